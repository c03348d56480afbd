//! Hypotheses of the robot's pose.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Heading, Point, Pose};

use super::Outline;
use super::fit::{Fit, fit};
use super::surfaces::Surface;
use super::wheels::Rolled;
use crate::tangent::difference;

/// One possible pose of the robot.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hypothesis {
    pub(super) pose: Pose,
    pub(super) covariance: Matrix3<f64>,
    /// Log-probability of the hypothesis, up to a constant.
    score: f64,
    /// Number of the robot's looks since the hypothesis was made.
    pub(super) looks: u32,
}

/// Initial standard deviations of a hypothesis, m and rad, about the pose of a place.
const SPREAD: (f64, f64) = (0.25, 0.25);

/// Number of headings of the hypotheses at each place.
const DIRECTIONS: u32 = 14;

/// Distance of two places below which they make only one hypothesis, m.
const APART: f64 = 0.4;

/// Difference from the best log-likelihood at which a hypothesis is dropped.
const HOPELESS: f64 = 12.0;

/// Distance below which two hypotheses are one, m and rad.
const SAME: (f64, f64) = (0.2, 0.2);

/// Factor by which the weight of earlier looks shrinks after each look, because no map is exactly
/// right.
const FORGETS: f64 = 0.95;

/// Weight of a look's evidence, relative to that for a map without errors.
const BELIEVES: f64 = 0.3;

/// Log-likelihood (natural) that a hypothesis loses by a look that the map contradicts completely.
const REFUTES: f64 = 6.0;

/// Bonus for the believed pose over any other, as a log-likelihood.
const HELD: f64 = 5.0;

/// Returns hypotheses with headings all round at each of `places`.
pub(super) fn everywhere(places: &[Pose]) -> Vec<Hypothesis> {
    let mut points: Vec<Point> = vec![];
    for place in places {
        let near = |point: &Point| (point - place.position).norm() < APART;
        if !points.iter().any(near) {
            points.push(place.position);
        }
    }
    points.into_iter().flat_map(all_round).collect()
}

fn all_round(position: Point) -> impl Iterator<Item = Hypothesis> {
    let (distance, turn) = SPREAD;
    let variances = Vector3::new(distance * distance, distance * distance, turn * turn);
    (0..DIRECTIONS).map(move |direction| {
        let heading = Heading::from_radians(f64::from(direction) * TAU / f64::from(DIRECTIONS));
        Hypothesis {
            pose: Pose::new(position, heading),
            covariance: Matrix3::from_diagonal(&variances),
            score: 0.0,
            looks: 0,
        }
    })
}

/// Returns the hypotheses after the robot has moved and looked, the best first, at most `most`.
pub(super) fn looked(
    before: Vec<Hypothesis>,
    rolled: &Rolled,
    outline: &Outline,
    surfaces: &[&Surface],
    most: usize,
) -> Vec<Hypothesis> {
    let mut after: Vec<Hypothesis> = (before.into_iter())
        .filter_map(|hypothesis| hypothesis.looked(rolled, outline, surfaces))
        .collect();
    after.sort_by(|a, b| b.score.total_cmp(&a.score));
    let best = after.first().map_or(0.0, |hypothesis| hypothesis.score);
    let mut kept: Vec<Hypothesis> = vec![];
    for hypothesis in after {
        let is_known = kept.iter().any(|other| hypothesis.is(other));
        if !is_known && hypothesis.score > best - HOPELESS && kept.len() < most {
            kept.push(hypothesis);
        }
    }
    kept
}

/// Returns the probability of each hypothesis.
pub(super) fn weights(hypotheses: &[Hypothesis]) -> Vec<f64> {
    let best = hypotheses
        .first()
        .map_or(0.0, |hypothesis| hypothesis.score);
    let shares = hypotheses
        .iter()
        .map(|hypothesis| libm::exp(hypothesis.score - best));
    let shares: Vec<f64> = shares.collect();
    let sum: f64 = shares.iter().sum();
    shares.into_iter().map(|share| share / sum).collect()
}

impl Hypothesis {
    /// Returns the hypothesis that the robot is still at the pose believed before the doubt began.
    /// Its initial score is above that of any other.
    pub(super) const fn held(pose: Pose, covariance: Matrix3<f64>) -> Self {
        Self {
            pose,
            covariance,
            score: HELD,
            looks: 0,
        }
    }

    fn looked(self, rolled: &Rolled, outline: &Outline, surfaces: &[&Surface]) -> Option<Self> {
        let predicted = self.pose.compose(rolled.pose);
        let turned = turned_into(rolled.pose, &self.covariance);
        let covariance = turned + rolled.covariance;
        let Fit {
            pose,
            covariance,
            likelihood,
            contradicted,
            ..
        } = fit(outline, surfaces, predicted, &covariance)?;
        Some(Self {
            pose,
            covariance,
            score: FORGETS * self.score + BELIEVES * likelihood - REFUTES * contradicted,
            looks: self.looks + 1,
        })
    }

