//! Parses the messages of a log, one per line.

use tolman_geom::Pose;
use tolman_robot::{Ring, Scan};

use super::parameters::{NOTHING_HIT, Parameters};
use crate::fields::{Fields, Wrong};
use crate::log::{LogOdometry, LogScan, LogTrouble, ReadScan};

/// Maximum number of beams; no laser has more.
const MOST_BEAMS: u32 = 100_000;

pub(crate) fn odometry(line: u64, fields: &mut Fields<'_>) -> Result<LogOdometry, Wrong> {
    let pose = fields.pose("the pose")?;
    fields.pass(3, "a velocity")?;
    let time = fields.number("the time")?;
    Ok(LogOdometry { line, time, pose })
}

pub(crate) fn front_laser(
    line: u64,
    fields: &mut Fields<'_>,
    parameters: &Parameters,
) -> Result<ReadScan, Wrong> {
    let ranges = ranges(fields)?;
    let noted = fields.pose("the laser's pose")?;
    let odometry = fields.pose("the odometry")?;
    let time = fields.number("the time")?;
    let ring = parameters.ring(beams(&ranges));
    let robot_from_laser = parameters.robot_from_laser(odometry, noted);
    let scan = LogScan {
        line,
        time,
        odometry,
        noted,
        robot_from_laser,
        scan: Scan {
            ring,
            ranges: Vec::new(),
        },
    };
    Ok(ReadScan::of(scan, &ranges))
}

/// Returns the number of beams: [`MOST_BEAMS`] at most.
fn beams(ranges: &[Option<f64>]) -> u32 {
    u32::try_from(ranges.len()).unwrap_or(u32::MAX)
}

/// Fields behind the ranges of a ROBOTLASER1 of the older age: two poses, four of velocity and
/// safety, the time, the host, the logger's time.
const OLDER_FIELDS: usize = 6 + 4 + 3;

pub(crate) fn robot_laser(line: u64, fields: &mut Fields<'_>) -> Result<ReadScan, Wrong> {
    let (ring, ranges) = head(fields)?;
    let is_newer = fields.left() != OLDER_FIELDS;
    if is_newer {
        let remissions = fields.count("the number of remissions")?;
        fields.pass(remissions.min(MOST_BEAMS), "a remission")?;
    }
    let noted = fields.pose("the laser's pose")?;
    let odometry = fields.pose("the robot's pose")?;
    fields.pass(if is_newer { 5 } else { 4 }, "a velocity")?;
    let time = fields.number("the time")?;
    let scan = LogScan {
        line,
        time,
        odometry,
        noted,
        robot_from_laser: Pose::IDENTITY,
        scan: Scan {
            ring,
            ranges: Vec::new(),
        },
    };
    Ok(ReadScan::of(scan, &ranges))
}

/// Readings of a laser alone. Its pose on the robot is that of the parameters.
pub(crate) fn raw_laser(
    line: u64,
    fields: &mut Fields<'_>,
    parameters: &Parameters,
) -> Result<ReadScan, Wrong> {
    let (ring, ranges) = head(fields)?;
    let remissions = fields.count("the number of remissions")?;
    fields.pass(remissions.min(MOST_BEAMS), "a remission")?;
    let time = fields.number("the time")?;
    let scan = LogScan {
        line,
        time,
        odometry: Pose::IDENTITY,
        noted: Pose::IDENTITY,
        robot_from_laser: parameters.mount(),
        scan: Scan {
            ring,
            ranges: Vec::new(),
        },
    };
    Ok(ReadScan::of(scan, &ranges))
}

/// Reads the geometry of the beams, and their ranges.
fn head(fields: &mut Fields<'_>) -> Result<(Ring, Vec<Option<f64>>), Wrong> {
    fields.pass(1, "the kind of laser")?;
    let first_bearing = fields.number("the first bearing")?;
    fields.pass(1, "the field of view")?;
    let spacing = fields.number("the spacing")?;
    let max_range = fields.number("the greatest range")?;
    fields.pass(2, "the accuracy")?;
    let ranges = ranges(fields)?;
    let ring = Ring {
        beams: beams(&ranges),
        first_bearing,
        spacing,
        max_range: match max_range > 0.0 {
            true => max_range.min(NOTHING_HIT),
            false => NOTHING_HIT,
        },
    };
    Ok((ring, ranges))
}

fn ranges(fields: &mut Fields<'_>) -> Result<Vec<Option<f64>>, Wrong> {
    let beams = fields.count("the number of ranges")?;
    if beams == 0 || beams > MOST_BEAMS {
        return Err((
            LogTrouble::NoNumber,
            format!("it says to have {beams} ranges"),
        ));
    }
    fields.ranges(beams)
}
