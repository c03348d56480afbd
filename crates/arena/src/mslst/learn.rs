//! Phases I and II: the robot wanders, learns states, wanders again, and learns the graph.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::Outcome;
use tolman_geom::Point;
use tolman_maps::mslst_graph::{Mapper, Zone};
use tolman_maze::Direction;
use tolman_robot::Body;
use tolman_sim::robots::LaserPioneerConfig;

use super::{MslstConfig, MslstMap, States, StatesError};
use crate::agents::{Avoid, Brain, Perception};
use crate::course::Course;
use crate::drive::Drive;
use crate::episode::{EpisodeError, stream};
use crate::pioneer::heading_free;

/// Why no map was learned.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LearnError {
    /// The robot cannot wander there.
    #[error("the robot cannot wander")]
    Wander(#[from] EpisodeError),
    /// Its scans make no states.
    #[error("the scans make no states")]
    States(#[from] StatesError),
}

/// A map, and what is known of how it was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// What the brain gets.
    pub map: MslstMap,
    /// What it does not.
    pub survey: Survey,
}

/// The truth about a map, for pictures and scores; no brain sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// Where the robot truly was when each node was made, by id; metres.
    pub positions: Vec<Point>,
    /// The action of Phase II, from 1, that made each node; 0 for the first one.
    pub made_by: Vec<u32>,
}

/// The streams that the seed of a map is split into.
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

/// Phase I: "the robot wanders the maze at random, using the Avoid brain … It records its input vector at
/// every time step." Each is [turned to the north](heading_free). Steps in which laser or compass gave nothing
/// record nothing.
///
/// # Errors
/// If the robot cannot be built for the course.
pub fn scans(
    course: &Course,
    robot: &LaserPioneerConfig,
    steps: u32,
    seed: u64,
) -> Result<Vec<Vec<f64>>, LearnError> {
    let mut wanderer = Wanderer::new(course, robot, &mut stream(seed, SCANS_STREAM))?;
    let mut scans = Vec::new();
    while wanderer.drive.steps() < steps {
        wanderer.act(|drive| {
            if drive.steps() <= steps {
                scans.extend(north_scan(drive));
            }
        })?;
    }
    Ok(scans)
}

/// Phase II: "the robot wanders at random as in Phase I, but this time instead of recording sensor data it
/// determines the closest-matching GNG state at the start of every high-level action", and hands it to the
/// [`Mapper`]. An action that was cut short after a step succeeded ("MSLST will not record it as a failed
/// action").
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
    let mut wanderer = Wanderer::new(course, robot, &mut stream(seed, GRAPH_STREAM))?;
    let state_of = |drive: &Drive<'_>, before: u32| {
        // Blind for a moment, or a scan of another ring: what was sensed before still holds.
        north_scan(drive)
            .and_then(|scan| states.nearest(&scan).ok())
            .unwrap_or(before)
    };
    let mut state = state_of(&wanderer.drive, 0);
    let mut mapper = Mapper::new(state, wanderer.zone());
    let mut survey = Survey {
        positions: vec![wanderer.position()],
        made_by: vec![0],
    };
    for number in 1..=actions {
        let (action, outcome) = wanderer.act(|_| {})?;
        if outcome.moved() {
            state = state_of(&wanderer.drive, state);
            mapper.succeeded(action, state, wanderer.zone());
        } else {
            mapper.failed(action);
        }
        if mapper.nodes().len() > survey.positions.len() {
            survey.positions.push(wanderer.position());
            survey.made_by.push(number);
        }
    }
    let graph = mapper.finish();
    Ok(Learned {
        map: MslstMap { states, graph },
        survey,
    })
}

/// What the quantizer sees now; none while laser or compass give nothing.
fn north_scan(drive: &Drive<'_>) -> Option<Vec<f64>> {
    let sensing = drive.sensing();
    Some(heading_free(sensing.scan.as_ref()?, sensing.compass?))
}

/// An action that has not ended by then, such as of a robot without a compass, has failed.
const LONGEST_ACTION: u32 = 100;

/// A robot that wanders by the Avoid brain and goes nowhere.
struct Wanderer<'a> {
    drive: Drive<'a>,
    brain: Avoid,
    last: Option<(Direction, Outcome)>,
    rng: ChaCha8Rng,
}

impl<'a> Wanderer<'a> {
    fn new(
        course: &'a Course,
        robot: &LaserPioneerConfig,
        seeds: &mut ChaCha8Rng,
    ) -> Result<Self, EpisodeError> {
        let body = Body::Circle {
            radius: robot.radius,
        };
        let start = course.random_start(&body, seeds);
        let simulation = seeds.next_u64();
        let layers = stream(seeds.next_u64(), 0);
        Ok(Self {
            drive: Drive::new(course, robot, start, simulation, layers)?,
            brain: Avoid::default(),
            last: None,
            rng: stream(seeds.next_u64(), 0),
        })
    }

    /// Carries out one action; `watch` is shown every step once it is made.
    fn act(
        &mut self,
        mut watch: impl FnMut(&Drive<'_>),
    ) -> Result<(Direction, Outcome), EpisodeError> {
        let sensing = self.drive.sensing();
        let perception = Perception {
            last: self.last,
            scan: sensing.scan.as_ref(),
            heading: sensing.compass,
        };
        let action = self.brain.choose(&perception, &mut self.rng);
        self.drive.begin(action);
        let mut outcome = Outcome::Failed;
        for _ in 0..LONGEST_ACTION {
            let ends = self.drive.step()?.ends;
            watch(&self.drive);
            if let Some(ended) = ends {
                outcome = ended;
                break;
            }
        }
        self.last = Some((action, outcome));
        Ok((action, outcome))
    }

    fn zone(&self) -> Zone {
        if self.drive.is_in_destination() {
            Zone::Destination
        } else {
            Zone::Elsewhere
        }
    }

    fn position(&self) -> Point {
        self.drive.robot().truth().pose.position
    }
}
