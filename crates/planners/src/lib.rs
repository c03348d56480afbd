//! Searches graphs, over anything that can list a node's neighbours.
//!
//! A [`Graph`] numbers its nodes from 0 and lists the arcs that leave one. The searches know
//! nothing of maps, mazes or robots:
//!
//! - [`steps_from`] counts arcs (breadth-first), and [`costs_from`] sums their costs (Dijkstra).
//! - [`path_to`] lists the nodes of a shortest path. [`path_between`] lists those of a cheapest one
//!   from both ends, and [`a_star`] by an admissible heuristic. [`best_first`] lists those of any
//!   path, by the heuristic alone, and [`depth_first`] without one.
//! - [`expected_costs`] plans where actions may fail. [`compressed`] removes detours from a path's
//!   actions.
//!
//! To get distances *to* a goal, search the reversed graph: [`Arcs::reversed`].
//!
//! Grid mazes are searched without a graph, without allocation and some hundred times faster. The
//! search works on [`Passages`], taken from all that is known of their
//! [`Walls`](tolman_maze::Walls). A [`StepMap`] counts cells. [`speed_run`] finds the fastest run
//! of a micromouse, and [`moves`] the one of fewest steps under the simpler rules of a paper. A
//! [`PoseSet`] finds a mouse that has lost its way.
//!
//! ```
//! use tolman_planners::{Arcs, costs_from, steps_from};
//!
//! // 0 → 1 → 2 is two cheap arcs, 0 → 2 one dear arc.
//! let arcs = Arcs::new(3, &[(0, 1, 2), (1, 2, 2), (0, 2, 9)]);
//! assert_eq!(steps_from(&arcs, [0]), [Some(0), Some(1), Some(1)]);
//! assert_eq!(costs_from(&arcs, [0]), [Some(0), Some(2), Some(4)]);
//! // What does it cost to reach node 2 from each?
//! assert_eq!(costs_from(&arcs.reversed(), [2]), [Some(4), Some(2), Some(0)]);
//! ```
//!
//! # A grid of your own
//!
//! `cargo run --example own_grid`:
#![doc = "```"]
#![doc = include_str!("../examples/own_grid.rs")]
#![doc = "```"]
#![allow(clippy::needless_doctest_main, reason = "the example is a program")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use tolman_maze as maze;

#[cfg(feature = "alloc")]
mod arcs;
#[cfg(feature = "alloc")]
mod best_first;
#[cfg(feature = "alloc")]
mod breadth_first;
#[cfg(feature = "alloc")]
mod compression;
#[cfg(feature = "alloc")]
mod depth_first;
#[cfg(feature = "alloc")]
mod dijkstra;
#[cfg(feature = "alloc")]
mod expected_costs;
mod graph;
pub mod lattice;
pub mod moves;
mod passages;
#[cfg(feature = "alloc")]
mod path;
#[cfg(feature = "alloc")]
mod path_between;
mod pose_set;
#[cfg(feature = "alloc")]
mod reached;
#[cfg(feature = "alloc")]
mod ring;
pub mod speed_run;
mod step_map;
mod too_large;

pub use graph::Graph;
pub use passages::{Passages, Unknown};
pub use pose_set::{PoseKnowledge, PoseSet};
pub use step_map::StepMap;
pub use too_large::TooLarge;
#[cfg(feature = "alloc")]
pub use {
    arcs::Arcs,
    best_first::{Found, a_star, best_first},
    breadth_first::steps_from,
    compression::compressed,
    depth_first::depth_first,
    dijkstra::costs_from,
    expected_costs::{Decisions, expected_costs},
    path::path_to,
    path_between::path_between,
};
