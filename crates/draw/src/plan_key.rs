//! The key below a plan: a scale bar, and the meaning of its signs.

use maud::{Markup, html};

use super::number::{tenths, trimmed};
use super::words;
use super::{NodeMark, Series};

/// Height of a line of the key, user units.
const LINE: f64 = 18.0;

/// Width of a sign, user units.
const SIGN: f64 = 18.0;

/// Longest scale bar, as a share of the plan's width.
const LONGEST: f64 = 0.25;

/// A sign that a key explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyMark {
    /// An open ring, for a node.
    Ring,
    /// A filled disc, for a node.
    Disc,
    /// An open square, for a node.
    Square,
    /// A line, for an edge or a way.
    Line,
    /// A dashed line, for doubtful things.
    Dashed,
    /// A box, for where something may be.
    Box,
}

/// The key of a plan.
#[derive(Clone, Debug, Default)]
pub(super) struct PlanKey {
    /// User units per metre; `None` for a plan without a scale bar.
    pub(super) scale: Option<f64>,
    pub(super) entries: Vec<(KeyMark, Series, String)>,
}

impl PlanKey {
    /// Returns the key in lines from `left` and `top`, and its height. Lines break before `width`
    /// where they can.
    pub(super) fn markup(&self, left: f64, top: f64, width: f64) -> (Markup, f64) {
        let bar = self.scale.and_then(|scale| bar(scale, width));
        if bar.is_none() && self.entries.is_empty() {
            return (html! {}, 0.0);
        }
        let (mut x, mut y) = (left, top + 0.5 * LINE + 2.0);
        let mut items = Vec::new();
        if let Some((metres, length)) = bar {
            let text = format!("{} m", trimmed(metres, 4));
            items.push(html! {
                path class="scale-bar" d={
                    "M" (tenths(x)) " " (tenths(y - 4.0)) "v8M" (tenths(x)) " " (tenths(y))
                    "h" (tenths(length)) "M" (tenths(x + length)) " " (tenths(y - 4.0)) "v8"
                } {}
                text class="quiet" x=(tenths(x + length + 6.0)) y=(tenths(y))
                    dominant-baseline="central" { (text) }
            });
            x += length + 6.0 + words::broad(&text) + 14.0;
        }
        for (mark, series, meaning) in &self.entries {
            let entry = SIGN + 4.0 + words::broad(meaning);
            if x > left && x + entry > width {
                (x, y) = (left, y + LINE);
            }
            items.push(html! {
                g class=(series.class()) { (sign(*mark, x, y)) }
                text class="quiet" x=(tenths(x + SIGN + 4.0)) y=(tenths(y))
                    dominant-baseline="central" { (meaning) }
            });
            x += entry + 14.0;
        }
        let markup = html! { g class="key" { @for item in items { (item) } } };
        (markup, y + 0.5 * LINE + 2.0 - top)
    }
}

/// Returns the length of a scale bar in metres and in user units; `None` if there is no room for a
/// bar. The metres are 1, 2 or 5 times a power of ten.
fn bar(scale: f64, width: f64) -> Option<(f64, f64)> {
    let longest = LONGEST * width / scale;
    if !longest.is_finite() || longest <= 0.0 {
        return None;
    }
    let power = libm::pow(10.0, libm::log10(longest).floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * power);
    let metres = steps.into_iter().find(|metres| *metres <= longest)?;
    Some((metres, metres * scale))
}

fn sign(mark: KeyMark, x: f64, y: f64) -> Markup {
    let node = |mark: NodeMark| mark.markup(None, (x + 0.5 * SIGN, y), 3.2, "");
    let line = |dashes: Option<&str>| {
        html! {
            path class="edge" stroke-dasharray=[dashes]
                d={ "M" (tenths(x)) " " (tenths(y)) "h" (tenths(SIGN)) } {}
        }
    };
    match mark {
        KeyMark::Ring => node(NodeMark::Ring),
        KeyMark::Disc => node(NodeMark::Disc),
        KeyMark::Square => node(NodeMark::Square),
        KeyMark::Line => line(None),
        KeyMark::Dashed => line(Some("4 3")),
        KeyMark::Box => html! {
            rect class="uncertain" x=(tenths(x)) y=(tenths(y - 5.0)) width=(tenths(SIGN)) height="10" {}
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_round_and_have_room() {
        for (scale, width, metres) in [
            (10.0, 400.0, 10.0),
            (33.0, 400.0, 2.0),
            (1000.0, 420.0, 0.1),
        ] {
            let (shown, length) = bar(scale, width).unwrap();
            assert!((shown - metres).abs() < 1e-9, "{shown} m, not {metres}");
            assert!(length <= LONGEST * width);
        }
        assert_eq!(bar(f64::NAN, 400.0), None);
    }

    #[test]
    fn entries_break_into_lines() {
        let entries = (0..6).map(|i| (KeyMark::Ring, Series(i), "a place of the map".to_owned()));
        let key = PlanKey {
            scale: None,
            entries: entries.collect(),
        };
        let (_, narrow) = key.markup(0.0, 0.0, 200.0);
        let (_, wide) = key.markup(0.0, 0.0, 2000.0);
        assert!(narrow > 5.0 * wide, "{narrow} {wide}");
        assert!(PlanKey::default().markup(0.0, 0.0, 200.0).1 <= 0.0);
    }
}
