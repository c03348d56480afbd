//! Values shown as depths of a colour.

use maud::{Markup, html};

use super::Series;
use super::number::{NOTHING, extent, tenths};

/// Depth of one colour by value: none at the low end, full at the high end. It works on light and
/// dark pages alike, and one colour shows more and less to every reader.
///
/// ```
/// use tolman_draw::{FloorPlan, Series, Shade};
/// use tolman_geom::Point;
///
/// let visits = [(Point::new(0.5, 0.5), 3.0), (Point::new(1.5, 0.5), 12.0)];
/// let shade = Shade::of("visits", visits.map(|(_, count)| count)).series(Series(1));
/// assert_eq!((shade.low, shade.high), (3.0, 12.0));
/// let wall = [Point::new(0.0, 0.0), Point::new(2.0, 0.0)];
/// let mut plan = FloorPlan::of_walls(&[wall], 200.0);
/// plan.cells(&visits, 1.0, &shade);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Shade {
    /// Name of the shown quantity, with its unit.
    pub title: String,
    /// Value that is drawn without colour.
    pub low: f64,
    /// Value with the full colour.
    pub high: f64,
    /// Series whose colour the values are shades of.
    pub series: Series,
    /// Number of decimals of values.
    pub decimals: u8,
}

impl Shade {
    /// Returns the shade of the first colour between two values, which are written without
    /// decimals.
    pub fn new(title: impl Into<String>, low: f64, high: f64) -> Self {
        Self {
            title: title.into(),
            low,
            high,
            series: Series(0),
            decimals: 0,
        }
    }

    /// Returns the shade from the minimum to the maximum of these values. Non-finite values are
    /// ignored.
    pub fn of(title: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Self {
        let finite = values.into_iter().filter(|value| value.is_finite());
        let (low, high) = extent(finite, NOTHING);
        if low <= high {
            Self::new(title, low, high)
        } else {
            Self::new(title, 0.0, 1.0)
        }
    }

    /// Sets the colour.
    #[must_use]
    pub const fn series(mut self, series: Series) -> Self {
        self.series = series;
        self
    }

    /// Sets the number of decimals.
    #[must_use]
    pub const fn decimals(mut self, decimals: u8) -> Self {
        self.decimals = decimals;
        self
    }

    /// Returns a value as text.
    pub(super) fn text(&self, value: f64) -> String {
        format!("{value:.0$}", usize::from(self.decimals))
    }

    /// Returns the depth from 0 to 1; 0 if the range is empty.
    fn share(&self, value: f64) -> f64 {
        let share = (value - self.low) / (self.high - self.low);
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    /// Returns the attribute that gives an element with the class `heat` its depth.
    pub(super) fn opacity(&self, value: f64) -> String {
        // Text on it must be readable at full depth, and the smallest value must still look
        // coloured.
        format!("{:.2}", 0.06 + 0.84 * self.share(value))
    }

    /// Returns the class of text on a value. On deep colours it has a halo: neither black nor white
    /// is easy to read on all of them, on a light and on a dark page.
    pub(super) fn text_class(&self, value: f64) -> &'static str {
        if self.share(value) > 0.4 { "halo" } else { "" }
    }

    /// The height of [`Self::legend`].
    pub(super) const LEGEND: f64 = 34.0;

    /// Returns a bar of all depths with labelled ends, from `x` on.
    pub(super) fn legend(&self, x: f64, y: f64) -> Markup {
        const STEPS: u32 = 24;
        const STEP: f64 = 5.0;
        let width = f64::from(STEPS) * STEP;
        html! {
            g class=(self.series.class()) {
                @for step in 0..STEPS {
                    @let value = self.low + (self.high - self.low) * (f64::from(step) + 0.5) / f64::from(STEPS);
                    rect class="heat" fill-opacity=(self.opacity(value)) width=(tenths(STEP)) height="9"
                        x=(tenths(x + STEP * f64::from(step))) y=(tenths(y)) {}
                }
                text class="quiet small" x=(tenths(x)) y=(tenths(y + 21.0)) { (self.text(self.low)) }
                text class="quiet small" x=(tenths(x + width)) y=(tenths(y + 21.0)) text-anchor="end" {
                    (self.text(self.high))
                }
                text class="quiet" x=(tenths(x + width + 10.0)) y=(tenths(y + 8.0)) { (self.title) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_deeper_and_ends_are_kept() {
        let shade = Shade::of("steps", [3.0, f64::NAN, 7.0]);
        let depths: Vec<f64> = [2.0, 3.0, 5.0, 7.0, 9.0]
            .map(|value| shade.opacity(value).parse().unwrap())
            .to_vec();
        assert_eq!(depths, [0.06, 0.06, 0.48, 0.9, 0.9]);
        assert_eq!((shade.text_class(4.0), shade.text_class(5.0)), ("", "halo"));
    }

    #[test]
    fn nothing_and_one_value_have_a_shade() {
        assert_eq!(Shade::of("nothing", []).opacity(0.5), "0.48");
        assert_eq!(Shade::of("one", [4.0]).opacity(4.0), "0.06");
        assert_eq!(Shade::of("one", [4.0]).opacity(f64::NAN), "0.06");
    }
}
