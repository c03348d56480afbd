use tolman_geom::{Point, Pose};

use crate::gngslam::rigid_motion;

/// Distances of positions from those of another trajectory, after the best rigid motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignedScore {
    /// Pairs of positions.
    pub pairs: usize,
    /// Root of the mean squared distance, m.
    pub rms: f64,
    /// Greatest distance, m.
    pub largest: f64,
    /// Rigid motion from the first trajectory to the second.
    pub truth_from_found: Pose,
}

impl AlignedScore {
    /// Returns the score of pairs of a found and a true position; `None` if there are none.
    /// O(pairs).
    #[must_use]
    pub fn of(pairs: &[(Point, Point)]) -> Option<Self> {
        if pairs.is_empty() {
            return None;
        }
        let truth_from_found = rigid_motion(pairs);
        let off = |(a, b): &(Point, Point)| (truth_from_found.transform(*a) - b).norm();
        let squares: f64 = pairs.iter().map(|pair| off(pair) * off(pair)).sum();
        Some(Self {
            pairs: pairs.len(),
            rms: libm::sqrt(squares / pairs.len() as f64),
            largest: pairs.iter().map(off).fold(0.0, f64::max),
            truth_from_found,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Heading;

    use super::*;

    proptest! {
        #[test]
        fn a_turn_and_a_shift_cost_nothing(
            points in proptest::collection::vec((-9.0..9.0, -9.0..9.0), 2..20),
            x in -5.0..5.0, y in -5.0..5.0, turn in -3.0..3.0,
        ) {
            let moved = Pose::new(Point::new(x, y), Heading::from_radians(turn));
            let pairs: Vec<(Point, Point)> = (points.iter())
                .map(|(x, y): &(f64, f64)| (Point::new(*x, *y), moved.transform(Point::new(*x, *y))))
                .collect();
            let score = AlignedScore::of(&pairs).unwrap();
            prop_assert!(score.largest < 1e-9);
            // One position off by d is off by no more once all are aligned, root mean square.
            let mut pairs = pairs;
            pairs[0].0.x += 0.5;
            let score = AlignedScore::of(&pairs).unwrap();
            prop_assert!(score.rms <= 0.5 / (pairs.len() as f64).sqrt() + 1e-9);
        }
    }
}
