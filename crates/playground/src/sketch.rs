use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;
use tolman_arena::family::Family;
use tolman_maze::{Cell, Direction, Format, Grid, Maze, MazeFile};

use crate::PlaygroundError;

/// A maze that a visitor is drawing, which need not have a way to the goal yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    pub(crate) name: String,
    pub(crate) maze: Maze,
}

/// The parts of a [`Sketch`] to draw. Cells are counted from the south-west.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SketchPlan {
    /// Number of columns.
    pub width: u16,
    /// Number of rows.
    pub height: u16,
    /// All edges between cells and of the border, each once.
    pub walls: Vec<SketchWall>,
    /// Cell of the start; `None` if there is none.
    pub start: Option<[u16; 2]>,
    /// Cells of the goal.
    pub goals: Vec<[u16; 2]>,
    /// Reason why no robot can be sent into the maze; `None` if one can.
    pub fault: Option<String>,
}

/// An edge of a [`SketchPlan`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SketchWall {
    /// Cell beside the edge.
    pub cell: [u16; 2],
    /// Side of that cell on which the edge is.
    pub side: Direction,
    /// Whether the wall stands.
    pub stands: bool,
    /// Whether the wall is a part of the border, which always stands.
    pub is_border: bool,
}

impl Sketch {
    /// Numbers of columns and rows that can be drawn.
    pub const SIDES: core::ops::RangeInclusive<u16> = 5..=16;

    /// Reads the text of a maze file in any format.
    ///
    /// # Errors
    /// [`PlaygroundError::Maze`] if it is invalid, or no way leads to its goal.
    pub fn read(text: &str) -> Result<Self, PlaygroundError> {
        let MazeFile { name, maze, .. } = tolman_maze::read(text)?;
        let name = name.unwrap_or_else(|| "own".to_owned());
        Ok(Self { name, maze })
    }

    /// Draws a maze of a [family](Family::all), of `size` columns and rows at most, from a seed.
    ///
    /// # Errors
    /// [`PlaygroundError::Family`] if there is no such family, or it has no drawing of that size.
    pub fn drawn(family: &str, size: u16, seed: u64) -> Result<Self, PlaygroundError> {
        let families = Family::all();
        let cannot = |source| PlaygroundError::Family {
            name: family.to_owned(),
            source,
        };
        let known = Family::named(&families, family);
        let known = known.ok_or_else(|| cannot("there is no such family".into()))?;
        // A family whose worlds are not square gets this width, and the height that belongs to it.
        let [.., (columns, rows)] = known.sizes;
        let share = |side: u16| (side * size).div_ceil(columns.max(rows)).clamp(1, size);
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let maze = (known.draw)((share(columns), share(rows)), &mut rng).map_err(cannot)?;
        let name = known.name.to_owned();
        Ok(Self { name, maze })
    }

    /// Returns a maze without inner walls, its start and goal in opposite corners.
    #[must_use]
    pub fn empty(size: u16) -> Self {
        let size = size.clamp(*Self::SIDES.start(), *Self::SIDES.end());
        let mut maze = Maze::open(Grid::new(size, size));
        maze.set_start(Some((Cell::new(0, 0), Direction::North)));
        maze.set_goals(vec![Cell::new(size - 1, size - 1)]);
        let name = "own".to_owned();
        Self { name, maze }
    }

    /// Builds or removes the wall on a side of a cell. The border, and cells that are not there,
    /// are left as they are.
    pub fn set_wall(&mut self, cell: Cell, side: Direction, stands: bool) {
        let grid = self.maze.grid();
        if grid.contains(cell) && grid.neighbour(cell, side).is_some() {
            self.maze.set_wall(cell, side, stands);
            "own".clone_into(&mut self.name);
        }
    }

    /// Moves the start. The robot looks along an open way if there is one.
    pub fn set_start(&mut self, cell: Cell) {
        if self.maze.grid().contains(cell) {
            let way = self.maze.neighbours(cell).next();
            let way = way.map_or(Direction::North, |(way, _)| way);
            self.maze.set_start(Some((cell, way)));
            "own".clone_into(&mut self.name);
        }
    }

