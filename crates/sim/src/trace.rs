//! Traces: what happened in a run, written as JSON lines and replayed to the bit.
//!
//! The first line holds the world, the seed and the robots. Then follows one line per tick and
//! robot with its command, pose, bump and, if chosen, its readings. Every robot that was lifted and
//! every door that was moved from outside also has a line. [`replay`] simulates the commands again
//! and compares every number; a [`Reader`] only reads.
//!
//! A [`Disturbance`](crate::noise::Disturbance) is code, which no file can hold. The trace of a
//! robot that has one names it in the first line; [`replay`] then refuses, and [`replay_with`] asks
//! for the robot.
//!
//! ```
//! use tolman_geom::{Heading, Point, Pose};
//! use tolman_robot::TurnTranslate;
//! use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
//! use tolman_sim::trace::{Detail, Recording, replay};
//! use tolman_sim::{WallSegment, World};
//!
//! let wall = WallSegment::between(Point::new(3.0, -2.0), Point::new(3.0, 2.0));
//! let world = World::from_segments(vec![wall])?;
//! let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?;
//! let start = Pose::new(Point::origin(), Heading::EAST);
//!
//! let mut file = Vec::new();
//! let mut recording = Recording::start(world, 7, vec![(robot, start)], &mut file, Detail::Sensing)?;
//! for _ in 0..10 {
//!     recording.step(&[TurnTranslate { turn: 0.1, translate: 0.5 }])?;
//! }
//! recording.finish()?;
//! assert_eq!(replay::<LaserPioneer>(file.as_slice())?.tick(), 10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod lines;
mod reader;
mod recording;
mod replay;

use core::error::Error;
use core::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use error::{RecordError, ReplayError};
pub use lines::{StepRecord, TraceLine};
pub use reader::Reader;
pub use recording::{Detail, Recording};
pub use replay::{replay, replay_with};

use crate::Model;

/// A model that can be written to a trace and built again.
pub trait Recordable:
    Model<Command: Serialize + DeserializeOwned, Sensing: Clone + Serialize + DeserializeOwned>
{
    /// Configuration: everything needed to build a robot of this kind.
    type Config: Clone + Debug + Serialize + DeserializeOwned;
    /// Reason why a robot of this kind cannot be built.
    type ConfigError: Error + Send + Sync + 'static;

    /// Returns the robot's configuration.
    fn config(&self) -> &Self::Config;

    /// Builds the model.
    ///
    /// # Errors
    /// If the configuration is invalid.
    fn from_config(config: Self::Config) -> Result<Self, Self::ConfigError>
    where
        Self: Sized;

    /// Returns the disturbances that come from outside the configuration, each as a text that tells
    /// it from others; see [`Disturbance`](crate::noise::Disturbance). A trace keeps the texts,
    /// since it cannot keep the code.
    fn disturbances(&self) -> Vec<String> {
        Vec::new()
    }
}
