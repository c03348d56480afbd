//! Errands: a robot with an empty map delivers to one landmark after another.
//!
//! Engelson and McDermott, *Maps Considered As Adaptive Planning Resources*, reject a phase of
//! mapping: a courier has packages to deliver from the first minute, learns the building on the
//! way, and notices that a door is shut. They give no such experiment; this is ours.

mod oracle;
mod plan;

use alloc::collections::BTreeMap;

use tolman_maze::Maze;
use tolman_robot::{Goal, Landmark, Task};
use tolman_sim::DoorState;

use self::oracle::Spot;
use self::plan::{DoorMove, ErrandPlan};
use super::condition::door_name;
use super::play::{Bout, Contest, ContestError, Moment};
use crate::Outing;
use crate::registry::Schooling;
use crate::run::TaskEnd;

pub use self::plan::NoLandmarks;

/// A run of errands by the contestant of a [`Contest`].
///
/// A landmark of the drawing is named, and the robot, which begins at the start with an empty map,
/// goes there or looks for it; then the next one is named. The run lasts as many metres as an
/// oracle needs for [`OF_THE_ORACLE`](Self::OF_THE_ORACLE) errands: one that knows the world, doors
/// included, and takes each errand's shortest way along the middles of the corridors. An errand
/// that is given up costs the oracle's way, so that nobody gains by giving up.
#[derive(Clone, Copy, Debug)]
pub struct Errands<'a> {
    /// Contestant, robot, drawing, condition and seed. Its drawing marks the landmarks, or they are
    /// [placed](Self::placed) by seed.
    pub contest: Contest<'a>,
    /// Whether it learns the whole world first, and begins its errands after that.
    pub learns_first: bool,
}

/// Result of a run of errands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrandsRecord {
    /// Reason why the contestant abstained; `None` if it drove.
    pub abstained: Option<String>,
    /// Length of the run, m.
    pub metres: f64,
    /// Metres driven until each delivery, in order.
    pub deliveries: Vec<f64>,
    /// Metres that the oracle drives until each of its deliveries, in order.
    pub oracle: Vec<f64>,
    /// Number of errands that the system gave up, or for which it drove too far, by the reason.
    pub given_up: BTreeMap<String, u32>,
    /// Number of errands that the system called done elsewhere.
    pub wrong_arrivals: u32,
}

impl ErrandsRecord {
    /// Returns the deliveries over those of the oracle in the same metres, 0 to 1.
    #[must_use]
    pub fn oracle_rate(&self) -> f64 {
        self.rate_after(0.0)
    }

    /// Returns the same for the last third of the metres.
    #[must_use]
    pub fn oracle_rate_last_third(&self) -> f64 {
        self.rate_after(2.0 / 3.0 * self.metres)
    }

    /// Returns the metres driven until the delivery of this number, from 1; `None` if it did not
    /// come to that.
    #[must_use]
    pub fn metres_until(&self, delivery: usize) -> Option<f64> {
        self.deliveries.get(delivery.checked_sub(1)?).copied()
    }

    fn rate_after(&self, from: f64) -> f64 {
        let after = |all: &[f64]| all.iter().filter(|at| **at > from).count();
        match after(&self.oracle) {
            0 => 0.0,
            oracle => after(&self.deliveries) as f64 / oracle as f64,
        }
    }
}

