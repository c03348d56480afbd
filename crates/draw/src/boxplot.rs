//! Box plots with every run as a dot beside its box.

use maud::{Markup, html};

use super::number::{extent, tenths, trimmed};
use super::scale::Scale;
use super::words;
use super::{Drawing, Series};
use tolman_stats::{FiveNumbers, five_numbers};

/// Least width for the values at the axis, user units.
const LEFT: f64 = 52.0;
/// Height for the title of the value axis, user units.
const TOP: f64 = 30.0;
const PLOT_HEIGHT: f64 = 260.0;
const BOTTOM: f64 = 34.0;
/// Maximum number of characters in one line of a row's name below its box.
const NAME: usize = 18;
const SLOT: f64 = 128.0;
const BOX: f64 = 38.0;
/// Width for the dots beside a box, user units.
const DOTS: f64 = 44.0;
/// Distance of dots with nearly the same value, and the height of the band that they share, user
/// units.
const DOT: f64 = 3.2;

/// A run in a box plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// The measured value, kept with the dot as `data-value`.
    pub value: f64,
    /// The index of the run, kept with the dot as `data-run`.
    pub run: u32,
    /// The seed of the run, kept with the dot as `data-seed`.
    pub seed: u64,
}

/// The paper's mean and its spread, drawn beside the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperMark {
    /// Mean that the paper gives, in the unit of the value axis.
    pub mean: f64,
    /// The standard deviation; `None` if the paper gives none.
    pub sd: Option<f64>,
}

/// One box and its dots.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxGroup {
    /// Row of the table that the box shows. It is written below the box and kept with the dots as
    /// `data-row`.
    pub row: String,
    /// Series whose colour the box has.
    pub series: Series,
    /// The runs; non-finite values are left out.
    pub dots: Vec<Dot>,
    /// Value of the paper.
    pub paper: Option<PaperMark>,
}

/// A box plot: R-7 quartiles, and whiskers to the last datum within 1.5 interquartile ranges. Every
/// run is a dot beside its box. A diamond with a bar shows the paper's mean ± standard deviation.
///
/// The value axis begins at 0, or below the smallest value if that is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxPlot {
    /// Table that the plot shows, kept with the dots as `data-table`.
    pub table: String,
    /// Quantity on the value axis.
    pub axis: String,
    /// The boxes, from left to right.
    pub groups: Vec<BoxGroup>,
}

impl BoxPlot {
    /// Returns the finished picture.
    pub fn drawing(&self) -> Drawing {
        let names = self
            .groups
            .iter()
            .map(|group| words::lines(&group.row, NAME));
        let lines = names.map(|lines| lines.len()).max().unwrap_or(1).max(1);
        let height = TOP + PLOT_HEIGHT + BOTTOM + words::LINE * (lines - 1) as f64;
        let values = self.groups.iter().flat_map(|group| {
            let reach = group
                .paper
                .map(|paper| paper.mean + paper.sd.unwrap_or(0.0));
            group.dots.iter().map(|dot| dot.value).chain(reach)
        });
        let finite = values.filter(|value| value.is_finite());
        let (low, high) = extent(finite, (0.0, 0.0));
        let scale = match low < 0.0 {
            true => Scale::linear(1.04 * low, 1.04 * high, 5.0),
            false => Scale::up_to(high, 5.0),
        };
        let y = |value: f64| TOP + PLOT_HEIGHT * (1.0 - scale.share(value));
        let ticks = scale.ticks.iter();
        let left = ticks.fold(LEFT, |left, tick| left.max(words::broad(&tick.label) + 8.0));
        let boxes = left + SLOT * (self.groups.len().max(1) as f64) + 8.0;
        let width = boxes.max(words::broad(&self.axis));
        let body = html! {
            text class="quiet" x="0" y="12" { (self.axis) }
            @for tick in &scale.ticks {
                path class="grid" d={ "M" (tenths(left)) " " (tenths(y(tick.value))) "H" (tenths(width)) } {}
                text class="quiet" x=(tenths(left - 6.0)) y=(tenths(y(tick.value)))
                    text-anchor="end" dominant-baseline="central" { (tick.label) }
            }
            @for (i, group) in self.groups.iter().enumerate() {
                (self.group(group, left + SLOT * i as f64, &y))
            }
        };
        Drawing {
            width,
            height,
            description: self.describe(),
            body,
        }
    }

    fn group(&self, group: &BoxGroup, left: f64, y: &impl Fn(f64) -> f64) -> Markup {
        let middle = left + 24.0 + BOX / 2.0;
        let dots: Vec<Dot> = finite(&group.dots);
        let values: Vec<f64> = dots.iter().map(|dot| dot.value).collect();
        html! {
            g class=(group.series.class()) data-table=(self.table) data-row=(group.row) {
                (words::centred(&words::lines(&group.row, NAME), left + SLOT / 2.0, TOP + PLOT_HEIGHT + 20.0))
                @if let Some(paper) = group.paper { (paper_mark(paper, left + 12.0, y)) }
                @if let Ok(five) = five_numbers(&values) { (box_and_whiskers(&five, middle, y)) }
                g class="dots" {
                    @for (x, dot) in swarm(&dots, left + 24.0 + BOX + 8.0, y) {
                        circle cx=(tenths(x)) cy=(tenths(y(dot.value))) r="1.8"
                            data-run=(dot.run) data-seed=(dot.seed) data-value=(trimmed(dot.value, 4)) {}
                    }
                }
            }
        }
    }

