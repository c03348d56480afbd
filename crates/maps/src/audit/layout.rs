//! Places the poses by the supported closures.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Reverse;

use tolman_geom::Pose;

use super::chain::{cost_of, spread_of};
use super::{Audit, AuditConfig};
use crate::pose_graph::{OptimizerConfig, PoseEdgeKind, PoseGraph};

/// Number of steps of the optimizer: enough for a picture.
const STEPS: u32 = 10;
const ITERATIONS: usize = 200;

/// Returns the graph with odometry and supported closures alone, and its poses placed by them.
/// Poses are first placed along the surest way from the first, then optimized. Poses that nothing
/// joins with the first stay as they are.
///
/// # Complexity
/// O(edges · log poses), and 2000 times O(edges) at most to optimize.
#[must_use]
pub fn supported_graph(graph: &PoseGraph, config: &AuditConfig, audit: &Audit) -> PoseGraph {
    let supported = audit
        .closures
        .iter()
        .filter(|closure| closure.verdict.is_supported());
    let supported: Vec<u32> = supported.map(|closure| closure.edge).collect();
    let mut cleaned = PoseGraph::new();
    for pose in graph.poses() {
        cleaned.add_pose(*pose);
    }
    for (index, edge) in (0..).zip(graph.edges()) {
        if edge.kind == PoseEdgeKind::Odometry || supported.binary_search(&index).is_ok() {
            // It was an edge of a graph before.
            let _ = cleaned.add_edge(*edge);
        }
    }
    place(&mut cleaned, config);
    cleaned.optimize(&OptimizerConfig {
        most_steps: STEPS,
        most_iterations: ITERATIONS,
        ..OptimizerConfig::plain()
    });
    cleaned
}

/// Moves every pose to its position along the surest way from the first (Dijkstra).
fn place(graph: &mut PoseGraph, config: &AuditConfig) {
    let mut edges_of: Vec<Vec<u32>> = alloc::vec![Vec::new(); graph.poses().len()];
    for (index, edge) in (0..).zip(graph.edges()) {
        edges_of[edge.from as usize].push(index);
        edges_of[edge.to as usize].push(index);
    }
    let costs: Vec<f64> = graph
        .edges()
        .iter()
        .map(|edge| cost_of(&spread_of(edge, config), config))
        .collect();
    let mut least = alloc::vec![f64::INFINITY; graph.poses().len()];
    let mut heap = BinaryHeap::new();
    if let Some(first) = least.first_mut() {
        *first = 0.0;
        heap.push(Reverse((0_u64, 0_u32)));
    }
    while let Some(Reverse((cost, pose))) = heap.pop() {
        if cost != least[pose as usize].to_bits() {
            continue;
        }
        for edge in &edges_of[pose as usize] {
            let (next, measured) = across(graph, *edge, pose);
            let cost = f64::from_bits(cost) + costs[*edge as usize];
            if cost < least[next as usize] {
                least[next as usize] = cost;
                graph.move_pose(next, graph.poses()[pose as usize].compose(measured));
                heap.push(Reverse((cost.to_bits(), next)));
            }
        }
    }
}

/// Returns the pose at the other end of an edge, as seen from this one.
fn across(graph: &PoseGraph, edge: u32, pose: u32) -> (u32, Pose) {
    let edge = &graph.edges()[edge as usize];
    match edge.from == pose {
        true => (edge.to, edge.measured),
        false => (edge.from, edge.measured.inverse()),
    }
}
