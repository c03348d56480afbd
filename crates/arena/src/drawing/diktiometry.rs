//! A learned map over its world, like the paper's figures 3(a) and 4.

use tolman_geom::Point;
use tolman_sim::Bounds;

use crate::diktiometry::{Office, Survey};
use tolman_draw::{
    Drawing, EdgeLine, FloorPlan, GraphEdge, GraphNode, GraphPicture, KeyMark, Region, Series,
};

/// Width of a plan, user units.
const WIDTH: f64 = 560.0;

/// Maximum number of boxes; more would cover each other and hide the world.
const MOST_BOXES: usize = 100;

/// Returns the places and links over the walls. Each place has its number and its box relative to
/// the robot's start.
///
/// The picture is large enough for all boxes. Maps of more than a hundred places are drawn without
/// boxes and numbers.
#[must_use]
pub fn map_over_world(office: &Office, survey: &Survey) -> Drawing {
    let drawn = survey.drawn();
    let boxed = || drawn.iter().filter(|_| drawn.len() <= MOST_BOXES);
    let held: Vec<Point> = boxed()
        .flat_map(|place| [place.bounds.min, place.bounds.max])
        .collect();
    let mut plan = FloorPlan::of_world_holding(&office.course.world, &held, WIDTH);
    for place in boxed() {
        plan.region(&Region::within(&place.bounds), Series(1));
    }
    let mut graph = GraphPicture::new();
    let nodes = drawn.iter().map(|place| {
        let Bounds { min, max } = place.bounds;
        let mut node = GraphNode::at(min + 0.5 * (max - min)).note(&place.label);
        if drawn.len() <= MOST_BOXES {
            node = node.label(place.id.to_string());
        }
        (place.id, graph.node(node))
    });
    let nodes: Vec<(u32, usize)> = nodes.collect();
    // The nodes are sorted by id, as the layout is.
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
    plan.key(KeyMark::Ring, Series(0), "place with its number");
    plan.key(KeyMark::Line, Series(0), "link");
    if boxed().next().is_some() {
        plan.key(KeyMark::Box, Series(1), "where the place can lie");
    }
    plan.drawing(format!("A learned map over its world: {places} places."))
}
