//! The brains by the names the command line has for them.

use alloc::sync::Arc;
use core::fmt;

use clap::ValueEnum;
use tolman::agents::{Avoid, Mind, Oracle, Policy, Random, WallFollow};
use tolman::course::Course;
use tolman::episode::EpisodeError;
use tolman_sim::robots::LaserPioneerConfig;

/// Who chooses the actions.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Brain {
    /// Any direction, each time anew: the floor
    Random,
    /// MSLST's random wanderer that does not turn back before a dead end
    Avoid,
    /// MSLST's follower of the wall on its right
    WallFollow,
    /// Knows the maze and where it is: the ceiling
    Oracle,
}

impl fmt::Display for Brain {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.to_possible_value();
        formatter.write_str(value.as_ref().map_or("", |value| value.get_name()))
    }
}

impl Brain {
    /// A mind of this kind for a robot on a course.
    ///
    /// # Errors
    /// If the oracle cannot plan there.
    pub(super) fn mind(
        self,
        course: &Course,
        robot: &LaserPioneerConfig,
    ) -> Result<Mind, EpisodeError> {
        Ok(match self {
            Self::Random => Mind::Brain(Box::new(Random)),
            Self::Avoid => Mind::Brain(Box::<Avoid>::default()),
            Self::WallFollow => Mind::Brain(Box::<WallFollow>::default()),
            Self::Oracle => {
                let policy = Policy::new(course, robot)?;
                Mind::Yardstick(Box::new(Oracle::new(Arc::new(policy))))
            }
        })
    }
}
