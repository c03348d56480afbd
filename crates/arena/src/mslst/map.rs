use tolman_maps::mslst_graph::MslstGraph;

use super::States;

/// What Phases I and II leave to Phase III: all that the brain knows of the maze.
#[derive(Clone, Debug)]
pub struct MslstMap {
    /// The states that scans are sorted into.
    pub states: States,
    /// How actions lead from one to the next.
    pub graph: MslstGraph,
}
