//! A family of worlds: a spine along the south with teeth of any length, the goal at the end of the
//! last.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman::Family;
use tolman_arena::BoxError;
use tolman_maze::{Cell, Direction, Grid, Maze};

pub const TEETH: Family = Family::new("teeth", "A spine with a tooth at every cell", draw);

fn draw((width, height): (u16, u16), rng: &mut ChaCha8Rng) -> Result<Maze, BoxError> {
    if width < 2 || height < 2 {
        return Err("teeth need 2x2 cells or more".into());
    }
    let grid = Grid::new(width, height);
    let mut maze = Maze::open(grid);
    for cell in grid.cells() {
        maze.set_wall(cell, Direction::North, true);
        maze.set_wall(cell, Direction::East, true);
    }
    let mut end = Cell::new(0, 0);
    for x in 0..width {
        if x + 1 < width {
            maze.set_wall(Cell::new(x, 0), Direction::East, false);
        }
        let length = rng.random_range(1..u32::from(height)) as u16;
        for y in 0..length {
            maze.set_wall(Cell::new(x, y), Direction::North, false);
        }
        end = Cell::new(x, length);
    }
    maze.set_start(Some((Cell::new(0, 0), Direction::East)));
    maze.set_goals(vec![end]);
    Ok(maze)
}
