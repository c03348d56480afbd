use alloc::collections::BTreeSet;
use alloc::format;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::{
    Action, Explained, Link, LinkId, MoveOutcome, ObservedMove, Observer, PathGraph, PlaceBelief,
    PlaceId,
};
use tolman_maze::Direction;
use tolman_planners::{Graph, path_to};
use tolman_robot::{Goal, Landmark, Standing, Task};

use super::{LandmarkSpot, Next, Rover, first_place, give_up, is_at_goal, observed};
use crate::brain::NO_POINTS;
use crate::stream;

/// Chooses the next move of a rover that was put down anywhere on a learned map. It knows no robot.
#[derive(Clone, Debug)]
pub(super) struct RouteFinder {
    map: Observer,
    goal: Option<LandmarkSpot>,
    /// Belief; `None` before the rover stands at a place for the first time.
    belief: Option<PlaceBelief>,
    exits: [bool; 4],
    /// Direction of a routine that broke off between two places.
    under_way: Option<Direction>,
    /// Actions that differed from the map.
    shut: BTreeSet<(PlaceId, Action)>,
    /// Number of moves since the rover last knew its place.
    unsure: usize,
    walk: ChaCha8Rng,
}

/// Minimum probability of a place at which the robot is sure to be there.
const SURE: f64 = 0.9;
/// Probability that a landmark is not sensed at the place where it was learned.
const UNSENSED: f64 = 0.05;
/// Stream of the random walk.
const WALK_STREAM: u64 = 1;
/// Number of moves after which a rover that fits nowhere gives up, in addition to ten for each
/// place.
const PATIENCE: usize = 40;

impl RouteFinder {
    pub(super) fn new(map: Observer, goal: Option<LandmarkSpot>, seed: u64) -> Self {
        Self {
            map,
            goal,
            belief: None,
            exits: [false; 4],
            under_way: None,
            shut: BTreeSet::new(),
            unsure: 0,
            walk: stream(seed, WALK_STREAM),
        }
    }

    pub(super) const fn belief(&self) -> Option<&PlaceBelief> {
        self.belief.as_ref()
    }

    /// Makes the next move of `task` with `rover`.
    pub(super) fn act<V: Rover>(
        &mut self,
        rover: &mut V,
        task: Task,
    ) -> Result<Standing, V::Error> {
        let before = rover.landmark();
        let direction = match self.under_way {
            Some(_) if is_at_goal(task, before) => return Ok(Standing::Done),
            Some(direction) => direction,
            None => {
                if self.belief.is_none() {
                    self.find_footing(rover)?;
                }
                match self.next(task, rover.landmark()) {
                    Next::Continue(direction) => direction,
                    Next::Break(standing) => return Ok(standing),
                }
            }
        };
        self.go(rover, direction)?;
        let here = rover.landmark();
        self.recognize(here);
        if self.is_done(task, here) {
            return Ok(Standing::Done);
        }
        Ok(Standing::UnderWay)
    }

    /// Drives to a place from anywhere, without changing the belief, and looks round.
    fn find_footing<V: Rover>(&mut self, rover: &mut V) -> Result<(), V::Error> {
        let mut seen = rover.look()?;
        let mut ways = Vec::from(Direction::ALL);
        ways.sort_by_key(|way| !seen.exits[way.index()]);
        for way in ways {
            seen = rover.go(way)?;
            if seen.outcome == MoveOutcome::Arrived {
                break;
            }
        }
        let first = first_place(self.map.config(), &seen);
        self.belief = Some(PlaceBelief::put_down(&self.map, &first));
        self.exits = seen.exits;
        Ok(())
    }

    /// Lets `rover` go in `direction` and takes in the result.
    fn go<V: Rover>(&mut self, rover: &mut V, direction: Direction) -> Result<(), V::Error> {
        self.under_way = Some(direction);
        let arrival = rover.go(direction)?;
        self.under_way = None;
        let seen = observed(self.map.config(), direction, &arrival);
        self.take_in(&seen);
        self.exits = arrival.exits;
        Ok(())
    }

    /// Takes in a move. If it leads elsewhere than on the map, the link is noted as changed.
    pub(super) fn take_in(&mut self, seen: &ObservedMove) {
        let from = self.here();
        let Some(belief) = &mut self.belief else {
            return;
        };
        let explained = belief.follow(&self.map, seen);
        if let (Some(from), Explained::NotAtAll) = (from, explained) {
            self.shut.insert((from, seen.action));
        }
        self.unsure = match self.here() {
            Some(_) => 0,
            None => self.unsure + 1,
        };
    }

    /// Weighs the belief by the absence of a landmark, if the rover senses none.
    fn recognize(&mut self, here: Option<Landmark>) {
        if let (Some(belief), Some(LandmarkSpot::Place(goal)), None) =
            (&mut self.belief, self.goal, here)
        {
            belief.weigh(|place| if place == goal { UNSENSED } else { 1.0 });
        }
    }

    /// Returns the robot's place, or `None` if it is not sure.
    fn here(&self) -> Option<PlaceId> {
        let places = self.belief.as_ref()?.places();
        let (place, chance) = *places.first()?;
        (chance >= SURE).then_some(place)
    }

    /// Returns the likeliest place if the map cannot tell the remaining places apart.
    fn likeliest(&self) -> Option<PlaceId> {
        let belief = self.belief.as_ref()?;
        let (place, _) = *belief.places().first()?;
        belief.telling_action(&self.map).is_none().then_some(place)
    }

