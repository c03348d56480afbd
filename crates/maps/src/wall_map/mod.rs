//! The walls of a grid maze as a mouse learns them.
//!
//! After "Plot and Navigate a Virtual Maze" (Wang), section 3.3.1, the *Mapper*: every wall is
//! known to stand, known to be absent, or unknown. There are three differences. Both cells beside a
//! wall share it, so they always agree. The size is any rectangle. Observations can be undone.
//!
//! With the feature `serde` a map is saved and loaded as a `SavedWallMap`, whatever its `N` and
//! `LOG`.
//!
//! Two bits a wall and no allocation: `WallMap<16>` holds mazes up to 16 × 16, `WallMap<32>` up to
//! 32 × 32.

mod cell_ray;
mod draw;
mod log;
mod map;
#[cfg(feature = "serde")]
mod saved;

pub use cell_ray::{CellRay, RayEnd};
pub use map::{ClosedCells, ObserveError, WallMap};
#[cfg(feature = "serde")]
pub use saved::{SavedWallMap, SavedWallMapError};
pub use tolman_planners::TooLarge;
