use alloc::collections::BTreeMap;

use tolman_geom::Point;
use tolman_robot::{MapLink, MapView};

/// Returns a map of places as GeoJSON for the route server of ROS 2's navigation (`nav2_route`).
/// Each place is a point, each link a line, in metres of the map's frame. Places without a position
/// are left out, and so are their links. The numbers of links follow those of the places.
///
/// Source: <https://docs.nav2.org/tutorials/docs/route_server_tools/route_graph_generation.html>.
#[must_use]
pub fn route_geojson(map: &MapView) -> String {
    let places = map.places.iter();
    let at: BTreeMap<u32, Point> = places
        .filter_map(|place| Some((place.id, place.position?)))
        .collect();
    let first_link = at.last_key_value().map_or(0, |(id, _)| id + 1);
    let mut features: Vec<String> = at.iter().map(|(id, at)| point(*id, *at)).collect();
    let links = map.links.iter().filter_map(|link| {
        let ends = at.get(&link.from).zip(at.get(&link.to))?;
        Some((link, ends))
    });
    features.extend(
        (first_link..)
            .zip(links)
            .map(|(id, (link, (from, to)))| line(id, *link, *from, *to)),
    );
    format!(
        "{{\"type\":\"FeatureCollection\",\"name\":\"places\",\"features\":[\n{}\n]}}\n",
        features.join(",\n")
    )
}

fn point(id: u32, at: Point) -> String {
    format!(
        "{{\"type\":\"Feature\",\"properties\":{{\"id\":{id},\"frame\":\"map\"}},\"geometry\":{{\"type\":\"Point\",\
         \"coordinates\":[{:.6},{:.6}]}}}}",
        at.x, at.y
    )
}

fn line(id: u32, link: MapLink, from: Point, to: Point) -> String {
    format!(
        "{{\"type\":\"Feature\",\"properties\":{{\"id\":{id},\"startid\":{},\"endid\":{}}},\"geometry\":\
         {{\"type\":\"MultiLineString\",\"coordinates\":[[[{:.6},{:.6}],[{:.6},{:.6}]]]}}}}",
        link.from, link.to, from.x, from.y, to.x, to.y
    )
}
