//! Values over two parameters, as a picture.

use core::fmt::Write;

use maud::{Markup, html};

use super::number::tenths;
use super::words;
use super::{Drawing, Shade};

const CELL_HEIGHT: f64 = 30.0;
const LEAST_CELL_WIDTH: f64 = 46.0;

/// Distance between the lines of a hatching, user units.
const HATCH: f64 = 5.0;

/// Text of a cell that is completely hatched.
const NONE: &str = "–";

/// A table of values as a picture, with one parameter across and another down. Each value is
/// written in its cell and shown by the depth of its colour.
///
/// ```
/// use tolman_draw::{HeatMap, Shade};
///
/// let success = vec![vec![40.0, 68.0], vec![72.0, f64::NAN]];
/// let map = HeatMap {
///     across: "corridor width (m)".into(),
///     columns: vec!["0.5".into(), "0.6".into()],
///     down: "beams".into(),
///     rows: vec!["36".into(), "72".into()],
///     shade: Shade::of("success %", success.concat()),
///     values: success,
///     hatching: None,
/// };
/// let drawing = map.drawing("Success by width and beams.");
/// # assert!(drawing.body.into_string().contains(">72<"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Quantity of the columns.
    pub across: String,
    /// The columns, from left to right.
    pub columns: Vec<String>,
    /// Quantity of the rows.
    pub down: String,
    /// The rows, from the top.
    pub rows: Vec<String>,
    /// Values by row and column. A value that is not finite or missing leaves its cell empty.
    pub values: Vec<Vec<f64>>,
    /// Colours of values.
    pub shade: Shade,
    /// Part of each cell that is hatched; `None` for no hatching.
    pub hatching: Option<Hatching>,
}

/// Hatched parts of the cells of a [`HeatMap`]. They show which share of the data behind a value is
/// of another kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Hatching {
    /// Meaning of a hatched part, in a few words.
    pub title: String,
    /// Hatched share by row and column, 0 … 1. A completely hatched cell shows a dash instead of
    /// its value.
    pub shares: Vec<Vec<f64>>,
}

impl Hatching {
    fn share(&self, row: usize, column: usize) -> f64 {
        let share = self.shares.get(row).and_then(|row| row.get(column));
        share.copied().unwrap_or(0.0).clamp(0.0, 1.0)
    }

    /// Returns the width of [`Self::legend`].
    fn width(&self) -> f64 {
        40.0 + words::width(&self.title)
    }

    fn legend(&self, x: f64, y: f64) -> Markup {
        html! {
            path class="hatch" d=(hatch([x, y], [22.0, 10.0])) {}
            text class="quiet" x=(tenths(x + 30.0)) y=(tenths(y + 8.0)) { (self.title) }
        }
    }
}

fn words_of(name: &str) -> Vec<String> {
    name.split_whitespace().map(str::to_owned).collect()
}

/// Returns slanted lines in a rectangle, and its outline, as path data. It uses no SVG pattern,
/// whose name would be global to the page.
fn hatch([x, y]: [f64; 2], [width, height]: [f64; 2]) -> String {
    let mut path = format!(
        "M{} {}h{}v{}h{}z",
        tenths(x),
        tenths(y),
        tenths(width),
        tenths(height),
        tenths(-width)
    );
    let mut foot = HATCH;
    while foot < width + height {
        // From the bottom or right edge up to the left or top edge.
        let low = (foot - width).max(0.0);
        let high = foot.min(height);
        let line = [x + foot - low, y + low, x + foot - high, y + high].map(tenths);
        let _ = write!(path, "M{} {}L{} {}", line[0], line[1], line[2], line[3]);
        foot += HATCH;
    }
    path
}

