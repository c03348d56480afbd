//! A robot that feels its way through a maze: it knows where north is and notices walls by bumping
//! into them, and nothing else. The judge of the map that it makes.

use alloc::collections::BTreeSet;

use tolman_maps::bump_map::{BumpMap, BumpMove, BumpWay, NotStill};
use tolman_maze::{Cell, Direction, Maze};

/// What the robot sees of the place where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BumpSight {
    /// Nothing: all places look alike.
    None,
    /// Which ways are open.
    OpenWays,
}

/// A robot in a maze and the map that it makes.
#[derive(Clone, Debug)]
pub struct BumpWalk<'a> {
    maze: &'a Maze,
    sight: BumpSight,
    at: Cell,
    map: BumpMap,
}

impl<'a> BumpWalk<'a> {
    /// Puts the robot into `start`.
    #[must_use]
    pub fn new(maze: &'a Maze, start: Cell, sight: BumpSight) -> Self {
        Self {
            maze,
            sight,
            at: start,
            map: BumpMap::new(sight.look(maze, start)),
        }
    }

    /// Moves the robot to `action`, if there is no wall, and lets it learn.
    ///
    /// # Errors
    /// Never in a maze, whose walls stand still.
    pub fn step(&mut self, action: Direction) -> Result<(), NotStill> {
        let next = self.maze.beside(self.at, action);
        self.at = next.unwrap_or(self.at);
        self.map.learn(BumpMove {
            action,
            moved: next.is_some(),
            look: self.sight.look(self.maze, self.at),
        })
    }

    /// Returns the map.
    #[must_use]
    pub const fn map(&self) -> &BumpMap {
        &self.map
    }

    /// Returns whether the map is complete and tells every walk from here as it would truly be: it
    /// is the maze up to bisimulation. O(places · cells).
    #[must_use]
    pub fn is_exact(&self) -> bool {
        let first = (self.map.here(), self.at);
        let (mut seen, mut open) = (BTreeSet::from([first]), vec![first]);
        while let Some((place, cell)) = open.pop() {
            for action in Direction::ALL {
                match (self.map.way(place, action), self.maze.beside(cell, action)) {
                    (BumpWay::Closed, None) => {}
                    (BumpWay::To(next), Some(beside)) => {
                        if seen.insert((next, beside)) {
                            open.push((next, beside));
                        }
                    }
                    _ => return false,
                }
            }
        }
        true
    }
}

impl BumpSight {
    fn look(self, maze: &Maze, cell: Cell) -> u32 {
        let open = |side: &Direction| u32::from(maze.is_open(cell, *side)) << side.index();
        match self {
            Self::None => 0,
            Self::OpenWays => Direction::ALL.iter().map(open).sum(),
        }
    }
}

#[cfg(test)]
mod tests {
    use tolman_maze::Grid;

    use super::*;

    #[test]
    fn a_map_is_exact_once_it_tells_every_walk() {
        let mut maze = Maze::open(Grid::new(2, 1));
        let mut walk = BumpWalk::new(&maze, Cell::new(0, 0), BumpSight::OpenWays);
        let mut steps = 0;
        while !walk.is_exact() {
            walk.step(walk.map().advice()).unwrap();
            steps += 1;
        }
        // Three walls of each of two cells, and the way between them.
        assert_eq!((steps, walk.map().untried()), (7, 0));

        let learned = walk.map().clone();
        maze.set_wall(Cell::new(0, 0), Direction::East, true);
        let other = BumpWalk {
            maze: &maze,
            sight: BumpSight::OpenWays,
            at: Cell::new(0, 0),
            map: learned,
        };
        assert!(!other.is_exact(), "its map is of another maze");
    }
}
