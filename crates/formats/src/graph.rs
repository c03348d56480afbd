//! Maps of places as graphs, in formats that other programs read. All are written from a
//! [`MapView`](tolman_robot::MapView).
//!
//! A way that can be driven both ways is in a `MapView` twice, and so it is in the files: all
//! graphs are directed.

mod dot;
mod geojson;
mod graphml;
mod node_link;

pub use dot::dot;
pub use geojson::route_geojson;
pub use graphml::graphml;
pub use node_link::node_link_json;
