use tolman_geom::Point;
use tolman_maps::mslst_graph::{MslstGraph, Node, NodeZone};
use tolman_robot::{Landmark, MapLink, MapPlace, MapView};

use super::States;

/// Result of Phases I and II for Phase III: all of the brain's knowledge of the maze.
#[derive(Clone, Debug)]
pub struct MslstMap {
    /// States into which scans are sorted.
    pub states: States,
    /// Graph of the actions that lead from one state to the next.
    pub graph: MslstGraph,
}

/// A map, and the truth that an observer recorded about it.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The part for the brain.
    pub map: MslstMap,
    /// Truth, which the brain does not get.
    pub survey: GrowthRecord,
}

/// Truth recorded while a map was learned, for pictures and scores; no brain reads it. Empty if
/// nothing was recorded, as with a real robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GrowthRecord {
    /// True position of the robot when each node was made, by id, m.
    pub positions: Vec<Point>,
    /// Action of Phase II, from 1, that made each node; 0 for the first node.
    pub made_by: Vec<u32>,
}

impl MslstMap {
    /// Returns the memory of states and graph, bytes. O(states + nodes).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let models = self.states.models().iter();
        let states = models.map(|model| size_of_val(model.as_slice()));
        states.sum::<usize>() + self.graph.bytes()
    }

    /// Returns the graph as places without positions; the destination nodes have the landmark of
    /// the goal. O(nodes + edges).
    #[must_use]
    pub fn view(&self) -> MapView {
        view(self.graph.nodes())
    }
}

/// Returns the nodes of a graph as places. Failed actions lead nowhere and are left out.
pub(super) fn view(nodes: &[Node]) -> MapView {
    let place = |(id, node): (u32, &Node)| MapPlace {
        id,
        position: None,
        landmark: (node.zone == NodeZone::Destination).then_some(Landmark::Goal),
    };
    MapView {
        places: (0..).zip(nodes).map(place).collect(),
        links: (0..)
            .zip(nodes)
            .flat_map(|(from, node)| {
                let heads = node.edges.iter().filter_map(|edge| edge.head);
                heads.map(move |to| MapLink { from, to })
            })
            .collect(),
        ..MapView::default()
    }
}
