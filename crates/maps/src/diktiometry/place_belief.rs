use alloc::collections::{BTreeMap, BTreeSet, VecDeque};
use alloc::vec::Vec;

use super::{
    Action, Exits, FirstPlace, MoveOutcome, ObservedMove, Observer, PlaceId, agrees, share_a_view,
};

/// Probability of each place of a learned map for a robot that was put down anywhere.
///
/// Views and moves make some places likelier. Places that contradict them are dropped. If the robot
/// is where no place fits, all places are considered again. The map is only read.
///
/// Beyond the paper, whose tracks begin at a known place: a histogram filter over places (S. Thrun,
/// W. Burgard, D. Fox, *Probabilistic Robotics*, 2005, section 8.2).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlaceBelief {
    /// Probability of each place; the probabilities sum to 1.
    chances: BTreeMap<PlaceId, f64>,
}

/// Whether the map explains a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Explained {
    /// The move led to where the map has it, from a possible place of the robot.
    ByTheMap,
    /// The move led elsewhere than the map says.
    NotAtAll,
}

/// Probability that a place has a new look.
const NEW_LOOK: f64 = 0.05;
/// Probability that an open way seems shut, or a shut one open.
const CHANGED_EXIT: f64 = 0.1;
/// Probability that a known action leads elsewhere, or that the robot is carried.
const ASTRAY: f64 = 0.01;
/// Share of the likeliest place's probability below which a place is dropped.
const LEAST: f64 = 1e-4;
/// Maximum number of pairs of places that are searched for an action that tells two places apart.
const PAIRS: usize = 20_000;

impl PlaceBelief {
    /// Returns the belief of a robot that was put down on the map of `observer` and has the view
    /// `seen`. O(places).
    #[must_use]
    pub fn put_down(observer: &Observer, seen: &FirstPlace) -> Self {
        let places = observer.map.paths.places();
        let mut belief = Self {
            chances: places.map(|(id, _)| (id, 1.0)).collect(),
        };
        belief.weigh(|place| observer.likelihood(place, seen));
        belief
    }

    /// Takes in a move and the view at its end. O(places + links · log places).
    pub fn follow(&mut self, observer: &Observer, step: &ObservedMove) -> Explained {
        let seen = FirstPlace {
            percept: step.percept.clone(),
            exits: step.exits.clone(),
        };
        let mut led: BTreeMap<PlaceId, f64> = BTreeMap::new();
        for (place, chance) in &self.chances {
            for (to, share) in observer.led(*place, step) {
                *led.entry(to).or_default() += chance * share;
            }
        }
        let anywhere = ASTRAY / observer.map.paths.standing().max(1) as f64;
        let (mut explained, mut strayed) = (0.0, 0.0);
        let places = observer.map.paths.places();
        let chances = places.map(|(place, _)| {
            let likelihood = observer.likelihood(place, &seen);
            let by_map = (1.0 - ASTRAY) * led.get(&place).copied().unwrap_or(0.0) * likelihood;
            explained += by_map;
            strayed += anywhere * likelihood;
            (place, by_map + anywhere * likelihood)
        });
        self.chances = chances.collect();
        self.weigh(|_| 1.0);
        match explained > strayed {
            true => Explained::ByTheMap,
            false => Explained::NotAtAll,
        }
    }

    /// Multiplies the probability of each place by its `likelihood`, 0 to 1, and drops places that
    /// have become too unlikely. If nothing is likely, the belief stays the same.
    pub fn weigh(&mut self, likelihood: impl Fn(PlaceId) -> f64) {
        let weighed = self.chances.iter();
        let weighed = weighed.map(|(place, chance)| (*place, chance * likelihood(*place)));
        let weighed: Vec<(PlaceId, f64)> = weighed.collect();
        let best = weighed
            .iter()
            .map(|(_, weight)| *weight)
            .fold(0.0, f64::max);
        if best > 0.0 {
            let kept = weighed
                .into_iter()
                .filter(|(_, weight)| *weight > LEAST * best);
            self.chances = kept.collect();
            let all: f64 = self.chances.values().sum();
            self.chances.values_mut().for_each(|chance| *chance /= all);
        }
    }

    /// Returns the possible places with their probabilities, which sum to 1; the likeliest first,
    /// of equals the older.
    #[must_use]
    pub fn places(&self) -> Vec<(PlaceId, f64)> {
        let mut places: Vec<(PlaceId, f64)> =
            self.chances.iter().map(|(id, p)| (*id, *p)).collect();
        places.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        places
    }

