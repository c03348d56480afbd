//! Differences of poses as vectors: ahead and to the left, m, and the heading, rad.

use tolman_geom::nalgebra::Vector3;
use tolman_geom::{Point, Pose};

/// Returns `pose` moved by `step` in its own frame: ahead, left, m, and turn, rad.
pub(crate) fn moved(pose: Pose, step: &Vector3<f64>) -> Pose {
    let position = pose.transform(Point::new(step.x, step.y));
    Pose::new(position, pose.heading.turned(step.z))
}

/// Returns the step from `pose` to `other` in the frame of `pose`: ahead, left, m, and turn, rad.
pub(crate) fn difference(pose: Pose, other: Pose) -> Vector3<f64> {
    let off = pose.between(other);
    Vector3::new(off.position.x, off.position.y, off.heading.radians())
}
