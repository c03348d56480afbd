//! A robot in an abstract world, its observer, and how right the observer is.

use alloc::collections::{BTreeMap, VecDeque};

use super::abstract_world::{AbstractMove, AbstractRobot, AbstractWorld, MoveNoise};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::{
    Action, Config, Exits, FirstPlace, MoveOutcome, ObservedMove, Observer, Percepts, PlaceId,
    Signature, SignatureKind, StepReport, Use, ViewRotation,
};
use tolman_maze::{Braided, Cell, Direction, Grid, Maze};

pub(crate) const COMPASS: f64 = 4.0 * core::f64::consts::PI / 180.0;

/// 10 % of the distance, and a compass of ± 4°.
pub(crate) const ODOMETRY: MoveNoise = {
    let mut errors = MoveNoise::NONE;
    errors.distance = 0.1;
    errors.compass = COMPASS;
    errors
};

/// The simulated robot of the offices goes past the middle of an opening and back: on 4 m it drives
/// a good metre more.
pub(crate) const ROUGH: MoveNoise = {
    let mut errors = ODOMETRY;
    errors.distance = 0.13;
    errors.compass = 1.3 * ODOMETRY.compass;
    errors
};

/// Returns a mapper of places a metre apart that all look alike.
pub(crate) fn alike() -> Config {
    Config::new(Config::compass_actions(), 1.0)
}

/// Places with a colour to each side, seen with an error of 0.2.
pub(crate) fn painted() -> Config {
    let mut config = alike();
    config.percepts = Percepts::Signatures(SignatureKind {
        rows: 1,
        columns: 4,
        tolerance: 0.4,
        share: 1.0,
        rotation: ViewRotation::Aligned,
        views: 2,
    });
    config
}

pub(crate) fn open(side: u16) -> AbstractWorld {
    AbstractWorld::from_maze(&Maze::open(Grid::new(side, side)), 1.0)
}

/// Corridors between blocks: a square grid in which a share of the inner walls stands, but for
/// those that would cut a cell off.
pub(crate) fn blocks(side: u16, walls: f64, rng: &mut impl Rng) -> Maze {
    let grid = Grid::new(side, side);
    let mut maze = Maze::open(grid);
    // What is reachable is counted from the goals.
    maze.set_goals(vec![Cell::new(0, 0)]);
    for cell in grid.cells() {
        for direction in [Direction::North, Direction::East] {
            if grid.neighbour(cell, direction).is_some() && rng.random_range(0.0..1.0) < walls {
                maze.set_wall(cell, direction, true);
                if maze.reachable().count() < grid.cells().count() {
                    maze.set_wall(cell, direction, false);
                }
            }
        }
    }
    maze
}

pub(crate) struct Walk {
    pub(crate) robot: AbstractRobot,
    pub(crate) observer: Observer,
    /// Place where each move ended: its true number, and the observer's id of it at that time.
    pub(crate) log: Vec<(u32, PlaceId)>,
    sees: bool,
}

/// Quality of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Score {
    pub(crate) purity: f64,
    pub(crate) places: usize,
    pub(crate) visited: usize,
    pub(crate) link_precision: f64,
    /// Share of the links that were really taken which the map has, 0 to 1.
    pub(crate) link_recall: f64,
}

impl Walk {
    pub(crate) fn new(world: AbstractWorld, errors: MoveNoise, config: Config, seed: u64) -> Self {
        let sees = config.percepts != tolman_maps::diktiometry::Percepts::None;
        let robot = AbstractRobot::new(world.into(), 0, errors, seed).unwrap();
        let start = FirstPlace {
            percept: sees.then(|| percept(robot.look())),
            exits: exits(&robot),
        };
        let observer = Observer::new(config, start).unwrap();
        let log = Vec::from([(robot.at(), observer.place())]);
        Self {
            robot,
            observer,
            log,
            sees,
        }
    }

    pub(crate) fn go(&mut self, direction: Direction) -> (AbstractMove, StepReport) {
        let moved = self.robot.go(direction).unwrap();
        let step = self.told(&moved);
        let report = self.observer.step(&step).unwrap();
        self.log.push((moved.to, self.observer.place()));
        (moved, report)
    }

    pub(crate) fn told(&self, moved: &AbstractMove) -> ObservedMove {
        ObservedMove {
            action: Action(moved.direction as u32),
            odometry: moved.odometry,
            percept: self.sees.then(|| percept(moved.look)),
            exits: exits(&self.robot),
            outcome: MoveOutcome::Arrived,
        }
    }

    pub(crate) fn wander(&mut self, moves: usize) {
        for _ in 0..moves {
            let direction = self.robot.wander().unwrap();
            self.go(direction);
        }
    }

    /// Heeds this share of the advice.
    pub(crate) fn heed(&mut self, heed: f64, moves: usize) {
        let mut planner = Scripted::new(heed, 0);
        for _ in 0..moves {
            planner.go(self);
        }
    }

    /// Returns the true place that each place of the map was most often met at.
    pub(crate) fn truths(&self) -> BTreeMap<PlaceId, u32> {
        let mut counts: BTreeMap<PlaceId, BTreeMap<u32, usize>> = BTreeMap::new();
        for &(truth, place) in &self.log {
            if let Some(place) = self.observer.map().paths.resolve(place) {
                *counts.entry(place).or_default().entry(truth).or_default() += 1;
            }
        }
        let most = |truths: &BTreeMap<u32, usize>| {
            let most = truths.iter().max_by_key(|(_, count)| **count);
            *most.unwrap().0
        };
        counts
            .iter()
            .map(|(place, truths)| (*place, most(truths)))
            .collect()
    }

