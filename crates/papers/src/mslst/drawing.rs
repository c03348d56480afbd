//! Pictures of what was learned, for reports and the command.

use tolman_maps::mslst_graph::NodeZone;

use crate::plan::model_scan;
use tolman_arena::course::Course;
use tolman_draw::{Drawing, GraphEdge, GraphNode, GraphPicture, NodeMark, Series, Tiles};
use tolman_systems::mslst::Learned;

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

/// Returns the paper's figure 3: every model scan, north upwards, with the number of nodes that
/// have it.
#[must_use]
pub fn states(learned: &Learned) -> Drawing {
    let mut tiles = Tiles::new(6);
    for (state, model) in (0_u32..).zip(learned.map.states.models()) {
        let nodes = learned.map.graph.nodes().iter();
        let count = nodes.filter(|node| node.state == state).count();
        let drawing = model_scan(model.iter().copied(), 96.0, format!("Model scan {state}."));
        tiles.tile(format!("{state}: {count} nodes"), drawing);
    }
    let count = learned.map.states.models().len();
    tiles.drawing(format!("The {count} states of a map."))
}

/// How many actions of Phase II a picture of the graph shows: a part of it, as the paper's, since
/// all of it would be a blot.
pub const SHOWN_ACTIONS: u32 = 500;

/// Returns the paper's figure 4, over the maze: each node of the first [`SHOWN_ACTIONS`] where the
/// robot truly was when it was made, those of the destination filled.
#[must_use]
pub fn graph_over_maze(course: &Course, learned: &Learned) -> Drawing {
    let mut graph = GraphPicture::new().radius(2.0);
    let made_by = learned.survey.made_by.iter();
    let shown = made_by
        .take_while(|action| **action <= SHOWN_ACTIONS)
        .count();
    let nodes = &learned.map.graph.nodes()[..shown];
    for (node, position) in nodes.iter().zip(&learned.survey.positions) {
        let mark = match node.zone {
            NodeZone::Destination => NodeMark::Disc,
            NodeZone::Elsewhere => NodeMark::Ring,
        };
        graph.node(GraphNode::at(*position).mark(mark).series(Series(0)));
    }
    for (from, node) in nodes.iter().enumerate() {
        // Every edge is entered both ways; once is enough to draw.
        let heads = node.edges.iter().filter_map(|edge| edge.head);
        let heads = heads.map(|head| head as usize);
        for head in heads.filter(|head| (from..shown).contains(head)) {
            graph.edge(GraphEdge::between(from, head));
        }
    }
    let mut plan = crate::plan_of_course(course, WIDTH);
    plan.graph(&graph);
    plan.drawing(format!("The graph of a map over {}.", course.name))
}
