//! Explorers of steps on mazes that are seen as far as the next wall. What they prove is true, and
//! the way on which they prove it is pinned.

use alloc::collections::BTreeSet;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Braided, Cell, Direction, Grid, Knowledge, Maze, Wall, Walls};
use tolman_planners::moves::{
    MoveDecision, MoveExplorer, MoveExplorerConfig, MoveMap, RolloutConfig, Rollouts, WorthConfig,
};
use tolman_planners::{Passages, Unknown};

struct Seen {
    maze: Maze,
    walls: BTreeSet<Wall>,
}

impl Walls for Seen {
    fn grid(&self) -> Grid {
        self.maze.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let is_inner = self.grid().neighbour(cell, direction).is_some();
        let is_seen = self.walls.contains(&self.grid().wall(cell, direction));
        if is_inner && !is_seen {
            return Knowledge::Unknown;
        }
        self.maze.knowledge(cell, direction)
    }
}

impl Seen {
    fn new(side: u16, share: f64, seed: u64) -> Self {
        let shape = Braided {
            width: side,
            height: side,
            share,
        };
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        Self {
            maze: shape.generate(rng).unwrap(),
            walls: BTreeSet::new(),
        }
    }

    /// Looks from a cell to three sides, each as far as the next wall.
    fn look(&mut self, at: Cell, heading: Direction) {
        for side in [heading.left(), heading, heading.right()] {
            let mut at = at;
            loop {
                self.walls.insert(self.grid().wall(at, side));
                if !self.maze.is_open(at, side) {
                    break;
                }
                at = self.grid().neighbour(at, side).unwrap();
            }
        }
    }

    /// Explores the maze. Returns the stops on the way, each as column and row, and the last
    /// decision.
    fn explored(
        mut self,
        mut decide: impl FnMut(&Self, Cell) -> MoveDecision,
    ) -> (String, MoveDecision) {
        let (mut at, mut heading) = self.maze.start().unwrap();
        let mut way = String::new();
        for _ in 0..400 {
            self.look(at, heading);
            match decide(&self, at) {
                MoveDecision::Drive(leap) => {
                    heading = leap.direction;
                    at = leap.end;
                    way.push_str(&format!("{}{} ", at.x, at.y));
                }
                MoveDecision::Turn => heading = heading.right(),
                last => return (way, last),
            }
        }
        (way, MoveDecision::Stuck)
    }

    /// Returns the fewest steps from the start to a goal, with all walls known.
    fn fewest(&self) -> u16 {
        let passages = Passages::<8>::new(&self.maze, Unknown::Closed).unwrap();
        let map = MoveMap::new(&passages, self.maze.goals().iter().copied());
        map.moves(self.maze.start().unwrap().0).unwrap()
    }
}

fn explorer(maze: &Maze) -> MoveExplorer<8> {
    MoveExplorer::new(MoveExplorerConfig::tuned(), maze.start().unwrap().0).unwrap()
}

/// Returns the ways of an explorer, of its rollouts, and of rollouts that stop when it is not
/// worth it.
fn ways(side: u16, share: f64, seed: u64) -> Vec<String> {
    let fewest = Seen::new(side, share, seed).fewest();
    let mut ways = Vec::new();
    for kind in 0..3 {
        let seen = Seen::new(side, share, seed);
        let goals = seen.maze.goals().to_vec();
        let base = explorer(&seen.maze);
        let mut plain = base.clone();
        let mut rollouts = Rollouts::new(base, RolloutConfig::tuned()).unwrap();
        if kind == 2 {
            rollouts = rollouts.until_worth(WorthConfig::tuned()).unwrap();
        }
        let (way, last) = seen.explored(|seen, at| match kind {
            0 => plain.decide(seen, &goals, at).unwrap(),
            _ => rollouts.decide(seen, &goals, at).unwrap(),
        });
        match last {
            MoveDecision::Finished { moves } => assert_eq!(moves, fewest, "{way}"),
            MoveDecision::Enough { moves } => assert!(kind == 2 && moves >= fewest),
            other => panic!("{other:?} after {way}"),
        }
        ways.push(format!("{way}{last:?}"));
    }
    ways
}

#[test]
fn what_is_proven_is_the_fewest_steps() {
    for seed in 0..10 {
        ways(
            5 + (seed % 4) as u16,
            [0.2, 0.6, 1.0][seed as usize % 3],
            seed,
        );
    }
}

#[test]
fn the_ways_of_explorers_are_what_they_were() {
    let found: Vec<String> = [(8, 0.5, 1), (8, 1.0, 2), (7, 0.8, 3), (8, 0.8, 9)]
        .into_iter()
        .flat_map(|(side, share, seed)| ways(side, share, seed))
        .collect();
    if std::env::var_os("TOLMAN_PIN").is_some() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/moves.txt");
        std::fs::write(path, found.join("\n") + "\n").unwrap();
    }
    let expected: Vec<&str> = include_str!("moves.txt").lines().collect();
    assert_eq!(found, expected);
}
