use tolman_geom::Pose;
use tolman_robot::Scan;

/// One thing that a robot noted.
#[derive(Clone, Debug, PartialEq)]
pub enum LogEntry {
    /// Where its wheels had it.
    Odometry(LogOdometry),
    /// What its laser read, and where its wheels had it then.
    Scan(LogScan),
}

/// Where the wheels of a robot had it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogOdometry {
    /// Line of the file, from 1.
    pub line: u64,
    /// Time of the measurement, s, by the robot's own clock.
    pub time: f64,
    /// Dead reckoning, in a frame of its own.
    pub pose: Pose,
}

/// What the laser of a robot read.
#[derive(Clone, Debug, PartialEq)]
pub struct LogScan {
    /// Line of the file, from 1.
    pub line: u64,
    /// Time of the measurement, s, by the robot's own clock.
    pub time: f64,
    /// Dead reckoning, in a frame of its own.
    pub odometry: Pose,
    /// Pose that the log notes beside the odometry: in a raw log that of the laser by dead reckoning, in a log that somebody has
    /// corrected that of the map.
    pub noted: Pose,
    /// Where the laser sits on the robot.
    pub robot_from_laser: Pose,
    /// The ranges; `ring.max_range` where nothing was hit.
    pub scan: Scan,
}