    pub(crate) fn score(&self) -> Score {
        let paths = &self.observer.map().paths;
        let mut counts: BTreeMap<PlaceId, BTreeMap<u32, usize>> = BTreeMap::new();
        let mut visited: BTreeMap<u32, usize> = BTreeMap::new();
        for &(truth, place) in &self.log {
            *visited.entry(truth).or_default() += 1;
            if let Some(place) = paths.resolve(place) {
                *counts.entry(place).or_default().entry(truth).or_default() += 1;
            }
        }
        let majority: BTreeMap<PlaceId, u32> = counts
            .iter()
            .map(|(place, truths)| {
                let most = truths.iter().max_by_key(|(_, count)| **count);
                (*place, *most.unwrap().0)
            })
            .collect();
        let right: usize = counts
            .values()
            .map(|truths| truths.values().max().unwrap())
            .sum();
        let all: usize = counts.values().flat_map(BTreeMap::values).sum();
        let mut taken: Vec<(u32, u32)> = self
            .log
            .windows(2)
            .map(|pair| (pair[0].0, pair[1].0))
            .collect();
        taken.sort_unstable();
        taken.dedup();
        let mut known: Vec<(u32, u32)> = Vec::new();
        let mut wrong = 0;
        for (_, link) in paths.links() {
            let ends = [link.from, link.to].map(|end| majority.get(&end).copied());
            let [Some(from), Some(to)] = ends else {
                continue;
            };
            let direction = Direction::ALL[link.action.0 as usize];
            if self.robot.world().neighbour(from, direction) == Some(to) {
                known.push((from, to));
            } else {
                wrong += 1;
            }
        }
        let right_links = known.len();
        known.sort_unstable();
        known.dedup();
        let met = taken
            .iter()
            .filter(|link| known.binary_search(link).is_ok())
            .count();
        Score {
            purity: right as f64 / all as f64,
            places: paths.places().count(),
            visited: visited.len(),
            link_precision: right_links as f64 / (right_links + wrong) as f64,
            link_recall: met as f64 / taken.len() as f64,
        }
    }
}

/// A planner that walks at random but for this share of its decisions, in which it begins the best
/// script that is advised.
pub(crate) struct Scripted {
    heed: f64,
    script: VecDeque<Action>,
    rng: ChaCha8Rng,
}

impl Scripted {
    pub(crate) fn new(heed: f64, seed: u64) -> Self {
        Self {
            heed,
            script: VecDeque::new(),
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Returns the direction to go next. A script that the world does not allow is given up.
    pub(crate) fn choose(&mut self, walk: &Walk) -> Direction {
        if self.script.is_empty() && self.rng.random_range(0.0..1.0) < self.heed {
            let advice = walk.observer.opportunities().into_iter().next();
            self.script = advice.map_or(VecDeque::new(), |advice| advice.script.into());
        }
        let advised = self.script.pop_front();
        let advised = advised.map(|action| Direction::ALL[action.0 as usize]);
        let (world, here) = (walk.robot.world(), walk.robot.at());
        let possible = advised.filter(|direction| world.neighbour(here, *direction).is_some());
        possible.unwrap_or_else(|| {
            self.script.clear();
            walk.robot.wander().unwrap()
        })
    }

    pub(crate) fn go(&mut self, walk: &mut Walk) -> (AbstractMove, StepReport) {
        let direction = self.choose(walk);
        walk.go(direction)
    }
}

pub(crate) fn percept(look: [f64; 4]) -> Signature {
    Signature::new(1, look.to_vec()).unwrap()
}

pub(crate) fn exits(robot: &AbstractRobot) -> Exits {
    let exits = robot.world().exits(robot.at());
    Exits::Seen(exits.map(|direction| Action(direction as u32)).collect())
}

pub(crate) fn braided(side: u16, share: f64, rng: &mut ChaCha8Rng) -> Maze {
    let shape = Braided {
        width: side,
        height: side,
        share,
    };
    shape.generate(rng).unwrap()
}

/// Returns an open square of square rooms of `room` places each way, all painted like the first.
pub(crate) fn rooms(side: u16, room: u32, colours: u32, seed: u64) -> AbstractWorld {
    let across = u32::from(side);
    let first = |place: u32| (place / across % room) * across + place % across % room;
    open(side).painted(colours, seed).looking_like(first)
}

/// Returns a walk of 1500 moves, with scripts and merges by looks. The world is the corridors of a
/// braided maze of 6 × 6 cells, with walls of `colours` colours.
pub(crate) fn braided_corridors(colours: u32, seed: u64) -> Walk {
    let maze = braided(6, 1.0, &mut ChaCha8Rng::seed_from_u64(seed));
    let world = AbstractWorld::from_corridors(&maze, 1.0).painted(colours, seed);
    let mut errors = ROUGH;
    errors.stop = 0.0175;
    errors.look = 0.2;
    let mut config = painted();
    config.place_radius = errors.stop;
    config.restructuring.look_merge = Use::On;
    let mut walk = Walk::new(world, errors, config, seed);
    let mut planner = Scripted::new(0.3, seed);
    for _ in 0..1500 {
        planner.go(&mut walk);
    }
    walk
}
