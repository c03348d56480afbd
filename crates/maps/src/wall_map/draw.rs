use core::fmt;

use tolman_maze::{Cell, Direction, Knowledge, Walls};

use super::WallMap;

/// Draws the map as mazes are drawn, north first; a dot marks every unknown wall.
impl<const N: usize, const LOG: usize> fmt::Display for WallMap<N, LOG> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grid = self.grid();
        for y in (0..grid.height()).rev() {
            self.line(f, y, Direction::North)?;
            f.write_str(self.upright(Cell::new(0, y), Direction::West))?;
            for x in 0..grid.width() {
                f.write_str("   ")?;
                f.write_str(self.upright(Cell::new(x, y), Direction::East))?;
            }
            f.write_str("\n")?;
        }
        if grid.height() > 0 {
            self.line(f, 0, Direction::South)?;
        }
        Ok(())
    }
}

impl<const N: usize, const LOG: usize> WallMap<N, LOG> {
    /// Draws the walls on one side of row `y`, between posts.
    fn line(&self, f: &mut fmt::Formatter<'_>, y: u16, side: Direction) -> fmt::Result {
        for x in 0..self.grid().width() {
            f.write_str(match self.knowledge(Cell::new(x, y), side) {
                Knowledge::Unknown => "o . ",
                Knowledge::Open => "o   ",
                Knowledge::Wall => "o---",
            })?;
        }
        f.write_str("o\n")
    }

    fn upright(&self, cell: Cell, side: Direction) -> &'static str {
        match self.knowledge(cell, side) {
            Knowledge::Unknown => ".",
            Knowledge::Open => " ",
            Knowledge::Wall => "|",
        }
    }
}
