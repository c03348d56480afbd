//! Other people's files, read into plain structs.
//!
//! [`RosMap`] is an occupancy grid as `map_server` of ROS writes it. It has a YAML file with the
//! grid's scale and place, and a PGM picture beside it. [`RosMapHeader`] and [`GreyMap`] are the
//! two files by themselves. [`G2o`] is a pose graph in the plane, read and written.
//!
//! [`WholeLog`] reads logs of robots and bags of ROS, and [`LogReader`] a log line by line; a
//! [`LogReport`] lists the parts of a log that cannot be used. [`ReadTrajectory`] and [`tum`] read
//! and write trajectories, and [`ReadRelations`] reads relative poses. [`UtiasRobot`], [`TucDrive`]
//! and [`SonarTable`] are published data sets. [`dot`], [`graphml`], [`node_link_json`] and
//! [`route_geojson`] write maps of places.
//!
//! ```
//! use tolman_formats::{GreyMap, MapCell, RosMap, RosMapHeader};
//! let yaml = "image: hall.pgm\nresolution: 0.5\norigin: [-1.0, 0.0, 0.0]\nnegate: 0\n\
//!             occupied_thresh: 0.65\nfree_thresh: 0.196\n";
//! let header = RosMapHeader::parse(yaml)?;
//! assert_eq!(header.image, "hall.pgm");
//! let picture = GreyMap::parse(b"P2 2 1 255\n254 0\n")?;
//! let map = RosMap::of(&header, &picture);
//! assert_eq!((map.width, map.height), (2, 1));
//! assert_eq!(map.cells, [MapCell::Free, MapCell::Occupied]);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # From a log to a trajectory
//!
//! `cargo run --example log_to_tum`:
#![doc = "```"]
#![doc = include_str!("../examples/log_to_tum.rs")]
#![doc = "```"]
// Files hold any bytes: a reader indexes nothing and cuts no number off.
#![cfg_attr(
    not(test),
    warn(clippy::indexing_slicing, clippy::cast_possible_truncation)
)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use tolman_geom as geom;
pub use tolman_robot as robot;

mod bag;
mod carmen;
mod fields;
mod g2o;
mod graph;
pub mod input;
mod log;
mod ros_map;
mod sonar_table;
mod trajectory;
mod tuc;
mod unpack;
mod utias;
mod wean;

pub use graph::{dot, graphml, node_link_json, route_geojson};
pub use log::{
    KindCount, LogEntry, LogError, LogOdometry, LogOptions, LogReader, LogReport, LogScan,
    LogTimes, LogTopic, LogTrouble, LogVelocity, TroubleCount, WholeLog,
};

pub use g2o::{G2o, G2oEdge, G2oError, G2oFault, G2oFaultKind, G2oPose};
pub use ros_map::{
    GreyMap, GreyMapError, MapCell, RosMap, RosMapError, RosMapHeader, RosMapHeaderError,
};
pub use sonar_table::SonarTable;
pub use trajectory::{ReadRelations, ReadTrajectory, SpacePose, TrajectoryError, tum};
pub use tuc::{PlaceMatch, TucDrive};
pub use utias::{BarcodeSighting, UtiasRobot};
