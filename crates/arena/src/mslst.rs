//! Phases I and II: the robot wanders, learns states, wanders again, and learns the graph.

use alloc::sync::Arc;

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::{Drive, Stack};
use tolman_geom::Point;
use tolman_robot::{Body, Ring, System, Task};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_systems::mslst::better::{BetterConfig, BetterExplorer, BetterMap, BetterPart};
use tolman_systems::mslst::{
    BetterMslst, GrowthRecord, Learned, MslstConfig, ScanRecorder, States, StatesError, Topology,
};
use tolman_systems::{Actor, Brain, Doing, OwnHeading, TimeStep, stream};

use crate::course::Course;
use crate::episode::layers;
use crate::episode_error::{EpisodeError, broken};
use crate::lingerer::Lingerer;
use crate::pioneer::CoursePioneer;
use crate::run::{self, Ended, Limited};

/// The better MSLST with the layers of a laser robot and a heading of its own.
pub type BetterDriver = OwnHeading<BetterMslst>;

/// Standard deviation of a compass's constant error, rad.
const COMPASS_SD: f64 = 5.0 * core::f64::consts::PI / 180.0;

/// Returns the better MSLST, without knowledge, to drive a robot with this ring by the layers of
/// `stack`. All random numbers follow from `seed`.
#[must_use]
pub fn better_driver(config: BetterConfig, ring: Ring, stack: Stack, seed: u64) -> BetterDriver {
    let brain = BetterMslst::new(config, ring);
    own_heading(Actor::seeded(brain, stack, seed))
}

/// Returns an actor with a heading of its own, on a robot whose compass may be off.
pub(crate) fn own_heading<B: Brain>(actor: Actor<B>) -> OwnHeading<B> {
    OwnHeading::new(actor, COMPASS_SD)
}

