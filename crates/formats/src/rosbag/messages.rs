//! Messages of ROS 2 in the common data representation (CDR): only the fields that are needed.

use byteorder::{BigEndian, LittleEndian};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use tolman_geom::{Point, Pose};
use tolman_robot::{Ring, Scan};

use crate::quaternion;

#[derive(Deserialize)]
pub(super) struct Header {
    pub(super) stamp: Stamp,
    pub(super) frame_id: String,
}

#[derive(Deserialize)]
pub(super) struct Stamp {
    sec: i32,
    nanosec: u32,
}

#[derive(Deserialize)]
pub(super) struct LaserScan {
    pub(super) header: Header,
    angle_min: f32,
    _angle_max: f32,
    angle_increment: f32,
    _time_increment: f32,
    _scan_time: f32,
    range_min: f32,
    range_max: f32,
    ranges: Vec<f32>,
}

/// Odometry; fields after the pose are not read.
#[derive(Deserialize)]
pub(super) struct Odometry {
    pub(super) header: Header,
    pub(super) child_frame_id: String,
    position: [f64; 3],
    orientation: [f64; 4],
}

#[derive(Deserialize)]
pub(super) struct Transforms {
    pub(super) transforms: Vec<Transform>,
}

#[derive(Deserialize)]
pub(super) struct Transform {
    pub(super) header: Header,
    pub(super) child_frame_id: String,
    translation: [f64; 3],
    rotation: [f64; 4],
}

/// Number of bytes before a message that tell its byte order.
const ENCAPSULATION: usize = 4;

/// Reads a message and returns it; bytes after its last field are ignored.
pub(super) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    let (head, body) = bytes
        .split_first_chunk::<ENCAPSULATION>()
        .ok_or("a message of less than four bytes")?;
    let decoded = match head[1] & 1 {
        1 => cdr_encoding::from_bytes::<T, LittleEndian>(body),
        _ => cdr_encoding::from_bytes::<T, BigEndian>(body),
    };
    match decoded {
        Ok((message, _)) => Ok(message),
        Err(error) => Err(error.to_string()),
    }
}

impl Stamp {
    /// Returns the time of the stamp, s.
    pub(super) fn seconds(&self) -> f64 {
        f64::from(self.sec) + 1e-9 * f64::from(self.nanosec)
    }
}

impl LaserScan {
    /// Returns the scan and the number of its invalid ranges, or `None` if its angles are invalid.
    /// Ranges outside those of the laser have hit nothing.
    pub(super) fn scan(&self) -> Option<(Scan, usize)> {
        let (first, spacing, most) = (self.angle_min, self.angle_increment, self.range_max);
        let are_numbers =
            first.is_finite() && spacing.is_finite() && most.is_finite() && most > 0.0;
        if !are_numbers || self.ranges.is_empty() {
            return None;
        }
        let max_range = f64::from(most);
        let seen = self.range_min..=most;
        let length = |range: &f32| match seen.contains(range) {
            true => f64::from(*range),
            false => max_range,
        };
        let ring = Ring {
            beams: u32::try_from(self.ranges.len()).ok()?,
            first_bearing: f64::from(first),
            spacing: f64::from(spacing),
            max_range,
        };
        let bad = self.ranges.iter().filter(|range| range.is_nan()).count();
        let ranges = self.ranges.iter().map(length).collect();
        Some((Scan { ring, ranges }, bad))
    }
}

impl Odometry {
    pub(super) fn pose(&self) -> Pose {
        pose(self.position, self.orientation)
    }
}

impl Transform {
    pub(super) fn pose(&self) -> Pose {
        pose(self.translation, self.rotation)
    }
}

/// Returns the pose on the floor of a pose in space: its position and heading in the plane.
fn pose([x, y, _]: [f64; 3], orientation: [f64; 4]) -> Pose {
    Pose::new(Point::new(x, y), quaternion::heading(orientation))
}
