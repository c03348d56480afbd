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
