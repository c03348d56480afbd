use core::error::Error;
use core::fmt;
use core::marker::PhantomData;

use serde::Serialize;
use serde::de::DeserializeOwned;
use tolman_systems::{Actor, Brain, MapFiles, TimeStep};

use super::{LaserLike, MapText, Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing, Sent, Simulated};

/// The entry of a brain that any robot with a laser can carry: facts are all that it adds. What the
/// brain has learned is written as it is serialized, and read again to drive by.
///
/// Systems whose maps have places to show, or that need other robots, implement [`SystemEntry`]
/// themselves.
pub struct LaserEntry<B> {
    facts: SystemFacts,
    brain: PhantomData<fn() -> B>,
}

impl<B> LaserEntry<B> {
    /// Returns the entry of the brain `B` with these facts.
    #[must_use]
    pub const fn new(facts: SystemFacts) -> Self {
        let brain = PhantomData;
        Self { facts, brain }
    }

    const fn files(&self) -> MapFiles {
        MapFiles {
            system: self.facts.name,
        }
    }
}

impl<B> fmt::Debug for LaserEntry<B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LaserEntry")
            .field("facts", &self.facts)
            .finish_non_exhaustive()
    }
}

impl<B> SystemEntry for LaserEntry<B>
where
    B: Brain<Observation = TimeStep, Error: Error + Send + Sync>,
    B: Default + Serialize + DeserializeOwned + 'static,
{
    fn facts(&self) -> SystemFacts {
        self.facts
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let sent = sent(setup, B::default())?;
        let (files, origin) = (self.files(), setup.origin(sent.course()));
        let keep = move |actor: &Actor<B>, _: &_| Ok(Some(files.write(&origin, actor.brain())?));
        Ok(Box::new(sent.keeping(keep)))
    }

    fn driver(&self, maps: &[MapText], setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let map = maps
            .first()
            .ok_or("it drives by a map, and none is given")?;
        let (_, brain): (_, B) = self.files().read(&map.text)?;
        Ok(Box::new(sent(setup, brain)?))
    }
}

/// Sends out a brain on the laser robot of a setup.
fn sent<B: Brain>(
    setup: &Setup<'_>,
    brain: B,
) -> Result<Sent<Simulated<LaserLike>, Actor<B>>, BoxError> {
    let (course, robot, layers) = setup.laser_robot()?;
    let actor = Actor::seeded(brain, layers, setup.seed);
    let steps = setup.steps.unwrap_or(u32::MAX);
    Ok(Sent::new(course, robot, steps, actor))
}
