//! Logs of the Carnegie Mellon Robot Navigation Toolkit (CARMEN), one message per line. These are
//! read:
//!
//! ```text
//! PARAM name value …
//! ODOM x y theta tv rv accel ipc_time host logger_time
//! FLASER n r₁ … rₙ x y theta odom_x odom_y odom_theta ipc_time host logger_time
//! ROBOTLASER1 type start fov spacing max accuracy mode n r₁ … rₙ m e₁ … eₘ laser_x … laser_theta x y theta tv rv front side turn
//!     ipc_time host logger_time
//! RAWLASER1 type start fov spacing max accuracy mode n r₁ … rₙ m e₁ … eₘ ipc_time host logger_time
//! ```
//!
//! Older logs have ROBOTLASER1 without remissions and without `turn`. Other messages are counted
//! and left out.
//!
//! Source: the comments at the head of each log, and CARMEN's `logger.c`. A beam of 80 m or more
//! has hit nothing.

mod messages;
mod parameters;

pub(crate) use messages::{front_laser, odometry, raw_laser, robot_laser};
pub(crate) use parameters::Parameters;
