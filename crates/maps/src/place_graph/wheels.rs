use tolman_geom::Pose;
use tolman_geom::nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2, Vector3};
use tolman_robot::Odometry;

use crate::tangent::difference;

/// Estimate of the constant errors of the wheels: their common size, and the difference between
/// them.
///
/// A robot that rolled `distance` and `turn` has truly moved `distance` · (1 + scale), and has
/// truly turned by `turn` · (1 + scale) + `distance` · curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelError {
    /// Relative error of the way by the size of both wheels: 0.01 for wheels that roll 1 % farther
    /// than they measure.
    pub scale: f64,
    /// Turn that the wheels do not measure, rad per metre, counter-clockwise.
    pub curvature: f64,
    /// Covariance of scale and curvature.
    covariance: Matrix2<f64>,
}

/// Pose of a robot by its wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rolled {
    /// Motion since the last step.
    pub(super) pose: Pose,
    /// Covariance of the motion, ahead and to the left, and of the heading.
    pub(super) covariance: Matrix3<f64>,
    /// Derivative of the pose by scale and curvature.
    by_error: Matrix3x2<f64>,
}

/// Variances caused by slip: of the way per metre, of the heading per metre and per radian.
const SLIP_WAY: f64 = 0.02 * 0.02;
const SLIP_TURN: f64 = 0.03 * 0.03;
/// Variance of a robot that has not moved.
const LEAST_VARIANCE: f64 = 1e-6;

impl WheelError {
    /// Returns errors that are known only up to these standard deviations.
    #[must_use]
    pub fn unknown(scale_deviation: f64, curvature_deviation: f64) -> Self {
        let deviations = Vector2::new(scale_deviation, curvature_deviation);
        Self {
            scale: 0.0,
            curvature: 0.0,
            covariance: Matrix2::from_diagonal(&deviations.component_mul(&deviations)),
        }
    }

    /// Returns the pose that follows from the odometry, corrected for the error, with its
    /// covariance.
    pub(super) fn predict(&self, rolled: &[Odometry]) -> Rolled {
        let pose = way(rolled, self.scale, self.curvature);
        let changed = |scale: f64, curvature: f64| {
            let other = way(rolled, self.scale + scale, self.curvature + curvature);
            difference(pose, other) / STEP
        };
        let by_error = Matrix3x2::from_columns(&[changed(STEP, 0.0), changed(0.0, STEP)]);
        let distance: f64 = rolled.iter().map(|step| step.distance.abs()).sum();
        let turn: f64 = rolled.iter().map(|step| step.turn.abs()).sum();
        let heading = SLIP_TURN * (distance + turn) + LEAST_VARIANCE;
        let across = SLIP_WAY * distance + 0.3 * heading * distance * distance + LEAST_VARIANCE;
        let slip = Vector3::new(SLIP_WAY * distance + LEAST_VARIANCE, across, heading);
        let covariance =
            by_error * self.covariance * by_error.transpose() + Matrix3::from_diagonal(&slip);
        Rolled {
            pose,
            covariance,
            by_error,
        }
    }

    /// Learns from the pose at which the robot was found: `off` from the prediction, whose
    /// covariance is `before`. The new pose has the covariance `after`, to which the prediction
    /// contributes.
    pub(super) fn learn(
        &mut self,
        predicted: &Rolled,
        off: &Vector3<f64>,
        before: &Matrix3<f64>,
        after: &Matrix3<f64>,
    ) {
        let Some(information) = before.try_inverse() else {
            return;
        };
        let gain = self.covariance * predicted.by_error.transpose() * information;
        let change = gain * off;
        self.scale += change.x;
        self.curvature += change.y;
        let known = gain * (before - after) * gain.transpose();
        self.covariance -= 0.5 * (known + known.transpose());
        // A minimum variance lets the estimate follow slow changes of the wheels.
        for part in 0..2 {
            self.covariance[(part, part)] = self.covariance[(part, part)].max(LEAST_DOUBT);
        }
    }
}

/// Change of the error by which its effect on the pose is measured.
const STEP: f64 = 1e-4;

const LEAST_DOUBT: f64 = 1e-6;

fn way(rolled: &[Odometry], scale: f64, curvature: f64) -> Pose {
    rolled.iter().fold(Pose::IDENTITY, |pose, step| {
        let distance = step.distance * (1.0 + scale);
        pose.displaced(
            distance,
            step.turn * (1.0 + scale) + step.distance * curvature,
        )
    })
}
