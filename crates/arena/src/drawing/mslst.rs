//! Draws learned maps, for reports and the command.

use tolman_maps::mslst_graph::NodeZone;

use crate::course::Course;
use tolman_draw::{Drawing, GraphEdge, GraphNode, GraphPicture, KeyMark, NodeMark, Series};
use tolman_systems::mslst::Learned;

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

/// Number of Phase II actions in the paper's picture of the graph.
pub const SHOWN_ACTIONS: u32 = 500;

/// Returns the paper's figure 4, over the maze: the nodes of the first [`SHOWN_ACTIONS`] actions.
/// Each is at the robot's true position when it was made. Nodes in the destination are filled.
#[must_use]
pub fn graph_over_maze(course: &Course, learned: &Learned) -> Drawing {
    let made_by = learned.survey.made_by.iter();
    let shown = made_by.take_while(|action| **action <= SHOWN_ACTIONS);
    let shown = shown.count();
    over_maze(course, learned, shown, 2.0)
}

/// Returns the whole graph over the maze, each node at the robot's true position when it was made.
/// Nodes in the destination are filled and have their own colour.
#[must_use]
pub fn whole_graph_over_maze(course: &Course, learned: &Learned) -> Drawing {
    over_maze(course, learned, learned.map.graph.len(), 1.1)
}

fn over_maze(course: &Course, learned: &Learned, shown: usize, radius: f64) -> Drawing {
    let mut graph = GraphPicture::new().radius(radius);
    let all = learned.map.graph.nodes();
    let nodes = &all[..shown.min(all.len())];
    for (node, position) in nodes.iter().zip(&learned.survey.positions) {
        let node_picture = GraphNode::at(*position);
        graph.node(match node.zone {
            NodeZone::Destination => node_picture.mark(NodeMark::Disc).series(DESTINATION),
            NodeZone::Elsewhere => node_picture.mark(NodeMark::Ring).series(NODE),
        });
    }
    for (from, node) in nodes.iter().enumerate() {
        // Every edge is stored both ways, so it is drawn only once.
        let heads = node.edges.iter().filter_map(|edge| edge.head);
        let heads = heads.map(|head| head as usize);
        for head in heads.filter(|head| (from..nodes.len()).contains(head)) {
            graph.edge(GraphEdge::between(from, head));
        }
    }
    let destination = |node: &&tolman_maps::mslst_graph::Node| node.zone == NodeZone::Destination;
    let at_goal = nodes.iter().filter(destination).count();
    let mut plan = super::plan_of_course(course, WIDTH);
    plan.graph(&graph);
    let of = match nodes.len() == all.len() {
        true => format!("{} nodes", nodes.len()),
        false => format!("the first {} of {} nodes", nodes.len(), all.len()),
    };
    plan.key(KeyMark::Ring, NODE, of);
    plan.key(
        KeyMark::Disc,
        DESTINATION,
        format!("{at_goal} of them in the destination"),
    );
    plan.key(KeyMark::Line, NODE, "actions");
    plan.drawing(format!("The graph of a map over {}.", course.name))
}

/// Colour of nodes.
const NODE: Series = Series(0);
/// Colour of nodes in the destination.
const DESTINATION: Series = Series(4);
