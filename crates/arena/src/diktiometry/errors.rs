//! Measures errors as the paper does: by the a-posteriori position error.

use tolman_geom::{Point, PointBox, Vector};
use tolman_maps::diktiometry::StepReport;

/// Squared distances of one move between the robot's true motion and the expected motion, m².
///
/// "We measure this by calculating the sum-of-squared-distance (SSD) between the robot's actual
/// relative motion and predicted relative motion for each track after a move."
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveError {
    /// Error of the map, the mean over all tracks. A track that expected nothing counts with its
    /// odometry.
    pub map: f64,
    /// Error of the middle of the odometry's box alone.
    pub odometry: f64,
    /// The share of the tracks that expected something.
    pub coverage: f64,
}

impl MoveError {
    /// Returns the errors of a move that the observer reported. `moved` is its odometry and `truth`
    /// its true displacement.
    #[must_use]
    pub fn of(report: &StepReport, moved: PointBox, truth: Vector) -> Self {
        let square = |middle: Point| (middle.coords - truth).norm_squared();
        let odometry = square(moved.middle());
        let expected = report.tracks.iter().map(|track| {
            let predicted = track.predicted.and_then(|predicted| predicted.displacement);
            predicted.map(PointBox::middle).map(square)
        });
        let expected: Vec<Option<f64>> = expected.collect();
        let tracks = expected.len() as f64;
        let errors = expected.iter().map(|error| error.unwrap_or(odometry));
        let covered = expected.iter().flatten().count() as f64;
        Self {
            map: if tracks > 0.0 {
                errors.sum::<f64>() / tracks
            } else {
                odometry
            },
            odometry,
            coverage: covered / tracks.max(1.0),
        }
    }
}

/// Summary of a run's errors. See `docs/notebook/diktiometry.md` for the definitions.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSummary {
    /// The mean error per move by the map over the last [`TAIL`] of all moves, m².
    pub asymptote: f64,
    /// The mean error per move by odometry over all moves, m².
    pub odometry: f64,
    /// Number of moves after which the mean over a [`WINDOW`] of moves is [`NEAR`] the run's own
    /// asymptote, and stays so. All moves if it never is.
    pub moves_to_own: usize,
    /// The mean error by the map over each successive [`WINDOW`] of moves, m².
    pub curve: Vec<f64>,
    /// Errors of the odometry alone.
    pub odometry_curve: Vec<f64>,
    /// The share of expectations over the last [`TAIL`] of all moves.
    pub coverage: f64,
}

/// Number of moves in a window.
pub const WINDOW: usize = 25;
/// Last part of a run that counts as asymptotic, as a share of its moves.
pub const TAIL: f64 = 0.25;
/// Margin above the asymptote that counts as near, as a share of the odometry's error.
pub const NEAR: f64 = 0.2;

impl ErrorSummary {
    /// Sums up the errors of a run, window by window. Moves beyond the last full window belong to
    /// none. `None` if no move was made.
    #[must_use]
    pub fn of(errors: &[MoveError]) -> Option<Self> {
        let mean = |part: &[MoveError], value: fn(&MoveError) -> f64| {
            part.iter().map(value).sum::<f64>() / part.len() as f64
        };
        if errors.is_empty() {
            return None;
        }
        let tail = ((errors.len() as f64 * TAIL) as usize).max(1);
        let last = &errors[errors.len() - tail..];
        let windows = errors.chunks_exact(WINDOW.min(errors.len()));
        let curve = |value| -> Vec<f64> { windows.clone().map(|part| mean(part, value)).collect() };
        let asymptote = mean(last, |error| error.map);
        let odometry = mean(errors, |error| error.odometry);
        let by_map = curve(|error| error.map);
        let limit = asymptote + NEAR * odometry;
        let late = by_map.iter().rposition(|error| *error > limit);
        let windows_to_own = late.map_or(1, |window| window + 2);
        Some(Self {
            asymptote,
            odometry,
            moves_to_own: (windows_to_own * WINDOW).min(errors.len()),
            curve: by_map,
            odometry_curve: curve(|error| error.odometry),
            coverage: mean(last, |error| error.coverage),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_asymptote_is_the_last_quarter_and_the_curve_goes_by_windows() {
        // High for 60 moves, then low; ten moves more than a window has.
        let run: Vec<MoveError> = (0..410)
            .map(|number| MoveError {
                map: if number < 60 { 2.0 } else { 0.1 },
                odometry: 0.5,
                coverage: if number < 205 { 0.0 } else { 1.0 },
            })
            .collect();
        let summary = ErrorSummary::of(&run).unwrap();
        assert!((summary.asymptote - 0.1).abs() < 1e-12);
        assert!((summary.odometry - 0.5).abs() < 1e-12);
        // The third window, moves 50 to 75, is still too high.
        assert_eq!(summary.moves_to_own, 100);
        assert!((summary.coverage - 1.0).abs() < 1e-12);
        assert_eq!(summary.curve.len(), 16);
        // Ten of the third window's moves are high.
        let third = (10.0 * 2.0 + 15.0 * 0.1) / 25.0;
        assert!((summary.curve[1] - 2.0).abs() < 1e-12);
        assert!((summary.curve[2] - third).abs() < 1e-12);
        assert!((summary.odometry_curve[2] - 0.5).abs() < 1e-12);
        assert!(ErrorSummary::of(&[]).is_none());
    }

    #[test]
    fn a_relapse_counts_and_a_flat_run_is_there_at_once() {
        let to_own = |errors: &[f64]| {
            let errors: Vec<MoveError> = errors
                .iter()
                .map(|map| MoveError {
                    map: *map,
                    odometry: 0.5,
                    coverage: 1.0,
                })
                .collect();
            ErrorSummary::of(&errors).unwrap().moves_to_own
        };
        let mut errors = [0.1; 400];
        assert_eq!(to_own(&errors), WINDOW);
        errors[200..210].fill(2.0);
        assert_eq!(to_own(&errors), 250);
        errors[399] = 9.0;
        assert_eq!(to_own(&errors), 400);
    }
}
