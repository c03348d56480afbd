use tolman_geom::{Pose, Twist};
use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds, WheelTurns};
use tolman_robot::{Landmark, Robot, SensesLandmarks};

use super::calibration::{Reading, WheelCalibration};
use super::robot::CpmRobot;

/// A body with dead reckoning by its encoders.
#[derive(Debug)]
pub(super) struct Reckoned<B> {
    pub(super) body: B,
    /// Believed pose, in the frame of the first pose.
    pub(super) pose: Pose,
    /// Distance driven by the robot's middle, m, forward or backward.
    pub(super) driven: f64,
    /// Number of time steps made.
    pub(super) steps: u32,
    /// Calibration of the wheels, with the calibrated sensing; `None` if the encoders are trusted
    /// as they are.
    pub(super) calibrated: Option<Calibrated>,
}

/// The calibration of a robot's wheels, and its sensing corrected by it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Calibrated {
    pub(super) wheels: WheelCalibration,
    sensing: EpuckSensing,
    /// Number of steps in a row in which a reading did not come.
    missed: u32,
}

/// Number of steps in a row for which a reading that does not come is made up.
const MOST_MISSED: u32 = 20;

impl Calibrated {
    /// Returns the state of a robot that senses `sensing` before its first step.
    pub(super) const fn new(wheels: WheelCalibration, sensing: EpuckSensing) -> Self {
        Self {
            wheels,
            sensing,
            missed: 0,
        }
    }

    /// Takes in the body's readings after `command`. Missing ones are replaced for some steps:
    /// sensors read as before, and wheels turn as commanded.
    fn sense(&mut self, now: &EpuckSensing, command: &WheelSpeeds) {
        let is_whole = now.proximity.is_some() && now.encoders.is_some();
        self.missed = if is_whole { 0 } else { self.missed + 1 };
        let before = self.sensing;
        let step = now.time_us.saturating_sub(before.time_us) as f64 * 1e-6;
        let commanded = before.encoders.map(|_| WheelTurns {
            left: command.left * step,
            right: command.right * step,
        });
        let made_up = self.missed <= MOST_MISSED;
        self.sensing = self.wheels.sense(&EpuckSensing {
            proximity: now.proximity.or(before.proximity.filter(|_| made_up)),
            encoders: now.encoders.or(commanded.filter(|_| made_up)),
            ..*now
        });
    }
}

impl<B: CpmRobot> Reckoned<B> {
    /// Corrects the heading by a reading of the walls.
    pub(super) fn correct(&mut self, reading: Reading) {
        if let Some(Calibrated { wheels, .. }) = &mut self.calibrated {
            self.pose.heading = self.pose.heading.turned(wheels.read(reading));
        }
    }
}

impl<B: CpmRobot> Robot for Reckoned<B> {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = B::Error;

    fn sensing(&self) -> &EpuckSensing {
        match &self.calibrated {
            Some(calibrated) => &calibrated.sensing,
            None => self.body.sensing(),
        }
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), B::Error> {
        match &mut self.calibrated {
            Some(calibrated) => {
                let command = calibrated.wheels.command(command);
                self.body.step(&command)?;
                calibrated.sense(self.body.sensing(), &command);
            }
            None => self.body.step(command)?,
        }
        self.steps += 1;
        if let Some(turns) = self.sensing().encoders {
            let roll = |turn: f64| turn * WHEEL_RADIUS;
            let Twist { linear, angular } =
                Twist::of_wheels(roll(turns.left), roll(turns.right), TRACK);
            self.pose = self.pose.displaced(linear, angular);
            self.driven += linear.abs();
        }
        Ok(())
    }
}

impl<B: CpmRobot> SensesLandmarks for Reckoned<B> {
    fn landmark(&self) -> Option<Landmark> {
        self.body.landmark()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tolman_robot::epuck::PROXIMITY_SENSORS;

    #[test]
    fn readings_that_do_not_come_are_made_up_for_some_steps() {
        let whole = EpuckSensing {
            proximity: Some([70.0; PROXIMITY_SENSORS]),
            encoders: Some(WheelTurns {
                left: 0.1,
                right: 0.2,
            }),
            ..EpuckSensing::default()
        };
        let command = WheelSpeeds {
            left: 3.0,
            right: -1.0,
        };
        let mut calibrated = Calibrated::new(WheelCalibration::UNKNOWN, whole);
        for step in 1..=u64::from(MOST_MISSED) {
            let nothing = EpuckSensing {
                time_us: step * 10_000,
                ..EpuckSensing::default()
            };
            calibrated.sense(&nothing, &command);
            let WheelTurns { left, right } = calibrated.sensing.encoders.unwrap();
            assert!((left - 0.03).abs() < 1e-12 && (right + 0.01).abs() < 1e-12);
            assert_eq!(calibrated.sensing.proximity, whole.proximity);
        }
        calibrated.sense(&EpuckSensing::default(), &command);
        assert_eq!(calibrated.sensing.proximity, None);
        assert_eq!(calibrated.sensing.encoders, None);
        calibrated.sense(&whole, &command);
        assert_eq!(calibrated.sensing.encoders, whole.encoders);
    }
}
