use tolman_geom::{Point, Vector};

use crate::casters::BeamSweep;
use crate::scene::Scene;
use crate::{Material, Truth, WallSegment, World};

/// Input of sensors: the true state of things round one robot at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    pub(crate) scene: Scene<'a>,
    pub(crate) robot: usize,
    /// Pose of the robot, its motion in this step, and the time.
    pub truth: &'a Truth,
}

/// A half-line in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin of the ray, m.
    pub origin: Point,
    /// Direction: a unit vector.
    pub direction: Vector,
}

/// Answer to a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// Distance of what the ray meets, m; the ray's whole length if it meets nothing.
    pub range: f64,
    /// Material; robots are of the default material.
    pub material: Material,
}

impl Echo {
    /// Adds something at `range`, which counts if it is nearer than all before.
    fn shorten(&mut self, range: f64, material: Material) {
        if range < self.range {
            *self = Self { range, material };
        }
    }
}

/// Distance from a wall within which a point lies on it, m.
const TOUCHING: f64 = 1e-6;

impl<'a> Surroundings<'a> {
    /// Returns the world.
    #[must_use]
    pub fn world(&self) -> &'a World {
        self.scene.world
    }

    /// Returns the range of a ray up to a wall, a shut door or another robot, m; `max_range` if it
    /// meets nothing before. `direction` is a unit vector in the world.
    #[must_use]
    pub fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64 {
        let range = self.world().caster().cast(origin, direction, max_range);
        let doors = self
            .scene
            .shut
            .iter()
            .map(|wall| wall.ray(origin, direction));
        let near = self.scene.bodies.near(self.robot, origin, range);
        let bodies = near.map(|other| other.ray(origin, direction));
        doors.chain(bodies).fold(range, f64::min)
    }

    /// Returns the first thing that each ray meets within `max_range`, m: a wall, a shut door or
    /// another robot.
    #[must_use]
    pub fn echoes<const N: usize>(&self, rays: &[Ray; N], max_range: f64) -> [Echo; N] {
        let caster = self.world().caster();
        let mut echoes = rays.map(|Ray { origin, direction }| {
            let range = caster.cast(origin, direction, max_range);
            let material = self.material(origin + direction * range);
            let mut echo = Echo { range, material };
            for door in self.scene.shut {
                echo.shorten(door.ray(origin, direction), door.material);
            }
            echo
        });
        // All rays begin somewhere on the body, so the robots near by are determined once.
        let here = self.truth.pose.position;
        let spread = rays.iter().map(|ray| (ray.origin - here).norm());
        let reach = max_range + spread.fold(0.0, f64::max);
        let body = Material::default();
        for other in self.scene.bodies.near(self.robot, here, reach) {
            for (ray, echo) in rays.iter().zip(&mut echoes) {
                echo.shorten(other.ray(ray.origin, ray.direction), body);
            }
        }
        echoes
    }

    /// Clears `found` and collects in it all walls, shut doors and outlines of other robots that
    /// come within `reach` m of a point. `found` may hold some others. A disc counts as the regular
    /// polygon of 24 sides round it, which is larger by less than 1 % of its radius.
    pub fn standing_near(&self, centre: Point, reach: f64, found: &mut Vec<WallSegment>) {
        found.clear();
        self.world()
            .index()
            .near(centre, reach, |walls| found.extend_from_slice(walls));
        found.extend_from_slice(self.scene.shut);
        for other in self.scene.bodies.near(self.robot, centre, reach) {
            found.extend(other.outline());
        }
    }

    /// Returns the material of the wall at a point.
    fn material(&self, point: Point) -> Material {
        if let Some(everywhere) = self.world().common_material() {
            return everywhere;
        }
        let mut nearest = (f64::INFINITY, Material::default());
        self.world().index().near(point, TOUCHING, |walls| {
            for wall in walls {
                let distance = wall.distance(point);
                if distance < nearest.0 {
                    nearest = (distance, wall.material);
                }
            }
        });
        nearest.1
    }

    /// Shortens every beam of `sweep` to the wall, shut door or other robot it meets.
    pub fn scan(&self, sweep: &mut BeamSweep) {
        self.world().caster().scan(sweep);
        for wall in self.scene.shut {
            sweep.meet_wall(wall);
        }
        let reach = sweep.ring().max_range;
        for other in self.scene.bodies.near(self.robot, sweep.origin(), reach) {
            other.shorten(sweep);
        }
    }
}
