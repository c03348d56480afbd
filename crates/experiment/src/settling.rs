//! When the mean curve of a row settles.

/// The settling time of control theory: the time from which the mean of all runs' curves stays at
/// or below a limit. All rows of the table share the limit.
///
/// The limit is the lowest mean of `level` among the rows, plus `margin` times the mean of `scale`
/// in the row `of`. Rows whose runs lack one of the three fields are ignored.
///
/// The value is the end of the first step after which no step's mean is above the limit. If the
/// last step is above it, the row does not settle, and the value is the length of the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Settling {
    /// Field that holds numbers at equally spaced steps.
    pub curve: String,
    /// Step between two numbers of the curve, in the metric's unit.
    pub step: f64,
    /// Numeric field: the level at which a run's curve ends.
    pub level: String,
    /// Distance of the limit above the lowest level, as a share of `scale`.
    pub margin: f64,
    /// Numeric field: the quantity of which the margin is a share.
    pub scale: String,
    /// Row from which the scale is taken.
    pub of: String,
}

/// Whether the event that a metric waits for happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reached {
    /// The event happened.
    #[default]
    Yes,
    /// The event did not happen before the end: the value is a lower bound.
    No,
}

/// Returns the time at which the mean of curves settles at or below a limit, and whether it does. A
/// curve that ends early counts up to its end.
pub(super) fn settles(curves: &[&[f64]], step: f64, limit: f64) -> (f64, Reached) {
    let length = curves.iter().map(|curve| curve.len()).max().unwrap_or(0);
    let above = |at: &usize| {
        let values = curves.iter().filter_map(|curve| curve.get(*at));
        let (mut sum, mut count) = (0.0, 0.0);
        for value in values {
            sum += value;
            count += 1.0;
        }
        sum > limit * count
    };
    let steps = match (0..length).rev().find(above) {
        None => 1,
        Some(last) => last + 2,
    };
    if steps > length {
        (length as f64 * step, Reached::No)
    } else {
        (steps as f64 * step, Reached::Yes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(curves: &[&[f64]], expect: f64, reached: Reached) {
        let (value, found) = settles(curves, 25.0, 1.0);
        assert!((value - expect).abs() < 1e-12, "{value} for {curves:?}");
        assert_eq!(found, reached, "{curves:?}");
    }

    #[test]
    fn the_mean_counts_and_a_relapse_too() {
        // It settles at once, in the third step, and after a relapse.
        check(&[&[0.5, 0.5, 0.5]], 25.0, Reached::Yes);
        check(&[&[3.0, 2.0, 0.5, 0.5]], 75.0, Reached::Yes);
        check(&[&[3.0, 0.5, 2.0, 0.5]], 100.0, Reached::Yes);
        // One run is above the limit where the mean is not.
        check(&[&[3.0, 1.5, 0.0], &[3.0, 0.0, 0.0]], 50.0, Reached::Yes);
    }

    #[test]
    fn a_row_that_does_not_settle_has_the_length_of_the_run() {
        check(&[&[3.0, 0.5, 2.0]], 75.0, Reached::No);
        check(&[], 0.0, Reached::No);
    }
}
