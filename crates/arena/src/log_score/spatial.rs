use tolman_geom::Point;
use tolman_geom::nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

use crate::gngslam::rigid_motion;

/// How a trajectory is laid over the true one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrajectoryAlignment {
    /// By a turn about the vertical and a shift.
    Plane,
    /// By any turn and a shift.
    Space,
    /// By any turn, a shift and a scale: for a camera that knows no lengths.
    Scale,
    /// Not at all.
    None,
}

/// Errors of a trajectory whose poses were matched with those of a true one: absolute after
/// alignment, and relative over some poses.
///
/// Source: S. Umeyama: Least-Squares Estimation of Transformation Parameters, 1991. M. Grupp: evo.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialScore {
    /// Distances of positions from the true ones, m.
    pub absolute: ErrorStatistics,
    /// Lengths of the errors of moves over the given number of poses, m; without errors if there
    /// are too few poses.
    pub relative: ErrorStatistics,
    /// Root of the mean square of the turns of these moves' errors, rad.
    pub relative_turn_rms: f64,
    /// Scale of the alignment.
    pub scale: f64,
}

/// A list of errors in short.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorStatistics {
    /// Number of errors.
    pub count: usize,
    /// Root of the mean square.
    pub rms: f64,
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Smallest error.
    pub least: f64,
    /// Greatest error.
    pub largest: f64,
}

/// A found pose and the true one.
pub type PosePair = (Isometry3<f64>, Isometry3<f64>);

impl SpatialScore {
    /// Minimum number of pairs of a score: fewer can be laid over any others.
    pub const FEWEST: usize = 3;

    /// Returns the score of pairs; `None` if there are fewer than three. `step` is the number of
    /// poses over which relative errors are measured, at least 1. O(pairs · log pairs).
    #[must_use]
    pub fn of(pairs: &[PosePair], alignment: TrajectoryAlignment, step: usize) -> Option<Self> {
        if pairs.len() < Self::FEWEST {
            return None;
        }
        let (truth_from_found, scale) = alignment.of(pairs);
        let moved = |pose: &Isometry3<f64>| {
            let mut scaled = *pose;
            scaled.translation.vector *= scale;
            truth_from_found * scaled
        };
        let off = pairs.iter().map(|(found, truth)| {
            (moved(found).translation.vector - truth.translation.vector).norm()
        });
        let absolute = ErrorStatistics::of(off.collect());
        let every: Vec<&PosePair> = pairs.iter().step_by(step.max(1)).collect();
        let errors = every.windows(2).map(|two| {
            let [found, truth] = [
                moved(&two[0].0).inv_mul(&moved(&two[1].0)),
                two[0].1.inv_mul(&two[1].1),
            ];
            truth.inv_mul(&found)
        });
        let errors: Vec<Isometry3<f64>> = errors.collect();
        let turns = errors.iter().map(|error| error.rotation.angle());
        let lengths = errors.iter().map(|error| error.translation.vector.norm());
        Some(Self {
            absolute,
            relative: ErrorStatistics::of(lengths.collect()),
            relative_turn_rms: ErrorStatistics::of(turns.collect()).rms,
            scale,
        })
    }
}

impl TrajectoryAlignment {
    /// Returns the motion from the found frame to the true one, and the scale before it.
    fn of(self, pairs: &[PosePair]) -> (Isometry3<f64>, f64) {
        match self {
            Self::None => (Isometry3::identity(), 1.0),
            Self::Plane => (planar(pairs), 1.0),
            Self::Space => umeyama(pairs, false),
            Self::Scale => umeyama(pairs, true),
        }
    }
}

/// Returns the mean position of the found poses and of the true ones.
fn means(pairs: &[PosePair]) -> (Vector3<f64>, Vector3<f64>) {
    let zero = Vector3::zeros();
    let (from, to) = pairs.iter().fold((zero, zero), |sum, (found, truth)| {
        (
            sum.0 + found.translation.vector,
            sum.1 + truth.translation.vector,
        )
    });
    let count = pairs.len() as f64;
    (from / count, to / count)
}

fn planar(pairs: &[PosePair]) -> Isometry3<f64> {
    let on_floor = |pose: &Isometry3<f64>| Point::from(pose.translation.vector.xy());
    let points: Vec<(Point, Point)> = (pairs.iter())
        .map(|(found, truth)| (on_floor(found), on_floor(truth)))
        .collect();
    let motion = rigid_motion(&points);
    let (from, to) = means(pairs);
    let at = motion.position.coords;
    Isometry3::new(
        Vector3::new(at.x, at.y, to.z - from.z),
        Vector3::z() * motion.heading.radians(),
    )
}

