use alloc::collections::BTreeMap;
use core::ops::ControlFlow;

use rand::{Rng, RngExt};
use tolman_maps::cpm::{
    CpMap, CpMapper, CpmError, Dictionary, FragmentId, Junction, JunctionId, MapUpdate, Port,
    PortState, Sighting, Traversal, Turn,
};
use tolman_robot::Landmark;

use super::config::{CpmConfig, Onward};
use super::decision::{Aim, Done, Leg};

/// Layer 3: "it makes a decision for the robot, and collects the path-fragment representation".
///
/// Call [`decide`](Self::decide) at each junction, dead end or landmark. Perform the turn and walk
/// to the next one. Then report the walk with [`arrive`](Self::arrive), or to its mapper with
/// [`turned_back`](CpMapper::turned_back) if the decision said to give up.
///
/// The caller owns the random numbers and the dictionary. An exploration always ends after at most
/// [`CpmConfig::most_traversals`] fragments.
#[derive(Clone, Debug)]
pub struct Explorer {
    config: CpmConfig,
    /// The map, and the robot's place on it.
    pub mapper: CpMapper,
    /// Number of walks along each fragment since the map last changed.
    walked_again: BTreeMap<FragmentId, u32>,
}

impl Explorer {
    /// Returns an explorer at a place that ends fragments, as if the robot had come in by port 0.
    /// At a dead end, port 0 is the only one. Elsewhere it is the first opening counter-clockwise
    /// from straight behind.
    ///
    /// As in the paper, a robot in mid-fragment has to drive on to the first such place before.
    ///
    /// # Errors
    /// [`CpmError`] if the place has no ports.
    pub fn new(config: CpmConfig, start: Sighting) -> Result<Self, CpmError> {
        let mapper = CpMapper::new(config.mapper(), start)?;
        Ok(Self::of(config, mapper))
    }

    /// Returns an explorer that continues a map learned before, at one of its ports.
    ///
    /// # Errors
    /// [`CpmError::Turn`] if the map has no such port.
    pub fn resume(config: CpmConfig, map: CpMap, at: Port) -> Result<Self, CpmError> {
        let mapper = CpMapper::resume(config.mapper(), map, at)?;
        Ok(Self::of(config, mapper))
    }

    const fn of(config: CpmConfig, mapper: CpMapper) -> Self {
        Self {
            config,
            mapper,
            walked_again: BTreeMap::new(),
        }
    }

    /// Takes in a walk: the turn that was performed, and the robot's observations.
    ///
    /// # Errors
    /// [`CpmError`]; the explorer is as before then.
    pub fn arrive(
        &mut self,
        turn: Turn,
        walk: &Traversal,
        dictionary: &Dictionary,
    ) -> Result<MapUpdate, CpmError> {
        let update = self.mapper.arrive(turn, walk, dictionary)?;
        match (update, self.map().end_at(self.mapper.at())) {
            (MapUpdate::Known, Some(end)) => {
                *self.walked_again.entry(end.fragment).or_default() += 1;
            }
            _ => self.walked_again.clear(),
        }
        Ok(update)
    }

    /// Returns the decision at this junction. It changes nothing but the state of `rng`.
    ///
    /// O(fragments · log fragments); [`Aim::WayBack`] and [`Aim::Shortest`] take as long for each
    /// junction.
    pub fn decide(&self, aim: Aim, rng: &mut impl Rng) -> ControlFlow<Done, Leg> {
        if let Some(done) = self.is_done(aim) {
            return ControlFlow::Break(done);
        }
        if self.mapper.traversals() >= self.config.most_traversals {
            return ControlFlow::Break(Done::OutOfPatience);
        }
        let leg = match aim {
            Aim::Find(landmark) => match self.detour(landmark) {
                Some(id) if id == self.mapper.at().junction => self.explore(rng),
                Some(detour) => self.first_leg(|id| id == detour),
                None => self.towards(landmark).or_else(|| self.explore(rng)),
            },
            Aim::Explore => self.explore(rng),
            Aim::Check => self.explore(rng).or_else(|| self.walk_again(rng)),
            Aim::WayBack => self.way_back(rng),
            Aim::Shortest => self.towards_helpful(rng),
        };
        match (leg, aim) {
            (Some(leg), _) => ControlFlow::Continue(leg),
            (None, Aim::Explore | Aim::Check | Aim::Shortest) => ControlFlow::Break(Done::Reached),
            (None, _) => ControlFlow::Break(Done::NotThere),
        }
    }

