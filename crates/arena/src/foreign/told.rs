use serde_json::{Value, json};
use tolman_robot::{Guess, MapPlace, Position, Standing, VisitNaming};
use tolman_systems::AnyOnRobot;

use crate::contest::Claim;
use crate::registry::SystemFacts;
use crate::run::TaskEnd;

/// What a system on its robot tells of itself, as the JSON of `docs/brain.md`.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    /// Facts about the system.
    pub facts: &'a SystemFacts,
    /// The system on its robot.
    pub pilot: &'a dyn AnyOnRobot,
}

impl core::fmt::Debug for Told<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let name = self.facts.name;
        f.debug_struct("Told").field("system", &name).finish()
    }
}

impl Told<'_> {
    /// Returns how a task stands.
    #[must_use]
    pub fn standing(&self, standing: &Standing) -> Value {
        let (word, why) = words(standing);
        let situation = self.pilot.words();
        let visits = self.pilot.visit_count();
        json!({ "standing": word, "why": why, "situation": situation, "visits": visits })
    }

    /// Returns where the system believes the robot to be.
    #[must_use]
    pub fn belief(&self) -> Value {
        let guess = |guess: &Guess| {
            let weight = guess.weight;
            match guess.at {
                Position::Place(place) => json!({ "place": place, "weight": weight }),
                Position::Point(at) => json!({ "point": [at.x, at.y], "weight": weight }),
            }
        };
        Value::from_iter(self.pilot.belief().iter().map(guess))
    }

    /// Returns the map. O(map).
    #[must_use]
    pub fn map(&self) -> Value {
        let view = self.pilot.map();
        let place = |place: &MapPlace| {
            let position = place.position.map(|at| [at.x, at.y]);
            json!({ "id": place.id, "position": position, "landmark": place.landmark })
        };
        let links = view.links.iter().map(|link| [link.from, link.to]);
        json!({
            "places": view.places.iter().map(place).collect::<Vec<Value>>(),
            "links": links.collect::<Vec<[u32; 2]>>(),
        })
    }

    /// Returns the places that were visited.
    #[must_use]
    pub fn visits(&self) -> Value {
        let naming = match self.pilot.visit_naming() {
            VisitNaming::Never => "never",
            VisitNaming::EachStep => "each_step",
            VisitNaming::EachArrival => "each_arrival",
        };
        json!({ "naming": naming, "places": self.pilot.visits() })
    }

    /// Returns the system's own verdict on its map.
    #[must_use]
    pub fn verdict(&self, standing: &Standing) -> Value {
        let (doubt, certainty) = (self.pilot.doubt(), self.pilot.certainty());
        let end = match standing {
            Standing::UnderWay => TaskEnd::OutOfTime,
            Standing::Done => TaskEnd::Done,
            Standing::GaveUp { why } => TaskEnd::GaveUp { why: why.clone() },
        };
        let claim = match Claim::by(&end, self.facts.claims, doubt.as_deref(), certainty) {
            Claim::Right => "right",
            Claim::Wrong => "wrong",
            Claim::Undecided => "undecided",
        };
        json!({ "map": claim, "doubt": doubt, "certainty": certainty })
    }
}

/// Returns the word for a standing, and its reason.
pub(super) fn words(standing: &Standing) -> (&'static str, Option<&str>) {
    match standing {
        Standing::UnderWay => ("under_way", None),
        Standing::Done => ("done", None),
        Standing::GaveUp { why } => ("gave_up", Some(why)),
    }
}
