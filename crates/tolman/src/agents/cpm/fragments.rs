use alloc::collections::BTreeMap;
use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;
use tolman_maze::{Cell, Direction, Maze};

/// The fragments that a maze really has, for scoring; no robot knows them.
#[derive(Clone, Debug)]
pub struct TrueFragments {
    ways: BTreeMap<(Cell, u32), Way>,
    count: u32,
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
                if ways.contains_key(&(from, quarter(out))) {
                    continue;
                }
                let (mut at, mut came, mut cells) = (next, out, 1);
                while !is_place(at) {
                    let back = opposite(came);
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
                ways.insert((from, quarter(out)), way(true, at));
                ways.insert((at, quarter(opposite(came))), way(false, from));
                count += 1;
            }
        }
        Self { ways, count }
    }

    /// How many there are.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// The way by which one leaves a place that looks in this heading.
    #[must_use]
    pub fn way(&self, from: Cell, heading: Heading) -> Option<Way> {
        let nearest = libm::round(heading.radians() / FRAC_PI_2).rem_euclid(4.0) as u32;
        self.ways.get(&(from, nearest)).copied()
    }

    /// Whether fragments end in a cell.
    #[must_use]
    pub fn is_place(&self, cell: Cell) -> bool {
        (0..4).any(|quarter| self.ways.contains_key(&(cell, quarter)))
    }

    /// All ways out of all places.
    pub fn ways(&self) -> impl Iterator<Item = (Cell, Way)> + '_ {
        self.ways.iter().map(|((from, _), way)| (*from, *way))
    }
}

fn quarter(direction: Direction) -> u32 {
    (0..)
        .zip(DIRECTIONS)
        .find(|(_, other)| *other == direction)
        .map_or(0, |(index, _)| index)
}

fn opposite(direction: Direction) -> Direction {
    DIRECTIONS[(quarter(direction) as usize + 2) % 4]
}