    fn is_done(&self, aim: Aim) -> Option<Done> {
        let here = self.mapper.at().junction;
        let reached = match aim {
            Aim::Find(landmark) => self.map().has(here, landmark),
            Aim::WayBack => self.map().has(here, Landmark::Start),
            Aim::Explore | Aim::Check | Aim::Shortest => false,
        };
        reached.then_some(Done::Reached)
    }

    fn map(&self) -> &CpMap {
        self.mapper.map()
    }

    /// Returns the number of the port behind the robot, and the junction where it is.
    fn here(&self) -> Option<(u32, &Junction)> {
        let Port { junction, number } = self.mapper.at();
        Some((number, self.map().junction(junction)?))
    }

    /// Returns the first leg of the shortest known way to a landmark, or `None` if none is known.
    fn towards(&self, landmark: Landmark) -> Option<Leg> {
        self.first_leg(|id| self.map().has(id, landmark))
    }

    /// Returns the place with an unknown port by which the way to a landmark of the map may be
    /// shorter; `None` if no way is known, or none may be shorter.
    #[must_use]
    pub fn detour(&self, landmark: Landmark) -> Option<JunctionId> {
        let map = self.map();
        map.detour(self.mapper.at(), |id| map.has(id, landmark))
    }

    fn first_leg(&self, wanted: impl Fn(JunctionId) -> bool) -> Option<Leg> {
        let plan = self.map().plan(self.mapper.at(), wanted)?;
        let first = plan.legs.first()?;
        Some(Leg {
            turn: first.turn,
            known: Some(first.enter),
            give_up_after: None,
        })
    }

    fn explore(&self, rng: &mut impl Rng) -> Option<Leg> {
        if !self.mapper.looks_at_map() {
            return self.wander(rng);
        }
        let (_, here) = self.here()?;
        let open: Vec<u32> = here.open_ports().collect();
        // "1) If the current junction has some remaining unknown ports, it randomly chooses one and
        // moves on."
        if let Some(number) = choose(&open, rng) {
            return self.leg_to(number, None);
        }
        // 2) "No unknown ports left".
        let has_open = |id: JunctionId| {
            let place = self.map().junction(id);
            place.is_some_and(|place| place.open_ports().next().is_some())
        };
        let way = self.first_leg(has_open)?;
        match self.config.onward {
            Onward::ShortestKnownWay => Some(way),
            Onward::GoOn => self.wander(rng),
        }
    }

    /// Returns the first leg to a fragment that was walked too rarely since the map last changed.
    /// The fragment begins here, or at the nearest place that has one.
    fn walk_again(&self, rng: &mut impl Rng) -> Option<Leg> {
        let is_rare = |port: Port| {
            let end = self.map().end_at(port)?;
            let walks = self.walked_again.get(&end.fragment).copied();
            (walks.unwrap_or(0) < self.config.checks).then_some(port.number)
        };
        let rare = |id: JunctionId| {
            let ports = 0..self.map().degree(id);
            ports.filter_map(move |number| is_rare(id.port(number)))
        };
        let here: Vec<u32> = rare(self.mapper.at().junction).collect();
        match choose(&here, rng) {
            Some(number) => self.leg_to(number, None),
            None => self.first_leg(|id| rare(id).next().is_some()),
        }
    }

