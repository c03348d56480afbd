use alloc::vec;
use alloc::vec::Vec;

use rand::Rng;

use super::perfect::carve;
use super::{GenerateError, chance, grid, mark};
use crate::{Cell, Direction, Grid, Maze};

/// Rooms and corridors: open rectangles, the space between them filled with winding corridors, and
/// doors from one to the other.
///
/// Rooms are tried at random places and kept where they overlap neither another room nor the start.
/// So there may be fewer than asked for. Corridors come from the recursive backtracker. Doors first
/// make a tree of all rooms and corridors, then close loops. Start in the south-west, goal in the
/// middle. O(cells + attempts · largest²).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rooms {
    /// Number of columns.
    pub width: u16,
    /// Number of rows.
    pub height: u16,
    /// Number of tries to place a room.
    pub attempts: u32,
    /// Shortest side of a room, cells.
    pub smallest: u16,
    /// Longest side of a room, cells.
    pub largest: u16,
    /// Number of doors beyond those that connect everything. Each closes a cycle.
    pub extra_doors: u32,
}

impl Rooms {
    /// Generates the maze that `rng` leads to.
    ///
    /// # Errors
    /// [`GenerateError::Size`], [`GenerateError::RoomSide`].
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use tolman_maze::Rooms;
    ///
    /// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    /// let rooms = Rooms {
    ///     width: 20, height: 12, attempts: 30, smallest: 2, largest: 4, extra_doors: 3,
    /// };
    /// let maze = rooms.generate(&mut rng).unwrap();
    /// assert!(maze.steps_to_goal().iter().all(Option::is_some));
    /// ```
    pub fn generate(&self, rng: &mut impl Rng) -> Result<Maze, GenerateError> {
        let grid = grid(self.width, self.height)?;
        let Self {
            smallest,
            largest,
            width,
            height,
            ..
        } = *self;
        if smallest == 0 || smallest > largest || largest > width.min(height) {
            return Err(GenerateError::RoomSide {
                smallest,
                largest,
                width,
                height,
            });
        }
        let mut maze = Maze::solid(grid);
        let mut regions = vec![None; grid.cell_count()];
        let mut count = 0;
        for _ in 0..self.attempts {
            let room = Room::at_random(self, rng);
            if room
                .cells()
                .all(|cell| cell != START && regions[grid.index(cell)].is_none())
            {
                room.open(&mut maze);
                room.cells()
                    .for_each(|cell| regions[grid.index(cell)] = Some(count));
                count += 1;
            }
        }
        for cell in grid.cells() {
            if regions[grid.index(cell)].is_none() {
                carve(&mut maze, &mut regions, count, cell, rng);
                count += 1;
            }
        }
        self.add_doors(&mut maze, &regions, count, rng);
        mark(&mut maze);
        Ok(maze)
    }

    /// Joins all regions, of which there are `count`, and adds the extra doors.
    fn add_doors(&self, maze: &mut Maze, regions: &[Option<u32>], count: u32, rng: &mut impl Rng) {
        let grid = maze.grid();
        let region = |cell| regions[grid.index(cell)].unwrap_or_default();
        let mut walls: Vec<(Cell, Direction, [u32; 2])> = Vec::new();
        for (cell, direction, next) in grid.inner_edges() {
            if region(cell) != region(next) {
                walls.push((cell, direction, [region(cell), region(next)]));
            }
        }
        chance::shuffle(&mut walls, rng);

        // Kruskal's spanning tree over the regions.
        let mut parents: Vec<u32> = (0..count).collect();
        let mut extra = Vec::new();
        for (cell, direction, sides) in walls {
            let [a, b] = sides.map(|region| root(&mut parents, region));
            if a == b {
                extra.push((cell, direction));
            } else {
                parents[a as usize] = b;
                maze.set_wall(cell, direction, false);
            }
        }
        for (cell, direction) in extra.into_iter().take(self.extra_doors as usize) {
            maze.set_wall(cell, direction, false);
        }
    }
}

const START: Cell = Cell::new(0, 0);

/// A rectangle of cells, from its south-west corner.
struct Room {
    corner: Cell,
    width: u16,
    height: u16,
}

impl Room {
    fn at_random(rooms: &Rooms, rng: &mut impl Rng) -> Self {
        let width = chance::between(rooms.smallest, rooms.largest, rng);
        let height = chance::between(rooms.smallest, rooms.largest, rng);
        let x = chance::between(0, rooms.width - width, rng);
        let y = chance::between(0, rooms.height - height, rng);
        Self {
            corner: Cell::new(x, y),
            width,
            height,
        }
    }

    fn cells(&self) -> impl Iterator<Item = Cell> {
        let Cell { x, y } = self.corner;
        Grid::new(self.width, self.height)
            .cells()
            .map(move |cell| Cell::new(x + cell.x, y + cell.y))
    }

    /// Removes the walls within the room.
    fn open(&self, maze: &mut Maze) {
        for cell in self.cells() {
            if cell.x > self.corner.x {
                maze.set_wall(cell, Direction::West, false);
            }
            if cell.y > self.corner.y {
                maze.set_wall(cell, Direction::South, false);
            }
        }
    }
}

/// Returns the representative of a region's set, shortening the way to it.
fn root(parents: &mut [u32], mut region: u32) -> u32 {
    while parents[region as usize] != region {
        let grandparent = parents[parents[region as usize] as usize];
        parents[region as usize] = grandparent;
        region = grandparent;
    }
    region
}
