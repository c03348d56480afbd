//! Maps of places as graphs, in formats that other programs read. All are written from a
//! [`MapView`](tolman_robot::MapView).
//!
//! All graphs are directed: a way that can be driven in both directions is in the file twice, as it
//! is in the `MapView`.

mod dot;
mod geojson;
mod graphml;
mod node_link;

pub use dot::dot;
pub use geojson::route_geojson;
pub use graphml::graphml;
pub use node_link::node_link_json;
