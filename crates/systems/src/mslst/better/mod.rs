//! A better MSLST, on the same scans, compass and motors, with the encoders that the paper's robot
//! had and did not use.
//!
//! - [`BetterExplorer`] learns: it merges places while its map grows, and goes to the map's gaps
//!   until none is left.
//! - [`BetterMap`] is the learned map made ready. The robot simulates every action from every
//!   standpoint on its own map. So the map knows the cost of each way to the goal for a robot with
//!   errors.
//! - [`BetterMapFile`] keeps the learned map.
//! - [`BetterNavigator`] navigates: it believes in places instead of strings of states, and chooses
//!   the action of least average cost.
//!
//! Its layers see scans [straightened](tolman_control::straightened): with a laser that errs by 2 %
//! Orient turns to and fro.
//!
//! ```
//! use std::sync::Arc;
//!
//! use tolman_control::Stack;
//! use tolman_robot::{
//!     Goal, Landmark, LaserSensing, Odometry, Ring, Robot, SensesLandmarks, Standing, System, Task, TurnTranslate,
//! };
//! use tolman_systems::Actor;
//! use tolman_systems::mslst::better::{BetterConfig, BetterExplorer, BetterMap, BetterNavigator};
//! # use tolman_geom::{Heading, Point, Pose};
//!
//! /// A robot in a blind alley, 4 m long from west to east and 0.95 m wide, whose eastern end is the goal.
//! struct InAlley {
//!     pose: Pose,
//!     sensing: LaserSensing,
//! }
//! # impl InAlley {
//! #     /// To a wall at 0 or at `far`, going `way` along an axis from `at`.
//! #     fn to_wall(at: f64, way: f64, far: f64) -> f64 {
//! #         if way > 0.0 { (far - at) / way } else { -at / way.min(-1e-12) }
//! #     }
//! #     fn sense(&mut self) {
//! #         let Pose { position: at, heading } = self.pose;
//! #         self.sensing.compass = Some(heading);
//! #         let scan = self.sensing.scan.as_mut().unwrap();
//! #         for (beam, range) in (0..).zip(&mut scan.ranges) {
//! #             let way = heading.turned(scan.ring.bearing(beam)).unit();
//! #             let wall = Self::to_wall(at.x, way.x, 4.0).min(Self::to_wall(at.y, way.y, 0.95));
//! #             *range = wall.min(scan.ring.max_range);
//! #         }
//! #     }
//! # }
//! #
//! # impl Robot for InAlley {
//! #     type Command = TurnTranslate;
//! #     type Sensing = LaserSensing;
//! #     type Error = core::convert::Infallible;
//! #
//! #     fn sensing(&self) -> &LaserSensing {
//! #         &self.sensing
//! #     }
//! #
//! #     fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
//! #         let turn = command.turn * 91_f64.to_radians();
//! #         self.pose.heading = self.pose.heading.turned(turn);
//! #         let distance = command.translate;
//! #         let to = self.pose.position + self.pose.heading.unit() * distance;
//! #         self.pose.position = Point::new(to.x.clamp(0.25, 3.75), to.y.clamp(0.25, 0.7));
//! #         self.sensing.odometry = Some(Odometry { distance, turn });
//! #         self.sense();
//! #         Ok(())
//! #     }
//! # }
//! #
//! # impl SensesLandmarks for InAlley {
//! #     fn landmark(&self) -> Option<Landmark> {
//! #         (self.pose.position.x > 3.4).then_some(Landmark::Goal)
//! #     }
//! # }
//!
//! let ring = Ring::full(72, 1.25);
//! let layers = || Stack::paper(ring, 0.5, 0.95);
//! let config = BetterConfig::pioneer();
//! let pose = Pose::new(Point::new(1.5, 0.5), Heading::NORTH);
//! let sensing = LaserSensing::silent(ring);
//! let mut robot = InAlley { pose, sensing };
//! # robot.sense();
//!
//! let mut learning = Actor::seeded(BetterExplorer::new(config), layers()?, 1);
//! while learning.act(&mut robot, Task::Explore)? == Standing::UnderWay {}
//! let learned = learning.into_brain().into_learned();
//! let map = Arc::new(BetterMap::of(learned.chart(), ring, &config)?);
//!
//! // Put down elsewhere, it finds out where it is and goes to the goal.
//! robot.pose.position = Point::new(0.5, 0.4);
//! # robot.sense();
//! let mut navigating = Actor::seeded(BetterNavigator::new(map), layers()?, 1);
//! let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
//! while navigating.act(&mut robot, goal)? == Standing::UnderWay {}
//! assert_eq!(robot.landmark(), Some(Landmark::Goal));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod changed_map;
mod config;
mod costs;
mod explorer;
mod imagined;
mod map;
mod map_file;
mod navigator;
mod reckoning;
mod rehearsal;
mod stop;
mod tries;

pub use config::{BetterConfig, BetterPart, Motors};
pub use explorer::BetterExplorer;
pub use map::BetterMap;
pub use map_file::{BetterMapFile, BetterMapFileError};
pub use navigator::BetterNavigator;
