//! Pictures as SVG: plans of worlds with what robots did and learned there, plots of runs, charts.
//!
//! A [`Drawing`] is the content of a picture; a [`Figure`] is a drawing with its name, title and
//! caption. The same drawing works alone in a file or inline on a page. It is styled only by
//! classes, whose rules ([`style`]) follow the reader's light or dark scheme.
//!
//! | to show | take |
//! | --- | --- |
//! | a maze, trajectories, zones | [`FloorPlan`] |
//! | a learned graph over the maze | [`FloorPlan::graph`] with a [`GraphPicture`] |
//! | where something may be | [`FloorPlan::region`] with a [`Region`]: boxes, ellipses |
//! | values of the cells of a maze | [`FloorPlan::cells`] with a [`Shade`] |
//! | runs of rows | [`BoxPlot`]; every experiment gets those by itself |
//! | a quantity over another, with its spread | [`Chart::line`] |
//! | points, a network over its data | [`Chart::points`], [`Chart::graph`] |
//! | pictures where they were taken | [`Chart::image`] |
//! | values over two parameters | [`HeatMap`] |
//! | scans, as seen from the robot | [`PolarPlot`] |
//! | pixels | [`Image`] |
//! | many small pictures with captions | [`Tiles`] |
//! | figures and tables on a page of their own | [`Page`] |
//!
//! `cargo run -p tolman-papers --example pictures > pictures.html` draws one of each.
//!
//! ```
//! use tolman_draw::{Figure, FloorPlan, Series};
//! use tolman_geom::Point;
//!
//! let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
//! let walls: Vec<[Point; 2]> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
//! let mut plan = FloorPlan::of_walls(&walls, 640.0);
//! plan.trajectory(&[Point::new(0.5, 0.5), Point::new(2.5, 1.5)], Series(0));
//! let figure = Figure::new("room", "A room", plan.drawing("One straight way through a room."));
//! assert!(figure.standalone().starts_with("<svg xmlns="));
//! ```
//!
//! # A plan with a learned map
//!
//! `cargo run --example floor_plan`:
#![doc = "```"]
#![doc = include_str!("../examples/floor_plan.rs")]
#![doc = "```"]

extern crate alloc;

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use tolman_geom as geom;
pub use tolman_robot as robot;
pub use tolman_sim as sim;
pub use tolman_stats as stats;

mod boxplot;
mod chart;
mod figure;
mod floor_plan;
mod graph_picture;
mod heatmap;
mod image;
mod number;
mod page;
mod plan_key;
mod polar;
mod region;
mod scale;
mod series;
mod shade;
mod simplify;
mod tiles;
mod visible;
mod words;

pub use boxplot::{BoxGroup, BoxPlot, Dot, PaperMark};
pub use chart::{Axis, Chart, Line, LinePoint, Points};
pub use figure::{Drawing, Figure, style};
pub use floor_plan::{FloorPlan, ZoneStyle};
pub use graph_picture::{EdgeLine, GraphEdge, GraphNode, GraphPicture, NodeMark};
pub use heatmap::{Hatching, HeatMap};
pub use image::{Image, ImageError};
pub use page::{Page, PageTable};
pub use plan_key::KeyMark;
pub use polar::PolarPlot;
pub use region::Region;
pub use series::Series;
pub use shade::Shade;
pub use tiles::Tiles;
pub use visible::visible;
