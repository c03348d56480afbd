//! Lost mice: the true pose is never ruled out, and is found where the maze is not symmetric.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Braided, Cell, Direction, Grid, Knowledge, Maze, Walls};
use tolman_planners::{PoseKnowledge, PoseSet};

/// A maze of which the walls of a part of the cells are known.
struct Partly<'a> {
    maze: &'a Maze,
    /// By [`Grid::index`].
    known: Vec<bool>,
}

impl Walls for Partly<'_> {
    fn grid(&self) -> Grid {
        self.maze.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let grid = self.grid();
        let known = |cell: Cell| grid.contains(cell) && self.known[grid.index(cell)];
        let beside = grid.neighbour(cell, direction);
        if known(cell) || beside.is_none_or(known) {
            self.maze.knowledge(cell, direction)
        } else {
            Knowledge::Unknown
        }
    }
}

fn seen_as(heading: Direction, side: Direction) -> Direction {
    Direction::ALL[(heading.index() + side.index()) % 4]
}

/// Returns whether the maze looks the same from both poses, wherever one drives.
fn are_twins(maze: &Maze, a: (Cell, Direction), b: (Cell, Direction)) -> bool {
    let mut seen = vec![(a.0, b.0)];
    let mut next = 0;
    while let Some(&(here, there)) = seen.get(next) {
        next += 1;
        for side in Direction::ALL {
            let (ours, theirs) = (seen_as(a.1, side), seen_as(b.1, side));
            if maze.is_open(here, ours) != maze.is_open(there, theirs) {
                return false;
            }
            if maze.is_open(here, ours) {
                let step = |cell, direction| maze.grid().neighbour(cell, direction).unwrap();
                let pair = (step(here, ours), step(there, theirs));
                if !seen.contains(&pair) {
                    seen.push(pair);
                }
            }
        }
    }
    true
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_lost_mouse_finds_itself(
        seed in any::<u64>(),
        (width, height) in (2_u16..=10, 1_u16..=10),
        (x, y, heading) in (0_u16..10, 0_u16..10, prop::sample::select(&Direction::ALL[..])),
        known in prop::collection::vec(prop::bool::weighted(0.8), 100),
        all in any::<bool>(),
    ) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let braided = Braided { width, height, share: 0.3 };
        let maze = braided.generate(&mut rng).unwrap();
        let partly = Partly { maze: &maze, known: known.iter().map(|known| all || *known).collect() };
        let (mut at, mut looks) = (Cell::new(x % width, y % height), heading);
        let mut poses = PoseSet::<16>::anywhere(maze.grid()).unwrap();
        for _ in 0..400 {
            for side in Direction::ALL {
                poses.see(&partly, side, maze.is_open(at, seen_as(looks, side)));
            }
            prop_assert!(poses.contains(at, looks), "the truth is ruled out");
            let Some(side) = poses.next_drive(&partly) else {
                break;
            };
            let direction = seen_as(looks, side);
            prop_assert!(maze.is_open(at, direction), "against the wall");
            at = maze.grid().neighbour(at, direction).unwrap();
            looks = direction;
            poses.drive(&partly, side);
        }
        match poses.location() {
            PoseKnowledge::Found { cell, heading } => prop_assert_eq!((cell, heading), (at, looks)),
            // If everything is known, only what cannot be told apart is left.
            PoseKnowledge::Among { .. } if all => {
                for cell in maze.grid().cells() {
                    for heading in Direction::ALL {
                        if poses.contains(cell, heading) {
                            prop_assert!(are_twins(&maze, (at, looks), (cell, heading)));
                        }
                    }
                }
            }
            PoseKnowledge::Among { .. } => {}
            PoseKnowledge::Nowhere => prop_assert!(false, "the truth is ruled out"),
        }
    }
}

/// One corridor to and fro over seven rows, the same from both ends but for one opening after more
/// than two rows.
#[test]
fn what_tells_poses_apart_may_lie_far_off() {
    let grid = Grid::new(16, 7);
    let mut maze = Maze::solid(grid);
    for y in 0..7 {
        for x in 0..15 {
            maze.set_wall(Cell::new(x, y), Direction::East, false);
        }
        let end = if y % 2 == 0 { 15 } else { 0 };
        if y < 6 {
            maze.set_wall(Cell::new(end, y), Direction::North, false);
        }
    }
    maze.set_wall(Cell::new(3, 2), Direction::North, false);
    for (start, looks) in [
        (Cell::new(0, 0), Direction::East),
        (Cell::new(15, 6), Direction::South),
    ] {
        let (mut at, mut heading) = (start, looks);
        let mut poses = PoseSet::<16>::anywhere(grid).unwrap();
        let mut driven = 0;
        loop {
            for side in Direction::ALL {
                poses.see(&maze, side, maze.is_open(at, seen_as(heading, side)));
            }
            let Some(side) = poses.next_drive(&maze) else {
                break;
            };
            heading = seen_as(heading, side);
            at = grid.neighbour(at, heading).unwrap();
            poses.drive(&maze, side);
            driven += 1;
        }
        let found = PoseKnowledge::Found { cell: at, heading };
        assert_eq!(poses.location(), found, "after {driven}");
        assert!(driven > 32, "{driven}");
    }
}

#[test]
fn a_wrong_wall_leaves_nowhere_to_be() {
    let maze = Maze::open(Grid::new(2, 2));
    let mut poses = PoseSet::<16>::anywhere(maze.grid()).unwrap();
    poses.see(&maze, Direction::North, false);
    poses.see(&maze, Direction::South, false);
    assert_eq!(poses.location(), PoseKnowledge::Nowhere);
    assert_eq!(poses.next_drive(&maze), None);
}
