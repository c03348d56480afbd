use tolman_maps::cpm::{End, Turn};
use tolman_robot::Landmark;

/// Aim of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// To be at a landmark: by the shortest known way if it is on the map, else by exploring.
    Find(Landmark),
    /// To have been through every port of the map ("the task is to obtain the complete map").
    Explore,
    /// To have been through every port, and then through every fragment again as often as
    /// [`checks`](super::CpmConfig::checks) says; ours.
    Check,
    /// To be at the start again, trying unknown ports that might make the way between start and
    /// goal shorter (section 6).
    WayBack,
    /// To be sure that no way between start and goal is shorter than the shortest of the map; ours.
    Shortest,
}

/// Decision at a junction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JunctionDecision {
    /// Turn and follow the path.
    Go(Leg),
    /// Nothing more to do for this aim.
    Done(Done),
}

/// One fragment to walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leg {
    /// Δ, to perform first.
    pub turn: Turn,
    /// The end of the fragment it enters, if that is on the map.
    pub known: Option<End>,
    /// Number of observations without an end of the fragment after which the robot turns round and
    /// comes back; `None` for never.
    pub give_up_after: Option<u32>,
}

/// Reason why there is nothing more to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// The aim is reached.
    Reached,
    /// All that can be reached was explored, and the landmark is not there.
    NotThere,
    /// [`most_traversals`](super::CpmConfig::most_traversals) fragments were walked.
    OutOfPatience,
}
