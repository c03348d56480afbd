//! A robot that feels its way through a maze: it knows where north is and notices walls by bumping
//! into them, and nothing else. The judge of the map that it makes.

use alloc::collections::BTreeSet;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_maps::bump_map::{BumpMap, BumpMove, BumpMoves, BumpWay, NotStill};
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
    failures: Option<Failures>,
}

/// How the robot's moves fail.
#[derive(Clone, Debug)]
struct Failures {
    moves: BumpMoves,
    share: f64,
    rng: ChaCha8Rng,
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
            failures: None,
        }
    }

    /// The same, where a `share` (0 … 1) of the moves along open ways fail as `moves` says: the
    /// robot stays. The map knows how moves fail, and not how often.
    #[must_use]
    pub fn failing(self, moves: BumpMoves, share: f64, rng: ChaCha8Rng) -> Self {
        Self {
            map: BumpMap::with_moves(self.sight.look(self.maze, self.at), moves),
            failures: Some(Failures { moves, share, rng }),
            ..self
        }
    }

    /// Moves the robot to `action`, if there is no wall and the move does not fail, and lets it
    /// learn.
    ///
    /// # Errors
    /// Never in a maze, whose walls stand still.
    pub fn step(&mut self, action: Direction) -> Result<(), NotStill> {
        let next = self.maze.beside(self.at, action);
        let failures = self.failures.as_mut().filter(|_| next.is_some());
        let failed = failures.and_then(|failures| {
            let fails = failures.rng.random_bool(failures.share);
            fails.then_some(failures.moves)
        });
        if failed.is_none() {
            self.at = next.unwrap_or(self.at);
        }
        self.map.learn(BumpMove {
            action,
            moved: next.is_some() && failed != Some(BumpMoves::MayBump),
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
    /// Returns a number for what the robot sees in a cell: the same for cells that look alike.
    #[must_use]
    pub fn look(self, maze: &Maze, cell: Cell) -> u32 {
        let open = |side: &Direction| u32::from(maze.is_open(cell, *side)) << side.index();
        match self {
            Self::None => 0,
            Self::OpenWays => Direction::ALL.iter().map(open).sum(),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;
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
            failures: None,
        };
        assert!(!other.is_exact(), "its map is of another maze");
    }

    #[test]
    fn a_move_that_fails_leaves_the_robot_where_it_is() {
        let maze = Maze::open(Grid::new(2, 1));
        let harsh = BumpMoves::MayStay {
            one_in: 2,
            unit_steps: false,
        };
        for (moves, known) in [(BumpMoves::MayBump, 0), (harsh, 1)] {
            let walk = BumpWalk::new(&maze, Cell::new(0, 0), BumpSight::None);
            let mut walk = walk.failing(moves, 1.0, ChaCha8Rng::seed_from_u64(1));
            walk.step(Direction::East).unwrap();
            assert_eq!(walk.at, Cell::new(0, 0));
            let open = Direction::ALL.iter().filter(|action| {
                let way = walk.map().way(walk.map().start(), **action);
                matches!(way, BumpWay::To(_))
            });
            assert_eq!(open.count(), known);
        }
    }
}
