//! Maps of places as graphs, in the formats that others read: all of them are written from a
//! [`MapView`](tolman_robot::MapView).
//!
//! A way that can be gone both ways stands in a `MapView` twice, and so it does in the files: all
//! graphs are directed.

mod dot;
mod geojson;
mod graphml;
mod node_link;

pub use dot::dot;
pub use geojson::route_geojson;
pub use graphml::graphml;
pub use node_link::node_link_json;
