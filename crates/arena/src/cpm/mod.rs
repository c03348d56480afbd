//! CPM: "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path Planning" (Kawewong, Honda, Tsuboyama,
//! Hasegawa 2010), on an e-puck.
//!
//! In the order of the paper: a [`Body`] is the robot, with [`Landmark`](tolman_maps::cpm::Landmark)s; a [`Walker`] its layers 0 and 1 and its
//! observations (sections 3.2 and 4.1); [`CommonPatterns`] the dictionary it learns in the learning maze (section 4.1); [`Cpm`] layer 3, which maps,
//! reasons and plans on `tolman_maps::cpm` (sections 4.2, 4.3 and 6). A [`Trial`] plays both episodes in the maze of a [`Venue`] and scores them by its
//! [`TrueFragments`]. An [`Errand`] is one episode, of which a [`MapFile`] can be kept; a [`Layout`] says where the parts of a map lie.
//! An [`Exploration`] is a maze walked to its end. [`find_out`] is how a robot that was put down somewhere learns where it is, [`PutDown`] a trial of it; a
//! [`RoundTrip`] is the way to the goal, back by untried fragments, and there again.
//!
//! # On a real robot
//!
//! Layers, dictionary and map are written against [`Body`], which any e-puck is that is [`Landmarked`]: so is that behind the serial driver of
//! `tolman-robot` (feature `epuck-serial`). What to measure first: the response curve of its sensors, from which `walker_config` makes ranges; a
//! time step in which four lines and their answers have room, which says how fast it sweeps as well. The thresholds of
//! [`SegmentConfig`](tolman_control::epuck::SegmentConfig) are values of sensors that see 25 cm, as the paper's simulated ones; those of other
//! sensors, and corridors as wide as they see, are to be found out. All this was tried on a simulated firmware, never on a robot.
//!
//! ```no_run
//! use std::fs::File;
//! use std::thread::sleep;
//! use std::time::{Duration, Instant};
//!
//! use rand::SeedableRng;
//! use rand_chacha::ChaCha8Rng;
//! use tolman_arena::cpm::{
//!     CommonPatterns, Cpm, Landmarked, Lesson, Walker, slow_epuck, soinn, walker_config, wander,
//! };
//! use tolman_control::epuck::TURN_STEP;
//! use tolman_maps::cpm::{Aim, CpmConfig, Landmark};
//! use tolman_robot::epuck_serial::SerialEpuck;
//!
//! # fn goal_is_seen() -> bool { false }
//! // Paired and bound to a device file, with a time-out: `stty -F /dev/rfcomm0 115200 raw -echo min 0 time 10`.
//! let port = File::options().read(true).write(true).open("/dev/rfcomm0")?;
//! let described = slow_epuck(); // with the `response` and the `step_us` of this robot
//! let mut config = walker_config(&described, 0.25)?;
//! config.pilot.turn_tolerance = TURN_STEP;
//!
//! // A step ends so long after the one before.
//! let mut passed = Instant::now();
//! let wait = |step: Duration| {
//!     sleep((passed + step).saturating_duration_since(Instant::now()));
//!     passed = Instant::now();
//! };
//! let robot = SerialEpuck::open(port, described.step_us, wait)?;
//! let body = Landmarked::new(robot, |_| goal_is_seen().then_some(Landmark::Goal));
//! let mut walker = Walker::new(body, config);
//!
//! // In the learning maze; then somebody carries it to the start of another.
//! let mut rng = ChaCha8Rng::seed_from_u64(1);
//! let patterns = CommonPatterns::learn(&wander(&mut walker, Lesson::Observations(1000), &mut rng)?, soinn())?;
//! let mut agent = Cpm::begin(walker, &patterns, CpmConfig::online())?;
//! let episode = agent.pursue(Aim::Find(Landmark::Goal), &mut rng, |_, _| {})?;
//! println!("{:?} after {:.0} s", episode.done, episode.seconds);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(test)]
mod adversity;
mod agent;
mod bends;
mod body;
mod common_patterns;
mod distinctness;
mod errand;
mod exploration;
mod fragments;
mod known_map;
mod layout;
mod map_file;
mod map_right;
mod put_down;
mod robot;
mod round_trip;
mod score;
mod spots;
mod survey;
mod trial;
mod venue;
mod walker;
mod whereabouts;
#[cfg(test)]
mod wire;

pub use agent::{AgentError, Cpm, Episode, Step};
pub use bends::Likeness;
pub use body::{Body, Landmarked, Reckoned, SimulatedEpuck};
pub use common_patterns::{CommonPatterns, LearnError, Lesson, wander};
pub use distinctness::{Distinctness, Pair, distinctness};
pub use errand::{DriveFrom, Errand, Learned, Progress};
pub use exploration::Exploration;
pub use fragments::{TrueFragments, Way};
pub use layout::{Course, Fit, Layout, OpenPort};
pub use map_file::{MapFile, MapFileError, System};
pub use put_down::{KnownMaze, PutDown, PutDownRecord};
pub use robot::{epuck, idealized_epuck, slow_epuck, soinn, walker_config};
pub use round_trip::RoundTrip;
pub use score::Closures;
pub use survey::{Surveyed, survey};
pub use trial::placed;
pub use trial::{Mode, Record, Trial, TrialError, learn, learn_by};
pub use venue::Venue;
pub use walker::{
    BeforePlace, HeadingBy, Observation, Prospect, Walk, WalkError, Walker, WalkerConfig,
};
pub use whereabouts::{Approach, Whereabouts, WhereaboutsError, find_out};
