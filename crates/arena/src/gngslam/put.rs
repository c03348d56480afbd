use alloc::sync::Arc;

use thiserror::Error;
use tolman_robot::Stopping;
use tolman_sim::PlaceError;
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig, Pioneer2dxError};

use super::{Pitch, PitchError};
use crate::Simulated;

/// Reason why no robot was put into an arena.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PutError {
    /// The robot cannot be built.
    #[error("the robot cannot be built; correct its configuration")]
    Robot(#[from] Pioneer2dxError),
    /// The arena has no room for the robot.
    #[error(transparent)]
    Pitch(#[from] PitchError),
    /// The robot cannot stand where it begins.
    #[error(transparent)]
    Place(#[from] PlaceError),
}

impl Pitch {
    /// Returns a robot at the [start](Self::start) of a run with this `seed`, at rest. It stands
    /// still when the run is over.
    ///
    /// # Errors
    /// [`PutError`] if it cannot be built or cannot stand there.
    pub fn put(
        &self,
        robot: Pioneer2dxConfig,
        seed: u64,
    ) -> Result<Stopping<Simulated<Pioneer2dx>>, PutError> {
        let robot = Pioneer2dx::new(robot)?;
        let start = self.start(seed)?;
        let robot = Simulated::new(Arc::clone(&self.world), robot, start, seed)?;
        Ok(Stopping::new(robot))
    }
}
