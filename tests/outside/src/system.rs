//! A system: it wanders, and its map is its paces, one for each action that was completed.

use tolman::system::{Setup, SystemEntry, laser_pioneer};
use tolman_arena::{Outing, Sent};
use tolman_systems::baselines::AvoidBrain;
use tolman_systems::robot::{Mapper, Standing, Task};
use tolman_systems::{Actor, Brain, Doing, MapFiles, TimeStep};
use tolman_systems::{control::Outcome, maze::Direction, rand::Rng};

#[derive(Debug, Default, serde::Serialize)]
pub struct Paces {
    path: Vec<(i8, i8)>,
    #[serde(skip)]
    wander: AvoidBrain,
}

impl Mapper for Paces {
    type Observation = TimeStep;
    type Error = std::convert::Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Self::Error> {
        if let Doing::Ended(action, Outcome::Completed) = seen.doing {
            self.path.push(action.step());
        }
        self.wander.observe(seen)
    }
}

impl Brain for Paces {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.wander.choose(rng)
    }

    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Explore if self.path.len() >= 200 => Standing::Done,
            _ => Standing::UnderWay,
        }
    }
}

pub struct PacesEntry;

pub const FILES: MapFiles = MapFiles { system: "paces" };

impl SystemEntry for PacesEntry {
    fn name(&self) -> &'static str {
        FILES.system
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, anyhow::Error> {
        let (course, robot, layers) = laser_pioneer(setup)?;
        let origin = setup.origin(&course, "laser Pioneer");
        let actor = Actor::seeded(Paces::default(), layers, setup.seed);
        let sent = Sent::new(course, robot, u32::MAX, actor);
        let keep =
            move |actor: &Actor<Paces>, _: &_| Ok(Some(FILES.write(&origin, actor.brain())?));
        Ok(Box::new(sent.keeping(keep)))
    }
}
