//! One episode of one robot.

use alloc::sync::Arc;

use rand_chacha::ChaCha8Rng;
use tolman_maze::Direction;
use tolman_maze::rand::RngExt;

use super::floor::{Floor, Stand};
use super::oracle;
use super::settings::Settings;
use super::task::GridTask;

/// Cost of each step. A delivery, a new place or link, and the right pose give 1.
const STEP_COST: f64 = 0.01;

/// Number of moves: ahead, to the right, to the left. A pose is told by its number after these.
pub(super) const MOVES: u32 = 3;

#[derive(Clone, Debug)]
pub(super) struct Episode {
    pub(super) floor: Arc<Floor>,
    pub(super) stand: Stand,
    /// All actions so far: a copy repeats them.
    pub(super) actions: Vec<u32>,
    job: Job,
    /// Whether the robot sees as far as the next wall, or its own cell alone.
    sees_far: bool,
}

/// What is left to do.
#[derive(Clone, Debug)]
enum Job {
    Errand {
        /// Cells of the landmarks, whose numbers begin with 1.
        landmarks: Vec<u32>,
        /// Landmarks to drive to, as indices, the last one first.
        wanted: Vec<usize>,
    },
    Learn(Unseen),
    Locate {
        is_told: bool,
    },
}

/// Places and links that the robot has not seen yet.
#[derive(Clone, Debug)]
pub(super) struct Unseen {
    /// For each cell whether it is one of them.
    cells: Vec<bool>,
    /// For each wall whether it is an opening among them.
    links: Vec<bool>,
    pub(super) left: usize,
}

impl Episode {
    /// Begins an episode.
    ///
    /// # Errors
    /// If the maze has too few cells for the landmarks.
    pub(super) fn new(
        floor: Arc<Floor>,
        settings: &Settings,
        rng: &mut ChaCha8Rng,
    ) -> Result<Self, String> {
        let marked = floor.maze.start();
        let marked = marked.map(|(cell, heading)| Stand {
            cell: floor.maze.grid().index(cell) as u32,
            heading,
        });
        let anywhere = |cells: &[u32], rng: &mut ChaCha8Rng| Stand {
            cell: cells[rng.random_range(0..cells.len())],
            heading: Direction::ALL[rng.random_range(0..4)],
        };
        let all: Vec<u32> = (0..floor.cell_count() as u32).collect();
        let start = marked.unwrap_or_else(|| anywhere(&all, rng));
        let cells = floor.reachable(start.cell);
        let mut episode = Self {
            stand: match settings.task {
                GridTask::Locate => anywhere(&cells, rng),
                GridTask::Errand | GridTask::Learn => start,
            },
            job: match settings.task {
                GridTask::Errand => Job::errand(start, &cells, settings, rng)?,
                GridTask::Learn => Job::Learn(Unseen::all(&floor, &cells)),
                GridTask::Locate => Job::Locate { is_told: false },
            },
            floor,
            actions: Vec::new(),
            sees_far: settings.rays,
        };
        episode.look();
        Ok(episode)
    }

    /// Makes a step and returns its reward.
    pub(super) fn step(&mut self, action: u32) -> f64 {
        self.actions.push(action);
        match action.checked_sub(MOVES) {
            None => self.stand = self.stand.moved(&self.floor)[action as usize],
            Some(told) => {
                self.job = Job::Locate { is_told: true };
                let is_right = told == self.stand.number();
                return if is_right { 1.0 } else { -1.0 } - STEP_COST;
            }
        }
        let arrived = match &mut self.job {
            Job::Errand { landmarks, wanted } => {
                let is_there = wanted.last().map(|last| landmarks[*last]) == Some(self.stand.cell);
                if is_there {
                    wanted.pop();
                }
                usize::from(is_there)
            }
            Job::Learn(_) => self.look(),
            Job::Locate { .. } => 0,
        };
        arrived as f64 - STEP_COST
    }

    /// Returns the rewards that are left: errands, places and links, or a pose to tell.
    pub(super) fn left(&self) -> usize {
        match &self.job {
            Job::Errand { wanted, .. } => wanted.len(),
            Job::Learn(unseen) => unseen.left,
            Job::Locate { is_told } => usize::from(!is_told),
        }
    }

    /// Notes what is in sight, and returns how much of it is new.
    fn look(&mut self) -> usize {
        match &mut self.job {
            Job::Learn(unseen) => unseen.look(&self.floor, self.stand.cell, self.sees_far),
            Job::Errand { .. } | Job::Locate { .. } => 0,
        }
    }

    /// Returns what the robot senses to its four sides, clockwise from ahead: how many cells it can
    /// look along, or at most one of them.
    pub(super) fn sides(&self) -> [u8; 4] {
        Direction::ALL.map(|side| {
            let direction = self.stand.heading.turned(side);
            let sight = sight(&self.floor, self.stand.cell, direction, self.sees_far);
            sight.count() as u8
        })
    }

