//! The paper's mouse on the continuous simulator (its section 6): walls have a thickness, wheels slip, ranges are noisy.
//!
//! Rules, search and score are those of the paper; but a step is driven by motors that miss, and the mouse
//! knows where it is from its commands and three range sensors alone. It holds a [`PoseFilter`] on a [`WallBelief`] that
//! grows with what it sees.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maps::wall_belief::{
    FilterError, PoseFilter, PoseFilterConfig, RangeReading, WallBelief,
};
use tolman_maps::wall_map::TooLarge;
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::moves::{
    Leap, MouseStep, MoveDecision, MoveExplorer, MoveExplorerConfig, MoveExplorerConfigError,
    MoveMap,
};
use tolman_planners::{Passages, Unknown};
use tolman_robot::{LaserSensing, Ring, Robot, TurnTranslate};
use tolman_sim::noise::{Fault, Gaussian, Slip};
use tolman_sim::robots::{ConfigError, LaserPioneer, LaserPioneerConfig, MotorNoise};
use tolman_sim::{CorridorSize, PlaceError, Solo, StepError, World, WorldError};

use super::MAX_STEPS;

/// The largest maze, columns or rows.
const SIDE: usize = 16;

/// How much a mouse's wheels and sensors err, and how it copes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisyConfig {
    /// How the mouse knows where it is.
    pub localization: Localization,
    /// Wheels slip: distances and turns are off by a share uniform in ± this. ≥ 0.
    pub slip: f64,
    /// Standard deviation of the turn that nobody asked for, rad per metre. ≥ 0.
    pub drift: f64,
    /// Standard deviation of a range, m. ≥ 0.
    pub range: f64,
    /// The same as a share of the range. ≥ 0.
    pub relative_range: f64,
}

/// How a mouse knows where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Localization {
    /// It believes that its wheels do what they are told.
    DeadReckoning,
    /// It compares what it sees with the walls it knows.
    ParticleFilter,
}

impl NoisyConfig {
    /// Ordinary noise times `level`: wheels slip by up to a tenth, as those of Webots do, and drift by 0.2 rad/m; ranges are off
    /// by 3 mm and 2 %.
    #[must_use]
    pub fn ordinary(localization: Localization, level: f64) -> Self {
        Self {
            localization,
            slip: 0.1 * level,
            drift: 0.2 * level,
            range: 0.003 * level,
            relative_range: 0.02 * level,
        }
    }

    /// A body of 8 cm, three range sensors that reach 1 m, 2 cm and 0.2 rad in a time step of 20 ms.
    fn robot(&self) -> LaserPioneerConfig {
        let slip = Fault::Slip(Slip { share: self.slip });
        let mut robot = LaserPioneerConfig {
            radius: 0.04,
            ring: Ring::fan(3, core::f64::consts::PI, 1.0),
            turn_per_step: 0.2,
            translate_per_step: 0.02,
            motor_noise: MotorNoise {
                drift_sd: self.drift,
                ..MotorNoise::default()
            },
            scan_noise: Gaussian {
                absolute_sd: self.range,
                relative_sd: self.relative_range,
            },
            step_us: 20_000,
            ..LaserPioneerConfig::noiseless()
        };
        robot.faults.motor_turn.push(slip);
        robot.faults.motor_distance.push(slip);
        robot
    }

    /// What the filter takes for noise: what there is, and a little for what its model leaves out.
    fn filter(&self) -> PoseFilterConfig {
        PoseFilterConfig {
            particles: 200,
            // The standard deviation of a uniform number in ± 1.
            slip: 0.577 * self.slip + 0.01,
            drift: self.drift + 0.02,
            spread: 0.0005,
            range: self.range + 0.004,
            relative_range: self.relative_range + 0.01,
            outliers: 0.1,
        }
    }
}

/// A maze of the competitions: cells of 18 cm, walls of 12 mm.
const SIZE: CorridorSize = CorridorSize {
    corridor_width: 0.168,
    wall_thickness: 0.012,
};

