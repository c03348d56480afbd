use tolman_geom::{Point, Vector};

use super::Material;
use crate::casters::Seen;

/// A straight wall without thickness: a closed segment, which contains its ends.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallSegment {
    /// One end, m.
    pub start: Point,
    /// The other end, m.
    pub end: Point,
    /// Material of the wall.
    #[serde(default)]
    pub material: Material,
}

impl WallSegment {
    /// Returns a wall of the default material.
    #[must_use]
    pub fn between(start: Point, end: Point) -> Self {
        Self {
            start,
            end,
            material: Material::default(),
        }
    }

    /// Returns the distance from `point`, m.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        (point - self.nearest(point)).norm()
    }

    /// Returns the point of the wall nearest to `point`.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Point {
        let along = self.end - self.start;
        let share = (point - self.start).dot(&along) / along.norm_squared();
        if share <= 0.0 {
            self.start
        } else if share >= 1.0 {
            self.end
        } else {
            self.start + along * share
        }
    }

    /// Returns the range of a ray up to the wall, m; infinity if it does not meet the wall.
    /// `direction` is a unit vector.
    ///
    /// Two walls that share an end leave no gap. The side of the ray on which an end lies is
    /// computed from that end alone, so both walls agree.
    #[must_use]
    pub fn ray(&self, origin: Point, direction: Vector) -> f64 {
        let (start, end) = (self.start - origin, self.end - origin);
        let range = Seen::new(start, end).range(direction.x, direction.y);
        if range < f64::INFINITY {
            return range;
        }
        if !(direction.perp(&start).abs() > 0.0 || direction.perp(&end).abs() > 0.0) {
            // The ray runs along the wall.
            let (start, end) = (direction.dot(&start), direction.dot(&end));
            let nearest = if start * end < 0.0 {
                0.0
            } else {
                start.min(end)
            };
            return if nearest >= 0.0 {
                nearest
            } else {
                f64::INFINITY
            };
        }
        f64::INFINITY
    }

    /// Checks that the wall is valid. The error is a predicate, such as "has no length".
    pub(super) fn check(&self) -> Result<(), &'static str> {
        let numbers = [
            self.start.x,
            self.start.y,
            self.end.x,
            self.end.y,
            self.material.reflectance,
            self.material.base,
            self.material.height,
            self.material.glow,
        ];
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err("has a number that is not finite");
        }
        if numbers[..4].iter().any(|number| number.abs() > 1e6) {
            return Err("lies more than 1000 km away");
        }
        if (self.end - self.start).norm() < 1e-9 {
            return Err("has no length");
        }
        Ok(())
    }
}
