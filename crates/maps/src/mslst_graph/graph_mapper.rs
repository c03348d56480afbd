use alloc::vec;
use alloc::vec::Vec;

use tolman_maze::Direction;

use super::graph::{ActionEdge, MslstGraph, Node, NodeZone, follow};

/// Builds the graph while the robot wanders (Phase II).
///
/// ```
/// use tolman_maps::mslst_graph::{GraphMapper, NodeZone};
/// use tolman_maze::Direction::{East, West};
///
/// // East from state 4 to the destination in state 9, and back.
/// let mut mapper = GraphMapper::new(4, NodeZone::Elsewhere);
/// let there = mapper.succeeded(East, 9, NodeZone::Destination);
/// let back = mapper.succeeded(West, 4, NodeZone::Elsewhere);
/// assert_eq!((there, back, mapper.at()), (1, 0, 0));
/// assert_eq!(mapper.finish().nodes().len(), 2);
/// ```
#[derive(Clone, Debug)]
pub struct GraphMapper {
    nodes: Vec<Node>,
    at: u32,
}

impl GraphMapper {
    /// Begins with the node of the robot's first state.
    #[must_use]
    pub fn new(state: u32, zone: NodeZone) -> Self {
        let first = Node {
            state,
            zone,
            edges: Vec::new(),
        };
        Self {
            nodes: vec![first],
            at: 0,
        }
    }

    /// Takes in a successful action that led to `state`. Returns the node the robot is at now.
    ///
    /// "If the last high-level action succeeded, then normally it adds a node to the graph with the
    /// current state, and connects it to the previous one with the action that it just completed …
    /// When it reverses an action or string of actions and ends up in the same state it was in
    /// before, instead of adding a new node it traces the graph back to the old node and when it
    /// eventually reaches a new state it adds on from there."
    ///
    /// Edges are stored both ways, so a reversed action finds the edge back. It is enough to look
    /// for an edge of this action to a node of this state. A new node hangs on one edge, so only
    /// the exact reverse of the actions that led away from a node leads back to it. O(degree of the
    /// node).
    pub fn succeeded(&mut self, action: Direction, state: u32, zone: NodeZone) -> u32 {
        if let Some(known) = follow(&self.nodes, self.at, action, state) {
            self.at = known;
            return known;
        }
        let new = self.nodes.len() as u32;
        let back = ActionEdge {
            action: action.opposite(),
            head: Some(self.at),
        };
        self.nodes.push(Node {
            state,
            zone,
            edges: vec![back],
        });
        self.enter(ActionEdge {
            action,
            head: Some(new),
        });
        self.at = new;
        new
    }

    /// Takes in a failed action: "If the last action failed, then it adds a connection from the
    /// previous node to the dummy node." A connection that exists is not added again.
    pub fn failed(&mut self, action: Direction) {
        let failure = ActionEdge { action, head: None };
        if !self.nodes[self.at as usize].edges.contains(&failure) {
            self.enter(failure);
        }
    }

    fn enter(&mut self, edge: ActionEdge) {
        self.nodes[self.at as usize].edges.push(edge);
    }

    /// Returns the node the robot is at.
    #[must_use]
    pub const fn at(&self) -> u32 {
        self.at
    }

    /// Returns the graph so far, by id.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Returns the graph, with every node's distance to the nearest destination node. O(nodes +
    /// edges).
    #[must_use]
    pub fn finish(self) -> MslstGraph {
        MslstGraph::finished(self.nodes)
    }
}