    /// Returns the first action of the shortest script that tells the two likeliest places apart on
    /// the map. `None` if there is only one place, or nothing on the map tells them apart.
    /// Breadth-first over at most 20,000 pairs of places.
    #[must_use]
    pub fn telling_action(&self, observer: &Observer) -> Option<Action> {
        let places = self.places();
        let [(one, _), (other, _), ..] = places[..] else {
            return None;
        };
        let actions = (0..observer.config.actions.len() as u32).map(Action);
        let mut seen = BTreeSet::from([(one, other)]);
        let mut ahead = VecDeque::from([((one, other), None)]);
        while let Some((pair, first)) = ahead.pop_front() {
            for action in actions.clone() {
                let first = first.or(Some(action));
                match observer.both(pair, action) {
                    Pair::ToldApart => return first,
                    Pair::At(next) if seen.len() < PAIRS && seen.insert(next) => {
                        ahead.push_back((next, first));
                    }
                    Pair::At(_) | Pair::Unknown => {}
                }
            }
        }
        None
    }
}

/// Result of one action from two possible places.
enum Pair {
    /// The outcome tells the two places apart.
    ToldApart,
    /// The robot may now be at one of these two places.
    At((PlaceId, PlaceId)),
    /// The map does not know, or the action leads to one place from both.
    Unknown,
}

impl Observer {
    /// Returns the likelihood of the first view at a place, up to a factor.
    fn likelihood(&self, place: PlaceId, seen: &FirstPlace) -> f64 {
        let known = self.map.place(place);
        let look = match agrees(known, seen.percept.as_ref(), &self.config.percepts) {
            true => 1.0,
            false => NEW_LOOK,
        };
        look * libm::pow(
            CHANGED_EXIT,
            self.differing(&known.exits, &seen.exits) as f64,
        )
    }

    /// Returns the number of actions that seem possible at one place alone, or 0 if either's exits
    /// are unknown.
    fn differing(&self, one: &Exits, other: &Exits) -> usize {
        let (Exits::Seen(one), Exits::Seen(other)) = (one, other) else {
            return 0;
        };
        let actions = (0..self.config.actions.len() as u32).map(Action);
        actions
            .filter(|action| one.contains(action) != other.contains(action))
            .count()
    }

    /// Returns the places to which a move led if it began at `place`, each with its share of the
    /// probability.
    fn led(&self, place: PlaceId, step: &ObservedMove) -> Vec<(PlaceId, f64)> {
        if step.outcome == MoveOutcome::Blocked {
            let open = self.map.place(place).is_open(step.action);
            return Vec::from([(place, if open { CHANGED_EXIT } else { 1.0 })]);
        }
        let moved = self.config.way(step);
        let fits = |to: PlaceId| {
            self.motion(place, to)
                .is_none_or(|known| known.meets(moved))
        };
        let known = self.predict(place, step.action);
        if known.is_empty() {
            // A way that was never gone may lead to whatever lies there.
            let places = self.map.paths.places().map(|(id, _)| id);
            let there: Vec<PlaceId> = places
                .filter(|to| {
                    self.motion(place, *to)
                        .is_some_and(|known| known.meets(moved))
                })
                .collect();
            let share = CHANGED_EXIT / there.len().max(1) as f64;
            return there.into_iter().map(|to| (to, share)).collect();
        }
        let known = known.into_iter().filter(|predicted| fits(predicted.place));
        known
            .map(|predicted| (predicted.place, predicted.probability))
            .collect()
    }

    /// Returns the result of an action from two possible places.
    fn both(&self, (one, other): (PlaceId, PlaceId), action: Action) -> Pair {
        let paths = &self.map.paths;
        let end = |place| Some(self.map.link(paths.likeliest(place, action)?).to);
        let (Some(a), Some(b)) = (end(one), end(other)) else {
            return Pair::Unknown;
        };
        let ways = [(one, a), (other, b)].map(|(from, to)| self.motion(from, to));
        let [at_a, at_b] = [a, b].map(|place| self.map.place(place));
        let apart = match ways {
            // As wide as odometry was on the way that is known, and where in the places it stopped.
            [Some(way_a), Some(way_b)] => {
                let between = self.config.between_places(way_a - way_b);
                between.norm().low() > 0.2 * way_a.norm().high()
            }
            _ => false,
        };
        let unlike = !share_a_view(at_a, at_b, &self.config.percepts);
        if apart || unlike || self.differing(&at_a.exits, &at_b.exits) > 0 {
            return Pair::ToldApart;
        }
        if a == b {
            Pair::Unknown
        } else {
            Pair::At((a, b))
        }
    }
}
