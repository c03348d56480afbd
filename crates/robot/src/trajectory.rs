use alloc::vec::Vec;

use tolman_geom::{Point, Pose};

/// Poses of a robot over time, from which the pose at any time between them is interpolated.
///
/// ```
/// use tolman_robot::{TimedPose, Trajectory};
/// use tolman_geom::{Heading, Point, Pose};
///
/// let at = |time, x| TimedPose { time, pose: Pose::new(Point::new(x, 0.0), Heading::EAST) };
/// let way = Trajectory::new([at(3.0, 2.0), at(1.0, 0.0)]);
/// assert_eq!(way.poses()[0].time, 1.0);
/// assert!((way.at(1.5).unwrap().position.x - 0.5).abs() < 1e-12);
/// assert_eq!(way.at(3.5), None);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    poses: Vec<TimedPose>,
}

/// Pose of a robot at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedPose {
    /// Time of the pose, s.
    pub time: f64,
    /// Pose at that time.
    pub pose: Pose,
}

impl Trajectory {
    /// Returns the way through these poses, in the order of time; of equal times in the order
    /// given. Poses and times that are not finite are left out. O(n log n).
    #[must_use]
    pub fn new(poses: impl IntoIterator<Item = TimedPose>) -> Self {
        let is_finite = |timed: &TimedPose| timed.time.is_finite() && timed.pose.is_finite();
        let mut poses: Vec<TimedPose> = poses.into_iter().filter(is_finite).collect();
        poses.sort_by(|a, b| a.time.total_cmp(&b.time));
        Self { poses }
    }

    /// Returns the poses, in the order of time.
    #[must_use]
    pub fn poses(&self) -> &[TimedPose] {
        &self.poses
    }

    /// Returns the pose at `time`, s, between the poses before and after in proportion; `None`
    /// before the first and after the last. O(log n).
    #[must_use]
    pub fn at(&self, time: f64) -> Option<Pose> {
        let after = self.poses.partition_point(|timed| timed.time < time);
        let next = self.poses.get(after)?;
        let Some(before) = after.checked_sub(1).map(|before| self.poses[before]) else {
            return (next.time <= time).then_some(next.pose);
        };
        let share = (time - before.time) / (next.time - before.time);
        let way = next.pose.position - before.pose.position;
        let turn = before.pose.heading.turn_to(next.pose.heading);
        let position: Point = before.pose.position + way * share;
        Some(Pose::new(
            position,
            before.pose.heading.turned(turn * share),
        ))
    }
}

/// The pose at one time relative to the pose at another, as known from elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseRelation {
    /// Time of the pose in whose frame `seen` is given, s.
    pub from: f64,
    /// Time of the pose seen, s.
    pub to: f64,
    /// Pose at the time `to`, in the frame of the pose at the time `from`.
    pub seen: Pose,
}
