//! Pictures as SVG: plans of worlds with what robots did there, and box plots of runs.
//!
//! A [`Drawing`] is the content of a picture; a [`Figure`] is a drawing with its name, title and
//! caption. The same drawing stands alone in a file or inline on a page: it is styled by classes
//! only, whose rules ([`style`]) follow the reader's light or dark scheme.
//!
//! ```
//! use tolman::draw::{Figure, Plan, Series};
//! use tolman_geom::Point;
//!
//! let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
//! let walls: Vec<[Point; 2]> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
//! let mut plan = Plan::of_walls(&walls, 640.0);
//! plan.trajectory(&[Point::new(0.5, 0.5), Point::new(2.5, 1.5)], Series(0));
//! let figure = Figure::new("room", "A room", plan.drawing("One straight way through a room."));
//! assert!(figure.standalone().starts_with("<svg xmlns="));
//! ```

mod boxplot;
mod figure;
mod number;
mod plan;
mod scale;
mod series;

pub use boxplot::{BoxGroup, BoxPlot, Dot, PaperMark};
pub use figure::{Drawing, Figure, style};
pub use plan::{Plan, Zone};
pub use series::Series;
