//! Logs of Wean Hall at Carnegie Mellon University, lengths in cm:
//!
//! ```text
//! O x y theta time
//! L x y theta laser_x laser_y laser_theta r₁ … r₁₈₀ time
//! ```
//!
//! The robot's pose is that of its wheels. The beams lie 1° apart, from −90°.

use tolman_geom::{Point, Pose};
use tolman_robot::Scan;

use crate::carmen::Parameters;
use crate::fields::{Fields, Wrong};
use crate::log::{LogOdometry, LogScan, ReadScan};

/// Number of beams of a scan.
const BEAMS: u32 = 180;
/// Length of a centimetre, m.
const CENTIMETRE: f64 = 0.01;

pub(crate) fn odometry(line: u64, fields: &mut Fields<'_>) -> Result<LogOdometry, Wrong> {
    let pose = in_metres(fields.pose("the pose")?);
    let time = fields.number("the time")?;
    Ok(LogOdometry { line, time, pose })
}

pub(crate) fn laser(
    line: u64,
    fields: &mut Fields<'_>,
    parameters: &Parameters,
) -> Result<ReadScan, Wrong> {
    let odometry = in_metres(fields.pose("the pose")?);
    let noted = in_metres(fields.pose("the laser's pose")?);
    let in_cm = fields.ranges(BEAMS)?.into_iter();
    let ranges: Vec<Option<f64>> = in_cm.map(|range| Some(CENTIMETRE * range?)).collect();
    let time = fields.number("the time")?;
    let scan = LogScan {
        line,
        time,
        odometry,
        noted,
        robot_from_laser: Pose::IDENTITY,
        scan: Scan {
            ring: parameters.ring(BEAMS),
            ranges: Vec::new(),
        },
    };
    Ok(ReadScan::of(scan, &ranges))
}

fn in_metres(pose: Pose) -> Pose {
    let Point { coords } = pose.position;
    Pose::new(Point::from(CENTIMETRE * coords), pose.heading)
}
