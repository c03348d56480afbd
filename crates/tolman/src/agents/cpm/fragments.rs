use alloc::collections::BTreeMap;
use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;
use tolman_maze::{Cell, Direction, Maze};

/// The fragments that a maze really has, for scoring; no robot knows them.
#[derive(Clone, Debug)]
pub struct TrueFragments {
    ways: BTreeMap<(Cell, Direction), Way>,
}

/// A fragment as one leaves a place by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// The fragment's number.
    pub fragment: u32,
    /// Whether one enters it at its first end.
    pub is_forward: bool,
    /// Where it leads.
    pub to: Cell,
    /// How many cells on.
    pub cells: u32,
}

/// Counter-clockwise from a heading of 0.
const DIRECTIONS: [Direction; 4] = [
    Direction::East,
    Direction::North,
    Direction::West,
    Direction::South,
];

impl TrueFragments {
    /// The fragments of a maze between its junctions, dead ends, start and goals.
    #[must_use]
    pub fn of(maze: &Maze) -> Self {
        let start = maze.start().map(|(cell, _)| cell);
        let is_place = |cell: Cell| {
            maze.degree(cell) != 2 || maze.goals().contains(&cell) || start == Some(cell)
        };
        let mut ways = BTreeMap::new();
        let mut count = 0;
        for from in maze.reachable().filter(|cell| is_place(*cell)) {
            for (out, next) in maze.neighbours(from) {
                if ways.contains_key(&(from, out)) {
                    continue;
                }
                let (mut at, mut came, mut cells) = (next, out, 1);
                while !is_place(at) {
                    let back = came.opposite();
                    let Some((on, next)) = maze.neighbours(at).find(|(on, _)| *on != back) else {
                        break;
                    };
                    (at, came, cells) = (next, on, cells + 1);
                }
                let way = |is_forward, to| Way {
                    fragment: count,
                    is_forward,
                    to,
                    cells,
                };
                ways.insert((from, out), way(true, at));
                ways.insert((at, came.opposite()), way(false, from));
                count += 1;
            }
        }
        Self { ways }
    }

    /// The way by which one leaves a place that looks in this heading.
    #[must_use]
    pub fn way(&self, from: Cell, heading: Heading) -> Option<Way> {
        let nearest = libm::round(heading.radians() / FRAC_PI_2).rem_euclid(4.0) as u32;
        let direction = DIRECTIONS[nearest as usize % DIRECTIONS.len()];
        self.ways.get(&(from, direction)).copied()
    }

    /// All ways out of all places.
    pub fn ways(&self) -> impl Iterator<Item = (Cell, Way)> + '_ {
        self.ways.iter().map(|((from, _), way)| (*from, *way))
    }
}
