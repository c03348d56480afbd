use nalgebra::Isometry2;
use thiserror::Error;
use tolman_geom::Pose;

use super::Sensor;
use crate::{Chance, Channel, Ray, Surroundings};

/// Response of an infrared proximity sensor to a surface that reflects all light: straight lines
/// between the points of a data sheet, the nearest first. Beyond the first and the last point it is
/// constant.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct ResponseCurve {
    points: Vec<ResponsePoint>,
}

/// One point of a [`ResponseCurve`].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResponsePoint {
    /// The range, m.
    pub range: f64,
    /// The raw value read at that range.
    pub value: f64,
    /// Standard deviation of the value, as a share of it.
    pub relative_sd: f64,
}

impl From<(f64, f64, f64)> for ResponsePoint {
    /// Returns the point of a range, m, a value and its relative standard deviation.
    fn from((range, value, relative_sd): (f64, f64, f64)) -> Self {
        Self {
            range,
            value,
            relative_sd,
        }
    }
}

/// The e-puck's sensors as Webots has them: range (m), value, relative standard deviation.
const EPUCK: [(f64, f64, f64); 10] = [
    (0.000, 4095.0, 0.002),
    (0.005, 2133.0, 0.003),
    (0.010, 1466.0, 0.007),
    (0.015, 601.0, 0.041),
    (0.020, 384.0, 0.015),
    (0.030, 235.0, 0.024),
    (0.040, 158.0, 0.029),
    (0.050, 120.0, 0.042),
    (0.060, 104.0, 0.031),
    (0.070, 67.0, 0.049),
];

impl ResponseCurve {
    /// Returns a curve through these points.
    ///
    /// # Errors
    /// If there are none, their ranges do not grow, or a number is invalid.
    pub fn new(points: Vec<ResponsePoint>) -> Result<Self, ResponseError> {
        let curve = Self { points };
        curve.check()?;
        Ok(curve)
    }

    /// Returns the e-puck's curve by Webots' table: 4095 at contact, 67 at 7 cm and beyond.
    #[must_use]
    pub fn epuck() -> Self {
        Self {
            points: EPUCK.map(ResponsePoint::from).to_vec(),
        }
    }

    /// Returns the curve of CPM's e-puck: the same shape over 25 cm, from 3800 at contact to 0.
    #[must_use]
    pub fn cpm() -> Self {
        let (_, most, _) = EPUCK[0];
        let (reach, least, _) = EPUCK[EPUCK.len() - 1];
        let mut curve = Self::epuck();
        for point in &mut curve.points {
            point.range *= 0.25 / reach;
            point.value = (point.value - least) * 3800.0 / (most - least);
        }
        curve
    }

    /// Checks that the points form a curve.
    ///
    /// # Errors
    /// If it has no points, their ranges do not grow, or a number is invalid.
    pub fn check(&self) -> Result<(), ResponseError> {
        if self.points.is_empty() {
            return Err(ResponseError::NoPoints);
        }
        let mut before = -1.0;
        for (index, point) in self.points.iter().enumerate() {
            let numbers = [
                ("range", point.range),
                ("value", point.value),
                ("relative_sd", point.relative_sd),
            ];
            for (part, value) in numbers {
                if !(0.0..=1e9).contains(&value) {
                    return Err(ResponseError::Number { index, part, value });
                }
            }
            if point.range <= before {
                return Err(ResponseError::Order { index });
            }
            before = point.range;
        }
        Ok(())
    }

    /// Returns the range beyond which the reading is constant, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.range)
    }

    /// Returns the point of the curve at a range, m: the reading and its relative standard
    /// deviation.
    #[must_use]
    pub fn at(&self, range: f64) -> ResponsePoint {
        let above = self.points.partition_point(|point| point.range < range);
        match (above.checked_sub(1), self.points.get(above)) {
            (None, Some(first)) => *first,
            (Some(below), Some(above)) => {
                let below = self.points[below];
                let share = (range - below.range) / (above.range - below.range);
                let between = |low: f64, high: f64| low + share * (high - low);
                let value = between(below.value, above.value);
                ResponsePoint::from((range, value, between(below.relative_sd, above.relative_sd)))
            }
            (Some(last), None) => self.points[last],
            (None, None) => ResponsePoint::from((range, 0.0, 0.0)),
        }
    }
}

/// Reason why points do not make a [`ResponseCurve`].
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// There are none.
    #[error("the curve has no points; give at least one")]
    NoPoints,
    /// A number is invalid.
    #[error("point {index} of the curve: `{part}` is {value}; give a number from 0 to 10⁹")]
    Number {
        /// Number of the point, from 0.
        index: usize,
        /// Name of the number.
        part: &'static str,
        /// The value given.
        value: f64,
    },
    /// A point is not farther than the one before.
    #[error("point {index} of the curve is not farther than the one before; sort them by range")]
    Order {
        /// Number of the point, from 0.
        index: usize,
    },
}

/// Infrared proximity sensors round the body, one ray each. A reading is the raw value of each:
/// larger is nearer.
#[derive(Clone, Debug)]
pub struct Infrared<const N: usize> {
    /// Rays in the robot's frame.
    rays: [Ray; N],
    curve: ResponseCurve,
}

impl<const N: usize> Infrared<N> {
    /// Returns sensors with the poses `mounts` in the robot's frame.
    ///
    /// # Errors
    /// If the curve is invalid.
    pub fn new(mounts: [Pose; N], curve: ResponseCurve) -> Result<Self, ResponseError> {
        curve.check()?;
        let rays = mounts.map(|mount| Ray {
            origin: mount.position,
            direction: mount.heading.unit(),
        });
        Ok(Self { rays, curve })
    }
}

impl<const N: usize> Sensor for Infrared<N> {
    type Reading = [f64; N];

    fn sense(
        &mut self,
        around: &Surroundings<'_>,
        chance: &Chance,
        reading: &mut Option<[f64; N]>,
    ) {
        let world_from_robot = Isometry2::from(around.truth.pose);
        let rays = self.rays.map(|ray| Ray {
            origin: world_from_robot * ray.origin,
            direction: world_from_robot * ray.direction,
        });
        let echoes = around.echoes(&rays, self.curve.reach());
        let dark = self.curve.at(f64::INFINITY).value;
        let most = self.curve.at(0.0).value;
        let mut draws = chance.draws(Channel::named("infrared"));
        *reading = Some(echoes.map(|echo| {
            let ResponsePoint {
                value, relative_sd, ..
            } = self.curve.at(echo.range);
            let value = dark + echo.material.reflectance * (value - dark);
            let noise = if relative_sd > 0.0 {
                value * relative_sd * draws.gaussian()
            } else {
                0.0
            };
            (value + noise).clamp(0.0, most)
        }));
    }
}
