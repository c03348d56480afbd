use tolman_robot::{MapPlace, MapView};

/// Returns a map of places as node-link JSON, as read by
/// `networkx.node_link_graph(…, edges="links")` and d3. Each place with a position has `x` and `y`,
/// m.
#[must_use]
pub fn node_link_json(map: &MapView) -> String {
    let node = |place: &MapPlace| match place.position {
        Some(at) => format!(
            "{{\"id\":{},\"x\":{:.6},\"y\":{:.6}}}",
            place.id, at.x, at.y
        ),
        None => format!("{{\"id\":{}}}", place.id),
    };
    let nodes: Vec<String> = map.places.iter().map(node).collect();
    let links = map.links.iter();
    let links = links.map(|link| format!("{{\"source\":{},\"target\":{}}}", link.from, link.to));
    let links: Vec<String> = links.collect();
    format!(
        "{{\"directed\":true,\"multigraph\":false,\"graph\":{{}},\"nodes\":[{}],\"links\":[{}]}}\n",
        nodes.join(","),
        links.join(",")
    )
}