    /// Returns a description of each box: number of runs, median, quartiles and whiskers.
    fn describe(&self) -> String {
        let mut text = format!(
            "Box plot of {} for each row of table {}.",
            self.axis, self.table
        );
        for group in &self.groups {
            let values: Vec<f64> = finite(&group.dots).iter().map(|dot| dot.value).collect();
            text += &match five_numbers(&values) {
                Ok(five) => format!(
                    " {}: {} runs, median {:.1}, quartiles {:.1} and {:.1}, whiskers {:.1} and {:.1}.",
                    group.row,
                    values.len(),
                    five.median,
                    five.lower_quartile,
                    five.upper_quartile,
                    five.lower_whisker,
                    five.upper_whisker
                ),
                Err(_) => format!(" {}: no runs.", group.row),
            };
        }
        text
    }
}

fn finite(dots: &[Dot]) -> Vec<Dot> {
    dots.iter()
        .copied()
        .filter(|dot| dot.value.is_finite())
        .collect()
}

fn box_and_whiskers(five: &FiveNumbers, middle: f64, y: &impl Fn(f64) -> f64) -> Markup {
    let (left, right) = (middle - BOX / 2.0, middle + BOX / 2.0);
    let (top, bottom) = (y(five.upper_quartile), y(five.lower_quartile));
    html! {
        path class="whisker" d={
            "M" (tenths(middle)) " " (tenths(y(five.upper_whisker))) "V" (tenths(top))
            "M" (tenths(middle)) " " (tenths(bottom)) "V" (tenths(y(five.lower_whisker)))
            "M" (tenths(middle - 8.0)) " " (tenths(y(five.upper_whisker))) "h16"
            "M" (tenths(middle - 8.0)) " " (tenths(y(five.lower_whisker))) "h16"
        } {}
        rect class="box" x=(tenths(left)) y=(tenths(top)) width=(tenths(BOX)) height=(tenths(bottom - top)) {}
        path class="median" d={ "M" (tenths(left)) " " (tenths(y(five.median))) "H" (tenths(right)) } {}
    }
}

fn paper_mark(paper: PaperMark, x: f64, y: &impl Fn(f64) -> f64) -> Markup {
    let middle = y(paper.mean);
    html! {
        @if let Some(sd) = paper.sd {
            path class="paper" d={
                "M" (tenths(x)) " " (tenths(y(paper.mean + sd)))
                "V" (tenths(y(paper.mean - sd).min(TOP + PLOT_HEIGHT)))
            } {}
        }
        path class="paper" d={ "M" (tenths(x)) " " (tenths(middle - 5.0)) "l5 5l-5 5l-5 -5Z" } {}
    }
}

/// Places the dots. Those in the same band of the value axis are side by side from `left` on, so
/// that a crowd looks wide. A crowd that is too wide is packed closer.
fn swarm(dots: &[Dot], left: f64, y: &impl Fn(f64) -> f64) -> Vec<(f64, Dot)> {
    let band = |dot: &Dot| (y(dot.value) / DOT).floor() as i64;
    let mut sorted = dots.to_vec();
    sorted.sort_by(|a, b| band(a).cmp(&band(b)).then(a.run.cmp(&b.run)));
    let mut placed = Vec::with_capacity(sorted.len());
    for crowd in sorted.chunk_by(|a, b| band(a) == band(b)) {
        let spacing = DOT.min(DOTS / crowd.len() as f64);
        let mut x = left;
        for dot in crowd {
            placed.push((x, *dot));
            x += spacing;
        }
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(values: &[f64]) -> BoxPlot {
        let dots = (0..).zip(values).map(|(run, &value)| Dot {
            value,
            run,
            seed: 100 + u64::from(run),
        });
        BoxPlot {
            table: "2 (J)".into(),
            axis: "steps".into(),
            groups: vec![BoxGroup {
                row: "Wall-follow".into(),
                series: Series(1),
                dots: dots.collect(),
                paper: Some(PaperMark {
                    mean: 91.8,
                    sd: Some(56.4),
                }),
            }],
        }
    }

    #[test]
    fn every_run_is_a_dot_with_its_run_and_seed() {
        let svg = plot(&[1.0, 2.0, 2.0, 3.0, 90.0])
            .drawing()
            .body
            .into_string();
        assert_eq!(svg.matches("<circle").count(), 5);
        for run in 0..5 {
            assert!(svg.contains(&format!("data-run=\"{run}\" data-seed=\"{}\"", 100 + run)));
        }
    }

    #[test]
    fn the_axis_takes_in_what_is_negative() {
        let svg = plot(&[-4.0, -2.0, 3.0]).drawing().body.into_string();
        let places = svg
            .split("cy=\"")
            .skip(1)
            .map(|rest| rest.split('"').next());
        let places: Vec<f64> = places
            .map(|place| place.unwrap().parse().unwrap())
            .collect();
        assert!(
            places.iter().all(|y| (TOP..=TOP + PLOT_HEIGHT).contains(y)),
            "{places:?}"
        );
    }

    #[test]
    fn crowds_stay_in_their_room() {
        let dots: Vec<Dot> = (0..1000)
            .map(|run| Dot {
                value: 200.0,
                run,
                seed: 0,
            })
            .collect();
        let placed = swarm(&dots, 10.0, &|value| value);
        assert!(placed.iter().all(|(x, _)| (10.0..10.0 + DOTS).contains(x)));
        assert!(placed.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn a_group_without_finite_runs_has_no_box() {
        let drawing = plot(&[f64::NAN]).drawing();
        assert!(drawing.description.contains("no runs"));
        assert!(!drawing.body.into_string().contains("class=\"box\""));
    }
}
