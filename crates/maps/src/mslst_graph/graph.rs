use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::Direction;
use tolman_planners::{Graph, path_to, steps_from};

/// Zone in which a node was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum NodeZone {
    /// The node was made while the robot was in the destination zone: a destination node.
    Destination,
    /// Anywhere else.
    Elsewhere,
}

/// One node: a state met at some place. The same state at another place is another node.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Node {
    /// Number of the quantizer's state.
    pub state: u32,
    /// Zone of the node: destination or not.
    pub zone: NodeZone,
    /// Edges in order of insertion. Several may have the same action.
    pub edges: Vec<ActionEdge>,
}

/// "If node A has an east connection to node B …, then node B also has a west connection to node
/// A."
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ActionEdge {
    /// The action that leads along the edge.
    pub action: Direction,
    /// The node to which the edge leads; `None` where the action failed ("Nodes can also have
    /// connections to a dummy node, which represent failed actions"). No search passes through the
    /// dummy node.
    pub head: Option<u32>,
}

/// Reason why a list of nodes is not a graph of MSLST.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum GraphError {
    /// There are no nodes.
    #[error("the graph has no nodes: learn one first")]
    Empty,
    /// There are more nodes than ids.
    #[error("the graph has {count} nodes, more than there are ids: learn a shorter one")]
    TooMany {
        /// Number of nodes in the file.
        count: usize,
    },
    /// An edge leads to a node that does not exist.
    #[error(
        "node {node}: its {action} edge leads to node {head}, which does not exist, as there are {count} nodes: learn the map again"
    )]
    NoSuchNode {
        /// Number of the node, from 0.
        node: u32,
        /// The edge's action.
        action: Direction,
        /// Node to which the edge leads.
        head: u32,
        /// Number of nodes.
        count: u32,
    },
    /// An edge is stored in one direction only.
    #[error(
        "node {node}: its {action} edge leads to node {head}, which has no {} edge back: learn the map again",
        action.opposite()
    )]
    OneWay {
        /// Number of the node, from 0.
        node: u32,
        /// The edge's action.
        action: Direction,
        /// Node to which the edge leads.
        head: u32,
    },
    /// Two edges of a node cannot be told apart.
    #[error(
        "node {node}: two {action} edges lead to the same, a node of one state or the dummy node; remove one"
    )]
    Ambiguous {
        /// Number of the node, from 0.
        node: u32,
        /// The edges' action.
        action: Direction,
    },
}

/// The finished graph of Phase II. Nodes are numbered from 0 in order of creation.
///
/// Every edge between nodes is stored both ways with opposite actions. Two edges of a node with the
/// same action lead to nodes of different states. So an action and the state it led to name at most
/// one edge.
///
/// With the feature `serde` it is saved as its nodes. Reading checks them as
/// [`from_nodes`](Self::from_nodes) does.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Saved"))]
pub struct MslstGraph {
    nodes: Vec<Node>,
    /// Distances to the destination, which follow from the nodes.
    #[cfg_attr(feature = "serde", serde(skip))]
    distances: Vec<Option<u32>>,
}

/// A graph as read from a file, unchecked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved {
    nodes: Vec<Node>,
}

#[cfg(feature = "serde")]
impl TryFrom<Saved> for MslstGraph {
    type Error = GraphError;

    fn try_from(saved: Saved) -> Result<Self, GraphError> {
        Self::from_nodes(saved.nodes)
    }
}

impl MslstGraph {
    /// Returns a graph of nodes that were learned before. O(nodes · degree²).
    ///
    /// # Errors
    /// [`GraphError`] if there are no nodes, or they are not as [`MslstGraph`] promises.
    pub fn from_nodes(nodes: Vec<Node>) -> Result<Self, GraphError> {
        check(&nodes)?;
        Ok(Self::finished(nodes))
    }

    /// Returns the finished graph, with distances. "When the graph-building is complete, we
    /// calculate the length of the path from each node to the nearest destination node … and store
    /// it."
    pub(super) fn finished(nodes: Vec<Node>) -> Self {
        let mut graph = Self {
            nodes,
            distances: Vec::new(),
        };
        // Edges lead both ways, so the way there is as long as the way back.
        let destinations: Vec<u32> = graph.ids().filter(|id| graph.is_destination(*id)).collect();
        graph.distances = steps_from(&graph, destinations);
        graph
    }

    /// Returns all nodes, by id.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Returns the ids of all nodes.
    pub fn ids(&self) -> impl Iterator<Item = u32> + use<> {
        0..self.nodes.len() as u32
    }

