use tolman_geom::{Point, Pose, Vector};

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
        let walls = self.scene.world.walls().iter().chain(self.scene.shut);
        let walls = walls.map(|wall| wall.ray(origin, direction));
        let bodies = self
            .scene
            .others(self.robot)
            .map(|other| other.ray(origin, direction));
        walls.chain(bodies).fold(max_range, f64::min)
    }
}
