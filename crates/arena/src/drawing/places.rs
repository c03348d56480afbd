//! Draws learned maps, for reports and the command.

use alloc::collections::BTreeMap;

use crate::course::Course;
use tolman_draw::{Drawing, GraphEdge, GraphNode, GraphPicture, KeyMark, NodeMark, Series};
use tolman_robot::{Landmark, MapView};

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

/// Returns the places of a map over the world, at their positions on the map, with the ways between
/// them. Places where the goal was sensed are filled. Places without a position are left out.
#[must_use]
pub fn places_over_world(course: &Course, map: &MapView) -> Drawing {
    let mut graph = GraphPicture::new().radius(2.0);
    let mut drawn = BTreeMap::new();
    for place in &map.places {
        let Some(at) = place.position else {
            continue;
        };
        let mark = match place.landmark {
            Some(Landmark::Goal) => NodeMark::Disc,
            _ => NodeMark::Ring,
        };
        let node = graph.node(GraphNode::at(at).mark(mark).series(Series(0)));
        drawn.insert(place.id, node);
    }
    // Every way also leads back, so it is drawn only once.
    for link in map.links.iter().filter(|link| link.from < link.to) {
        if let (Some(from), Some(to)) = (drawn.get(&link.from), drawn.get(&link.to)) {
            graph.edge(GraphEdge::between(*from, *to));
        }
    }
    let mut plan = super::plan_of_course(course, WIDTH);
    plan.graph(&graph);
    plan.key(KeyMark::Ring, Series(0), format!("{} places", drawn.len()));
    plan.key(KeyMark::Disc, Series(0), "places of the goal");
    plan.key(KeyMark::Line, Series(0), "ways between them");
    plan.drawing(format!("The places of a map over {}.", course.name))
}
