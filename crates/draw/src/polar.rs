//! Scans as seen from the robot.

use maud::{Markup, html};
use tolman_robot::{Ring, Scan};

use super::number::{line, tenths, trimmed};
use super::{Drawing, Series};

/// Margin around the outer ring for the ring's label, user units.
const MARGIN: f64 = 14.0;

/// Scans in polar coordinates: the robot in the middle, bearing 0 upwards, bearings growing
/// counter-clockwise as everywhere.
///
/// A filled outline joins the ends of the beams; a dot marks each beam that met something.
///
/// ```
/// use tolman_draw::{PolarPlot, Series, Tiles};
/// use tolman_robot::{Ring, Scan};
///
/// let mut scan = Scan::clear(Ring::full(36, 1.25));
/// scan.ranges[0] = 0.4;
/// let mut plot = PolarPlot::new(1.25, 160.0);
/// plot.scan(&scan, Series(0));
/// // A grid of such plots, each with a caption: the states of a quantizer.
/// let mut states = Tiles::new(4);
/// states.tile("state 1, won 12 times", plot.drawing("A wall ahead."));
/// let drawing = states.drawing("One state.");
/// # assert!(drawing.body.into_string().contains("won 12 times"));
/// ```
#[derive(Clone, Debug)]
pub struct PolarPlot {
    reach: f64,
    size: f64,
    layers: Vec<Markup>,
}

impl PolarPlot {
    /// Returns an empty plot, a square with sides of `size` user units, whose outer ring is at
    /// `reach` metres.
    pub const fn new(reach: f64, size: f64) -> Self {
        Self {
            reach,
            size,
            layers: Vec::new(),
        }
    }

    /// Adds a scan. Ranges that are not finite, or beyond the outer ring, are drawn to that ring.
    pub fn scan(&mut self, scan: &Scan, series: Series) {
        self.ranges(&scan.ring, &scan.ranges, series);
    }

    /// Adds one range for each beam of a ring, such as a prototype that a quantizer has learned.
    pub fn ranges(&mut self, ring: &Ring, ranges: &[f64], series: Series) {
        let beams = (0..ring.beams).zip(ranges);
        let ends = beams.map(|(beam, range)| (self.at(ring.bearing(beam), *range), *range));
        let reach = ring.max_range.min(self.reach);
        let met = ends.clone().filter(|(_, range)| *range < reach);
        // The outline of a fan ends at the robot, that of a full circle at its first beam.
        let turn = ring.spacing * f64::from(ring.beams);
        let middle =
            (turn < 0.99 * core::f64::consts::TAU).then_some((self.middle(), self.middle()));
        let outline = line(ends.map(|(end, _)| end).chain(middle));
        self.layers.push(html! {
            g class=(series.class()) {
                path class="outline" d={ (outline) "Z" } {}
                g class="points" {
                    @for ((x, y), _) in met { circle cx=(tenths(x)) cy=(tenths(y)) r="1.5" {} }
                }
            }
        });
    }

    /// Returns the finished picture. `description` describes it in words.
    pub fn drawing(self, description: impl Into<String>) -> Drawing {
        let middle = tenths(self.middle());
        let (half, full) = (0.5 * self.radius(), self.radius());
        let reach = format!("{} m", trimmed(self.reach, 2));
        let body = html! {
            circle class="grid" cx=(middle) cy=(middle) r=(tenths(full)) {}
            circle class="grid" cx=(middle) cy=(middle) r=(tenths(half)) {}
            path class="grid" d={
                "M" (middle) " " (tenths(MARGIN)) "v" (tenths(2.0 * full))
                "M" (tenths(MARGIN)) " " (middle) "h" (tenths(2.0 * full))
            } {}
            @for layer in &self.layers { (layer) }
            path class="robot" d={
                "M" (middle) " " (tenths(self.middle() - 5.0)) "l3.5 8h-7Z"
            } {}
            text class="quiet small" x=(tenths(self.size)) y="10" text-anchor="end" { (reach) }
        };
        Drawing {
            width: self.size,
            height: self.size,
            description: description.into(),
            body,
        }
    }

    fn middle(&self) -> f64 {
        0.5 * self.size
    }

    fn radius(&self) -> f64 {
        0.5 * self.size - MARGIN
    }

    /// Returns the end of a beam in the picture.
    fn at(&self, bearing: f64, range: f64) -> (f64, f64) {
        let share = range / self.reach;
        let share = if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            1.0
        };
        let (sin, cos) = libm::sincos(bearing);
        let r = share * self.radius();
        (self.middle() - r * sin, self.middle() - r * cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn svg(ring: Ring, ranges: &[f64]) -> String {
        let mut plot = PolarPlot::new(2.0, 2.0 * (100.0 + MARGIN));
        plot.ranges(&ring, ranges, Series(0));
        plot.drawing("a test").body.into_string()
    }

    #[test]
    fn ahead_is_up_and_bearings_grow_to_the_left() {
        let svg = svg(Ring::full(4, 2.0), &[1.0, 2.0, 0.5, f64::NAN]);
        assert!(
            svg.contains("class=\"outline\" d=\"M114 64L14 114L114 139L214 114Z\""),
            "{svg}"
        );
        assert_eq!(
            svg.matches("r=\"1.5\"").count(),
            2,
            "two beams met something"
        );
    }

    #[test]
    fn a_fan_closes_at_the_robot() {
        let ring = Ring::fan(3, core::f64::consts::PI, 2.0);
        assert!(svg(ring, &[2.0; 3]).contains("d=\"M214 114L114 14L14 114L114 114Z\""));
    }

    #[test]
    fn reaches_lose_their_zeros() {
        for (reach, expect) in [(1.25, "1.25"), (8.0, "8"), (2.5, "2.5"), (0.304, "0.3")] {
            assert_eq!(trimmed(reach, 2), expect);
        }
    }
}
