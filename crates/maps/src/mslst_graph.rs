//! MSLST's map: a graph of sensory states and the actions that lead from one to the next.
//!
//! Phase II and parts of Phase III of Tingle, Ball, Augat: "Maze Solving by Learning State
//! Topologies". Phase II is *Mapping the Topology Into a Graph*. Of Phase III, it is *Localization*
//! and the search of *Path-Finding*.
//!
//! A [`GraphMapper`] builds the [`MslstGraph`] while the robot wanders. [`localize`] finds the node
//! that fits the robot's latest states and actions. [`MslstGraph::path_to_destination`] returns the
//! way on from there.
//!
//! ```
//! use tolman_maps::mslst_graph::{localize, GraphMapper, Memory, NodeZone};
//! use tolman_maze::Direction::{East, North, West};
//!
//! // A corridor (state 7) to the east, whose bend (state 3) leads north to the destination (state 5).
//! let mut mapper = GraphMapper::new(7, NodeZone::Elsewhere);
//! mapper.failed(North);
//! mapper.succeeded(East, 7, NodeZone::Elsewhere);
//! mapper.succeeded(East, 3, NodeZone::Elsewhere);
//! mapper.succeeded(West, 7, NodeZone::Elsewhere); // back where it was: no node is added
//! mapper.succeeded(East, 3, NodeZone::Elsewhere);
//! mapper.succeeded(North, 5, NodeZone::Destination);
//! let graph = mapper.finish();
//! assert_eq!(graph.len(), 4);
//! assert_eq!(graph.distance(0), Some(3));
//!
//! // Somewhere in state 7. Both nodes with that state fit; the nearer to the destination is taken.
//! let mut memory = Memory::new(8);
//! memory.start(7);
//! assert_eq!(localize(&graph, &memory).node, Some(1));
//! // Once the robot has gone east from 7 to 7 there is one node left.
//! memory.moved(East, 7);
//! let found = localize(&graph, &memory);
//! assert_eq!(found.candidates, [1]);
//! assert_eq!(graph.path_to_destination(1, &[]), Some(vec![East, North]));
//! ```

mod graph;
mod graph_mapper;
mod localize;
mod memory;
mod overlay;

pub use graph::{ActionEdge, GraphError, MslstGraph, Node, NodeZone};
pub use graph_mapper::GraphMapper;
pub use localize::{Localization, localize};
pub use memory::{Experience, Memory};
pub use overlay::overlay;
