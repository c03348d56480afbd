use thiserror::Error;
use tolman_maps::wall_belief::{FilterError, PoseFilterConfig};
use tolman_maps::wall_map::TooLarge;
use tolman_planners::moves::MoveExplorerConfigError;

/// What a noisy mouse knows of its body and its maze.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoisyMouseConfig {
    /// How it knows where it is.
    pub localization: PoseSource,
    /// How it knows how far it drove and turned in a time step.
    pub motion: MotionSource,
    /// What its filter takes for noise.
    pub filter: PoseFilterConfig,
    /// From the middle of a cell to the next, m. > 0.
    pub pitch: f64,
    /// Thickness of a wall, m. ≥ 0.
    pub wall_thickness: f64,
    /// Turn made in a time step at the full command, rad. > 0.
    pub turn_per_step: f64,
    /// Way covered in a time step at the full command, m. > 0.
    pub translate_per_step: f64,
}

/// How a mouse knows where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseSource {
    /// It believes that its wheels do what they are told.
    DeadReckoning,
    /// It compares what it sees with the walls it knows.
    ParticleFilter,
}

/// How a mouse knows how far it drove and turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionSource {
    /// As far as its wheels were told.
    Commands,
    /// As far as its encoders say, and as far as told where they say nothing.
    Encoders,
}

/// Reason why there is no such mouse.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoisyMouseError {
    /// The maze is larger than its map.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// It cannot localize.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// It cannot search.
    #[error(transparent)]
    Search(#[from] MoveExplorerConfigError),
}
