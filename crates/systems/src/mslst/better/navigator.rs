use alloc::sync::Arc;
use core::convert::Infallible;

use rand::{Rng, RngExt};
use tolman_geom::Heading;
use tolman_maps::scan_map::{ScanChart, StandpointBelief};
use tolman_maze::Direction;
use tolman_robot::{Goal, Guess, Landmark, MapView, Mapper, Position, Standing, Task};

use super::reckoning::Reckoning;
use super::rehearsal::facing;
use super::{BetterMap, BetterPart};
use crate::{Brain, Doing, RolledStep};

/// Finds out where it is on its map, and does what leads to the goal soonest on average over all it believes.
#[derive(Clone, Debug)]
pub struct BetterNavigator {
    map: Arc<BetterMap>,
    belief: StandpointBelief,
    reckoning: Reckoning,
    heading: Heading,
    /// What failed since the robot last moved.
    failed: Vec<Direction>,
    next: Option<Direction>,
}

/// A standpoint less probable than that has no say.
const NO_SAY: f64 = 1e-4;

impl BetterNavigator {
    /// Returns one that knows `map` and has no idea where it is.
    #[must_use]
    pub fn new(map: Arc<BetterMap>) -> Self {
        Self {
            belief: StandpointBelief::anywhere(&map.standpoints),
            map,
            reckoning: Reckoning::default(),
            heading: Heading::NORTH,
            failed: Vec::new(),
            next: None,
        }
    }

    /// Returns the map it goes by.
    #[must_use]
    pub fn chart(&self) -> &ScanChart {
        self.map.chart()
    }

    fn look(&mut self, seen: &RolledStep) {
        let (moved, sd) = self.reckoning.take();
        let map = &*self.map;
        if moved != tolman_geom::Vector::zeros() {
            self.belief.moved(&map.standpoints, moved, sd);
        }
        if let (Some(scan), Some(heading)) = (&seen.step.scan, seen.step.heading) {
            self.heading = heading;
            self.belief.saw(&map.standpoints, heading, scan);
        }
        if seen.step.landmark != Some(Landmark::Goal) && map.config.has(BetterPart::Absence) {
            self.belief.missed_the_goal(&map.standpoints);
        }
        self.next = self.cheapest();
    }

    /// The action that costs least on average over all it believes.
    fn cheapest(&self) -> Option<Direction> {
        let axis = facing(self.heading);
        let only = match self.map.config.has(BetterPart::Average) {
            true => None,
            false => self.belief.likeliest(),
        };
        let mut costs = [0.0; 4];
        let probabilities = self.belief.probabilities().iter().copied();
        for (number, mass) in (0..).zip(probabilities.map(f64::from)) {
            let has_say = mass > NO_SAY / self.map.standpoints.len() as f64;
            if has_say && only.is_none_or(|only| only == number) {
                for action in Direction::ALL {
                    costs[action.index()] += mass * self.map.cost(number, axis, action);
                }
            }
        }
        let allowed = Direction::ALL.into_iter();
        let allowed = allowed.filter(|action| !self.failed.contains(action));
        allowed.min_by(|a, b| costs[a.index()].total_cmp(&costs[b.index()]))
    }
}

impl Mapper for BetterNavigator {
    type Observation = RolledStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &RolledStep) -> Result<(), Infallible> {
        if seen.step.doing == Doing::PutDown {
            *self = Self::new(Arc::clone(&self.map));
        }
        self.reckoning.add(seen, &self.map.config);
        match seen.step.doing {
            Doing::UnderWay(_) => return Ok(()),
            Doing::PutDown => {}
            Doing::Ended(_, outcome) if outcome.moved() => self.failed.clear(),
            Doing::Ended(action, _) => self.failed.push(action),
        }
        self.look(seen);
        Ok(())
    }

    fn map(&self) -> MapView {
        self.map.chart().view()
    }

    fn belief(&self) -> Vec<Guess> {
        let positions = self.map.standpoints.positions();
        let probabilities = self.belief.probabilities().iter().copied();
        let guesses = positions.zip(probabilities.map(f64::from));
        let guesses = guesses.filter(|(_, mass)| *mass > NO_SAY);
        let mut guesses: Vec<Guess> = guesses
            .map(|(at, weight)| Guess {
                at: Position::Point(at),
                weight,
            })
            .collect();
        guesses.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        guesses
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.map.chart().bytes())
    }
}

impl Brain for BetterNavigator {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.next
            .unwrap_or_else(|| Direction::ALL[rng.random_range(0..4)])
    }

    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Explore => Standing::Done,
            Task::Reach(Goal::Landmark(Landmark::Goal)) => Standing::UnderWay,
            Task::Reach(_) => Standing::gave_up("its map leads to the landmark of the goal alone"),
            Task::Localize => {
                let sure = self
                    .belief
                    .certainty(&self.map.standpoints, self.map.config.diameter);
                if sure > 0.95 {
                    Standing::Done
                } else {
                    Standing::UnderWay
                }
            }
        }
    }

    fn sees_straight(&self) -> bool {
        self.map.config.has(BetterPart::Straightening)
    }

    fn words(&self) -> String {
        let sure = self
            .belief
            .certainty(&self.map.standpoints, self.map.config.diameter);
        format!("believes with {:.0} % to know where it is", 100.0 * sure)
    }
}
