//! One run of one mind: from a start until the destination is reached or time is up.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use thiserror::Error;
use tolman_control::{Outcome, RingError};
use tolman_geom::Pose;
use tolman_maze::Direction;
use tolman_robot::{Body, Robot, TurnTranslate};
use tolman_sim::robots::{ConfigError, LaserPioneer, LaserPioneerConfig};
use tolman_sim::{PlaceError, Solo, StepError};

use crate::agents::{Mind, Perception};
use crate::course::Course;
use crate::drive::Drive;

/// Why a run could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EpisodeError {
    /// The robot cannot be built.
    #[error("the robot cannot be built")]
    Robot(#[from] ConfigError),
    /// The robot cannot start where it was put.
    #[error("the robot cannot start there")]
    Start(#[from] PlaceError),
    /// The layers do not fit the robot's ring.
    #[error("the layers do not fit the robot's ring")]
    Layers(#[from] RingError),
    /// The course is too large for the oracle.
    #[error(
        "the oracle would have to plan on {nodes} nodes, and {most} are the most: choose a smaller maze"
    )]
    Policy {
        /// How many nodes the course needs.
        nodes: usize,
        /// How many it may need.
        most: usize,
    },
    /// A step could not be made.
    #[error("step {step} could not be made")]
    Step {
        /// Which one, from 0.
        step: u32,
        /// Why.
        source: StepError,
    },
}

/// What a run is made of, beside the mind.
#[derive(Clone, Debug)]
pub struct Trial<'a> {
    /// Where it takes place.
    pub course: &'a Course,
    /// The robot.
    pub robot: LaserPioneerConfig,
    /// Where it begins.
    pub start: Pose,
    /// Time steps after which it has failed.
    pub step_limit: u32,
    /// The seed of the run: world, layers and mind draw from streams of their own.
    pub seed: u64,
}

/// What became of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Whether the robot's centre came to lie in the destination.
    pub reached: bool,
    /// High-level actions begun.
    pub actions: u32,
    /// How many of those failed.
    pub failed_actions: u32,
    /// Time steps made; the limit where time ran out.
    pub steps: u32,
    /// Steps in which the body touched a wall.
    pub bumps: u32,
    /// The true pose at the start and after every step.
    pub path: Vec<Pose>,
}

/// One time step of a run, as it has just been made.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The action it belongs to.
    pub action: Direction,
    /// Who chose it.
    pub mind: &'a Mind,
    /// What the motors were told.
    pub command: TurnTranslate,
    /// How the action ended with this step; none while it goes on.
    pub ends: Option<Outcome>,
    /// The robot as it is now.
    pub robot: &'a Solo<LaserPioneer>,
}

/// The streams that one run's seed is split into, beside the simulation's own.
const LAYERS_STREAM: u64 = 1;
const MIND_STREAM: u64 = 2;
const START_STREAM: u64 = 3;

/// The random start of the run with this seed: see [`Course::random_start`].
#[must_use]
pub fn random_start(course: &Course, body: &Body, seed: u64) -> Pose {
    course.random_start(body, &mut stream(seed, START_STREAM))
}

pub(crate) fn stream(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(stream);
    rng
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
    mut watch: impl FnMut(&Step<'_>),
) -> Result<Episode, EpisodeError> {
    let mut drive = Drive::new(
        trial.course,
        &trial.robot,
        trial.start,
        trial.seed,
        stream(trial.seed, LAYERS_STREAM),
    )?;
    let mut mind_rng = stream(trial.seed, MIND_STREAM);

    let mut episode = Episode {
        reached: false,
        actions: 0,
        failed_actions: 0,
        steps: 0,
        bumps: 0,
        path: vec![trial.start],
    };
    let mut last = None;
    while episode.steps < trial.step_limit && !episode.reached {
        let action = choose(mind, last, drive.robot(), &mut mind_rng);
        drive.begin(action);
        episode.actions += 1;
        while episode.steps < trial.step_limit && !episode.reached {
            let proposal = drive.step()?;
            episode.record(&drive);
            watch(&Step {
                action,
                mind,
                command: proposal.command,
                ends: proposal.ends,
                robot: drive.robot(),
            });
            if let Some(outcome) = proposal.ends {
                episode.failed_actions += u32::from(!outcome.moved());
                last = Some((action, outcome));
                break;
            }
        }
    }
    Ok(episode)
}

impl Episode {
    /// Takes down the step that was just made.
    fn record(&mut self, drive: &Drive<'_>) {
        let truth = drive.robot().truth();
        self.steps = drive.steps();
        self.bumps += u32::from(truth.bump);
        self.path.push(truth.pose);
        self.reached = drive.is_in_destination();
    }
}

fn choose(
    mind: &mut Mind,
    last: Option<(Direction, Outcome)>,
    solo: &Solo<LaserPioneer>,
    rng: &mut ChaCha8Rng,
) -> Direction {
    match mind {
        Mind::Yardstick(yardstick) => yardstick.choose(last, solo.truth(), rng),
        Mind::Brain(brain) => {
            let sensing = solo.sensing();
            let perception = Perception {
                last,
                scan: sensing.scan.as_ref(),
                heading: sensing.compass,
            };
            brain.choose(&perception, rng)
        }
    }
}