    /// Returns the memory of nodes and edges, bytes. O(nodes).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let edges = |node: &Node| size_of_val(node.edges.as_slice());
        size_of_val(self.nodes.as_slice()) + self.nodes.iter().map(edges).sum::<usize>()
    }

    /// Returns the number of nodes, without the dummy node.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns whether the graph has no nodes, which never holds for a learned one.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Returns the node of an id, or `None` for ids the graph does not have.
    #[must_use]
    pub fn node(&self, id: u32) -> Option<&Node> {
        self.nodes.get(id as usize)
    }

    /// Returns whether the node was made in the destination zone.
    #[must_use]
    pub fn is_destination(&self, id: u32) -> bool {
        self.node(id)
            .is_some_and(|node| node.zone == NodeZone::Destination)
    }

    /// Returns the number of actions from a node to the nearest destination node, or `None` if the
    /// graph has no destination.
    #[must_use]
    pub fn distance(&self, id: u32) -> Option<u32> {
        self.distances.get(id as usize).copied().flatten()
    }

    /// Returns the node to which `action` leads from `id` if the robot then finds itself in
    /// `state`.
    #[must_use]
    pub fn follow(&self, id: u32, action: Direction, state: u32) -> Option<u32> {
        follow(&self.nodes, id, action, state)
    }

    /// Returns the actions of a shortest path from a node to the nearest destination node; empty at
    /// one. "A simple breadth first search along the graph, then … a list of the values of the
    /// edges connecting the source node to the destination node". Ties go to edges that were
    /// entered earlier.
    ///
    /// The path does not begin with an action that just `failed`: "not allowing the first action to
    /// be equal to the one that failed (this results in a longer path)". Returns `None` if there is
    /// no such path. O(nodes + edges).
    #[must_use]
    pub fn path_to_destination(&self, id: u32, failed: &[Direction]) -> Option<Vec<Direction>> {
        let view = Without {
            graph: self,
            source: id,
            failed,
        };
        let way = path_to(&view, id, |node| self.is_destination(node))?;
        let hops = way.iter().zip(way.iter().skip(1));
        hops.map(|(&tail, &head)| {
            let mut edges = self.node(tail)?.edges.iter();
            let edge = edges.find(|edge| edge.head == Some(head) && view.allows(tail, edge));
            Some(edge?.action)
        })
        .collect()
    }
}

impl Graph for MslstGraph {
    fn node_count(&self) -> usize {
        self.nodes.len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let edges = self.node(node).map_or(&[][..], |node| &node.edges);
        for head in edges.iter().filter_map(|edge| edge.head) {
            visit(head, 1);
        }
    }
}

/// The graph without the edges of one node whose actions just failed there.
struct Without<'a> {
    graph: &'a MslstGraph,
    source: u32,
    failed: &'a [Direction],
}

impl Without<'_> {
    fn allows(&self, tail: u32, edge: &ActionEdge) -> bool {
        tail != self.source || !self.failed.contains(&edge.action)
    }
}

impl Graph for Without<'_> {
    fn node_count(&self) -> usize {
        self.graph.node_count()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let edges = self.graph.node(node).map_or(&[][..], |node| &node.edges);
        let allowed = edges.iter().filter(|edge| self.allows(node, edge));
        for head in allowed.filter_map(|edge| edge.head) {
            visit(head, 1);
        }
    }
}

pub(super) fn follow(nodes: &[Node], id: u32, action: Direction, state: u32) -> Option<u32> {
    let edges = &nodes.get(id as usize)?.edges;
    let heads = edges
        .iter()
        .filter(|edge| edge.action == action)
        .filter_map(|edge| edge.head);
    let leads_there = |head: &u32| nodes.get(*head as usize).map(|node| node.state) == Some(state);
    heads.into_iter().find(leads_there)
}

fn check(nodes: &[Node]) -> Result<(), GraphError> {
    let count = match u32::try_from(nodes.len()) {
        Ok(0) => return Err(GraphError::Empty),
        Ok(count) => count,
        Err(_) => return Err(GraphError::TooMany { count: nodes.len() }),
    };
    let state = |head: Option<u32>| nodes.get(head? as usize).map(|node| node.state);
    for (id, node) in (0..count).zip(nodes) {
        for (place, &ActionEdge { action, head }) in node.edges.iter().enumerate() {
            if let Some(head) = head {
                let Some(there) = nodes.get(head as usize) else {
                    return Err(GraphError::NoSuchNode {
                        node: id,
                        action,
                        head,
                        count,
                    });
                };
                let back = ActionEdge {
                    action: action.opposite(),
                    head: Some(id),
                };
                if !there.edges.contains(&back) {
                    return Err(GraphError::OneWay {
                        node: id,
                        action,
                        head,
                    });
                }
            }
            let alike =
                |other: &ActionEdge| other.action == action && state(other.head) == state(head);
            if node.edges[..place].iter().any(alike) {
                return Err(GraphError::Ambiguous { node: id, action });
            }
        }
    }
    Ok(())
}
