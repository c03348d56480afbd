//! The system of this program on the robot of this program.

use tolman::system::{Setup, SystemEntry, laser_pioneer};
use tolman_arena::{Depicted, Outing, Sent, pioneer::calibrated};
use tolman_sim::trace::Recordable;
use tolman_systems::Actor;

use crate::robot::Tank;
use crate::system::{FILES, Paces};

pub struct TankEntry;

impl SystemEntry for TankEntry {
    fn name(&self) -> &'static str {
        "paces-of-a-tank"
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, anyhow::Error> {
        let (course, pioneer, layers) = laser_pioneer(setup)?;
        let origin = setup.origin(&course, Tank::NAME);
        let tank = Tank::from_config(calibrated())?;
        let tank = course.robot_at(pioneer.truth().pose, tank, setup.seed)?;
        let actor = Actor::seeded(Paces::default(), layers, setup.seed);
        let sent = Sent::new(course, tank, u32::MAX, actor);
        Ok(Box::new(sent.keeping(move |actor, _| {
            Ok(Some(FILES.write(&origin, actor.brain())?))
        })))
    }
}
