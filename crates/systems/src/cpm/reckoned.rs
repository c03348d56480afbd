use tolman_geom::{Pose, Twist};
use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds};
use tolman_robot::{Landmark, Robot, SensesLandmarks};

use super::robot::CpmRobot;

/// A body with dead reckoning by its encoders.
#[derive(Debug)]
pub(super) struct Reckoned<B> {
    pub(super) body: B,
    /// Where it believes to be, in the frame of the first pose.
    pub(super) pose: Pose,
    /// Way of the robot's middle so far, m, forward or backward.
    pub(super) driven: f64,
    /// Time steps made.
    pub(super) steps: u32,
}

impl<B: CpmRobot> Reckoned<B> {
    /// Its heading is known better.
    pub(super) fn correct(&mut self, turn: f64) {
        self.pose.heading = self.pose.heading.turned(turn);
    }
}

impl<B: CpmRobot> Robot for Reckoned<B> {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = B::Error;

    fn sensing(&self) -> &EpuckSensing {
        self.body.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), B::Error> {
        self.body.step(command)?;
        self.steps += 1;
        if let Some(turns) = self.body.sensing().encoders {
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
