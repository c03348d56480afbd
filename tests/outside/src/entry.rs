//! The entry of the system: how it is put on any laser robot, and its map's file.

use tolman::registry::{DrivesBy, MapText, Setup, SystemEntry, SystemFacts};
use tolman_arena::{BoxError, Outing, Sent};
use tolman_systems::{Actor, MapFiles};

use crate::system::Paces;

pub struct PacesEntry;

pub const FILES: MapFiles = MapFiles { system: "paces" };

impl SystemEntry for PacesEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            drives: DrivesBy::AnyMap,
            // Its map has paces, and no places.
            claims: false,
            ..SystemFacts::new(FILES.system)
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let (course, robot, layers) = setup.laser_robot()?;
        let origin = setup.origin(&course);
        let actor = Actor::seeded(Paces::default(), layers, setup.seed);
        let sent = Sent::new(course, robot, setup.steps.unwrap_or(u32::MAX), actor);
        let keep =
            move |actor: &Actor<Paces>, _: &_| Ok(Some(FILES.write(&origin, actor.brain())?));
        Ok(Box::new(sent.keeping(keep)))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let (_, paces): (_, Paces) = FILES.read(&maps[0].text)?;
        let (course, robot, layers) = setup.laser_robot()?;
        let actor = Actor::seeded(paces, layers, setup.seed);
        Ok(Box::new(Sent::new(course, robot, u32::MAX, actor)))
    }
}