    /// Returns the number of the landmark in the robot's cell, and of the one that it has to drive
    /// to; 0 for none.
    pub(super) fn landmarks(&self) -> [i64; 2] {
        let Job::Errand { landmarks, wanted } = &self.job else {
            return [0, 0];
        };
        let here = landmarks.iter().position(|cell| *cell == self.stand.cell);
        [here, wanted.last().copied()].map(|number| number.map_or(0, |number| number as i64 + 1))
    }

    /// Returns the cell of each landmark, in the order of their numbers.
    pub(super) fn landmark_cells(&self) -> &[u32] {
        match &self.job {
            Job::Errand { landmarks, .. } => landmarks,
            Job::Learn(_) | Job::Locate { .. } => &[],
        }
    }

    /// Returns the number of steps after which one who knows all is done.
    pub(super) fn oracle_steps(&self) -> u32 {
        match &self.job {
            Job::Errand { landmarks, wanted } => {
                let cells = wanted.iter().rev().map(|number| landmarks[*number]);
                oracle::errands(&self.floor, self.stand, cells)
            }
            Job::Learn(unseen) => {
                oracle::nearest_first(&self.floor, self.stand, unseen.clone(), self.sees_far)
            }
            Job::Locate { is_told } => u32::from(!is_told),
        }
    }

    /// Returns the sum of the rewards of one who knows all, from here on.
    pub(super) fn oracle_rewards(&self) -> f64 {
        self.left() as f64 - STEP_COST * f64::from(self.oracle_steps())
    }
}

impl Job {
    fn errand(
        start: Stand,
        cells: &[u32],
        settings: &Settings,
        rng: &mut ChaCha8Rng,
    ) -> Result<Self, String> {
        let mut free: Vec<u32> = cells.to_vec();
        free.retain(|cell| *cell != start.cell);
        if free.len() < settings.landmarks {
            return Err(format!(
                "landmarks is {}, but the maze has only {} other cells that can be reached from the start",
                settings.landmarks,
                free.len()
            ));
        }
        let draw = |_| free.swap_remove(rng.random_range(0..free.len()));
        let landmarks: Vec<u32> = (0..settings.landmarks).map(draw).collect();
        let mut wanted = vec![rng.random_range(0..landmarks.len())];
        while wanted.len() < settings.errands {
            // Another than the last one.
            let further = rng.random_range(1..landmarks.len());
            wanted.push((wanted[wanted.len() - 1] + further) % landmarks.len());
        }
        Ok(Self::Errand { landmarks, wanted })
    }
}

impl Unseen {
    fn all(floor: &Floor, cells: &[u32]) -> Self {
        let mut unseen = Self {
            cells: vec![false; floor.cell_count()],
            links: vec![false; floor.maze.grid().wall_count()],
            left: cells.len(),
        };
        for cell in cells {
            unseen.cells[*cell as usize] = true;
            for direction in Direction::ALL {
                let is_open = floor.next(*cell, direction).is_some();
                let link = &mut unseen.links[floor.wall(*cell, direction) as usize];
                unseen.left += usize::from(is_open && !*link);
                *link |= is_open;
            }
        }
        unseen
    }

    /// Notes what is seen from a cell, and returns how much of it is new.
    pub(super) fn look(&mut self, floor: &Floor, cell: u32, is_far: bool) -> usize {
        let before = self.left;
        self.left -= usize::from(core::mem::take(&mut self.cells[cell as usize]));
        for direction in Direction::ALL {
            for (link, cell) in sight(floor, cell, direction, is_far) {
                self.left -= usize::from(core::mem::take(&mut self.links[link as usize]));
                self.left -= usize::from(core::mem::take(&mut self.cells[cell as usize]));
            }
        }
        before - self.left
    }

    /// Returns whether a look from a cell shows something new.
    pub(super) fn is_worth_a_look(&self, floor: &Floor, cell: u32, is_far: bool) -> bool {
        self.cells[cell as usize]
            || Direction::ALL.into_iter().any(|direction| {
                let mut sight = sight(floor, cell, direction, is_far);
                sight.any(|(link, cell)| self.links[link as usize] || self.cells[cell as usize])
            })
    }
}

/// Returns the openings and cells that are in sight from a cell in a direction, the nearest first.
fn sight(
    floor: &Floor,
    cell: u32,
    direction: Direction,
    is_far: bool,
) -> impl Iterator<Item = (u32, u32)> {
    let mut at = cell;
    let all = core::iter::from_fn(move || {
        let link = floor.wall(at, direction);
        at = floor.next(at, direction)?;
        Some((link, at))
    });
    all.take(if is_far { usize::MAX } else { 1 })
}