/// Reason why no map was learned.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LearnError {
    /// The robot cannot wander on the course.
    #[error("the robot cannot wander on this course; change the course or the robot")]
    Wander(#[from] EpisodeError),
    /// No states can be learned from the robot's scans.
    #[error("no states can be learned from the scans; check the laser or the GNG")]
    States(#[from] StatesError),
}

/// The better system's map, and the truth recorded about it.
#[derive(Clone, Debug)]
pub struct BetterLearned {
    /// The part for the brain.
    pub map: Arc<BetterMap>,
    /// How learning ended.
    pub ended: Ended,
    /// Number of actions until the robot had been everywhere.
    pub actions: u32,
    /// True position of the robot when each place was made, by id, m.
    pub positions: Vec<Point>,
    /// True places: of the positions where actions ended, as many as lie a robot's diameter apart,
    /// first come first counted.
    pub true_places: Vec<Point>,
}

/// Lets the better system learn a course on its own and returns the map. It ends once it has been
/// everywhere, or has made ten times the steps that a run may take there. Then it wanders on until
/// it has made `times` as many actions, to show that its map stops growing. The same seed gives the
/// same map.
///
/// # Errors
/// [`LearnError`] if the robot cannot be built for the course.
pub fn learn_better(
    course: &Course,
    robot: &LaserPioneerConfig,
    times: u32,
    seed: u64,
) -> Result<BetterLearned, LearnError> {
    learn_by(
        course,
        robot,
        &better_config(course.corridor_width, robot),
        times,
        seed,
    )
}

/// Lets the better system learn a course until it has been everywhere, without the part `without`,
/// if any. Returns the map.
///
/// # Errors
/// As [`learn_better`].
pub fn learn_better_without(
    without: Option<BetterPart>,
    course: &Course,
    robot: &LaserPioneerConfig,
    seed: u64,
) -> Result<BetterLearned, LearnError> {
    let mut config = better_config(course.corridor_width, robot);
    config.without = without;
    learn_by(course, robot, &config, 1, seed)
}

/// Returns the configuration of the better system on `robot`, where corridors are `corridor_width`
/// m wide.
#[must_use]
pub fn better_config(corridor_width: f64, robot: &LaserPioneerConfig) -> BetterConfig {
    let mut config = BetterConfig::pioneer();
    config.diameter = 2.0 * robot.radius;
    config.corridor_width = corridor_width;
    config
}

fn learn_by(
    course: &Course,
    robot: &LaserPioneerConfig,
    config: &BetterConfig,
    times: u32,
    seed: u64,
) -> Result<BetterLearned, LearnError> {
    let wanderer = Wanderer::new(course, robot, &mut stream(seed, BETTER_STREAM))?;
    let limit = course.step_limit().saturating_mul(10 * times);
    let mut robot_in_run = Limited::new(wanderer.robot, limit);
    let explorer = BetterExplorer::new(*config);
    let brain = match config.has(BetterPart::Exploration) {
        true => Lingerer::new(explorer, times),
        false => Lingerer::wandering(explorer),
    };
    let mut actor = Actor::new(brain, wanderer.drive, wanderer.rng);
    // It is put down on its first place.
    let mut positions = vec![robot_in_run.robot().truth().pose.position];
    let mut true_places: Vec<Point> = Vec::new();
    let ended = run::until_done(&mut robot_in_run, |robot| {
        let standing = actor.act(robot, Task::Explore);
        let here = robot.robot().truth().pose.position;
        positions.resize(actor.brain().learned().places().len(), here);
        if true_places
            .iter()
            .all(|place| (place - here).norm() >= config.diameter)
        {
            true_places.push(here);
        }
        standing
    })
    .map_err(|error| broken(&robot_in_run, error))?;
    let lingerer = actor.into_brain();
    let actions = lingerer.explored();
    let chart = lingerer.into_learned().chart();
    let map = BetterMap::of(chart, robot.ring, config).map_err(EpisodeError::from)?;
    Ok(BetterLearned {
        map: Arc::new(map),
        ended,
        actions,
        positions,
        true_places,
    })
}

/// The streams that the seed of a map is split into.
const BETTER_STREAM: u64 = 13;
const SCANS_STREAM: u64 = 11;
const GRAPH_STREAM: u64 = 12;

/// Learns a map of a course (Phases I and II). The same seed gives the same map.
///
/// # Errors
/// [`LearnError`] if the robot cannot be built for the course, or has not seen two different scans.
pub fn learn(
    course: &Course,
    robot: &LaserPioneerConfig,
    config: &MslstConfig,
    seed: u64,
) -> Result<Learned, LearnError> {
    let scans = scans(course, robot, config.scan_steps, seed)?;
    let states = States::learn(&scans, config.threshold)?;
    learn_graph(course, robot, states, config.graph_actions, seed)
}

/// Returns the scans of Phase I: see [`ScanRecorder`].
///
/// # Errors
/// If the robot cannot be built for the course.
pub fn scans(
    course: &Course,
    robot: &LaserPioneerConfig,
    steps: u32,
    seed: u64,
) -> Result<Vec<Vec<f64>>, LearnError> {
    let wanderer = Wanderer::new(course, robot, &mut stream(seed, SCANS_STREAM))?;
    let mut robot = Limited::new(wanderer.robot, u32::MAX);
    let mut actor = Actor::new(ScanRecorder::new(steps), wanderer.drive, wanderer.rng);
    run::run(&mut robot, &mut actor, Task::Explore).map_err(|error| broken(&robot, error))?;
    Ok(actor.into_brain().into_scans())
}

/// Learns the graph of Phase II and returns it with the true position at which each node was made:
/// see [`Topology`].
///
/// # Errors
/// If the robot cannot be built for the course.
pub fn learn_graph(
    course: &Course,
    robot: &LaserPioneerConfig,
    states: States,
    actions: u32,
    seed: u64,
) -> Result<Learned, LearnError> {
    let wanderer = Wanderer::new(course, robot, &mut stream(seed, GRAPH_STREAM))?;
    let mut survey = GrowthRecord {
        positions: vec![wanderer.robot.truth().pose.position],
        made_by: vec![0],
    };
    let topology = Topology::new(
        states,
        actions,
        &TimeStep::of(&wanderer.robot, Doing::PutDown),
    );
    let mut robot = Limited::new(wanderer.robot, u32::MAX);
    let mut actor = Actor::new(topology, wanderer.drive, wanderer.rng);
    run::until_done(&mut robot, |robot| {
        let standing = actor.act(robot, Task::Explore);
        let topology = actor.brain();
        if topology.nodes().len() > survey.positions.len() {
            survey.positions.push(robot.robot().truth().pose.position);
            survey.made_by.push(topology.actions());
        }
        standing
    })
    .map_err(|error| broken(&robot, error))?;
    let map = actor.brain().finished();
    Ok(Learned { map, survey })
}

/// A robot somewhere on a course, and what it needs to wander.
struct Wanderer {
    robot: CoursePioneer,
    drive: Drive<ChaCha8Rng>,
    rng: ChaCha8Rng,
}

impl Wanderer {
    fn new(
        course: &Course,
        robot: &LaserPioneerConfig,
        seeds: &mut ChaCha8Rng,
    ) -> Result<Self, EpisodeError> {
        let body = Body::Circle {
            radius: robot.radius,
        };
        let start = course.random_start(&body, seeds);
        let simulation = seeds.next_u64();
        let layers_rng = stream(seeds.next_u64(), 0);
        Ok(Self {
            robot: course.robot_at(start, LaserPioneer::new(robot.clone())?, simulation)?,
            drive: Drive::new(layers(course, robot)?, layers_rng),
            rng: stream(seeds.next_u64(), 0),
        })
    }
}
