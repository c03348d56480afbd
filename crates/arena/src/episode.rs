//! Runs one mind once: from a start until the destination is reached or time is up.

mod step;

use core::cell::Cell;
use core::ops::ControlFlow;

use tolman_control::{Drive, RingError, Stack};
use tolman_geom::Pose;
use tolman_robot::{Body, Goal, Landmark, Standing, Task};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_systems::{Actor, ActorError, stream};

use crate::course::Course;
use crate::episode_error::broken;
use crate::mind::Mind;
use crate::oracle::Seer;
use crate::pioneer::CoursePioneer;
use crate::run::{self, InRun, Limited, TaskEnd};

pub use crate::episode_error::EpisodeError;
pub use step::{Chooser, Step};

/// Everything a run needs except the mind.
#[derive(Clone, Debug)]
pub struct Trial<'a> {
    /// Course of the run.
    pub course: &'a Course,
    /// Configuration of the robot.
    pub robot: LaserPioneerConfig,
    /// Pose at the beginning.
    pub start: Pose,
    /// Number of time steps after which the run has failed.
    pub step_limit: u32,
    /// Seed of the run. World, layers and mind draw from separate streams.
    pub seed: u64,
}

/// A robot that is lifted in the middle of a run and put down elsewhere. Its brain is not told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lifted {
    /// Number of time steps after which the robot is lifted, at the end of the action in progress.
    pub after: u32,
    /// Pose at which the robot is put down.
    pub to: Pose,
}

/// Result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Whether the robot's centre came to lie in the destination.
    pub reached: bool,
    /// Number of high-level actions begun.
    pub actions: u32,
    /// Number of these actions that failed.
    pub failed_actions: u32,
    /// Number of these actions that failed in their first time step.
    pub failed_at_once: u32,
    /// Number of time steps made; the limit where time ran out.
    pub steps: u32,
    /// Number of steps in which the body touched a wall.
    pub bumps: u32,
    /// The true pose at the start and after every step.
    pub path: Vec<Pose>,
}

/// Streams into which one run's seed is split, beside the simulation's own.
const LAYERS_STREAM: u64 = 1;
const MIND_STREAM: u64 = 2;
/// The stream of random starts.
pub const START_STREAM: u64 = 3;

/// Task that every mind is given.
const ARRIVE: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

/// Returns the random start of the run with this seed: see [`Course::random_start`].
#[must_use]
pub fn random_start(course: &Course, body: &Body, seed: u64) -> Pose {
    course.random_start(body, &mut stream(seed, START_STREAM))
}

/// Returns the layers of a robot of this make on a course.
///
/// # Errors
/// If the layers do not fit the robot's ring.
pub fn layers(course: &Course, robot: &LaserPioneerConfig) -> Result<Stack, RingError> {
    Stack::paper(robot.ring, 2.0 * robot.radius, course.corridor_width)
}

/// Lets `mind` drive until its robot reaches the destination or the trial's time is up.
///
/// `watch` is shown every step once it is made; nothing of the run depends on it.
///
/// # Errors
/// [`EpisodeError`] if the robot cannot be built or placed.
pub fn run(
    trial: &Trial<'_>,
    mind: &mut Mind,
    watch: impl FnMut(&Step<'_>),
) -> Result<Episode, EpisodeError> {
    run_lifted(trial, mind, None, watch)
}

/// Runs like [`run()`], with a robot that is lifted on the way, and returns the same.
///
/// # Errors
/// [`EpisodeError`] if the robot cannot be built, or cannot stand at its start or where it is put
/// down.
pub fn run_lifted(
    trial: &Trial<'_>,
    mind: &mut Mind,
    lifted: Option<Lifted>,
    mut watch: impl FnMut(&Step<'_>),
) -> Result<Episode, EpisodeError> {
    run_while(trial, mind, lifted, |step| {
        watch(step);
        ControlFlow::Continue(())
    })
}

/// Runs like [`run_lifted`], until `watch` breaks. The run then ends with the present action.
///
/// # Errors
/// As [`run_lifted`].
pub fn run_while(
    trial: &Trial<'_>,
    mind: &mut Mind,
    mut lifted: Option<Lifted>,
    mut watch: impl FnMut(&Step<'_>) -> ControlFlow<()>,
) -> Result<Episode, EpisodeError> {
    let robot = LaserPioneer::new(trial.robot.clone())?;
    let robot = trial.course.robot_at(trial.start, robot, trial.seed)?;
    let mut robot = Limited::new(robot, trial.step_limit);
    // An action may last as long as the run.
    let layers = layers(trial.course, &trial.robot)?;
    let drive = Drive::new(layers, stream(trial.seed, LAYERS_STREAM)).longest_action(u32::MAX);
    let (mut failed_actions, mut failed_at_once) = (0, 0);
    let mut steps_of_action = 0;
    let broken_off = Cell::new(false);
    let mut see = |step: &Step<'_>| {
        steps_of_action += 1;
        if let Some(outcome) = step.ends {
            failed_actions += u32::from(!outcome.moved());
            failed_at_once += u32::from(!outcome.moved() && steps_of_action == 1);
            steps_of_action = 0;
        }
        broken_off.set(broken_off.get() | watch(step).is_break());
    };
    let unless_broken_off = |standing| match broken_off.get() && standing == Standing::UnderWay {
        true => Standing::gave_up("broken off"),
        false => standing,
    };
    let mut refused = None;
    let mut lift = |robot: &mut Limited<CoursePioneer>| {
        if let Some(Lifted { to, .. }) = lifted.take_if(|lifted| robot.steps() >= lifted.after) {
            refused = robot.robot_mut().place(to).err();
        }
    };
    let ended = match mind {
        Mind::Brain(brain) => {
            let mut actor = Actor::new(&mut **brain, drive, stream(trial.seed, MIND_STREAM));
            run::until_done(&mut robot, |robot| {
                lift(robot);
                let standing = actor.act_seen(robot, ARRIVE, |brain, step| {
                    see(&Step::of(Chooser::Brain(&**brain), step));
                });
                standing.map(unless_broken_off)
            })
        }
        Mind::Rolling(brain) => {
            let mut actor = Actor::new(&mut **brain, drive, stream(trial.seed, MIND_STREAM));
            run::until_done(&mut robot, |robot| {
                lift(robot);
                let standing = actor.act_seen(robot, ARRIVE, |brain, step| {
                    see(&Step::of(Chooser::Rolling(&**brain), step));
                });
                standing.map(unless_broken_off)
            })
        }
        Mind::Oracle(oracle) => {
            let mut seer = Seer::new(oracle, drive);
            run::until_done(&mut robot, |robot| {
                lift(robot);
                let standing = seer.act(robot, |step| see(&Step::of(Chooser::Oracle, step)));
                standing.map(unless_broken_off).map_err(ActorError::Robot)
            })
        }
    }
    .map_err(|error| broken(&robot, error))?;
    if let Some(refused) = refused {
        return Err(refused.into());
    }
    Ok(Episode {
        reached: ended.end == TaskEnd::Done,
        actions: ended.actions,
        failed_actions,
        failed_at_once,
        steps: ended.steps,
        bumps: robot.robot().bumps(),
        path: robot.robot().path().to_vec(),
    })
}
