use tolman_maps::cpm::{End, Turn};
use tolman_robot::Landmark;

/// Aim of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Reach a landmark: by the shortest known way if it is on the map, otherwise by exploring.
    Find(Landmark),
    /// Go through every port of the map ("the task is to obtain the complete map").
    Explore,
    /// Go through every port, and then through every fragment again as often as
    /// [`checks`](super::CpmConfig::checks) says; ours.
    Check,
    /// Return to the start, and try unknown ports that may shorten the way between start and goal
    /// (section 6).
    WayBack,
    /// Make sure that no way between start and goal is shorter than the shortest on the map; ours.
    Shortest,
}

/// Walk along one fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leg {
    /// Turn Δ to make first.
    pub turn: Turn,
    /// End of the fragment that the robot enters; `None` if it is not on the map.
    pub known: Option<End>,
    /// Number of observations without an end of the fragment after which the robot turns round and
    /// comes back; `None` for no limit.
    pub give_up_after: Option<u32>,
}

/// Reason why there is nothing more to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// The aim is reached.
    Reached,
    /// Everything that can be reached was explored, and the landmark was not found.
    NotThere,
    /// [`most_traversals`](super::CpmConfig::most_traversals) fragments were walked.
    OutOfPatience,
}