fn umeyama(pairs: &[PosePair], is_scaled: bool) -> (Isometry3<f64>, f64) {
    let (from, to) = means(pairs);
    let count = pairs.len() as f64;
    let (mut covariance, mut variance) = (Matrix3::zeros(), 0.0);
    for (found, truth) in pairs {
        let (a, b) = (
            found.translation.vector - from,
            truth.translation.vector - to,
        );
        covariance += b * a.transpose() / count;
        variance += a.norm_squared() / count;
    }
    let svd = covariance.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
        return (
            Isometry3::translation(to.x - from.x, to.y - from.y, to.z - from.z),
            1.0,
        );
    };
    let mut sign = Vector3::new(1.0, 1.0, 1.0);
    if u.determinant() * v_t.determinant() < 0.0 {
        // The direction of least extent is turned round: a reflection is no motion.
        sign[svd.singular_values.imin()] = -1.0;
    }
    let rotation = u * Matrix3::from_diagonal(&sign) * v_t;
    let scale = match is_scaled && variance > 0.0 {
        true => svd.singular_values.component_mul(&sign).sum() / variance,
        false => 1.0,
    };
    let shift = to - rotation * from * scale;
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    let turned = UnitQuaternion::from_rotation_matrix(&rotation);
    (Isometry3::from_parts(shift.into(), turned), scale)
}

impl ErrorStatistics {
    fn of(mut errors: Vec<f64>) -> Self {
        errors.sort_by(f64::total_cmp);
        let (Some(least), Some(largest)) = (errors.first(), errors.last()) else {
            return Self::default();
        };
        let count = errors.len();
        let mean = errors.iter().sum::<f64>() / count as f64;
        let square = errors.iter().map(|error| error * error).sum::<f64>() / count as f64;
        let spread = errors.iter().map(|error| (error - mean) * (error - mean));
        Self {
            count,
            rms: libm::sqrt(square),
            mean,
            median: 0.5 * (errors[(count - 1) / 2] + errors[count / 2]),
            sd: libm::sqrt(spread.sum::<f64>() / count as f64),
            least: *least,
            largest: *largest,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn way(numbers: &[(f64, f64, f64)]) -> Vec<Isometry3<f64>> {
        let poses = numbers.iter().map(|(x, y, z)| {
            Isometry3::new(Vector3::new(*x, *y, *z), Vector3::new(*y, *z, *x) * 0.1)
        });
        poses.collect()
    }

    proptest! {
        #[test]
        fn what_the_alignment_allows_costs_nothing(
            numbers in proptest::collection::vec((-9.0..9.0, -9.0..9.0, -9.0..9.0), 4..20),
            shift in proptest::array::uniform3(-5.0..5.0), turn in proptest::array::uniform3(-1.5..1.5), scale in 0.5..2.0,
        ) {
            let found = way(&numbers);
            let motion = Isometry3::new(Vector3::from(shift), Vector3::from(turn));
            let score = |scale: f64, motion: Isometry3<f64>, alignment| {
                let pairs: Vec<PosePair> = found.iter().map(|pose| {
                    let mut scaled = *pose;
                    scaled.translation.vector *= scale;
                    (*pose, motion * scaled)
                }).collect();
                SpatialScore::of(&pairs, alignment, 1).unwrap()
            };
            let space = score(1.0, motion, TrajectoryAlignment::Space);
            prop_assert!(space.absolute.largest < 1e-6 && space.relative.largest < 1e-6);
            let scaled = score(scale, motion, TrajectoryAlignment::Scale);
            prop_assert!(scaled.absolute.largest < 1e-6 && (scaled.scale - scale).abs() < 1e-6);
            let level = Isometry3::new(Vector3::from(shift), Vector3::z() * turn[0]);
            prop_assert!(score(1.0, level, TrajectoryAlignment::Plane).absolute.largest < 1e-6);
            let lifted = Isometry3::new(Vector3::z(), Vector3::zeros());
            let none = score(1.0, lifted, TrajectoryAlignment::None);
            prop_assert!((none.absolute.rms - 1.0).abs() < 1e-9);
            prop_assert!(none.relative.largest < 1e-9 && none.relative_turn_rms < 1e-6);
        }
    }
}
