use tolman_geom::{Point, Pose, Vector};

use crate::casters::Sweep;
use crate::scene::Scene;
use crate::{Motion, World};

/// What a sensor can be sensitive to: the true state of things round one robot at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    pub(crate) scene: Scene<'a>,
    pub(crate) robot: usize,
    /// Where the robot is.
    pub pose: Pose,
    /// How it moved in this step.
    pub motion: Motion,
    /// Whether that motion was cut by a contact.
    pub bump: bool,
    /// Steps since the run began.
    pub tick: u64,
    /// Microseconds since the run began.
    pub time_us: u64,
}

impl<'a> Surroundings<'a> {
    /// The world.
    #[must_use]
    pub fn world(&self) -> &'a World {
        self.scene.world
    }

    /// How far a ray goes before it meets a wall, a shut door or another robot, m; `max_range` if it
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

    /// Shortens every beam of `sweep` to the wall, shut door or other robot it meets.
    pub fn scan(&self, sweep: &mut Sweep) {
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
