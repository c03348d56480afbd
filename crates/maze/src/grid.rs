use core::ops::Range;

use crate::{Cell, Direction};

/// One edge of the grid: the border between two cells, or between a cell and the outside.
///
/// Ids are dense: first the vertical edges row by row from the south-west, then the horizontal
/// ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wall(pub u32);

/// The size of a maze, and with it the numbering of its walls. Needs no memory of its own.
///
/// Up to [`Grid::MAX_SIDE`] a side every wall has its own number; readers and generators refuse
/// more.
///
/// ```
/// use tolman_maze::{Cell, Direction, Grid};
///
/// let grid = Grid::new(16, 16);
/// let here = Cell::new(3, 5);
/// let east = grid.neighbour(here, Direction::East).unwrap();
/// // Both sides of an edge are the same wall.
/// assert_eq!(grid.wall(here, Direction::East), grid.wall(east, Direction::West));
/// assert_eq!(grid.wall_count(), 2 * 16 * 17);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Grid {
    #[cfg_attr(feature = "serde", serde(deserialize_with = "side"))]
    width: u16,
    #[cfg_attr(feature = "serde", serde(deserialize_with = "side"))]
    height: u16,
}

/// Maximum number of columns or rows whose walls 32 bits can number.
const MOST_NUMBERED: u16 = 46_340;

/// Reads the columns or rows of a grid.
#[cfg(feature = "serde")]
fn side<'de, D: serde::Deserializer<'de>>(from: D) -> Result<u16, D::Error> {
    let side = <u16 as serde::Deserialize>::deserialize(from)?;
    if side > Grid::MAX_SIDE {
        let (found, expected) = (
            serde::de::Unexpected::Unsigned(side.into()),
            "a side of 1024 at most",
        );
        return Err(serde::de::Error::invalid_value(found, &expected));
    }
    Ok(side)
}

impl Grid {
    /// Maximum number of columns or rows that readers and generators accept. It is far above any
    /// robot's maze, and low enough that a hostile file cannot ask for much memory.
    pub const MAX_SIDE: u16 = 1024;

    /// Returns a grid of `width` columns and `height` rows. A longer side than 46340 is cut to
    /// that, because 32 bits could not number its walls.
    #[must_use]
    pub const fn new(width: u16, height: u16) -> Self {
        Self {
            width: numbered(width),
            height: numbered(height),
        }
    }

    /// Returns the number of columns.
    #[must_use]
    pub const fn width(self) -> u16 {
        self.width
    }

    /// Returns the number of rows.
    #[must_use]
    pub const fn height(self) -> u16 {
        self.height
    }

    /// Returns the number of cells.
    #[must_use]
    pub const fn cell_count(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Returns the number of walls that could stand, the border's included.
    #[must_use]
    pub const fn wall_count(self) -> usize {
        self.vertical_count() + self.width as usize * (self.height as usize + 1)
    }

    const fn vertical_count(self) -> usize {
        (self.width as usize + 1) * self.height as usize
    }

    /// Returns whether `cell` lies on the grid.
    #[must_use]
    pub const fn contains(self, cell: Cell) -> bool {
        cell.x < self.width && cell.y < self.height
    }

    /// Returns the position of `cell` in row-major order from the south-west.
    #[must_use]
    pub const fn index(self, cell: Cell) -> usize {
        cell.y as usize * self.width as usize + cell.x as usize
    }

    /// Returns all cells in the order of [`Grid::index`].
    pub fn cells(self) -> impl Iterator<Item = Cell> + Clone {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| Cell::new(x, y)))
    }

    /// Returns the edge of `cell` that looks to `direction`. `cell` must lie on the grid.
    #[inline]
    #[must_use]
    pub const fn wall(self, cell: Cell, direction: Direction) -> Wall {
        let (x, y) = (cell.x as usize, cell.y as usize);
        let (width, vertical) = (self.width as usize, self.vertical_count());
        let id = match direction {
            Direction::West => y * (width + 1) + x,
            Direction::East => y * (width + 1) + x + 1,
            Direction::South => vertical + y * width + x,
            Direction::North => vertical + (y + 1) * width + x,
        };
        Wall(id as u32)
    }

    /// Returns the cell that `wall` is a side of, and which: the inverse of [`Grid::wall`]. Of two
    /// such cells it is the one in the west or south. None for a number that no wall of this grid
    /// has.
    ///
    /// ```
    /// use tolman_maze::{Cell, Direction, Grid, Wall};
    ///
    /// let grid = Grid::new(3, 3);
    /// let wall = grid.wall(Cell::new(1, 1), Direction::West);
    /// assert_eq!(grid.side(wall), Some((Cell::new(0, 1), Direction::East)));
    /// assert_eq!(grid.side(Wall(999)), None);
    /// ```
    #[must_use]
    pub const fn side(self, wall: Wall) -> Option<(Cell, Direction)> {
        let (id, vertical) = (wall.0 as usize, self.vertical_count());
        if id >= self.wall_count() {
            return None;
        }
        let (columns, first) = if id < vertical {
            (self.width as usize + 1, 0)
        } else {
            (self.width as usize, vertical)
        };
        let place = id - first;
        // Without columns there are no walls.
        let (Some(x), Some(y)) = (place.checked_rem(columns), place.checked_div(columns)) else {
            return None;
        };
        let (x, y) = (x as u16, y as u16);
        Some(if id < vertical {
            match x.checked_sub(1) {
                Some(west) => (Cell::new(west, y), Direction::East),
                None => (Cell::new(x, y), Direction::West),
            }
        } else {
            match y.checked_sub(1) {
                Some(south) => (Cell::new(x, south), Direction::North),
                None => (Cell::new(x, y), Direction::South),
            }
        })
    }

    /// Returns the cell beyond the `direction` edge of `cell`, or `None` outside the grid.
    #[inline]
    #[must_use]
    pub fn neighbour(self, cell: Cell, direction: Direction) -> Option<Cell> {
        cell.beyond(direction).filter(|next| self.contains(*next))
    }

    /// Returns the middle of the grid, where classic competitions put the goal: two columns by two
    /// rows, one where the width or height is odd.
    ///
    /// ```
    /// use tolman_maze::{Cell, Grid};
    ///
    /// assert!(Grid::new(5, 5).middle().eq([Cell::new(2, 2)]));
    /// assert!(Grid::new(4, 1).middle().eq([Cell::new(1, 0), Cell::new(2, 0)]));
    /// ```
    pub fn middle(self) -> impl Iterator<Item = Cell> {
        let (columns, rows) = (middle(self.width), middle(self.height));
        columns.flat_map(move |x| rows.clone().map(move |y| Cell::new(x, y)))
    }

    /// Returns every edge of the outer border once: the cell inside and the side it is on.
    pub fn border(self) -> impl Iterator<Item = (Cell, Direction)> {
        let sides = self
            .cells()
            .flat_map(|cell| Direction::ALL.map(|side| (cell, side)));
        sides.filter(move |(cell, side)| self.neighbour(*cell, *side).is_none())
    }

    /// Returns every edge between two cells once: the cell south or west of it, the side of that
    /// cell that it is on, and the cell beyond.
    pub fn inner_edges(self) -> impl Iterator<Item = (Cell, Direction, Cell)> {
        let sides = self
            .cells()
            .flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)]);
        sides.filter_map(move |(cell, side)| Some((cell, side, self.neighbour(cell, side)?)))
    }
}