impl Errands<'_> {
    /// Number of the oracle's deliveries that a run lasts.
    pub const OF_THE_ORACLE: u32 = 60;

    /// Returns the drawing with landmarks: its own, or some placed by `seed`.
    ///
    /// # Errors
    /// [`NoLandmarks`] if it marks too few, or has no room for any.
    pub fn placed(maze: &Maze, seed: u64) -> Result<Maze, NoLandmarks> {
        plan::placed(maze, seed)
    }

    /// Returns the reason why the contestant is not sent, in a sentence without a full stop; `None`
    /// if it is.
    #[must_use]
    pub fn abstains(&self) -> Option<String> {
        let has_doors = self.contest.condition != super::Condition::MovingDoors
            || !self.contest.doors().is_empty();
        match has_doors {
            true => self.contest.abstains(),
            false => Some(
                "no opening of the drawing can be shut without cutting some of it off".to_owned(),
            ),
        }
    }

    /// Runs the errands and returns the record. Calls `watch` with the contestant at every
    /// [`Moment`]; nothing depends on it.
    ///
    /// # Errors
    /// [`ContestError`].
    pub fn play(
        &self,
        schooling: &Schooling,
        watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ErrandsRecord, ContestError> {
        if let Some(why) = self.abstains() {
            return Ok(ErrandsRecord {
                abstained: Some(why),
                ..ErrandsRecord::default()
            });
        }
        let enter_error = |source| self.contest.enter_error(source);
        let maze = Self::placed(self.contest.maze, self.contest.seed);
        let maze = maze.map_err(|error| enter_error(error.into()))?;
        let contest = Contest {
            maze: &maze,
            ..self.contest
        };
        let bout = Bout::new(&contest, contest.enter(schooling)?);
        let plan = ErrandPlan::new(&maze, contest.doors(), contest.seed);
        let from = bout.squares.cell_at(bout.here());
        let oracle = oracle::deliveries(plan.clone(), from, bout.squares.pitch);
        let oracle = oracle.ok_or_else(|| {
            enter_error("a landmark cannot be reached by this robot; place it elsewhere".into())
        })?;
        let mut run = ErrandRun {
            bout,
            plan,
            record: ErrandsRecord {
                metres: oracle.last().copied().unwrap_or(0.0),
                oracle,
                ..ErrandsRecord::default()
            },
            driven: 0.0,
            watch,
        };
        (run.watch)(&*run.bout.outing, Moment::Begun);
        if self.learns_first {
            run.learn();
        }
        run.deliver().map_err(enter_error)?;
        (run.watch)(&*run.bout.outing, Moment::Over);
        Ok(run.record)
    }
}

/// A run of errands in progress.
struct ErrandRun<W> {
    bout: Bout,
    plan: ErrandPlan,
    record: ErrandsRecord,
    /// Distance driven, m.
    driven: f64,
    watch: W,
}

impl<W: FnMut(&dyn Outing, Moment)> ErrandRun<W> {
    /// Lets the system learn the world.
    fn learn(&mut self) {
        let most = Contest::LIMIT * self.bout.corridors();
        self.pursue(Task::Explore, most);
    }

    /// Names one landmark after another until the metres are driven.
    fn deliver(&mut self) -> Result<(), crate::BoxError> {
        let most = Contest::LIMIT * self.bout.corridors();
        while self.driven < self.record.metres {
            let errand = self.plan.next();
            if let Some(DoorMove { door, is_shut }) = errand.door {
                let state = match is_shut {
                    true => DoorState::Shut,
                    false => DoorState::Open,
                };
                self.bout.outing.set_door(&door_name(door), state)?;
            }
            let before = self.driven;
            let from = Spot {
                cell: self.bout.squares.cell_at(self.bout.here()),
                entered: None,
            };
            let to = Landmark::Numbered(errand.to);
            let (end, arrived) = self.pursue(Task::Reach(Goal::Landmark(to)), most);
            if arrived.is_none() {
                let way = oracle::nearest(self.plan.maze(), from, errand.to);
                let cells = way.map_or(1.0, |(_, cells)| f64::max(cells, 1.0));
                self.driven = self.driven.max(before + cells * self.bout.squares.pitch);
            }
            match (arrived, end) {
                (Some(after), _) if before + after <= self.record.metres => {
                    self.record.deliveries.push(before + after);
                }
                // The metres ended before it arrived.
                (Some(_), _) => {}
                (None, TaskEnd::Done) => self.record.wrong_arrivals += 1,
                (None, TaskEnd::GaveUp { why }) => {
                    *self.record.given_up.entry(why).or_default() += 1;
                }
                (None, TaskEnd::OutOfTime) if self.driven < self.record.metres => {
                    let why = "it drove too far, or nowhere".to_owned();
                    *self.record.given_up.entry(why).or_default() += 1;
                }
                // The metres ended on the way.
                (None, TaskEnd::OutOfTime) => {}
            }
        }
        Ok(())
    }

    /// Lets the system pursue a task for at most `most` m. Returns how that ended, and the
    /// metres until it was at the task's landmark; `None` if it was not.
    fn pursue(&mut self, task: Task, most: f64) -> (TaskEnd, Option<f64>) {
        let left = self.record.metres - self.driven;
        let pursuit = self.bout.set_out(task, most.min(left), None);
        let watch = &mut self.watch;
        let driven = self
            .bout
            .pursue(pursuit, |outing, _| watch(outing, Moment::Acted));
        self.driven += driven.metres;
        (driven.end, driven.arrived)
    }
}
