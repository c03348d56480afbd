//! Capabilities of a robot's sensing. A layer or a system names its needs in its bounds, and so
//! runs on every robot that meets them.

use tolman_geom::Heading;

use crate::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS};
use crate::{CameraSensing, ColumnImage, LaserSensing, Odometry, Scan};

/// Sensing with the ranges to the walls.
pub trait Ranges {
    /// Returns the ranges of this time step, or `None` for a drop-out.
    fn scan(&self) -> Option<&Scan>;
}

/// Sensing with the absolute heading.
pub trait Compass {
    /// Returns the heading, or `None` for a drop-out.
    fn heading(&self) -> Option<Heading>;
}

/// Sensing with the distances that the wheels rolled.
pub trait Rolls {
    /// Returns the odometry since the step before, or `None` for a drop-out.
    fn odometry(&self) -> Option<Odometry>;
}

/// Sensing with an image of all that is round the robot.
pub trait Sees {
    /// Returns the image of this time step, or `None` for a drop-out.
    fn image(&self) -> Option<&ColumnImage>;
}

/// Sensing with contact.
pub trait Bumps {
    /// Returns whether the body touched something in this time step, or `None` without a bumper or
    /// for a drop-out.
    fn bump(&self) -> Option<bool>;
}

/// Sensing with a clock.
pub trait Clock {
    /// Returns the microseconds since the robot was switched on.
    fn time_us(&self) -> u64;
}

// A type that holds a laser robot's readings has the laser robot's capabilities.

impl<S: AsRef<LaserSensing>> Ranges for S {
    fn scan(&self) -> Option<&Scan> {
        self.as_ref().scan.as_ref()
    }
}

impl<S: AsRef<LaserSensing>> Compass for S {
    fn heading(&self) -> Option<Heading> {
        self.as_ref().compass
    }
}

impl<S: AsRef<LaserSensing>> Rolls for S {
    fn odometry(&self) -> Option<Odometry> {
        self.as_ref().odometry
    }
}

impl<S: AsRef<LaserSensing>> Bumps for S {
    fn bump(&self) -> Option<bool> {
        self.as_ref().bump
    }
}

impl<S: AsRef<LaserSensing>> Clock for S {
    fn time_us(&self) -> u64 {
        self.as_ref().time_us
    }
}

impl Sees for CameraSensing {
    fn image(&self) -> Option<&ColumnImage> {
        self.image.as_ref()
    }
}

impl Rolls for EpuckSensing {
    fn odometry(&self) -> Option<Odometry> {
        let turns = self.encoders?;
        let [left, right] = [turns.left, turns.right].map(|turn| turn * WHEEL_RADIUS);
        let rolled = tolman_geom::Twist::of_wheels(left, right, TRACK);
        Some(Odometry {
            distance: rolled.linear,
            turn: rolled.angular,
        })
    }
}

impl Bumps for EpuckSensing {
    fn bump(&self) -> Option<bool> {
        self.bump
    }
}

impl Clock for EpuckSensing {
    fn time_us(&self) -> u64 {
        self.time_us
    }
}
