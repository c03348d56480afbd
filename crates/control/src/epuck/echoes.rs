use tolman_geom::Point;
use tolman_robot::epuck::{PROXIMITY_SENSORS, proximity_mounts};

use super::RangeCurve;

/// Echoes of the eight proximity sensors in one time step: a point in the robot's frame, m, for
/// each sensor, or nothing within reach.
///
/// The sensors are numbered as [`proximity_mounts`]: 0 and 7 look ahead, 1 and 6 diagonally, 2 and
/// 5 to the side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Echoes {
    points: [Option<Point>; PROXIMITY_SENSORS],
}

impl Echoes {
    /// Returns the echoes behind these raw values.
    #[must_use]
    pub fn of(values: &[f64; PROXIMITY_SENSORS], curve: &RangeCurve) -> Self {
        let mounts = proximity_mounts();
        let point = |sensor: usize| {
            let mount = mounts[sensor];
            let range = curve.range(values[sensor])?;
            Some(mount.position + mount.heading.unit() * range)
        };
        Self {
            points: core::array::from_fn(point),
        }
    }

    /// Returns the point that one sensor meets, in the robot's frame, m.
    #[must_use]
    pub fn of_sensor(&self, sensor: usize) -> Option<Point> {
        self.points.get(sensor).copied().flatten()
    }

    /// Returns the points that the sensors meet, in the robot's frame, m.
    pub fn iter(&self) -> impl Iterator<Item = Point> + '_ {
        self.points.iter().copied().flatten()
    }

    /// Returns the free distance straight ahead of the robot's middle, m, or `None` if neither
    /// sensor that looks ahead meets anything.
    #[must_use]
    pub fn ahead(&self) -> Option<f64> {
        let ahead = [0, 7]
            .into_iter()
            .filter_map(|sensor| self.of_sensor(sensor));
        ahead.map(|point| point.x).min_by(f64::total_cmp)
    }
}