    fn next(&mut self, task: Task, here: Option<Landmark>) -> Next {
        if self.is_done(task, here) {
            return Next::Break(Standing::Done);
        }
        let to = match task {
            Task::Explore => return give_up("it was put down on a learned map and learns none"),
            Task::Localize => None,
            Task::Reach(Goal::Place(id)) => match self.map.map().paths.resolve(PlaceId(id)) {
                None => return give_up(&format!("place {id} is not on the map")),
                to => to,
            },
            Task::Reach(Goal::Point(_)) => return give_up(NO_POINTS),
            Task::Reach(Goal::Landmark(landmark)) => {
                match self.goal.filter(|_| landmark == Landmark::Goal) {
                    None => {
                        return give_up("the goal is not on the map");
                    }
                    Some(LandmarkSpot::Place(place)) => Some(place),
                    Some(LandmarkSpot::Way(place, way)) => {
                        if self.here().or_else(|| self.likeliest()) == Some(place) {
                            return self.go_along(place, way);
                        }
                        Some(place)
                    }
                }
            }
        };
        let places = self.map.map().paths.places().count();
        if self.unsure > PATIENCE + 10 * places {
            let moves = self.unsure;
            return give_up(&format!(
                "it does not find out where it is: after {moves} moves no place of the map fits"
            ));
        }
        match (self.here().or_else(|| self.likeliest()), to) {
            (Some(from), Some(to)) if from != to => self.follow_plan(from, to),
            _ => self.tell_apart(),
        }
    }

    /// Goes along the way on which the goal is. That it is not there shows once the robot is past.
    fn go_along(&mut self, from: PlaceId, way: Direction) -> Next {
        match self.shut.insert((from, Action(way.index() as u32))) && self.exits[way.index()] {
            true => Next::Continue(way),
            false => give_up("the goal is not where it is on the map"),
        }
    }

    /// Follows the shortest way from one place to another along ways not known to be shut.
    fn follow_plan(&mut self, from: PlaceId, to: PlaceId) -> Next {
        while let Some(direction) = self.first_step(from, to) {
            if self.exits[direction.index()] {
                return Next::Continue(direction);
            }
            self.shut.insert((from, Action(direction.index() as u32)));
        }
        // What is held to be shut may have been a wrong belief.
        self.shut.clear();
        self.wander()
    }

    fn first_step(&self, from: PlaceId, to: PlaceId) -> Option<Direction> {
        let ways = OpenWays {
            paths: &self.map.map().paths,
            shut: &self.shut,
        };
        let path = path_to(&ways, from.0, |place| place == to.0)?;
        let next = PlaceId(*path.get(1)?);
        let mut links = ways.of(from);
        let (action, _) = links.find(|(_, to)| *to == next)?;
        Direction::ALL.get(action.0 as usize).copied()
    }

    /// Returns a description of its situation in a few words.
    pub(super) fn words(&self) -> String {
        let places = self
            .belief
            .as_ref()
            .map(PlaceBelief::places)
            .unwrap_or_default();
        match (self.here(), places.len()) {
            (_, 0) => "between places".to_owned(),
            (Some(place), _) => format!("at place {}", place.0),
            (None, places) => format!("at one of {places} places"),
        }
    }

    /// Makes a move that tells the likeliest places apart, or any move if there is none.
    fn tell_apart(&mut self) -> Next {
        let belief = self.belief.as_ref();
        let telling = belief.and_then(|belief| belief.telling_action(&self.map));
        let direction = telling.and_then(|action| Direction::ALL.get(action.0 as usize));
        match direction {
            Some(direction) if self.exits[direction.index()] => Next::Continue(*direction),
            _ => self.wander(),
        }
    }

    fn wander(&mut self) -> Next {
        let mut open = Vec::from(Direction::ALL);
        open.retain(|direction| self.exits[direction.index()]);
        let chosen = self.walk.random_range(0..open.len().max(1) as u32) as usize;
        match open.get(chosen) {
            Some(direction) => Next::Continue(*direction),
            None => give_up("no way leads on from where it stands"),
        }
    }

    fn is_done(&self, task: Task, here: Option<Landmark>) -> bool {
        match task {
            Task::Explore | Task::Reach(Goal::Point(_)) => false,
            Task::Localize => self.here().or_else(|| self.likeliest()).is_some(),
            Task::Reach(Goal::Landmark(_)) => is_at_goal(task, here),
            Task::Reach(Goal::Place(id)) => {
                let place = self.map.map().paths.resolve(PlaceId(id));
                place.is_some() && place == self.here()
            }
        }
    }
}

/// The ways of a map that are not known to be shut.
struct OpenWays<'a> {
    paths: &'a PathGraph,
    shut: &'a BTreeSet<(PlaceId, Action)>,
}

impl OpenWays<'_> {
    /// Returns the actions that are possible at a place, with their ends.
    fn of(&self, place: PlaceId) -> impl Iterator<Item = (Action, PlaceId)> {
        let open = move |link: &(LinkId, &Link)| !self.shut.contains(&(place, link.1.action));
        let links = self.paths.likely(place).filter(open);
        links.map(|(_, link)| (link.action, link.to))
    }
}

impl Graph for OpenWays<'_> {
    fn node_count(&self) -> usize {
        self.paths.node_count()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for (_, to) in self.of(PlaceId(node)) {
            visit(to.0, 1);
        }
    }
}
