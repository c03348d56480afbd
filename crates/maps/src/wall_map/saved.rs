// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::{Cell, Grid, Knowledge, Wall, Walls};

use super::{ClosedCells, TooLarge, WallMap};

/// Contents of a [`WallMap`]'s file. Works with any format of serde's.
///
/// ```
/// use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
/// use tolman_maze::{Cell, Direction, Grid};
///
/// let mut map: WallMap<16> = WallMap::new(Grid::new(9, 9), ClosedCells::Possible)?;
/// map.observe(Cell::new(0, 0), &[CellRay::to_wall(Direction::North, 3)])?;
/// let text = serde_json::to_string(&map)?;
/// let mut read: WallMap<16> = serde_json::from_str(&text)?;
/// assert_eq!(read, map);
/// assert_eq!(read.undo(1), 1, "what was saved can be forgotten");
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedWallMap {
    /// Size of the maze.
    pub grid: Grid,
    /// Whether the maze's rules allow cells with four walls.
    pub closed_cells: ClosedCells,
    /// Walls known not to stand, each inside the border and named once.
    pub open: Vec<Wall>,
    /// Walls known to stand, in the same form. Border walls are left out.
    pub standing: Vec<Wall>,
    /// The observations that can be forgotten again, the oldest first, each with the walls that it
    /// revealed. A map with a shorter memory drops the oldest.
    pub remembered: Vec<Vec<Wall>>,
    /// Number of visits to each cell, row by row from the south; 255 stands for all greater
    /// numbers.
    pub visits: Vec<Vec<u8>>,
}

impl<const N: usize, const LOG: usize> From<WallMap<N, LOG>> for SavedWallMap {
    fn from(map: WallMap<N, LOG>) -> Self {
        let grid = map.grid();
        let walls = |what: Knowledge| -> Vec<Wall> {
            let all = (0..).map(Wall).take(grid.wall_count());
            all.filter(|wall| is_inner(grid, *wall) && map.wall(*wall) == what)
                .collect()
        };
        let row = |y| (0..grid.width()).map(move |x| map.visits(Cell::new(x, y)));
        Self {
            grid,
            closed_cells: map.closed_cells(),
            open: walls(Knowledge::Open),
            standing: walls(Knowledge::Wall),
            remembered: map.remembered(),
            visits: (0..grid.height()).map(|y| row(y).collect()).collect(),
        }
    }
}

impl<const N: usize, const LOG: usize> TryFrom<SavedWallMap> for WallMap<N, LOG> {
    type Error = SavedWallMapError;

    fn try_from(saved: SavedWallMap) -> Result<Self, SavedWallMapError> {
        let SavedWallMap {
            grid,
            closed_cells,
            open,
            standing,
            remembered,
            visits,
        } = saved;
        let mut map = Self::new(grid, closed_cells)?;
        for (walls, knowledge) in [(open, Knowledge::Open), (standing, Knowledge::Wall)] {
            for wall in walls {
                if !is_inner(grid, wall) {
                    return Err(SavedWallMapError::NotInside { wall: wall.0, grid });
                }
                if map.wall(wall).is_known() {
                    return Err(SavedWallMapError::Twice { wall: wall.0 });
                }
                map.restore_wall(wall, knowledge);
            }
        }
        let mut named = BTreeSet::new();
        for observation in remembered {
            for (place, wall) in (0..).zip(observation) {
                if !is_inner(grid, wall) {
                    return Err(SavedWallMapError::NotInside { wall: wall.0, grid });
                }
                if !map.wall(wall).is_known() {
                    return Err(SavedWallMapError::Unknown { wall: wall.0 });
                }
                if !named.insert(wall) {
                    return Err(SavedWallMapError::Twice { wall: wall.0 });
                }
                map.restore_log(wall, place);
            }
        }
        let (width, height) = (usize::from(grid.width()), usize::from(grid.height()));
        if visits.len() != height || visits.iter().any(|row| row.len() != width) {
            return Err(SavedWallMapError::Visits { grid });
        }
        for (cell, count) in grid.cells().zip(visits.into_iter().flatten()) {
            map.restore_visits(cell, count);
        }
        Ok(map)
    }
}

/// Returns whether a cell of the grid lies on both sides of the wall.
fn is_inner(grid: Grid, wall: Wall) -> bool {
    let side = grid.side(wall);
    side.is_some_and(|(cell, direction)| grid.neighbour(cell, direction).is_some())
}

/// Reason why a saved map is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SavedWallMapError {
    /// The maze does not fit.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// A wall is not between two cells of the maze.
    #[error(
        "wall {wall} is not between two cells of a maze of {} × {}: remove it",
        grid.width(), grid.height()
    )]
    NotInside {
        /// Number of the wall.
        wall: u32,
        /// Size of the maze.
        grid: Grid,
    },
    /// A wall is named twice, as open, as standing or as remembered.
    #[error("wall {wall} is named twice: name it once")]
    Twice {
        /// Number of the wall.
        wall: u32,
    },
    /// The log remembers an observation of a wall that is unknown.
    #[error(
        "wall {wall} is remembered, but is neither open nor standing: name it there, or forget it"
    )]
    Unknown {
        /// Number of the wall.
        wall: u32,
    },
    /// The visits are not one number per cell.
    #[error(
        "the visits are not {} rows of {} numbers: give one for each cell, row by row from the south",
        grid.height(), grid.width()
    )]
    Visits {
        /// Size of the maze.
        grid: Grid,
    },
}