    /// Returns a random port other than the one behind; at a dead end, the one behind.
    fn wander(&self, rng: &mut impl Rng) -> Option<Leg> {
        let (behind, here) = self.here()?;
        let turn = match here.degree() {
            1 => Turn::BACK,
            degree => Turn(rng.random_range(1..degree)),
        };
        self.leg_to(turn.exit(behind, here.degree()).ok()?, None)
    }

    fn leg_to(&self, number: u32, give_up_after: Option<u32>) -> Option<Leg> {
        let (behind, here) = self.here()?;
        Some(Leg {
            turn: Turn::between(behind, number, here.degree()).ok()?,
            known: self.map().end_at(self.mapper.at().junction.port(number)),
            give_up_after,
        })
    }

    /// Returns the next leg on the way back to the start. "Before the robot follows the map …, the
    /// robot tries to enter another different path-fragment … As long as the new path length is
    /// less than the old path length, the robot continues moving along the new path."
    fn way_back(&self, rng: &mut impl Rng) -> Option<Leg> {
        let home = self.mapper.plan(Landmark::Start);
        // "It does not try the new path-fragment because the junction connects to A_s."
        let is_last = home.as_ref().is_some_and(|plan| plan.legs.len() == 1);
        if !is_last && let Some(leg) = self.shortcut(Landmark::Goal, rng) {
            return Some(leg);
        }
        match home {
            Some(_) => self.towards(Landmark::Start),
            // The start is not on the map: a robot that did not begin there has to look for it.
            None => self.explore(rng),
        }
    }

    /// Returns an unknown port here that may lead to a shorter way between start and goal.
    fn shortcut(&self, from: Landmark, rng: &mut impl Rng) -> Option<Leg> {
        let room = self.room(self.mapper.at().junction, from)?;
        let ports = (0..).zip(&self.here()?.1.ports);
        let helpful: Vec<u32> = ports
            .filter(|(_, port)| matches!(port, PortState::Open { at_least } if *at_least < room))
            .map(|(number, _)| number)
            .collect();
        self.leg_to(choose(&helpful, rng)?, Some(room))
    }

    /// Returns the length, in observations, below which an unknown fragment at `junction` can
    /// shorten the way between start and goal.
    ///
    /// The known part of the way begins at the landmark `from`. Returns `None` if no fragment can
    /// shorten it; if no way is known, any length can.
    fn room(&self, junction: JunctionId, from: Landmark) -> Option<u32> {
        let is_goal = |id| self.map().has(id, Landmark::Goal);
        // A start in a corridor may be on the map twice. The robot will be put back to the first.
        let start = self.map().start()?;
        let length = |from: Port, wanted: &dyn Fn(JunctionId) -> bool| {
            let plan = self.map().plan(from, wanted);
            plan.map(|plan| plan.length)
        };
        let near = match from {
            Landmark::Goal => length(junction.port(0), &is_goal)?,
            _ => length(start, &|id| id == junction)?,
        };
        let known = length(start, &is_goal).unwrap_or(u32::MAX);
        known.checked_sub(near).filter(|room| *room > 1)
    }

    /// Returns the first leg to the nearest unknown port that may lead to a shorter way between
    /// start and goal.
    fn towards_helpful(&self, rng: &mut impl Rng) -> Option<Leg> {
        if let Some(leg) = self.shortcut(Landmark::Start, rng) {
            return Some(leg);
        }
        let helps = |id: JunctionId| {
            let place = self.map().junction(id);
            let mut ports = place.map_or(&[][..], |place| &place.ports).iter();
            self.room(id, Landmark::Start).is_some_and(|room| {
                ports.any(|port| matches!(port, PortState::Open { at_least } if *at_least < room))
            })
        };
        self.first_leg(helps)
    }
}

fn choose(ports: &[u32], rng: &mut impl Rng) -> Option<u32> {
    if ports.is_empty() {
        return None;
    }
    ports
        .get(rng.random_range(0..ports.len() as u32) as usize)
        .copied()
}
