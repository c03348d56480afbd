//! Where a robot was.

use tolman_arena::course::Course;
use tolman_replay::{Floor, RobotTrack, Scenery};

/// Returns the scenery of a course. Adds the share of its floor that the robot has been on to the
/// robot's track.
///
/// A free world has no cells, so nothing is known of its floor.
#[must_use]
pub fn scenery_of(course: &Course, track: &mut RobotTrack) -> Scenery {
    let mut scenery = Scenery::of_world(&course.world);
    if let Some(floor) = Floor::from(&course.world, track.poses[0].position) {
        scenery.zones.extend(floor.solid());
        let places = track.poses.iter().map(|pose| pose.position);
        track.series.push(floor.coverage(places));
    }
    scenery
}
