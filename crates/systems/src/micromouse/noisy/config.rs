use thiserror::Error;
use tolman_geom::OutOfRange;
use tolman_maps::wall_belief::PoseFilterConfig;
use tolman_maps::wall_map::TooLarge;
use tolman_planners::moves::MoveExplorerConfigError;

/// Knowledge of a noisy mouse about its body and its maze.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NoisyMouseConfig {
    /// Estimate of the pose.
    pub localization: PoseSource,
    /// Estimate of the motion in a time step.
    pub motion: MotionSource,
    /// Noise that the mouse's filter assumes.
    pub filter: PoseFilterConfig,
    /// Distance between the middles of two cells, m. > 0.
    pub pitch: f64,
    /// Thickness of a wall, m. ≥ 0.
    pub wall_thickness: f64,
    /// Turn made in one time step at the full command, rad. > 0.
    pub turn_per_step: f64,
    /// Distance driven in one time step at the full command, m. > 0.
    pub translate_per_step: f64,
}

impl NoisyMouseConfig {
    /// Returns the configuration for cells `pitch` apart, m, between walls without thickness. The
    /// particle filter trusts wheels and sensors to a few percent
    /// ([`PoseFilterConfig::for_pitch`]), and the commands move it.
    #[must_use]
    pub const fn new(pitch: f64, turn_per_step: f64, translate_per_step: f64) -> Self {
        Self {
            localization: PoseSource::ParticleFilter,
            motion: MotionSource::Commands,
            filter: PoseFilterConfig::for_pitch(pitch),
            pitch,
            wall_thickness: 0.0,
            turn_per_step,
            translate_per_step,
        }
    }
}

/// Source of a mouse's estimate of its pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseSource {
    /// Assumes that its wheels follow the commands exactly.
    DeadReckoning,
    /// Compares its readings with the walls that it knows.
    ParticleFilter,
}

/// Source of a mouse's estimate of its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionSource {
    /// The commands, taken as carried out.
    Commands,
    /// The encoders, and the commands while the encoders give nothing.
    Encoders,
}

/// Reason why a mouse cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NoisyMouseError {
    /// The maze is larger than its map.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The filter's configuration is invalid.
    #[error(transparent)]
    Filter(#[from] OutOfRange),
    /// The search's configuration is invalid.
    #[error(transparent)]
    Search(#[from] MoveExplorerConfigError),
}