    /// Makes one cell the goal.
    pub fn set_goal(&mut self, cell: Cell) {
        if self.maze.grid().contains(cell) {
            self.maze.set_goals(vec![cell]);
            "own".clone_into(&mut self.name);
        }
    }

    /// Returns the name of the maze: that of its file or family, or `own`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the maze.
    #[must_use]
    pub const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Returns the maze as the text of a `.maze` file.
    #[must_use]
    pub fn text(&self) -> String {
        let file = MazeFile::from(self.maze.clone());
        // A drawing alone does not give the heading of a robot that starts before a wall.
        tolman_maze::write(&file, Format::Tolman).unwrap_or_else(|_| self.maze.to_string())
    }

    /// Returns the reason why no robot can be sent into the maze, as a sentence without a full
    /// stop; `None` if one can.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let Some((start, _)) = self.maze.start() else {
            return Some("it has no start".to_owned());
        };
        if self.maze.goals().contains(&start) {
            return Some("the start is at the goal".to_owned());
        }
        self.maze.check().err().map(|error| error.to_string())
    }

    /// Returns the drawing of the sketch. O(cells).
    #[must_use]
    pub fn plan(&self) -> SketchPlan {
        let grid = self.maze.grid();
        let place = |cell: Cell| [cell.x, cell.y];
        let walls = grid.cells().flat_map(|cell| {
            let sides = Direction::ALL.into_iter().filter(move |side| {
                // Each edge from the south or the west.
                let is_border = grid.neighbour(cell, *side).is_none();
                is_border || matches!(side, Direction::North | Direction::East)
            });
            sides.map(move |side| SketchWall {
                cell: place(cell),
                side,
                stands: !self.maze.is_open(cell, side),
                is_border: grid.neighbour(cell, side).is_none(),
            })
        });
        SketchPlan {
            width: grid.width(),
            height: grid.height(),
            walls: walls.collect(),
            start: self.maze.start().map(|(cell, _)| place(cell)),
            goals: self.maze.goals().iter().copied().map(place).collect(),
            fault: self.fault(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_edge_is_drawn_once() {
        let plan = Sketch::empty(6).plan();
        assert_eq!((plan.width, plan.height), (6, 6));
        assert_eq!(plan.walls.len(), 2 * 6 * 7);
        let border = plan.walls.iter().filter(|wall| wall.is_border).count();
        assert_eq!(border, 4 * 6);
        assert!(plan.walls.iter().all(|wall| wall.stands == wall.is_border));
        assert_eq!(plan.fault, None);
    }

    #[test]
    fn a_wall_stands_until_it_is_removed_and_the_border_for_ever() {
        let mut sketch = Sketch::empty(5);
        let before = sketch.plan();
        sketch.set_wall(Cell::new(1, 1), Direction::North, true);
        assert_ne!(sketch.plan(), before);
        sketch.set_wall(Cell::new(1, 2), Direction::South, false);
        assert_eq!(sketch.plan(), before);
        for cell in [Cell::new(0, 0), Cell::new(9, 9)] {
            sketch.set_wall(cell, Direction::West, false);
            assert_eq!(sketch.plan(), before);
        }
    }

    #[test]
    fn a_goal_that_is_walled_in_is_told() {
        let mut sketch = Sketch::empty(5);
        sketch.set_goal(Cell::new(2, 2));
        for side in Direction::ALL {
            assert_eq!(sketch.fault(), None);
            sketch.set_wall(Cell::new(2, 2), side, true);
        }
        let fault = sketch.fault().unwrap();
        assert!(fault.contains("way"), "{fault}");
        sketch.set_start(Cell::new(2, 2));
        assert_eq!(sketch.fault().unwrap(), "the start is at the goal");
    }

    #[test]
    fn what_is_written_is_read_again() {
        for family in Family::all() {
            for size in [5, 9, 16] {
                let Ok(sketch) = Sketch::drawn(family.name, size, 1) else {
                    continue;
                };
                assert_eq!(sketch, Sketch::drawn(family.name, size, 1).unwrap());
                let read = Sketch::read(&sketch.text()).unwrap();
                assert_eq!(read.maze, sketch.maze, "{}", family.name);
            }
        }
        assert!(Sketch::read("no maze").is_err());
        assert!(Sketch::drawn("towns", 8, 1).is_err());
    }
}
