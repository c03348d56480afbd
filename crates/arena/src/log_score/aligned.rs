use tolman_geom::{Heading, Point, Pose, Vector};

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
    ///
    /// Source: S. Umeyama: Least-Squares Estimation of Transformation Parameters, 1991, in the
    /// plane and without scale.
    #[must_use]
    pub fn of(pairs: &[(Point, Point)]) -> Option<Self> {
        if pairs.is_empty() {
            return None;
        }
        let count = pairs.len() as f64;
        let middle = |side: fn(&(Point, Point)) -> Point| {
            let sum: Vector = pairs.iter().map(|pair| side(pair).coords).sum();
            sum / count
        };
        let (found, truth) = (middle(|pair| pair.0), middle(|pair| pair.1));
        let (mut sin, mut cos) = (0.0, 0.0);
        for (a, b) in pairs {
            let (a, b) = (a.coords - found, b.coords - truth);
            sin += a.perp(&b);
            cos += a.dot(&b);
        }
        let heading = Heading::from_radians(libm::atan2(sin, cos));
        let truth_from_found = Pose::new(Point::from(truth - heading.rotate(found)), heading);
        let off = |(a, b): &(Point, Point)| (truth_from_found.transform(*a) - b).norm();
        let squares: f64 = pairs.iter().map(|pair| off(pair) * off(pair)).sum();
        Some(Self {
            pairs: pairs.len(),
            rms: libm::sqrt(squares / count),
            largest: pairs.iter().map(off).fold(0.0, f64::max),
            truth_from_found,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

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
