use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_sim::StepError;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_systems::cpm::{CommonPatterns, CpmRobot, Lesson, Walker, WalkerConfig, soinn, wander};

use super::robots::{epuck, pioneer_as_epuck, walker_config};
use crate::BoxError;
use crate::course::Course;
use crate::pioneer::calibrated;

/// Lesson of the paper's simulated robot (section 5).
const EPUCK_LESSON: Lesson = Lesson::Observations(1000);

/// Lesson of a Pioneer, whose walks are long.
const PIONEER_LESSON: Lesson = Lesson::Observations(300);

/// Learns the common patterns in a maze as the paper's simulated robot does, from 1000 observations
/// (section 5).
///
/// # Errors
/// If the robot cannot be put down, or cannot go on.
pub fn learn(course: &Course, seed: u64) -> Result<CommonPatterns, BoxError> {
    let config = walker_config(&epuck(), course.corridor_width)?;
    learn_by(course, epuck(), config, EPUCK_LESSON, seed)
}

/// Learns the common patterns in a maze by another e-puck, with its own walker.
///
/// # Errors
/// If the robot cannot be put down, or cannot go on.
pub fn learn_by(
    course: &Course,
    robot: EpuckConfig,
    config: WalkerConfig,
    lesson: Lesson,
    seed: u64,
) -> Result<CommonPatterns, BoxError> {
    let body = course.robot_at(course.start()?, Epuck::new(robot)?, seed)?;
    learn_with(body, config, lesson, seed)
}

/// Learns the common patterns in a maze by the calibrated laser Pioneer, used as an e-puck, from
/// 300 observations.
///
/// # Errors
/// If the robot cannot be put down, or cannot go on.
pub fn learn_on_pioneer(course: &Course, seed: u64) -> Result<CommonPatterns, BoxError> {
    let (body, config) = pioneer_as_epuck(course, course.start()?, calibrated(), seed)?;
    learn_with(body, config, PIONEER_LESSON, seed)
}

fn learn_with(
    body: impl CpmRobot<Error = StepError>,
    config: WalkerConfig,
    lesson: Lesson,
    seed: u64,
) -> Result<CommonPatterns, BoxError> {
    let mut walker = Walker::new(body, config);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let observations = wander(&mut walker, lesson, &mut rng)?;
    Ok(CommonPatterns::learn(&observations, soinn())?)
}