/// Returns the side of a grid whose walls can be numbered.
const fn numbered(side: u16) -> u16 {
    if side < MOST_NUMBERED {
        side
    } else {
        MOST_NUMBERED
    }
}

/// Returns the one or two middle values of `0..count`.
fn middle(count: u16) -> Range<u16> {
    count.saturating_sub(1) / 2..count.min(count / 2 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_edge_has_its_own_number_and_no_number_is_left_over() {
        for (width, height) in [(1, 1), (1, 5), (4, 1), (5, 7), (16, 16)] {
            let grid = Grid::new(width, height);
            let mut seen = [false; 600];
            for cell in grid.cells() {
                for direction in Direction::ALL {
                    let wall = grid.wall(cell, direction);
                    seen[wall.0 as usize] = true;
                    if let Some(beside) = grid.neighbour(cell, direction) {
                        assert_eq!(wall, grid.wall(beside, direction.opposite()));
                    }
                }
            }
            assert!(seen[..grid.wall_count()].iter().all(|seen| *seen));
            assert!(!seen[grid.wall_count()..].iter().any(|seen| *seen));
            for id in 0..grid.wall_count() as u32 {
                let (cell, direction) = grid.side(Wall(id)).unwrap();
                assert!(grid.contains(cell));
                assert_eq!(grid.wall(cell, direction), Wall(id));
            }
            assert_eq!(grid.side(Wall(grid.wall_count() as u32)), None);
        }
    }

    #[test]
    fn the_largest_grid_numbers_all_its_walls() {
        let grid = Grid::new(u16::MAX, u16::MAX);
        let last = Cell::new(grid.width() - 1, grid.height() - 1);
        for (cell, direction) in [
            (last, Direction::North),
            (last, Direction::East),
            (Cell::new(0, 0), Direction::South),
        ] {
            let wall = grid.wall(cell, direction);
            assert_eq!(grid.side(wall), Some((cell, direction)));
        }
        assert_eq!(grid.neighbour(last, Direction::East), None);
        assert_eq!(Grid::new(3, 2).width(), 3);
    }

    #[test]
    fn the_border_is_the_edges_without_a_neighbour() {
        for (width, height) in [(1, 1), (1, 5), (5, 3), (0, 3), (3, 0)] {
            let grid = Grid::new(width, height);
            let outer = grid
                .cells()
                .flat_map(|cell| Direction::ALL.map(|direction| (cell, direction)))
                .filter(|(cell, direction)| grid.neighbour(*cell, *direction).is_none());
            assert_eq!(grid.border().count(), outer.clone().count());
            assert!(
                outer
                    .into_iter()
                    .all(|edge| grid.border().any(|border| border == edge))
            );
        }
    }

    #[test]
    fn the_index_counts_the_cells() {
        let grid = Grid::new(7, 3);
        assert!(
            grid.cells()
                .map(|cell| grid.index(cell))
                .eq(0..grid.cell_count())
        );
        assert_eq!(Grid::new(0, 9).middle().count(), 0);
        assert_eq!(Grid::new(1, 1).middle().count(), 1);
        assert_eq!(Grid::new(16, 16).middle().count(), 4);
    }
}
