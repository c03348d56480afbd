//! The ceilings: minds that know the maze.
//!
//! An [`Oracle`] is given the true pose and follows a [`Policy`]. An [`UnlocalizedOracle`] uses its
//! robot's sensors, like every brain, but has a [`PlaceViews`] with the view from everywhere.
//! Neither is a competitor: they show what the same body and the same layers allow.

mod chances;
mod policy;
mod seer;
mod trier;
mod unlocalized;

use alloc::sync::Arc;

use tolman_control::Outcome;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction};
use tolman_sim::Solo;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};

pub use policy::Policy;
pub(crate) use seer::Seer;
pub use unlocalized::{PlaceViews, UnlocalizedOracle};

use crate::course::Course;
use crate::episode_error::EpisodeError;
use crate::pioneer::without_noise;

/// Returns the robot of a course without noise, to be set down anywhere.
fn perfect_robot(
    course: &Course,
    robot: &LaserPioneerConfig,
) -> Result<Solo<LaserPioneer>, EpisodeError> {
    noisy_robot(course, &without_noise(robot))
}

/// Returns the robot of a course with its noise, to be set down anywhere.
fn noisy_robot(
    course: &Course,
    robot: &LaserPioneerConfig,
) -> Result<Solo<LaserPioneer>, EpisodeError> {
    let model = LaserPioneer::new(robot.clone())?;
    let somewhere = course.starts().next().unwrap_or(Cell::new(0, 0));
    let somewhere = course.in_cell(somewhere, Direction::North);
    Ok(Solo::new(course.world.clone(), model, somewhere, 0)?)
}

/// The ceiling: it knows the maze and its true pose, and plans again at every action. Body and
/// layers are those of the others. Not in the paper.
///
/// Its [`Policy`] gives the expected cost of each action, in time steps, near the robot's pose. An
/// action that has just failed there is not tried again before the robot has moved.
#[derive(Clone, Debug)]
pub struct Oracle {
    policy: Arc<Policy>,
    failed: Vec<Direction>,
}

impl Oracle {
    /// Returns an oracle that follows `policy`.
    #[must_use]
    pub const fn new(policy: Arc<Policy>) -> Self {
        Self {
            policy,
            failed: Vec::new(),
        }
    }

    /// Returns the next action of a robot at `pose`. `last` is the action before and how it ended,
    /// if there was one.
    pub fn choose(&mut self, pose: Pose, last: Option<(Direction, Outcome)>) -> Direction {
        match last {
            Some((action, outcome)) if !outcome.moved() => self.failed.push(action),
            _ => self.failed.clear(),
        }
        if self.failed.len() == Direction::ALL.len() {
            self.failed.clear();
        }
        let costs = self.policy.costs(pose);
        // Ties go to the first, clockwise from north: the same on every run.
        Direction::ALL
            .into_iter()
            .filter(|action| !self.failed.contains(action))
            .min_by(|a, b| costs[a.index()].total_cmp(&costs[b.index()]))
            .unwrap_or(Direction::North)
    }
}
