//! Points, headings, poses and twists, and bounds on them: the geometry every tolman crate speaks.
//!
//! Metres, radians, seconds; angles grow counter-clockwise; in a robot's own frame x is ahead and
//! y is left. In a world frame x is east and y is north, so a heading of 0 looks east.
//!
//! Points and vectors are [nalgebra]'s. A [`Pose`] is a position and a [`Heading`]. It is also the
//! transform from coordinates of its own frame to those of the frame it is given in. So poses are
//! named `world_from_robot` where both frames matter. A [`Twist`] is a velocity, and
//! [`Pose::moved`] follows one along its exact arc.
//!
//! Values known only within bounds have types of their own: an [`Interval`] for a number, a
//! [`PointBox`] for a position, a [`PoseBox`] for a pose. Computations with them round outwards, so
//! that the true value stays inside.
//!
//! An [`OutOfRange`] says which number of a configuration is out of its range.
//!
//! All other trigonometry goes through [`libm`], so the same numbers come out on every platform.
//!
//! ```
//! use tolman_geom::{Heading, Point, Pose, Twist};
//!
//! let world_from_robot = Pose::new(Point::new(1.0, 2.0), Heading::from_degrees(90.0));
//! // One metre ahead of a robot that looks north is one metre further north.
//! let ahead = world_from_robot.transform(Point::new(1.0, 0.0));
//! assert!((ahead - Point::new(1.0, 3.0)).norm() < 1e-12);
//!
//! // A quarter circle of radius 1 m to the left, driven in one second.
//! let quarter = Twist::new(core::f64::consts::FRAC_PI_2, core::f64::consts::FRAC_PI_2);
//! let arrived = Pose::IDENTITY.moved(quarter, 1.0);
//! assert!((arrived.position - Point::new(1.0, 1.0)).norm() < 1e-12);
//! ```
//!
//! # Bounds that grow and shrink
//!
//! `cargo run --example bounds`:
#![doc = "```"]
#![doc = include_str!("../examples/bounds.rs")]
#![doc = "```"]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

// What the signatures need, whole: see docs/architecture.md, API boundaries.
pub use nalgebra;

mod floor;
mod heading;
mod interval;
mod out_of_range;
mod point_box;
mod pose;
mod pose_box;
mod segment;
mod twist;

pub use floor::floor_index;
pub use heading::Heading;
pub use interval::{Interval, IntervalError};
pub use out_of_range::{OutOfRange, POSITIVE};
pub use point_box::PointBox;
pub use pose::{Pose, path_length};
pub use pose_box::PoseBox;
pub use segment::nearest_on_segment;
pub use twist::Twist;

/// A position in the plane, in metres.
pub type Point = nalgebra::Point2<f64>;

/// A displacement or direction in the plane, in metres.
pub type Vector = nalgebra::Vector2<f64>;
