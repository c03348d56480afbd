use alloc::vec::Vec;
use core::f64::consts::TAU;

use thiserror::Error;
use tolman_geom::{Heading, Point};
use tolman_robot::epuck::{PROXIMITY_SENSORS, proximity_mounts};

use super::{RangeCurve, Sweep};

/// Surroundings of the robot: one value for each bearing, the mean over all sensors of a [`Sweep`];
/// larger is nearer.
///
/// Value *k* of *n* belongs to the bearing *k* · 360°/*n*, counter-clockwise from ahead. The last
/// is the neighbour of the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    values: Vec<f64>,
}

/// Whether a bearing of the profile meets a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Met {
    /// A wall stands within reach.
    Wall,
    /// Nothing within reach.
    Nothing,
}

/// Method by which the eight vectors of a sweep become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum SensorAlignment {
    /// Each sensor's vector is turned by the angle it is mounted at first, so that one bearing is
    /// averaged with itself.
    #[default]
    Mounts,
    /// Sample by sample, as in the paper ("these vectors are reduced to one single vector by
    /// averaging"), which mixes eight bearings.
    Literal,
}

impl Profile {
    /// Averages a sweep. A sensor's missing samples are left out.
    ///
    /// # Errors
    /// If the sweep has no samples, a value is not finite, or a bearing was seen by no sensor.
    pub fn of(sweep: &Sweep, alignment: SensorAlignment) -> Result<Self, ProfileError> {
        let samples = &sweep.samples;
        if samples.is_empty() {
            return Err(ProfileError::Empty);
        }
        let count = samples.len();
        let mut sums = alloc::vec![(0.0, 0.0); count];
        let shifts = proximity_mounts().map(|mount| match alignment {
            SensorAlignment::Mounts => mount.heading.radians() / TAU * count as f64,
            SensorAlignment::Literal => 0.0,
        });
        for (index, sample) in samples.iter().enumerate() {
            let Some(values) = sample else { continue };
            for sensor in 0..PROXIMITY_SENSORS {
                let value = values[sensor];
                if !value.is_finite() {
                    return Err(ProfileError::NotFinite { sensor, index });
                }
                // A sample counts for the two bearings beside its own; the nearer one counts more.
                let bearing = (index as f64 + shifts[sensor] + count as f64) % count as f64;
                let (below, share) = (libm::floor(bearing), bearing - libm::floor(bearing));
                for (at, weight) in [(below, 1.0 - share), (below + 1.0, share)] {
                    let (sum, weights) = &mut sums[at as usize % count];
                    *sum += weight * value;
                    *weights += weight;
                }
            }
        }
        let mut values = Vec::with_capacity(count);
        for (index, (sum, weights)) in sums.into_iter().enumerate() {
            if weights <= 0.0 {
                return Err(ProfileError::Blind { index });
            }
            values.push(sum / weights);
        }
        Ok(Self { values })
    }

    /// Returns a profile of these values, from ahead counter-clockwise.
    ///
    /// # Errors
    /// If there are none or one is not finite.
    pub fn from_values(values: Vec<f64>) -> Result<Self, ProfileError> {
        if values.is_empty() {
            return Err(ProfileError::Empty);
        }
        match values.iter().position(|value| !value.is_finite()) {
            Some(index) => Err(ProfileError::NotFinite { sensor: 0, index }),
            None => Ok(Self { values }),
        }
    }

    /// Returns the values, from ahead counter-clockwise.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the profile of a robot that looks the other way.
    #[must_use]
    pub fn half_turned(&self) -> Self {
        let mut values = self.values.clone();
        values.rotate_left(self.values.len() / 2);
        Self { values }
    }

    /// Returns the point that each bearing's reading stands for, in the robot's frame, m. Where
    /// nothing is met, it is the farthest point in reach.
    pub(super) fn echoes(&self, curve: &RangeCurve) -> impl Iterator<Item = (Point, Met)> + '_ {
        // The sensors sit on a circle.
        let mounts = proximity_mounts();
        let rim = mounts
            .iter()
            .map(|mount| mount.position.coords.norm())
            .sum::<f64>()
            / PROXIMITY_SENSORS as f64;
        let curve = curve.clone();
        (0_u32..).zip(&self.values).map(move |(index, value)| {
            let range = curve.range(*value);
            let bearing = Heading::from_radians(self.bearing(f64::from(index)));
            let reach = rim + range.unwrap_or(curve.reach());
            let met = if range.is_some() {
                Met::Wall
            } else {
                Met::Nothing
            };
            (Point::origin() + bearing.unit() * reach, met)
        })
    }

    /// Returns the angle between the walls and the robot's axes, rad, from -π/4 to π/4. Walls must
    /// stand at right angles to each other. In mazes of cells this is a heading without drift. None
    /// if too few walls are near.
    #[must_use]
    pub fn askew(&self, curve: &RangeCurve) -> Option<f64> {
        let points: Vec<(Point, Met)> = self.echoes(curve).collect();
        let (mut sine, mut cosine, mut weight) = (0.0, 0.0, 0.0);
        for (index, (here, met)) in points.iter().enumerate() {
            let (next, next_met) = points[(index + 3) % points.len()];
            let along = next - here;
            // Beyond a corner, or far away, where a range says little.
            let is_wall = *met == Met::Wall && next_met == Met::Wall && along.norm() < 0.06;
            if is_wall && here.coords.norm() < 0.2 {
                let (sin, cos) = libm::sincos(4.0 * libm::atan2(along.y, along.x));
                (sine, cosine, weight) = (sine + sin, cosine + cos, weight + 1.0);
            }
        }
        let agreement = libm::hypot(sine, cosine);
        (weight >= 10.0 && agreement > 0.6 * weight).then(|| libm::atan2(sine, cosine) / 4.0)
    }

    /// Returns the bearing of the value at a fractional index, rad, from -π to π.
    #[must_use]
    pub fn bearing(&self, index: f64) -> f64 {
        let turns = index / self.values.len() as f64;
        (turns - libm::round(turns)) * TAU
    }
}

/// Reason why a sweep cannot become a [`Profile`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The sweep has no samples.
    #[error("the sweep has no samples; sweep first")]
    Empty,
    /// A value is invalid.
    #[error("sample {index} of sensor {sensor} is not finite; give finite values")]
    NotFinite {
        /// Number of the sensor.
        sensor: usize,
        /// Number of the sample, from 0.
        index: usize,
    },
    /// No sensor looked towards one of the bearings of the sweep.
    #[error("no sensor gave a value for bearing {index} of the sweep; check the proximity sensors")]
    Blind {
        /// Number of the bearing, from 0.
        index: usize,
    },
}
