//! Mazes as CPM meets them: places, and corridors that look one way there and another way back.

use alloc::collections::BTreeMap;

use core::f64::consts::FRAC_PI_2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Interval, Point, PointBox};
use tolman_maps::cpm::{Bearings, DeadReckoning, Dictionary, PatternId, Sighting, Traversal, Turn};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_robot::Landmark;

pub(crate) struct World {
    pub(crate) maze: Maze,
    pub(crate) dictionary: Dictionary,
    /// Error of a heading and of a coordinate by dead reckoning, rad and m.
    pub(crate) bounds: f64,
    /// The patterns that each corridor shows, by the place and the way out of it.
    seen: BTreeMap<(Cell, Direction), Vec<PatternId>>,
}

/// A robot at a place, and the way behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Stand {
    pub(crate) at: Cell,
    pub(crate) behind: Direction,
}

impl World {
    /// Returns a maze of `side`² cells whose corridors all look different.
    pub(crate) fn new(side: u16, share: f64, seed: u64) -> Self {
        Self::painted(side, share, 40, seed)
    }

    /// Returns a maze whose corridors show this number of patterns and their inverses.
    pub(crate) fn painted(side: u16, share: f64, patterns: u32, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let shape = Braided {
            width: side,
            height: side,
            share,
        };
        let maze = shape.generate(&mut rng).unwrap();
        let mut dictionary = Dictionary::new(2);
        for _ in 0..patterns {
            let [a, b] = [0, 1].map(|_| rng.random_range(0.0..1.0));
            dictionary.learn(&[a, b], &[b, a], 1e-9).unwrap();
        }
        let mut world = Self {
            maze,
            dictionary,
            bounds: 0.05,
            seen: BTreeMap::new(),
        };
        for at in world.places() {
            for way in world.ways(at) {
                let (end, back, cells) = world.corridor(at, way);
                if world.seen.contains_key(&(at, way)) {
                    continue;
                }
                let length = cells.len() + rng.random_range(1..4);
                let patterns: Vec<PatternId> = (0..length)
                    .map(|_| PatternId(rng.random_range(0..world.dictionary.len() as u32)))
                    .collect();
                let inverse = world.dictionary.inverse(&patterns).unwrap();
                world.seen.insert((end, back), inverse);
                world.seen.insert((at, way), patterns);
            }
        }
        world
    }

    pub(crate) fn landmark(&self, at: Cell) -> Option<Landmark> {
        if self.maze.start().unwrap().0 == at {
            Some(Landmark::Start)
        } else {
            self.maze.goals().contains(&at).then_some(Landmark::Goal)
        }
    }

    pub(crate) fn places(&self) -> Vec<Cell> {
        let is_place = |at: &Cell| self.maze.degree(*at) != 2 || self.landmark(*at).is_some();
        self.maze.grid().cells().filter(is_place).collect()
    }

    pub(crate) fn ways(&self, at: Cell) -> Vec<Direction> {
        let open = |way: &Direction| self.maze.is_open(at, *way);
        Direction::ALL.into_iter().filter(open).collect()
    }

    /// Returns the ways of a place, counter-clockwise from the one behind.
    pub(crate) fn ports(&self, stand: Stand) -> Vec<Direction> {
        let Stand { at, behind } = stand;
        let ways = [behind, behind.left(), behind.opposite(), behind.right()];
        let is_open = |way: &Direction| self.maze.is_open(at, *way);
        ways.into_iter().filter(is_open).collect()
    }

    /// Returns the last cell of a corridor, the way that leads back into it, and the steps to its
    /// end.
    fn corridor(&self, from: Cell, way: Direction) -> (Cell, Direction, Vec<Direction>) {
        let (mut at, mut heading, mut cells) = (from, way, Vec::new());
        loop {
            at = self.maze.beside(at, heading).unwrap();
            cells.push(heading);
            if self.maze.degree(at) != 2 || self.landmark(at).is_some() {
                return (at, heading.opposite(), cells);
            }
            let onward = |next: &Direction| *next != heading.opposite();
            heading = self.ways(at).into_iter().find(onward).unwrap();
        }
    }

    pub(crate) fn sighting(&self, at: Cell) -> Sighting {
        Sighting {
            degree: self.maze.degree(at) as u32,
            landmark: self.landmark(at),
        }
    }

    /// Returns the stand after a turn and a walk, and the walk.
    pub(crate) fn walk(&self, stand: Stand, turn: Turn) -> (Stand, Traversal) {
        let way = self.ports(stand)[turn.0 as usize];
        let (at, behind, cells) = self.corridor(stand.at, way);
        let next = Stand { at, behind };
        let east = f64::from(at.x) - f64::from(stand.at.x);
        let north = f64::from(at.y) - f64::from(stand.at.y);
        let heading = |way: Direction| Interval::about(radians(way), self.bounds).unwrap();
        let ways: Vec<f64> = self.ports(next).into_iter().map(radians).collect();
        let walk = Traversal {
            patterns: self.seen[&(stand.at, way)].clone(),
            motion: Some(DeadReckoning {
                displacement: PointBox::about(Point::new(east, north), self.bounds).unwrap(),
                departure: heading(way),
                arrival: heading(*cells.last().unwrap()),
            }),
            sighting: self.sighting(at),
            bearings: Some(Bearings::of_directions(&ways).unwrap()),
        };
        (next, walk)
    }

    /// Returns the number of observations on the shortest way from a place to each other one, by
    /// relaxing until nothing changes.
    pub(crate) fn distances(&self, from: Cell) -> BTreeMap<Cell, usize> {
        let mut distances = BTreeMap::from([(from, 0)]);
        loop {
            let before = distances.clone();
            for ((at, way), patterns) in &self.seen {
                let (end, ..) = self.corridor(*at, *way);
                if let Some(here) = before.get(at) {
                    let there = distances.entry(end).or_insert(usize::MAX);
                    *there = (*there).min(here + patterns.len());
                }
            }
            if distances == before {
                return distances;
            }
        }
    }

    /// Returns the stand of a robot put down at the start.
    pub(crate) fn start(&self) -> Stand {
        let at = self.maze.start().unwrap().0;
        let behind = self.ways(at)[0];
        Stand { at, behind }
    }
}

/// Returns the heading of a direction, rad: 0 is east, counter-clockwise.
fn radians(way: Direction) -> f64 {
    match way {
        Direction::East => 0.0,
        Direction::North => FRAC_PI_2,
        Direction::West => 2.0 * FRAC_PI_2,
        Direction::South => -FRAC_PI_2,
    }
}