/// What became of a noisy mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisyTrial {
    /// How it ended.
    pub end: NoisyEnd,
    /// Steps of the paper's rules.
    pub steps: u32,
    /// Time steps in which it touched a wall.
    pub bumps: u32,
    /// How far the mouse was from where it thought it was, m: mean over its stops.
    pub mean_error: f64,
}

/// How the runs of a noisy mouse ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoisyEnd {
    /// It was at the goal in both runs.
    Arrived {
        /// Steps of the first run, the reset included.
        run_1: u32,
        /// Steps of the second.
        run_2: u32,
    },
    /// It said that it was at the goal and was not.
    Mistaken,
    /// It believes that no way leads to the goal.
    Stuck,
    /// It had made all its steps.
    OutOfSteps,
}

/// Why a mouse cannot be sent out.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NoisyError {
    /// The maze is larger than its map.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The maze does not say where the mouse starts.
    #[error("the maze has no start: mark a cell with S")]
    NoStart,
    /// The maze cannot be built.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The mouse cannot be built.
    #[error(transparent)]
    Robot(#[from] ConfigError),
    /// It cannot be put down at the start.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// It cannot drive.
    #[error(transparent)]
    Step(#[from] StepError),
    /// It cannot localize.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// It cannot search.
    #[error(transparent)]
    Search(#[from] MoveExplorerConfigError),
}

/// Sends a mouse through `maze`: it explores until it believes to have proven its run, is put back to the start, and makes
/// it.
///
/// # Errors
/// If there is no such maze or mouse.
pub fn send(maze: &Maze, config: &NoisyConfig, seed: u64) -> Result<NoisyTrial, NoisyError> {
    let mut outing = Outing::new(maze, config, seed)?;
    let end = outing.both_runs()?;
    Ok(NoisyTrial {
        end,
        steps: outing.steps,
        bumps: outing.bumps,
        mean_error: outing.errors / f64::from(outing.stops.max(1)),
    })
}

struct Outing<'a> {
    maze: &'a Maze,
    start: (Cell, Direction),
    solo: Solo<LaserPioneer>,
    rates: (f64, f64),
    localization: Localization,
    filter: PoseFilter,
    /// Where its wheels alone have brought it.
    reckoned: Pose,
    belief: WallBelief<SIDE>,
    rng: ChaCha8Rng,
    steps: u32,
    bumps: u32,
    stops: u32,
    errors: f64,
}

/// Readings taken in a stop.
const LOOKS: u32 = 4;
/// A mouse nearer to a wall ahead does not drive on, from its middle, m.
const TOO_NEAR: f64 = 0.055;
/// A turn or a place this near is reached, rad and m.
const CLOSE: (f64, f64) = (0.03, 0.004);
/// Time steps after which a step of the paper's rules is given up.
const PATIENCE: u32 = 200;

impl<'a> Outing<'a> {
    fn new(maze: &'a Maze, config: &NoisyConfig, seed: u64) -> Result<Self, NoisyError> {
        let start = maze.start().ok_or(NoisyError::NoStart)?;
        let belief = WallBelief::new(maze.grid(), SIZE.pitch(), SIZE.wall_thickness)?;
        let pose = Pose::new(belief.middle(start.0), heading_of(start.1));
        let world = World::from_maze(maze, &SIZE)?;
        let robot = config.robot();
        let rates = (robot.turn_per_step, robot.translate_per_step);
        Ok(Self {
            maze,
            start,
            solo: Solo::new(world, LaserPioneer::new(robot)?, pose, seed)?,
            rates,
            localization: config.localization,
            filter: PoseFilter::new(config.filter(), pose)?,
            reckoned: pose,
            belief,
            rng: ChaCha8Rng::seed_from_u64(seed),
            steps: 0,
            bumps: 0,
            stops: 0,
            errors: 0.0,
        })
    }

    fn both_runs(&mut self) -> Result<NoisyEnd, NoisyError> {
        if let Some(end) = self.explore()? {
            return Ok(end);
        }
        self.steps += 1;
        let run_1 = self.steps;
        let pose = Pose::new(self.belief.middle(self.start.0), heading_of(self.start.1));
        self.solo.place(pose)?;
        self.filter.place(pose);
        self.reckoned = pose;
        self.run(run_1)
    }

    /// The first run; how it ended, if badly.
    fn explore(&mut self) -> Result<Option<NoisyEnd>, NoisyError> {
        let mut explorer = MoveExplorer::<SIDE>::new(MoveExplorerConfig::tuned(), self.start.0)?;
        let mut was_at_goal = false;
        while self.steps < MAX_STEPS {
            self.look()?;
            was_at_goal |= self.is_at_goal();
            let decision = explorer.decide(&self.belief, self.maze.goals(), self.cell());
            match decision {
                MoveDecision::Drive(leap) => self.leap(leap)?,
                MoveDecision::Turn => self.turn_to(self.looks_to().right())?,
                MoveDecision::Finished { .. } if was_at_goal => return Ok(None),
                MoveDecision::Finished { .. } => return Ok(Some(NoisyEnd::Mistaken)),
                MoveDecision::Stuck => return Ok(Some(NoisyEnd::Stuck)),
            }
            self.steps += 1;
        }
        Ok(Some(NoisyEnd::OutOfSteps))
    }

    /// The second run, planned anew at every stop.
    fn run(&mut self, run_1: u32) -> Result<NoisyEnd, NoisyError> {
        while self.steps < MAX_STEPS {
            self.look()?;
            if self.maze.goals().contains(&self.cell()) {
                let run_2 = self.steps - run_1;
                return Ok(if self.is_at_goal() {
                    NoisyEnd::Arrived { run_1, run_2 }
                } else {
                    NoisyEnd::Mistaken
                });
            }
            let leap = [Unknown::Closed, Unknown::Open]
                .into_iter()
                .find_map(|unknown| {
                    let passages = Passages::<SIDE>::new(&self.belief, unknown);
                    let map = MoveMap::new(&passages, self.maze.goals().iter().copied());
                    map.way(&passages, self.cell()).next()
                });
            let Some(leap) = leap else {
                return Ok(NoisyEnd::Stuck);
            };
            self.leap(leap)?;
            self.steps += 1;
        }
        Ok(NoisyEnd::OutOfSteps)
    }

    fn pose(&self) -> Pose {
        match self.localization {
            Localization::DeadReckoning => self.reckoned,
            Localization::ParticleFilter => self.filter.estimate(),
        }
    }

    /// The cell the mouse thinks it is in; the start, if it thinks that it has left the maze.
    fn cell(&self) -> Cell {
        self.belief
            .cell_at(self.pose().position)
            .unwrap_or(self.start.0)
    }

    /// Where it looks, about.
    fn looks_to(&self) -> Direction {
        let pose = self.pose();
        let off = |side: &Direction| pose.heading.turn_to(heading_of(*side)).abs();
        Direction::ALL
            .into_iter()
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .unwrap_or(self.start.1)
    }

    /// Whether it really is in a goal.
    fn is_at_goal(&self) -> bool {
        let cell = self.belief.cell_at(self.solo.truth().pose.position);
        cell.is_some_and(|cell| self.maze.goals().contains(&cell))
    }

    fn look(&mut self) -> Result<(), NoisyError> {
        for _ in 0..LOOKS {
            self.time_step(TurnTranslate::STOP)?;
            for reading in readings(self.solo.sensing()) {
                self.belief.observe(self.pose(), reading);
            }
        }
        let off = self.pose().position - self.solo.truth().pose.position;
        self.errors += off.norm();
        self.stops += 1;
        Ok(())
    }

    /// One step of the paper's rules: a turn, then cells ahead or back.
    fn leap(&mut self, leap: Leap) -> Result<(), NoisyError> {
        let mut looks = self.looks_to();
        let MouseStep { cells, .. } = MouseStep::of_leap(&mut looks, leap);
        self.turn_to(looks)?;
        let ahead = if cells < 0 { -1.0 } else { 1.0 };
        let target = self.belief.middle(leap.end);
        let along = heading_of(looks).unit();
        let left = heading_of(looks.left()).unit();
        for _ in 0..PATIENCE {
            let pose = self.pose();
            let away = target - pose.position;
            let way = ahead * away.dot(&along);
            let front = self
                .solo
                .sensing()
                .scan
                .as_ref()
                .and_then(|scan| scan.ranges.get(1).copied());
            let blocked = ahead > 0.0 && front.is_some_and(|range| range < TOO_NEAR);
            if way < CLOSE.1 || blocked {
                return Ok(());
            }
            // Towards the middle of the corridor, the more the farther from it.
            let aside = (3.0 * away.dot(&left) / self.belief.pitch()).clamp(-0.4, 0.4);
            let wanted = heading_of(looks).turned(ahead * aside);
            let off = pose.heading.turn_to(wanted);
            let touched = self.time_step(TurnTranslate {
                turn: (off / self.rates.0).clamp(-1.0, 1.0),
                translate: ahead * (way / self.rates.1).min(1.0),
            })?;
            if touched {
                // Off the wall again, and look.
                self.time_step(TurnTranslate {
                    turn: 0.0,
                    translate: -0.5 * ahead,
                })?;
                return Ok(());
            }
        }
        Ok(())
    }

    fn turn_to(&mut self, side: Direction) -> Result<(), NoisyError> {
        for _ in 0..PATIENCE {
            let off = self.pose().heading.turn_to(heading_of(side));
            if off.abs() < CLOSE.0 {
                break;
            }
            self.time_step(TurnTranslate {
                turn: (off / self.rates.0).clamp(-1.0, 1.0),
                translate: 0.0,
            })?;
        }
        Ok(())
    }

    /// One time step; whether the mouse touched a wall.
    fn time_step(&mut self, command: TurnTranslate) -> Result<bool, NoisyError> {
        self.solo.step(&command)?;
        let sensing = self.solo.sensing();
        let touched = sensing.bump == Some(true);
        self.bumps += u32::from(touched);
        let (turn, distance) = (
            command.turn * self.rates.0,
            command.translate * self.rates.1,
        );
        self.reckoned = self.reckoned.displaced(distance, turn);
        if self.localization == Localization::ParticleFilter {
            let readings = readings(sensing);
            self.filter.drive(distance, turn, &mut self.rng);
            self.filter.sense(&self.belief, &readings, &mut self.rng);
        }
        Ok(touched)
    }
}

fn readings(sensing: &LaserSensing) -> Vec<RangeReading> {
    let Some(scan) = &sensing.scan else {
        return Vec::new();
    };
    (0..)
        .zip(&scan.ranges)
        .map(|(beam, range)| RangeReading {
            bearing: scan.ring.bearing(beam),
            range: *range,
            max_range: scan.ring.max_range,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use tolman_maze::Braided;

    use super::*;

    fn outcome(localization: Localization, level: f64) -> NoisyTrial {
        let braided = Braided {
            width: 12,
            height: 12,
            share: 0.5,
        };
        let mut maze = braided.generate(&mut ChaCha8Rng::seed_from_u64(1)).unwrap();
        maze.set_goals(maze.grid().middle().collect());
        send(&maze, &NoisyConfig::ordinary(localization, level), 1).unwrap()
    }

    #[test]
    fn the_filter_copes_with_noise_that_leads_dead_reckoning_astray() {
        let quiet = outcome(Localization::DeadReckoning, 0.0);
        let filtered = outcome(Localization::ParticleFilter, 2.0);
        let reckoned = outcome(Localization::DeadReckoning, 2.0);
        assert!(matches!(quiet.end, NoisyEnd::Arrived { .. }));
        assert_eq!(filtered.end, quiet.end, "the noise costs no step");
        assert!(!matches!(reckoned.end, NoisyEnd::Arrived { .. }));
        assert!(filtered.mean_error < 0.01 && reckoned.mean_error > 0.02);
    }
}
