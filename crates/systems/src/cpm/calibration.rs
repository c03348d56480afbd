use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds, WheelTurns};

/// Errors of both wheel encoders as shares, learned from walls that run along two axes.
///
/// Encoders and walls disagree about a turn because of both wheels' errors. A full turn in place
/// shows the sum of the errors, a straight way their difference. A Kalman filter estimates the
/// heading and both errors (Kalman 1960).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WheelCalibration {
    /// Shares by which the left and the right wheel roll more than they count.
    errors: [f64; 2],
    /// Covariance of the heading, rad, and of both errors.
    covariance: [[f64; 3]; 3],
    /// Distances rolled by the left and the right wheel since the last reading of the walls, m,
    /// ahead positive.
    rolled: [f64; 2],
    /// Distance that the wheels have turned since then, ahead and backward, m, summed over both.
    turned: f64,
}

/// Prior standard deviation of a wheel's error, as a share.
const UNKNOWN: f64 = 0.03;

/// Variance of the heading before the first reading of the walls, rad². Walls give the heading only
/// up to a quarter turn.
const ANY_HEADING: f64 = 0.2;

/// Variance of the heading from which walls can no longer correct it, rad²: it may be off by an
/// eighth of a turn.
const LOST: f64 = 0.1;

/// Reading of the heading by walls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    /// Heading minus the robot's belief, rad.
    pub(super) off: f64,
    /// Standard deviation, rad.
    pub(super) deviation: f64,
}

/// Variance that slipping wheels add to the heading, rad² per metre that both of them roll.
const SLIP: f64 = 2e-3;

/// Maximum deviation, in standard deviations. A larger one means that the reading belongs to
/// another wall.
const ODD: f64 = 4.0;

impl WheelCalibration {
    /// Calibration of a robot whose wheels were never compared with walls.
    pub(super) const UNKNOWN: Self = Self {
        errors: [0.0, 0.0],
        covariance: [
            [ANY_HEADING, 0.0, 0.0],
            [0.0, UNKNOWN * UNKNOWN, 0.0],
            [0.0, 0.0, UNKNOWN * UNKNOWN],
        ],
        rolled: [0.0, 0.0],
        turned: 0.0,
    };

    /// Returns the command that makes the wheels roll at the speeds in `command`.
    pub(super) fn command(&self, command: &WheelSpeeds) -> WheelSpeeds {
        let [left, right] = self.errors;
        WheelSpeeds {
            left: command.left / (1.0 + left),
            right: command.right / (1.0 + right),
        }
    }

    /// Takes in the encoders' counts, and returns them with the known errors corrected.
    pub(super) fn sense(&mut self, sensing: &EpuckSensing) -> EpuckSensing {
        let encoders = sensing.encoders.map(|turns| {
            let counted = [turns.left, turns.right].map(|turn| turn * WHEEL_RADIUS);
            for (rolled, counted) in self.rolled.iter_mut().zip(counted) {
                *rolled += counted;
                self.turned += counted.abs();
            }
            let [left, right] = self.errors;
            WheelTurns {
                left: turns.left * (1.0 + left),
                right: turns.right * (1.0 + right),
            }
        });
        EpuckSensing {
            encoders,
            ..*sensing
        }
    }

    /// Takes in the heading's error by the walls, and returns the correction to apply, rad.
    pub(super) fn read(&mut self, reading: Reading) -> f64 {
        self.predict();
        let Reading { off, deviation } = reading;
        if self.covariance[0][0] > LOST {
            self.forget_heading();
        }
        let innovation = self.covariance.map(|row| row[0]);
        let variance = innovation[0] + deviation * deviation;
        if off * off > ODD * ODD * variance {
            return 0.0;
        }
        let gain = innovation.map(|covariance| covariance / variance);
        for (row, gain) in self.covariance.iter_mut().zip(gain) {
            for (entry, by) in row.iter_mut().zip(innovation) {
                *entry -= gain * by;
            }
        }
        self.errors[0] += gain[1] * off;
        self.errors[1] += gain[2] * off;
        gain[0] * off
    }

    /// Forgets the heading, which may be off by more than walls can show. The next reading is
    /// accepted unchanged, and teaches nothing about the wheels.
    const fn forget_heading(&mut self) {
        self.covariance[0] = [ANY_HEADING, 0.0, 0.0];
        self.covariance[1][0] = 0.0;
        self.covariance[2][0] = 0.0;
    }

    /// Predicts the covariance from the last reading of the walls until now.
    fn predict(&mut self) {
        let [left, right] = self.rolled;
        let by = [1.0, -left / TRACK, right / TRACK];
        let before = self.covariance;
        let moved = |row: [f64; 3]| row.iter().zip(by).map(|(entry, by)| entry * by).sum();
        let with: [f64; 3] = before.map(moved);
        self.covariance[0] = [moved(with) + SLIP * self.turned, with[1], with[2]];
        self.covariance[1][0] = with[1];
        self.covariance[2][0] = with[2];
        (self.rolled, self.turned) = ([0.0, 0.0], 0.0);
    }

    /// Returns the standard deviation of the distance that the robot's middle rolls, as a share.
    pub(super) fn uncertainty(&self) -> f64 {
        let [_, left, right] = self.covariance;
        let sum = left[1] + right[2] + 2.0 * left[2];
        libm::sqrt(sum.max(0.0)) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, TAU};

    /// Returns the calibration of a robot that turns round once and drives 25 cm, `rounds` times,
    /// and reads the walls after each.
    fn calibrated(errors: [f64; 2], rounds: u32) -> WheelCalibration {
        let mut calibration = WheelCalibration::UNKNOWN;
        // True heading minus believed heading.
        let mut off = 0.0;
        for _ in 0..rounds {
            let turn = TAU * TRACK / 2.0;
            for counted in [[-turn, turn], [0.25, 0.25]] {
                let turns = counted.map(|way| way / WHEEL_RADIUS);
                let sensing = EpuckSensing {
                    encoders: Some(WheelTurns {
                        left: turns[0],
                        right: turns[1],
                    }),
                    ..EpuckSensing::default()
                };
                let told = calibration.sense(&sensing).encoders.unwrap();
                let [left, right] = [0, 1].map(|wheel| counted[wheel] * (1.0 + errors[wheel]));
                let believed = (told.right - told.left) * WHEEL_RADIUS / TRACK;
                off += (right - left) / TRACK - believed;
                off -= libm::round(off / FRAC_PI_2) * FRAC_PI_2;
                let deviation = 0.02;
                off -= calibration.read(Reading { off, deviation });
            }
        }
        calibration
    }

    #[test]
    fn walls_tell_how_far_each_wheel_rolls() {
        for errors in [[0.05, 0.03], [-0.05, 0.05], [0.0, 0.0], [-0.04, -0.05]] {
            let found = calibrated(errors, 300);
            for (found, error) in found.errors.into_iter().zip(errors) {
                assert!((found - error).abs() < 4e-3, "{found} for {error}");
            }
            assert!(found.uncertainty() < 5e-4, "{}", found.uncertainty());
        }
    }

    #[test]
    fn a_reading_that_cannot_be_changes_nothing() {
        let mut calibration = calibrated([0.01, 0.01], 100);
        let before = calibration;
        let (off, deviation) = (0.7, 0.02);
        assert!(calibration.read(Reading { off, deviation }).abs() < 1e-12);
        for (after, before) in calibration.errors.into_iter().zip(before.errors) {
            assert!((after - before).abs() < 1e-12);
        }
    }
}
