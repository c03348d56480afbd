//! A learned map over its world, like the paper's figures 3(a) and 4.

use tolman_draw::{
    Drawing, EdgeLine, FloorPlan, GraphEdge, GraphNode, GraphPicture, KeyMark, Region, Series,
};
use tolman_geom::{Point, PointBox, Vector};
use tolman_maps::diktiometry::{Observer, PlaceId};
use tolman_sim::{Bounds, World};

/// Width of a plan, user units.
const WIDTH: f64 = 560.0;

/// Maximum number of boxes; more would cover each other and hide the world.
const MOST_BOXES: usize = 100;

/// A place of a learned map where it is drawn over the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceMark {
    /// Id of the place on the map.
    pub id: u32,
    /// Box that holds the place for certain, as seen from the start, m.
    pub bounds: Bounds,
    /// Label in words.
    pub label: String,
}

/// Returns the places of a map, moved so that the first lies where the run truly began, m.
#[must_use]
pub fn place_marks(observer: &Observer, start: Point) -> Vec<PlaceMark> {
    let map = observer.map();
    let places = map.layout(PlaceId(0)).into_iter().map(|drawn| {
        let PointBox { x, y } = drawn.bounds;
        let corner = |x: f64, y: f64| start + Vector::new(x, y);
        let visits = map.paths.place(drawn.place).map_or(0, |place| place.visits);
        PlaceMark {
            id: drawn.place.0,
            bounds: Bounds {
                min: corner(x.low(), y.low()),
                max: corner(x.high(), y.high()),
            },
            label: format!("place {}, {visits} visits", drawn.place.0),
        }
    });
    places.collect()
}

/// Returns the places and links over the walls. Each place has its number and its box relative to
/// the robot's start.
///
/// The picture is large enough for all boxes. Maps of more than a hundred places are drawn without
/// boxes and numbers.
#[must_use]
pub fn map_over_world(world: &World, observer: &Observer, drawn: &[PlaceMark]) -> Drawing {
    let boxed = || drawn.iter().filter(|_| drawn.len() <= MOST_BOXES);
    let held: Vec<Point> = boxed()
        .flat_map(|place| [place.bounds.min, place.bounds.max])
        .collect();
    let mut plan = FloorPlan::of_world_holding(world, &held, WIDTH);
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
    for (_, link) in observer.map().paths.links() {
        if let (Some(from), Some(to)) = (node(link.from.0), node(link.to.0)) {
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
