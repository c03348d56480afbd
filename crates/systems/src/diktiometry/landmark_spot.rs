use tolman_maps::diktiometry::PlaceId;
use tolman_maze::Direction;
use tolman_robot::{Goal, Landmark, Task};

/// Position of a landmark on a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandmarkSpot {
    /// At a place.
    Place(PlaceId),
    /// On the way in a direction from a place.
    Way(PlaceId, Direction),
}

/// Returns the landmark of a task at which a robot breaks off on its way. Where `spot_of` has it at
/// a place, the robot goes on to the place.
pub(super) fn sought(
    task: Task,
    spot_of: impl FnOnce(Landmark) -> Option<LandmarkSpot>,
) -> Option<Landmark> {
    let Task::Reach(Goal::Landmark(landmark)) = task else {
        return None;
    };
    let is_at_a_place = matches!(spot_of(landmark), Some(LandmarkSpot::Place(_)));
    (!is_at_a_place).then_some(landmark)
}

/// Returns whether a robot that senses the landmark `here` is at the landmark of a task.
pub(super) fn is_at_goal(task: Task, here: Option<Landmark>) -> bool {
    here.is_some_and(|here| task == Task::Reach(Goal::Landmark(here)))
}
