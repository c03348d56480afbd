use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::{Scan, TimedPose, Trajectory};

/// One entry of a robot's log.
#[derive(Clone, Debug, PartialEq)]
pub enum LogEntry {
    /// Pose of the robot by its wheels.
    Odometry(LogOdometry),
    /// Readings of the robot's laser, with the pose by its wheels at the same time.
    Scan(LogScan),
    /// Readings of a laser without the robot's pose, which other entries have.
    BareScan(LogScan),
}

/// Pose of a robot by its wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogOdometry {
    /// Line of the file, from 1.
    pub line: u64,
    /// Time of the measurement, s, by the robot's own clock.
    pub time: f64,
    /// Pose by dead reckoning, in the odometry's own frame.
    pub pose: Pose,
}

/// Speed of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogVelocity {
    /// Time from which the velocity holds, s.
    pub time: f64,
    /// Speed straight ahead, m/s.
    pub forward: f64,
    /// Speed to the robot's left, m/s.
    pub left: f64,
    /// Turn rate, rad/s, counter-clockwise.
    pub turn: f64,
}

impl LogVelocity {
    /// Returns the trajectory by dead reckoning: the poses at the times of the velocities, each of
    /// which holds until the next. It begins at the origin, looking east. O(n).
    #[must_use]
    pub fn dead_reckoning(velocities: &[Self]) -> Trajectory {
        let mut pose = Pose::IDENTITY;
        let mut before: Option<&Self> = None;
        let poses = velocities.iter().map(|now| {
            if let Some(Self {
                time,
                forward,
                left,
                turn,
            }) = before
            {
                let duration = (now.time - time).max(0.0);
                // The displacement of an arc points half-way between the headings at its ends.
                let half = Heading::from_radians(0.5 * duration * turn);
                let way = duration * Vector::new(*forward, *left);
                let moved = Pose::new(Point::from(half.rotate(way)), half);
                pose = pose.compose(moved);
                pose.heading = pose.heading.turned(half.radians());
            }
            before = Some(now);
            let time = now.time;
            TimedPose { time, pose }
        });
        Trajectory::new(poses)
    }
}

/// Readings of a robot's laser.
#[derive(Clone, Debug, PartialEq)]
pub struct LogScan {
    /// Line of the file, from 1.
    pub line: u64,
    /// Time of the measurement, s, by the robot's own clock.
    pub time: f64,
    /// Pose by dead reckoning, in the odometry's own frame.
    pub odometry: Pose,
    /// Second pose of the entry. In a raw log it is the laser's pose by dead reckoning, in a
    /// corrected log the pose on the map.
    pub noted: Pose,
    /// Pose of the laser on the robot.
    pub robot_from_laser: Pose,
    /// Ranges of the beams; `ring.max_range` where nothing was hit.
    pub scan: Scan,
}

/// A scan, and the number of its ranges that are invalid.
pub(crate) struct ReadScan {
    pub(crate) scan: LogScan,
    pub(crate) bad_ranges: usize,
}

impl ReadScan {
    /// Returns the scan with its ranges, m. Ranges beyond the maximum have hit nothing.
    pub(crate) fn of(mut scan: LogScan, ranges: &[Option<f64>]) -> Self {
        let most = scan.scan.ring.max_range;
        let length = |range: &Option<f64>| range.map_or(most, |range| range.min(most));
        scan.scan.ranges = ranges.iter().map(length).collect();
        let bad_ranges = ranges.iter().filter(|range| range.is_none()).count();
        Self { scan, bad_ranges }
    }
}
