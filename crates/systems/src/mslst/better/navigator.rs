use alloc::sync::Arc;
use core::convert::Infallible;

use rand::{Rng, RngExt};
use tolman_control::{Outcome, StuckBeams};
use tolman_geom::{Heading, Point};
use tolman_maps::scan_map::{Explanation, ScanChart, StandpointBelief};
use tolman_maze::Direction;
use tolman_robot::{Goal, Guess, Landmark, MapView, Mapper, Position, Scan, Standing, Task};

use super::changed_map::ChangedMap;
use super::costs::ActionCosts;
use super::reckoning::Reckoning;
use super::rehearsal::facing;
use super::tries::Tries;
use super::{BetterMap, BetterPart};
use crate::{Brain, Doing, RolledStep};

/// Localizes on its map, and takes the action that reaches the goal soonest on average over its
/// belief.
#[derive(Clone, Debug)]
pub struct BetterNavigator {
    maps: ChangedMap,
    /// Known errors of the robot's laser.
    beams: StuckBeams,
    belief: StandpointBelief,
    reckoning: Reckoning,
    heading: Heading,
    /// Actions that failed since the robot last moved.
    failed: Vec<Direction>,
    failures: Tries,
    next: Option<Direction>,
    /// Where to go, with the costs of the ways there; `None` for the landmark of the goal.
    aim: Option<(Goal, ActionCosts)>,
}

/// Number of failures of an action at a place before it costs more there.
const FREE: usize = 1;
/// Extra cost of an action per failure at a place, time steps.
const FAILED: f64 = 15.0;
/// Least probability at which a standpoint counts.
const NO_SAY: f64 = 1e-4;
/// Minimum probability of the robot's place at which the system states the place.
const SURE_TO_SAY: f64 = 0.99;
/// Minimum probability of the robot's place at which the system judges new walls there.
const SURE: f64 = 0.9;

impl BetterNavigator {
    /// Returns a navigator that knows `map` but not its place.
    #[must_use]
    pub fn new(map: Arc<BetterMap>) -> Self {
        Self {
            belief: StandpointBelief::anywhere(&map.standpoints),
            maps: ChangedMap::new(map),
            beams: StuckBeams::default(),
            reckoning: Reckoning::default(),
            heading: Heading::NORTH,
            failed: Vec::new(),
            failures: Tries::default(),
            next: None,
            aim: None,
        }
    }

    /// Returns the map as learned, without new walls.
    #[must_use]
    pub fn chart(&self) -> &ScanChart {
        self.current().chart()
    }

    /// Returns the map with new walls.
    fn current(&self) -> &BetterMap {
        self.maps.now()
    }

    fn look(&mut self, seen: &RolledStep, scan: Option<&Scan>) {
        let (moved, sd) = self.reckoning.take();
        let map = Arc::clone(self.maps.now());
        if moved != tolman_geom::Vector::zeros() {
            self.belief.moved(&map.standpoints, moved, sd);
        }
        if let (Some(scan), Some(heading)) = (scan, seen.step.heading) {
            self.heading = heading;
            let explanation = self.belief.saw(&map.standpoints, heading, scan);
            if explanation == Explanation::Lifted && self.maps.forget() {
                self.carry_over(&map);
            }
        }
        if seen.step.landmark == Some(Landmark::Goal) {
            self.belief.sensed_the_goal(&map.standpoints);
        } else if map.config.has(BetterPart::Absence) {
            self.belief.missed_the_goal(&map.standpoints);
        }
    }

    /// Returns the likeliest position of the robot.
    fn likeliest(&self) -> Option<Point> {
        let number = self.belief.likeliest()?;
        self.current().standpoints.position(number)
    }

    /// Returns the share of its belief near the likeliest standpoint, 0 to 1.
    fn sure(&self) -> f64 {
        let map = self.current();
        let within = map.config.diameter;
        self.belief.certainty(&map.standpoints, within)
    }

    /// Returns the probability that the robot is at the place of its likeliest standpoint; 0 if
    /// that is on the way between places. O(standpoints believed in · places).
    fn at_its_place(&self) -> f64 {
        let corridors = self.maps.learned().corridors();
        let place = self.likeliest().and_then(|at| corridors.at(at));
        place.map_or(0.0, |place| self.at(Goal::Place(place)))
    }

    /// Returns the probability that the robot is at a goal of its map. O(standpoints believed in ·
    /// places).
    fn at(&self, goal: Goal) -> f64 {
        let believed = self.belief.probabilities().iter().copied().map(f64::from);
        let there = self.current().standpoints.positions().zip(believed);
        let there = there.filter(|(at, mass)| *mass > 0.0 && self.is_there(goal, *at));
        there.map(|(_, mass)| mass).sum()
    }

    /// Returns whether a point of its map belongs to a goal: to a place, or within half a corridor
    /// of a point, or of where a landmark was sensed.
    fn is_there(&self, goal: Goal, at: Point) -> bool {
        match goal {
            Goal::Place(place) => self.maps.learned().corridors().at(at) == Some(place),
            Goal::Point(point) => self.is_by(point, at),
            Goal::Landmark(Landmark::Numbered(number)) => {
                let mut spots = self.current().chart().spots_of(number);
                spots.any(|spot| self.is_by(spot, at))
            }
            Goal::Landmark(Landmark::Goal | Landmark::Start) => false,
        }
    }

