use alloc::vec::Vec;

use tolman_geom::Point;

use super::{Profile, RangeCurve};

/// Search for the middle of a junction. The paper does not say how a junction is entered.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked"))]
#[non_exhaustive]
pub struct MeetPointConfig {
    /// Maximum distance of the middle from the robot, m.
    pub reach: f64,
    /// Distance between the positions that are tried, m.
    pub resolution: f64,
}

/// A configuration as it stands in a file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    #[serde(deserialize_with = "crate::read::at_least_zero")]
    reach: f64,
    #[serde(deserialize_with = "crate::read::positive")]
    resolution: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for MeetPointConfig {
    type Error = alloc::string::String;

    /// Checks the number of steps of the search, (reach / resolution)², so that a file cannot ask
    /// for too many.
    fn try_from(unchecked: Unchecked) -> Result<Self, Self::Error> {
        let Unchecked { reach, resolution } = unchecked;
        if reach <= 1000.0 * resolution {
            Ok(Self { reach, resolution })
        } else {
            Err(alloc::format!(
                "`reach` is {reach} m: give at most 1000 times the `resolution` of {resolution} m"
            ))
        }
    }
}

impl MeetPointConfig {
    /// Returns the values for corridors `width` wide, m: up to half of it away, to 5 mm.
    #[must_use]
    pub const fn for_width(width: f64) -> Self {
        Self {
            reach: 0.5 * width,
            resolution: 0.005,
        }
    }
}

impl Profile {
    /// Returns the position with the most room round it, in the robot's frame, m. At a junction it
    /// is as far from one wall or corner as from two others. That is a meet point of the
    /// generalized Voronoi graph (Choset and Nagatani 2001).
    ///
    /// What the sensors cannot see counts as walls, so from afar it is a step towards that point.
    ///
    /// # Complexity
    /// (reach / resolution)² · values.
    #[must_use]
    pub fn meet_point(&self, curve: &RangeCurve, config: &MeetPointConfig) -> Point {
        // Where nothing is met, what lies beyond the reach is as good as a wall.
        let seen: Vec<Point> = self.echoes(curve).map(|(point, _)| point).collect();
        let room = |at: Point| {
            let gaps = seen.iter().map(|point| (point - at).norm_squared());
            gaps.fold(f64::INFINITY, f64::min)
        };
        let steps = libm::floor(config.reach / config.resolution) as i32;
        let mut best = (room(Point::origin()), Point::origin());
        for x in -steps..=steps {
            for y in -steps..=steps {
                let at = Point::new(f64::from(x), f64::from(y)) * config.resolution;
                if at.coords.norm() > config.reach {
                    continue;
                }
                let room = room(at);
                if room > best.0 {
                    best = (room, at);
                }
            }
        }
        best.1
    }
}
