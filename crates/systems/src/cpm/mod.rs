//! CPM: "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path
//! Planning" (Kawewong, Honda, Tsuboyama, Hasegawa 2010).
//!
//! In the order of the paper:
//!
//! - A [`CpmRobot`] senses landmarks. A [`Walker`] is its layers 0 and 1 and its observations
//!   (sections 3.2 and 4.1).
//! - [`CommonPatterns`] are the dictionary it learns in the learning maze (section 4.1).
//! - [`Layer3`] maps, reasons and plans on `tolman_maps::cpm` (sections 4.2, 4.3 and 6), as its
//!   [`Explorer`] decides, and plays the paper's episodes. A [`MapFile`] keeps a map.
//! - A [`Relocalization`] finds the place of a robot that was put down anywhere (section 8).
//! - [`Cpm`] is all this as a system that is lent a robot for one fragment at a time.
//!
//! A robot with a laser ring looks like an e-puck behind [`RingAsEpuck`].
//!
//! # On a real robot
//!
//! Any [`Landmarked`](tolman_robot::Landmarked) e-puck works, also behind the serial driver of
//! `tolman-robot` (feature `epuck-serial`). Measure two things first: the response curve of its
//! sensors, and a time step long enough for four lines and their answers. The time step also sets
//! the speed of a sweep. The thresholds of [`SegmentConfig`](tolman_control::epuck::SegmentConfig)
//! are for sensors that see 25 cm, like the paper's simulated ones. Other sensors, and corridors as
//! wide as they see, need other thresholds. All this was tried on a simulated firmware, never on a
//! robot.
//!
//! ```no_run
//! use std::fs::File;
//! use std::thread::sleep;
//! use std::time::{Duration, Instant};
//!
//! use rand::SeedableRng;
//! use rand_chacha::ChaCha8Rng;
//! use tolman_control::epuck::{RangeCurve, TURN_STEP};
//! use tolman_robot::epuck::MOST_WHEEL_SPEED;
//! use tolman_robot::epuck_serial::SerialEpuck;
//! use tolman_robot::{Goal, Landmark, Landmarked, Standing, System, Task};
//! use tolman_systems::cpm::{
//!     CommonPatterns, Cpm, CpmConfig, Lesson, Walker, WalkerConfig, soinn, wander,
//! };
//!
//! # fn goal_is_seen() -> bool { false }
//! // Paired and bound to a device file, with a time-out: `stty -F /dev/rfcomm0 115200 raw -echo min 0 time 10`.
//! let port = File::options().read(true).write(true).open("/dev/rfcomm0")?;
//! // With as many points as were measured.
//! let curve = RangeCurve::new(vec![(0.0, 3800.0), (0.25, 0.0)])?;
//! let step_us = 33_333;
//! let mut config = WalkerConfig::paper(curve, step_us, 0.25);
//! config.pilot.turn_tolerance = TURN_STEP;
//!
//! // A step ends so long after the one before.
//! let mut passed = Instant::now();
//! let wait = |step: Duration| {
//!     sleep((passed + step).saturating_duration_since(Instant::now()));
//!     passed = Instant::now();
//! };
//! let robot = SerialEpuck::open(port, step_us, wait)?;
//! let mut robot = Landmarked::new(robot, |_| goal_is_seen().then_some(Landmark::Goal));
//!
//! // In the learning maze; then somebody carries it to the start of another.
//! let mut rng = ChaCha8Rng::seed_from_u64(1);
//! let mut walker = Walker::new(&mut robot, config.clone());
//! let seen = wander(&mut walker, Lesson::Observations(1000), &mut rng)?;
//! let patterns = CommonPatterns::learn(&seen, soinn())?;
//! let mut cpm = Cpm::new(config, patterns, CpmConfig::online(), 1);
//! let find = Task::Reach(Goal::Landmark(Landmark::Goal));
//! while cpm.act(&mut robot, find)? == Standing::UnderWay {}
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod calibration;
mod common_patterns;
mod config;
mod decision;
mod episode;
mod explorer;
mod failure;
mod layer3;
mod map_file;
mod mode;
mod of_sites;
mod reckoned;
mod relocalization;
mod ring_as_epuck;
mod robot;
mod system;
mod trail;
mod walker;
mod walker_config;
mod whereabouts;

pub use common_patterns::{CommonPatterns, LearnPatternsError, Lesson, soinn, wander};
pub use config::{CpmConfig, Onward};
pub use decision::{Aim, Done, Leg};
pub use episode::{Begun, EpisodeSummary};
pub use explorer::Explorer;
pub use failure::{CpmFailure, CpmResult};
pub use layer3::{CpmObservation, FragmentStep, Layer3, Walked};
pub use map_file::{MapFile, MapFileError};
pub use mode::Mode;
pub use of_sites::CpmOfSites;
pub use relocalization::Relocalization;
pub use ring_as_epuck::{RingAsEpuck, RingMeasures, UnfitRing};
pub use robot::CpmRobot;
pub use system::{Cpm, CpmObserveError, view};
pub use walker::{
    BeforePlace, Observation, Prospect, RestingWalker, Walk, WalkError, WalkResult, Walker,
};
pub use walker_config::{HeadingBy, WalkerConfig};
pub use whereabouts::{Approach, Whereabouts};