    fn is(&self, other: &Self) -> bool {
        let off = difference(self.pose, other.pose);
        let (distance, turn) = SAME;
        libm::hypot(off.x, off.y) < distance && off.z.abs() < turn
    }
}

/// Returns the covariance of a pose after a known motion, from the covariance before.
pub(super) fn turned_into(motion: Pose, before: &Matrix3<f64>) -> Matrix3<f64> {
    let back = motion.inverse();
    let column = |unit: Pose| difference(Pose::IDENTITY, back.compose(unit).compose(motion));
    // Small steps ahead, to the left and round, as they appear at the other end of the motion.
    let step = 1e-6;
    let ahead = column(Pose::new(Point::new(step, 0.0), Heading::EAST)) / step;
    let left = column(Pose::new(Point::new(0.0, step), Heading::EAST)) / step;
    let round = column(Pose::new(Point::origin(), Heading::from_radians(step))) / step;
    let by_before = Matrix3::from_columns(&[ahead, left, round]);
    by_before * before * by_before.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_scores(scores: &[f64]) -> Vec<Hypothesis> {
        let one = |score: &f64| Hypothesis {
            pose: Pose::IDENTITY,
            covariance: Matrix3::identity(),
            score: *score,
            looks: 0,
        };
        scores.iter().map(one).collect()
    }

    /// Log-probabilities count up to a constant, however large it is.
    #[test]
    fn weights_are_in_the_ratio_of_the_likelihoods() {
        for best in [0.0, 3.0, -900.0, 900.0] {
            let found = weights(&of_scores(&[best, best - 1.0, best - 3.0]));
            let shares = [0.0, -1.0, -3.0].map(f64::exp);
            let all: f64 = shares.iter().sum();
            for (found, share) in found.iter().zip(shares) {
                assert!((found - share / all).abs() < 1e-9, "{best}: {found}");
            }
        }
        assert!(weights(&[]).is_empty());
    }

    #[test]
    fn there_are_headings_all_round_at_places_that_are_apart() {
        let at = |x: f64| Pose::new(Point::new(x, 1.0), Heading::NORTH);
        let all = everywhere(&[at(0.0), at(0.39), at(0.41), at(0.8)]);
        assert_eq!(all.len() as u32, 2 * DIRECTIONS);
        for (index, hypothesis) in all.iter().enumerate() {
            let turn = TAU * index as f64 / f64::from(DIRECTIONS);
            assert!(
                Heading::from_radians(turn)
                    .turn_to(hypothesis.pose.heading)
                    .abs()
                    < 1e-9
            );
            let x = if (index as u32) < DIRECTIONS {
                0.0
            } else {
                0.41
            };
            assert!((hypothesis.pose.position - Point::new(x, 1.0)).norm() < 1e-12);
            let variances = [(0, 0), (1, 1), (2, 2)].map(|at| hypothesis.covariance[at]);
            assert!(
                variances
                    .iter()
                    .all(|variance| (variance - 0.0625).abs() < 1e-12)
            );
        }
    }

    #[test]
    fn hypotheses_are_one_if_near_and_turned_alike() {
        let with = |x: f64, y: f64, turn: f64| Hypothesis {
            pose: Pose::new(Point::new(x, y), Heading::from_radians(turn)),
            ..of_scores(&[0.0])[0].clone()
        };
        let first = with(0.0, 0.0, 0.0);
        for (x, y, turn, same) in [
            (0.13, 0.14, 0.19, true),
            (0.15, -0.14, 0.0, false),
            (0.0, 0.0, -0.21, false),
            (-0.19, 0.0, -0.19, true),
        ] {
            assert_eq!(with(x, y, turn).is(&first), same, "{x} {y} {turn}");
        }
    }

    /// The covariance of a pose, seen from where the robot went.
    #[test]
    fn doubt_of_a_pose_turns_with_the_robot() {
        let motion = Pose::new(Point::new(2.0, -1.0), Heading::NORTH);
        let before = Matrix3::from_diagonal(&Vector3::new(0.04, 0.01, 0.0025));
        // A turn about the pose before moves the end of the way aside.
        let by_before = Matrix3::new(0.0, 1.0, 2.0, -1.0, 0.0, -1.0, 0.0, 0.0, 1.0);
        let expected = by_before * before * by_before.transpose();
        let found = turned_into(motion, &before);
        assert!((found - expected).abs().max() < 1e-6, "{found} {expected}");
    }
}
