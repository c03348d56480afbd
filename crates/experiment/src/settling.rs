//! When the mean curve of a row settles.

/// The settling time of control theory: from when on the mean of all runs' curves stays at or below
/// a limit that all rows of the table share.
///
/// The limit is the lowest mean of `level` among the rows, and `margin` times the mean of `scale`
/// in the row `of` above it. Rows whose runs lack one of the three fields have no part in it. The
/// value is the end of the first step from which on no step's mean is above the limit; where the
/// last one is, the row does not settle, and the value is the length of the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Settling {
    /// A field that holds numbers at equal steps.
    pub curve: String,
    /// Amount of the metric's unit per number of the curve.
    pub step: f64,
    /// A numeric field: where a run's curve ends up.
    pub level: String,
    /// Distance of the limit above the lowest level, as a share of `scale`.
    pub margin: f64,
    /// A numeric field: what the margin is a share of.
    pub scale: String,
    /// The row whose scale counts.
    pub of: String,
}

/// Whether something came about that a metric waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// It did.
    Yes,
    /// Not before the end: the value is only what it is more than.
    No,
}

/// Returns when the mean of curves settles at or below a limit, and whether it does. A curve that
/// ends early counts as far as it goes.
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
        // At once, in the third step, after a relapse.
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