    /// Returns whether a point of its map lies within half a corridor of another, and in sight.
    fn is_by(&self, point: Point, at: Point) -> bool {
        (at - point).norm() <= 0.5 * self.current().config.corridor_width
            && self.current().chart().ground().sees(point, at)
    }

    /// Returns the costs of the ways to a goal of its map; `None` if the map does not have it.
    fn costs_to(&self, goal: Goal) -> Option<ActionCosts> {
        let there = |at| self.is_there(goal, at);
        self.current().costs_to(there)
    }

    /// Looks for walls beyond its map that have just barred its way.
    fn meet(&mut self, heading: Heading, scan: &Scan) {
        let map = Arc::clone(self.maps.now());
        let on = &map.standpoints;
        let Some(here) = self.belief.likeliest() else {
            return;
        };
        if self.sure() < SURE {
            return;
        }
        let walls = on.new_walls(here, heading, scan);
        if let Some(at) = on.position(here)
            && !walls.is_empty()
            && self.maps.bar(&walls, at)
        {
            self.carry_over(&map);
        }
    }

    /// Carries the belief over from the former map to the present one.
    fn carry_over(&mut self, before: &BetterMap) {
        let now = &self.maps.now().standpoints;
        self.belief = self.belief.carried_over(&before.standpoints, now);
        let aim = self.aim.take();
        self.aim = aim.and_then(|(goal, _)| Some((goal, self.costs_to(goal)?)));
    }

    /// Returns the action of least mean cost over its belief.
    fn cheapest(&self) -> Option<Direction> {
        let map = self.current();
        let to_goal = || map.costs();
        let plan = self.aim.as_ref().map_or_else(to_goal, |(_, costs)| costs);
        let axis = facing(self.heading);
        let only = match map.config.has(BetterPart::Average) {
            true => None,
            false => self.belief.likeliest(),
        };
        let mut costs = [0.0; 4];
        let probabilities = self.belief.probabilities().iter().copied();
        for (number, mass) in (0..).zip(probabilities.map(f64::from)) {
            let has_say = mass > NO_SAY / map.standpoints.len() as f64;
            if has_say && only.is_none_or(|only| only == number) {
                for action in Direction::ALL {
                    costs[action.index()] += mass * plan.cost(number, axis, action);
                }
            }
        }
        if let Some(here) = self.likeliest() {
            for action in Direction::ALL {
                let often = self.failures.count(here, action).saturating_sub(FREE);
                costs[action.index()] += FAILED * often as f64;
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
            *self = Self {
                beams: core::mem::take(&mut self.beams),
                ..Self::new(Arc::clone(self.maps.learned()))
            };
        }
        let config = self.maps.now().config;
        self.reckoning.add(seen, &config);
        let scan = seen.step.scan.as_ref();
        let scan = scan.map(|scan| self.beams.mended(scan));
        match seen.step.doing {
            Doing::UnderWay(_) => return Ok(()),
            Doing::PutDown => {}
            Doing::Ended(_, outcome) if outcome.moved() => self.failed.clear(),
            Doing::Ended(action, _) => {
                self.failed.push(action);
                if let Some(here) = self.likeliest() {
                    self.failures.add(here, action);
                }
            }
        }
        self.look(seen, scan.as_ref());
        if let (Doing::Ended(_, Outcome::Failed | Outcome::CutShort), Some(heading), Some(scan)) =
            (seen.step.doing, seen.step.heading, &scan)
        {
            self.meet(heading, scan);
        }
        self.next = self.cheapest();
        Ok(())
    }

    fn map(&self) -> MapView {
        self.maps.learned().corridors().view()
    }

    fn belief(&self) -> Vec<Guess> {
        let positions = self.current().standpoints.positions();
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
        Some(self.current().chart().bytes())
    }
}

impl Brain for BetterNavigator {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.next
            .unwrap_or_else(|| Direction::ALL[rng.random_range(0..4)])
    }

    fn aim(&mut self, task: Task) {
        let goal = match task {
            Task::Reach(Goal::Landmark(Landmark::Goal)) | Task::Explore | Task::Localize => None,
            Task::Reach(goal) => Some(goal),
        };
        if goal != self.aim.as_ref().map(|(goal, _)| *goal) {
            self.aim = goal.and_then(|goal| Some((goal, self.costs_to(goal)?)));
            self.next = self.cheapest();
        }
    }

    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Explore => Standing::Done,
            Task::Reach(Goal::Landmark(Landmark::Goal)) => Standing::UnderWay,
            Task::Reach(Goal::Landmark(_)) => match &self.aim {
                None => Standing::gave_up("the landmark is not on its map"),
                Some(_) => Standing::UnderWay,
            },
            Task::Reach(goal) => match &self.aim {
                None => Standing::gave_up("its map has no floor there"),
                Some(_) if self.at(goal) > SURE => Standing::Done,
                Some(_) => Standing::UnderWay,
            },
            Task::Localize => {
                if self.at_its_place() > SURE_TO_SAY {
                    Standing::Done
                } else {
                    Standing::UnderWay
                }
            }
        }
    }

    fn sees_straight(&self) -> bool {
        self.current().config.has(BetterPart::Straightening)
    }

    fn words(&self) -> String {
        let sure = 100.0 * self.sure();
        format!("believes with {sure:.0} % to know where it is")
    }
}
