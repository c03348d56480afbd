//! Agents that can be sent through a maze, by name.

use alloc::sync::Arc;
use std::sync::OnceLock;

use tolman_sim::robots::LaserPioneerConfig;
use tolman_systems::baselines::{AvoidBrain, Random, WallFollow};

use crate::course::Course;
use crate::episode_error::EpisodeError;
use crate::mind::Mind;
use crate::oracle::{Oracle, PlaceViews, Policy, UnlocalizedOracle};

/// Agents by name: MSLST and its baselines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agent {
    /// [`AvoidBrain`].
    Avoid,
    /// [`WallFollow`].
    WallFollow,
    /// [`Random`].
    Random,
    /// [`Oracle`].
    Oracle,
    /// [`UnlocalizedOracle`].
    UnlocalizedOracle,
}

impl Agent {
    /// All agents: those of the paper in its order, then the floor and the ceilings.
    pub const ALL: [Self; 5] = [
        Self::Avoid,
        Self::WallFollow,
        Self::Random,
        Self::Oracle,
        Self::UnlocalizedOracle,
    ];

    /// Returns the name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Avoid => "Avoid",
            Self::WallFollow => "Wall-follow",
            Self::Random => "Random",
            Self::Oracle => "Oracle",
            Self::UnlocalizedOracle => "Unlocalized oracle",
        }
    }

    /// Returns a description in one line.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Avoid => {
                "Wanders at random and turns back only in dead ends, as in the MSLST paper"
            }
            Self::WallFollow => "Follows the wall on its right, as in the MSLST paper",
            Self::Random => "Chooses a random direction for each action: the floor",
            Self::Oracle => "Knows the maze and where it is: the ceiling",
            Self::UnlocalizedOracle => {
                "Knows the maze but not where it starts: the ceiling of localizing"
            }
        }
    }

    /// Returns the agent of that name in tables.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|agent| agent.name() == name)
    }
}

/// Makes the minds of all agents for one robot on one course. What they share is computed only
/// once.
#[derive(Debug, Default)]
pub struct Cast {
    policy: OnceLock<Arc<Policy>>,
    chart: OnceLock<Arc<PlaceViews>>,
}

impl Cast {
    /// Returns a fresh mind that remembers no run. `course` and `robot` must be the same at every
    /// call.
    ///
    /// # Errors
    /// If the oracle cannot plan there.
    pub fn mind(
        &self,
        agent: Agent,
        course: &Course,
        robot: &LaserPioneerConfig,
    ) -> Result<Mind, EpisodeError> {
        Ok(match agent {
            Agent::Avoid => Mind::Brain(Box::<AvoidBrain>::default()),
            Agent::WallFollow => Mind::Brain(Box::new(WallFollow::new(course.corridor_width))),
            Agent::Random => Mind::Brain(Box::new(Random)),
            Agent::Oracle => Mind::Oracle(Box::new(Oracle::new(self.policy(course, robot)?))),
            Agent::UnlocalizedOracle => {
                let chart = self.chart(course, robot)?;
                Mind::Brain(Box::new(UnlocalizedOracle::new(chart)))
            }
        })
    }

    fn chart(
        &self,
        course: &Course,
        robot: &LaserPioneerConfig,
    ) -> Result<Arc<PlaceViews>, EpisodeError> {
        once(&self.chart, || {
            PlaceViews::new(course, robot, self.policy(course, robot)?)
        })
    }

    fn policy(
        &self,
        course: &Course,
        robot: &LaserPioneerConfig,
    ) -> Result<Arc<Policy>, EpisodeError> {
        once(&self.policy, || Policy::new(course, robot))
    }
}

/// Returns the value in `cell`, which `make` fills first if it is empty. Two threads may call
/// `make` at once; both make the same value.
fn once<T, E>(cell: &OnceLock<Arc<T>>, make: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
    let made = match cell.get() {
        Some(made) => made,
        None => {
            let made = Arc::new(make()?);
            cell.get_or_init(|| made)
        }
    };
    Ok(Arc::clone(made))
}
