//! The paper's measure: the a-posteriori position error.

use tolman_geom::{Point, PointBox, Vector};
use tolman_maps::diktiometry::StepReport;

/// The squared distances of one move between how the robot truly moved and how it was expected to, m².
///
/// "We measure this by calculating the sum-of-squared-distance (SSD) between the robot's actual relative motion and
/// predicted relative motion for each track after a move."
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveError {
    /// By the map, the mean over all tracks; of a track that expected nothing, by the odometry.
    pub map: f64,
    /// By the middle of the odometry's box alone.
    pub odometry: f64,
    /// The share of the tracks that expected something.
    pub coverage: f64,
}

impl MoveError {
    /// The errors of a move that the observer reports so, whose odometry was `moved` and that truly was `truth`.
    #[must_use]
    pub fn of(report: &StepReport, moved: PointBox, truth: Vector) -> Self {
        let square = |middle: Point| (middle.coords - truth).norm_squared();
        let odometry = square(moved.middle());
        let expected = report.tracks.iter().map(|track| {
            let predicted = track.predicted.and_then(|predicted| predicted.displacement);
            predicted.map(PointBox::middle).map(square)
        });
        let (mut map, mut covered, mut tracks) = (0.0, 0.0, 0.0);
        for error in expected {
            map += error.unwrap_or(odometry);
            covered += f64::from(u8::from(error.is_some()));
            tracks += 1.0;
        }
        if tracks > 0.0 {
            (map, covered) = (map / tracks, covered / tracks);
        } else {
            map = odometry;
        }
        Self {
            map,
            odometry,
            coverage: covered,
        }
    }
}

/// What a run's errors come to. See `docs/diktiometry.md` for the definitions.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSummary {
    /// The mean error per move by the map over the last [`TAIL`] of all moves, m².
    pub asymptote: f64,
    /// The mean error per move by odometry over all moves, m².
    pub odometry: f64,
    /// Moves after which the mean over a [`WINDOW`] of moves is, and in every later window stays, within [`NEAR`] of the
    /// asymptote; all moves if it never is.
    pub moves_to_asymptote: usize,
    /// The mean over each successive window, m².
    pub curve: Vec<f64>,
    /// The share of expectations over the last [`TAIL`] of all moves.
    pub coverage: f64,
}

/// Moves in a window.
pub const WINDOW: usize = 25;
/// Moves are at their asymptote in this last share of a run.
pub const TAIL: f64 = 0.25;
/// What counts as near the asymptote: this share of the odometry's error above it.
pub const NEAR: f64 = 0.2;

impl ErrorSummary {
    /// Sums the errors of a run up, window by window; moves beyond the last full window belong to none. None if no move
    /// was made.
    #[must_use]
    pub fn of(errors: &[MoveError]) -> Option<Self> {
        let mean = |part: &[MoveError], value: fn(&MoveError) -> f64| {
            part.iter().map(value).sum::<f64>() / part.len() as f64
        };
        let by_map = |error: &MoveError| error.map;
        if errors.is_empty() {
            return None;
        }
        let tail = ((errors.len() as f64 * TAIL) as usize).max(1);
        let last = &errors[errors.len() - tail..];
        let asymptote = mean(last, by_map);
        let odometry = mean(errors, |error| error.odometry);
        let curve: Vec<f64> = errors
            .chunks_exact(WINDOW.min(errors.len()))
            .map(|window| mean(window, by_map))
            .collect();
        let limit = asymptote + NEAR * odometry;
        let late = curve.iter().rposition(|error| *error > limit);
        let windows = late.map_or(1, |window| window + 2);
        Some(Self {
            asymptote,
            odometry,
            moves_to_asymptote: (windows * WINDOW).min(errors.len()),
            curve,
            coverage: mean(last, |error| error.coverage),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(map: impl Iterator<Item = f64>) -> Vec<MoveError> {
        map.map(|map| MoveError {
            map,
            odometry: 0.5,
            coverage: 1.0,
        })
        .collect()
    }

    #[test]
    fn a_fall_to_an_asymptote_is_found() {
        // High for 60 moves, then low.
        let run = errors((0..400).map(|number| if number < 60 { 2.0 } else { 0.1 }));
        let summary = ErrorSummary::of(&run).unwrap();
        assert!((summary.asymptote - 0.1).abs() < 1e-12);
        // The third window, moves 50 to 75, is still too high on average.
        assert_eq!(summary.moves_to_asymptote, 100);
        assert_eq!(summary.curve.len(), 16);
    }

    #[test]
    fn a_relapse_counts() {
        let run = errors((0..400).map(|number| {
            if (200..210).contains(&number) {
                2.0
            } else {
                0.1
            }
        }));
        assert_eq!(ErrorSummary::of(&run).unwrap().moves_to_asymptote, 250);
    }

    #[test]
    fn a_flat_run_is_there_at_once_and_no_run_is_none() {
        let flat = ErrorSummary::of(&errors((0..100).map(|_| 0.1))).unwrap();
        assert_eq!(flat.moves_to_asymptote, WINDOW);
        assert!(ErrorSummary::of(&[]).is_none());
    }
}
