use tolman_geom::{Pose, Twist};
use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds};
use tolman_robot::{Landmark, Robot, SensesLandmarks};

use super::robot::CpmRobot;

/// A body with dead reckoning by its encoders.
#[derive(Debug)]
pub struct Reckoned<B> {
    body: B,
    /// In the frame of the first pose.
    pose: Pose,
    /// Way of the robot's middle so far, m, forward or backward.
    driven: f64,
}

impl<B: CpmRobot> Reckoned<B> {
    /// A body that stands at the origin of its frame.
    pub const fn new(body: B) -> Self {
        Self {
            body,
            pose: Pose::IDENTITY,
            driven: 0.0,
        }
    }

    /// Returns a body that stands at `pose` of its frame, after `driven` m.
    pub const fn resume(body: B, pose: Pose, driven: f64) -> Self {
        Self { body, pose, driven }
    }

    /// The body.
    pub const fn body(&self) -> &B {
        &self.body
    }

    /// The body, to be lifted.
    pub const fn body_mut(&mut self) -> &mut B {
        &mut self.body
    }

    /// Where it believes to be, in the frame in which it began.
    pub const fn pose(&self) -> Pose {
        self.pose
    }

    /// Its heading is known better.
    pub fn correct(&mut self, turn: f64) {
        self.pose.heading = self.pose.heading.turned(turn);
    }

    /// How far it drove so far, m.
    pub const fn driven(&self) -> f64 {
        self.driven
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
