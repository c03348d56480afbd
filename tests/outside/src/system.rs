//! A system: it wanders, and its map is its paces, one for each action that was completed.

use tolman::registry::{DrivesBy, LaserEntry, SystemFacts};
use tolman_systems::baselines::AvoidBrain;
use tolman_systems::robot::{Mapper, Standing, Task};
use tolman_systems::{Brain, Doing, TimeStep};
use tolman_systems::{control::Outcome, maze::Direction, rand::Rng};

#[derive(Debug, Default, serde::Deserialize, serde::Serialize)]
pub struct Paces {
    path: Vec<(i8, i8)>,
    #[serde(skip)]
    wander: AvoidBrain,
}

/// How it is entered: any robot with a laser can carry it.
pub static ENTRY: LaserEntry<Paces> = LaserEntry::new(SystemFacts {
    drives: DrivesBy::AnyMap,
    // Its map has paces, and no places.
    claims: false,
    ..SystemFacts::new("paces")
});

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
