use tolman_geom::{Pose, Twist};
use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds};
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
}

impl Calibrated {
    /// Returns the state of a robot that senses `sensing` before its first step.
    pub(super) const fn new(wheels: WheelCalibration, sensing: EpuckSensing) -> Self {
        Self { wheels, sensing }
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
            Some(Calibrated { wheels, sensing }) => {
                self.body.step(&wheels.command(command))?;
                *sensing = wheels.sense(self.body.sensing());
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
