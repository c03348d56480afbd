//! A learned map over the world it was learned in, as the paper's figures 3(a) and 4.

use tolman_sim::Bounds;

use tolman_arena::diktiometry::{Office, Survey};
use tolman_draw::{
    Drawing, EdgeLine, FloorPlan, GraphEdge, GraphNode, GraphPicture, Region, Series,
};

/// Width of a plan, user units.
const WIDTH: f64 = 560.0;

/// More boxes than these lie over each other and hide the world.
const MOST_BOXES: usize = 100;

/// Returns the places with the boxes that hold them, as seen from where the robot began, and the
/// links, over the walls. Maps of more than a hundred places are drawn without boxes.
#[must_use]
pub fn map_over_world(office: &Office, survey: &Survey) -> Drawing {
    let mut plan = FloorPlan::of_world(&office.course.world, WIDTH);
    let drawn = survey.drawn();
    for place in drawn.iter().filter(|_| drawn.len() <= MOST_BOXES) {
        plan.region(&Region::within(&place.bounds), Series(1));
    }
    let mut graph = GraphPicture::new();
    let nodes = drawn.iter().map(|place| {
        let Bounds { min, max } = place.bounds;
        let node = GraphNode::at(min + 0.5 * (max - min)).note(&place.label);
        (place.id, graph.node(node))
    });
    let nodes: Vec<(u32, usize)> = nodes.collect();
    // By id, as the layout is.
    let node = |id: u32| {
        let at = nodes.binary_search_by_key(&id, |(id, _)| *id).ok()?;
        Some(nodes[at].1)
    };
    for (from, to) in survey.links() {
        if let (Some(from), Some(to)) = (node(from), node(to)) {
            graph.edge(GraphEdge::between(from, to).line(EdgeLine::Arrow));
        }
    }
    plan.graph(&graph);
    let places = drawn.len();
    plan.drawing(format!("A learned map over its world: {places} places."))
}
