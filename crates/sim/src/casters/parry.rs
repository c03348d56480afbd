//! The only module that uses parry2d's types.

use parry2d_f64::math::{Pose as Isometry, Vec2};
use parry2d_f64::query::{Ray, RayCast};
use parry2d_f64::shape::Polyline;
use tolman_geom::{Point, Vector};

use super::Caster;
use crate::WallSegment;

/// parry2d's polyline: a bounding volume hierarchy over all walls. The reference.
#[derive(Clone, Debug)]
pub struct ParryPolyline {
    polyline: Polyline,
}

impl ParryPolyline {
    /// Returns the polyline of `walls`.
    #[must_use]
    pub fn new(walls: &[WallSegment]) -> Self {
        let ends = walls
            .iter()
            .flat_map(|wall| [vec2(wall.start.coords), vec2(wall.end.coords)]);
        let pairs = (0..walls.len() as u32).map(|wall| [2 * wall, 2 * wall + 1]);
        Self {
            polyline: Polyline::new(ends.collect(), Some(pairs.collect())),
        }
    }
}

impl Caster for ParryPolyline {
    fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64 {
        let ray = Ray::new(vec2(origin.coords), vec2(direction));
        self.polyline
            .cast_ray(&Isometry::IDENTITY, &ray, max_range, true)
            .unwrap_or(max_range)
    }
}

fn vec2(vector: Vector) -> Vec2 {
    Vec2::new(vector.x, vector.y)
}