impl HeatMap {
    /// Returns the finished picture. `description` describes it in words.
    pub fn drawing(&self, description: impl Into<String>) -> Drawing {
        let widest = |texts: &[String]| texts.iter().map(|t| words::width(t)).fold(0.0, f64::max);
        let written = self
            .values
            .iter()
            .flatten()
            .filter(|value| value.is_finite());
        let written: Vec<String> = written.map(|value| self.shade.text(*value)).collect();
        // One word per line: a column is as narrow as its longest word.
        let names: Vec<Vec<String>> = self.columns.iter().map(|name| words_of(name)).collect();
        let lines = names.iter().map(Vec::len).max().unwrap_or(1).max(1);
        let cell = (widest(&names.concat()).max(widest(&written)) + 14.0).max(LEAST_CELL_WIDTH);
        let left = widest(&self.rows).max(words::width(&self.down)) + 12.0;
        // The title of the columns, then their names.
        let top = (1.0 + lines as f64) * words::LINE + 8.0;
        let (columns, rows) = (self.columns.len() as f64, self.rows.len() as f64);
        let bottom = top + rows * CELL_HEIGHT;
        let legend = 140.0 + words::width(&self.shade.title);
        let hatched = self.hatching.as_ref().map_or(0.0, Hatching::width);
        let share = |row: usize, column: usize| {
            let hatching = self.hatching.as_ref();
            hatching.map_or(0.0, |hatching| hatching.share(row, column))
        };
        let cells = self.rows.iter().enumerate().flat_map(|(row, _)| {
            let value = move |column: usize| self.values.get(row)?.get(column).copied();
            let columns = (0..self.columns.len()).map(move |column| (column, value(column)));
            columns.filter_map(move |(column, value)| {
                let value = value.filter(|v| v.is_finite())?;
                Some((row as f64, column as f64, value, share(row, column)))
            })
        });
        let body = html! {
            text class="quiet" x=(tenths(left)) y="11" { (self.across) }
            text class="quiet" x="0" y=(tenths(top - 7.0)) { (self.down) }
            @for (i, name) in names.iter().enumerate() {
                @for (above, word) in name.iter().rev().enumerate() {
                    text x=(tenths(left + (i as f64 + 0.5) * cell)) y=(tenths(top - 7.0 - above as f64 * words::LINE))
                        text-anchor="middle" { (word) }
                }
            }
            @for (i, row) in self.rows.iter().enumerate() {
                text x=(tenths(left - 8.0)) y=(tenths(top + (i as f64 + 0.5) * CELL_HEIGHT))
                    text-anchor="end" dominant-baseline="central" { (row) }
            }
            g class=(self.shade.series.class()) {
                @for (row, column, value, hatched) in cells {
                    @let (x, y) = (left + column * cell, top + row * CELL_HEIGHT);
                    @let (width, height) = (cell - 2.0, CELL_HEIGHT - 2.0);
                    // Hatched from the right, so that the rest is as wide as its share.
                    @let rest = width * (1.0 - hatched);
                    @if rest > 0.0 {
                        rect class="heat" fill-opacity=(self.shade.opacity(value))
                            x=(tenths(x + 1.0)) y=(tenths(y + 1.0)) rx="3"
                            width=(tenths(rest)) height=(tenths(height)) {}
                    }
                    @if hatched > 0.0 {
                        path class="hatch" d=(hatch([x + 1.0 + rest, y + 1.0], [width - rest, height])) {}
                    }
                    @let text = if rest > 0.0 { self.shade.text(value) } else { NONE.to_owned() };
                    text class=(self.shade.text_class(value)) text-anchor="middle"
                        dominant-baseline="central" x=(tenths(x + 0.5 * cell))
                        y=(tenths(y + 0.5 * CELL_HEIGHT)) { (text) }
                }
            }
            (self.shade.legend(left, bottom + 10.0))
            @if let Some(hatching) = &self.hatching { (hatching.legend(left + legend + 16.0, bottom + 10.0)) }
        };
        Drawing {
            width: left + (columns * cell).max(legend + hatched),
            height: bottom + 10.0 + Shade::LEGEND,
            description: description.into(),
            body,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finite_value_has_a_cell_in_its_row_and_column() {
        let map = HeatMap {
            across: "a < b".into(),
            columns: vec!["1".into(), "2".into(), "3".into()],
            down: "y".into(),
            rows: vec!["p".into(), "q".into()],
            values: vec![vec![1.0, f64::NAN, 3.0], vec![5.0]],
            shade: Shade::new("v", 1.0, 5.0),
            hatching: None,
        };
        let drawing = map.drawing("a test");
        let svg = drawing.body.into_string();
        assert_eq!(svg.matches("rx=\"3\"").count(), 3);
        // The third column of the first row, the first of the second; names are one character wide.
        let (left, top) = (words::width("p") + 12.0, 2.0 * words::LINE + 8.0);
        for (row, column) in [(0.0, 2.0), (1.0, 0.0)] {
            let (x, y) = (
                left + 1.0 + column * LEAST_CELL_WIDTH,
                top + 1.0 + row * CELL_HEIGHT,
            );
            let place = format!("x=\"{}\" y=\"{}\"", tenths(x), tenths(y));
            assert!(svg.contains(&place), "{place} in {svg}");
        }
        assert!(roxmltree::Document::parse(&format!("<g>{svg}</g>")).is_ok());
    }

    #[test]
    fn a_name_of_several_words_stands_on_as_many_lines_above_its_column() {
        let width = |columns: [&str; 2]| {
            let map = HeatMap {
                across: "x".into(),
                columns: columns.map(str::to_owned).into(),
                down: "y".into(),
                rows: vec!["p".into()],
                values: vec![vec![1.0, 2.0]],
                shade: Shade::new("v", 1.0, 2.0),
                hatching: None,
            };
            let drawing = map.drawing("a test");
            (drawing.height, drawing.body.into_string())
        };
        let (one, _) = width(["rooms", "star"]);
        let (two, svg) = width(["braided rooms", "star"]);
        assert!((two - one - words::LINE).abs() < 1e-9, "{one} {two}");
        assert!(
            svg.contains(">braided<") && svg.contains(">rooms<"),
            "{svg}"
        );
    }

    #[test]
    fn what_is_hatched_is_told_from_a_value_of_nothing() {
        let map = HeatMap {
            across: "x".into(),
            columns: vec!["1".into(), "2".into(), "3".into()],
            down: "y".into(),
            rows: vec!["p".into()],
            values: vec![vec![0.0, 0.0, 50.0]],
            shade: Shade::new("v", 0.0, 100.0),
            hatching: Some(Hatching {
                title: "not tried".into(),
                shares: vec![vec![0.0, 1.0, 0.5]],
            }),
        };
        let svg = map.drawing("a test").body.into_string();
        // The cells that are not completely hatched, those hatched in part, and the legend.
        assert_eq!(svg.matches("rx=\"3\"").count(), 2);
        assert_eq!(svg.matches("class=\"hatch\"").count(), 3);
        assert!(svg.contains(">–<") && svg.contains(">not tried<"), "{svg}");
        assert_eq!(
            svg.matches(">0<").count(),
            2,
            "a cell and the end of the shades"
        );
        assert!(roxmltree::Document::parse(&format!("<g>{svg}</g>")).is_ok());
    }

    #[test]
    fn lines_of_a_hatching_stay_in_their_rectangle() {
        let path = hatch([10.0, 20.0], [12.0, 7.0]);
        for line in path.split('M').skip(2) {
            let numbers = line.split(['L', ' ']).map(|n| n.parse::<f64>().unwrap());
            let numbers: Vec<f64> = numbers.collect();
            for point in numbers.chunks(2) {
                assert!((10.0..=22.0).contains(&point[0]), "{path}");
                assert!((20.0..=27.0).contains(&point[1]), "{path}");
            }
        }
    }
}
