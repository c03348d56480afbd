use core::fmt::Write;

use tolman_geom::{Heading, Point};
use tolman_robot::{TimedPose, Trajectory};

/// Returns a trajectory as text, one pose per line, `time x y z qx qy qz qw`. It is the format of
/// the RGB-D benchmark of the Technical University of Munich, which evo and others read.
///
/// ```
/// use tolman_formats::{ReadTrajectory, tum};
/// let text = "0.500000 1.000000 2.000000 0 0 0 0.000000000 1.000000000\n";
/// let read = ReadTrajectory::parse(text)?;
/// assert_eq!(tum(&read.planar()), text);
/// # Ok::<(), tolman_formats::TrajectoryError>(())
/// ```
#[must_use]
pub fn tum(trajectory: &Trajectory) -> String {
    let mut text = String::new();
    for TimedPose { time, pose } in trajectory.poses() {
        let half = Heading::from_radians(0.5 * pose.heading.radians()).unit();
        let Point { coords } = pose.position;
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{time:.6} {:.6} {:.6} 0 0 0 {:.9} {:.9}",
            coords.x, coords.y, half.y, half.x
        );
    }
    text
}
