use alloc::vec::Vec;

use rand::{Rng, RngExt};
use thiserror::Error;

use super::beam::{Beam, Understood};
use super::config::{CpmConfig, Mapping, Onward};
use super::hypothesis::Belief;
use super::map::{CpMap, End, JunctionId, Port, PortState};
use super::mapper::{Mapper, Walked, trusts};
use super::pattern::{Dictionary, DictionaryError};
use super::plan::Plan;
use super::traversal::{Sighting, Traversal};
use super::turn::{NoSuchTurn, Turn};
use tolman_robot::Landmark;

/// Layer 3: "it makes a decision for the robot, and collects the path-fragment representation".
///
/// Ask it to [`decide`](Self::decide) at each junction, dead end or landmark, perform the turn, walk to the next one, and tell it
/// what the walk was like: [`arrive`](Self::arrive), or [`turned_back`](Self::turned_back) where the decision said to give up.
///
/// Chance and the dictionary belong to the caller; whatever the robot meets, an exploration ends after at most
/// [`CpmConfig::most_traversals`].
#[derive(Clone, Debug)]
pub struct Explorer {
    config: CpmConfig,
    knowledge: Knowledge,
    traversals: u32,
    before_duplicate: Option<u32>,
    contradictions: u32,
}

/// What the robot knows of the maze, and where it is there.
#[derive(Clone, Debug)]
enum Knowledge {
    /// Offline and online: one map.
    Map(Mapper),
    /// [`Mapping::Hypotheses`].
    Beam(Beam),
}

impl Knowledge {
    fn new(mapping: Mapping, mapper: Mapper) -> Self {
        match mapping {
            Mapping::Hypotheses { width } => Self::Beam(Beam::new(mapper, width)),
            Mapping::Offline { .. } | Mapping::Online => Self::Map(mapper),
        }
    }

    fn mapper(&self) -> &Mapper {
        match self {
            Self::Map(mapper) => mapper,
            Self::Beam(beam) => beam.best(),
        }
    }

    fn map_mut(&mut self) -> &mut CpMap {
        match self {
            Self::Map(mapper) => &mut mapper.map,
            Self::Beam(beam) => beam.best_map_mut(),
        }
    }
}

/// What the robot wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// To be at a landmark: by the shortest known way if it is on the map, else by exploring.
    Find(Landmark),
    /// To have been through every port of the map ("the task is to obtain the complete map").
    Explore,
    /// To be at the start again, trying unknown ports that might make the way between start and goal shorter (section 6).
    WayBack,
    /// To be sure that no way between start and goal is shorter than the shortest of the map; ours.
    Shortest,
}

/// What to do at a junction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Turn and follow the path.
    Go(Leg),
    /// Nothing more to do for this aim.
    Done(Done),
}

/// One fragment to walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leg {
    /// Δ, to perform first.
    pub turn: Turn,
    /// The end of the fragment it enters, if that is on the map.
    pub known: Option<End>,
    /// After so many observations without an end of the fragment, turn round and come back; for ever on if none.
    pub give_up_after: Option<u32>,
}

/// Why there is nothing more to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// The aim is reached.
    Reached,
    /// All that can be reached was explored, and what was looked for is not there.
    NotThere,
    /// [`CpmConfig::most_traversals`] fragments were walked.
    OutOfPatience,
}

/// What an arrival taught.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// A fragment that was not on the map.
    New,
    /// A fragment that was on the map, and was walked from where the map has it.
    Known,
    /// A duplicate: it was on the map already, and the robot did not know that it was there. A loop is closed.
    Duplicate,
    /// A fragment that was not on the map, to a place that was: a loop is closed on arrival.
    Loop,
    /// Another way to understand all that was met has become the likeliest: the whole map may have changed.
    Revised,
    /// The map expected another place or fragment; the robot goes on with what it found, apart from the rest until it recognizes
    /// something.
    Contradiction,
}

/// Why an exploration cannot begin or a walk cannot be taken in. The map is as before.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CpmError {
    /// No way leads out of a place.
    #[error("a place without ports: a robot that came in can get out, so it has at least 1")]
    NoPorts,
    /// More ways lead out than any place has.
    #[error("a place of {degree} ports: more than {most} cannot be")]
    TooManyPorts {
        /// How many.
        degree: u32,
        /// How many there may be.
        most: u32,
    },
    /// The ways out were counted twice, and differently.
    #[error("{bearings} bearings of a place of {degree} ports: give one for each, or none at all")]
    Bearings {
        /// How many bearings there are.
        bearings: u32,
        /// How many ports.
        degree: u32,
    },
    /// The junction has no such turn.
    #[error(transparent)]
    Turn(#[from] NoSuchTurn),
    /// A pattern is not in the dictionary, or the map is another dictionary's.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
}

/// Of one junction.
pub(super) const MOST_PORTS: u32 = 1000;

impl Explorer {
    /// Begins at a place that ends fragments, as if the robot had come in by port 0: that of a dead end; else the first opening
    /// counter-clockwise from straight behind it.
    ///
    /// A robot that stands in mid-fragment drives on to the first such place before, as the paper has it.
    ///
    /// # Errors
    /// [`CpmError`] if the place has no ports.
    pub fn new(config: CpmConfig, start: Sighting) -> Result<Self, CpmError> {
        check(start)?;
        Ok(Self {
            config,
            knowledge: Knowledge::new(config.mapping, Mapper::new(start)),
            traversals: 0,
            before_duplicate: None,
            contradictions: 0,
        })
    }

    /// Goes on with a map that was learned before, at one of its ports.
    ///
    /// # Errors
    /// [`CpmError::Turn`] if the map has no such port.
    pub fn resume(config: CpmConfig, map: CpMap, at: Port) -> Result<Self, CpmError> {
        Turn::BACK.exit(at.number, map.degree(at.junction))?;
        Ok(Self {
            config,
            knowledge: Knowledge::new(config.mapping, Mapper { map, at }),
            traversals: 0,
            before_duplicate: None,
            contradictions: 0,
        })
    }

    /// The map as it is now. Offline it holds duplicates until it is [optimized](Self::optimize).
    #[must_use]
    pub fn map(&self) -> &CpMap {
        &self.knowledge.mapper().map
    }

    /// Where the robot is on the map: the port behind it.
    #[must_use]
    pub fn at(&self) -> Port {
        self.knowledge.mapper().at
    }

    /// How many fragments were walked to their end.
    #[must_use]
    pub const fn traversals(&self) -> u32 {
        self.traversals
    }

    /// n_p of Theorem 1: how many fragments were passed before one came again; none if none did.
    #[must_use]
    pub const fn before_duplicate(&self) -> Option<u32> {
        self.before_duplicate
    }

    /// How often the map was not what the robot found.
    #[must_use]
    pub const fn contradictions(&self) -> u32 {
        self.contradictions
    }

    /// What to do here. Asking changes nothing but the generator. O(fragments · log fragments); [`Aim::WayBack`] and
    /// [`Aim::Shortest`] junctions times that.
    pub fn decide(&self, aim: Aim, rng: &mut impl Rng) -> Decision {
        if let Some(done) = self.is_done(aim) {
            return Decision::Done(done);
        }
        if self.traversals >= self.config.most_traversals {
            return Decision::Done(Done::OutOfPatience);
        }
        let leg = match aim {
            Aim::Find(landmark) => self.towards(landmark).or_else(|| self.explore(rng)),
            Aim::Explore => self.explore(rng),
            Aim::WayBack => self.way_back(rng),
            Aim::Shortest => self.towards_helpful(rng),
        };
        match (leg, aim) {
            (Some(leg), _) => Decision::Go(leg),
            (None, Aim::Explore | Aim::Shortest) => Decision::Done(Done::Reached),
            (None, _) => Decision::Done(Done::NotThere),
        }
    }

    /// Takes in a walk: the turn that was performed, and what was met. O(fragments) comparisons.
    ///
    /// # Errors
    /// [`CpmError`]; the explorer is as before then.
    pub fn arrive(
        &mut self,
        turn: Turn,
        walk: &Traversal,
        dictionary: &Dictionary,
    ) -> Result<Arrival, CpmError> {
        check(walk.sighting)?;
        check_bearings(walk)?;
        dictionary.check(&walk.patterns)?;
        if let Some(version) = self.map().version() {
            dictionary.check_version(version)?;
        }
        let (arrival, came_again) = match &mut self.knowledge {
            Knowledge::Map(mapper) => {
                let is_online = self.config.mapping.looks_at_map(self.traversals);
                let arrival = reason(mapper, turn, walk, &self.config, is_online, dictionary)?;
                let came_again = matches!(arrival, Arrival::Known | Arrival::Duplicate);
                (arrival, came_again)
            }
            Knowledge::Beam(beam) => {
                match beam.walked(turn, walk, &self.config.comparison(dictionary))? {
                    Understood::As(belief) => (belief.into(), belief.came_again()),
                    Understood::Anew(belief) => (Arrival::Revised, belief.came_again()),
                    Understood::Not => (Arrival::Contradiction, false),
                }
            }
        };
        if came_again {
            self.before_duplicate.get_or_insert(self.traversals);
        }
        self.knowledge.map_mut().version = Some(dictionary.version());
        self.traversals += 1;
        if arrival == Arrival::Contradiction {
            self.contradictions += 1;
        }
        Ok(arrival)
    }

    /// The robot has turned round in an unknown fragment after so many observations, and is back at the junction it came from.
    ///
    /// # Errors
    /// [`CpmError::Turn`] if the junction has no such turn.
    pub fn turned_back(&mut self, turn: Turn, observations: u32) -> Result<(), CpmError> {
        match &mut self.knowledge {
            Knowledge::Map(mapper) => {
                let exit = mapper.exit(turn)?;
                mapper.came_back(exit, observations);
            }
            Knowledge::Beam(beam) => beam.turned_back(turn, observations)?,
        }
        self.traversals += 1;
        Ok(())
    }

    /// Merges all that is similar: the offline CPM's last step. With hypotheses similar is not the same, and nothing happens. Returns how many fragments were duplicates.
    /// O(fragments²) comparisons.
    ///
    /// # Errors
    /// [`CpmError::Dictionary`] if the map is another dictionary's.
    pub fn optimize(&mut self, dictionary: &Dictionary) -> Result<usize, CpmError> {
        if let Some(version) = self.map().version() {
            dictionary.check_version(version)?;
        }
        Ok(match &mut self.knowledge {
            Knowledge::Map(mapper) => mapper.optimize(&self.config.comparison(dictionary)),
            Knowledge::Beam(_) => 0,
        })
    }

    /// The shortest known way from here to a landmark; none if none is known.
    #[must_use]
    pub fn plan(&self, landmark: Landmark) -> Option<Plan> {
        self.map().plan(self.at(), |id| self.has(id, landmark))
    }

    /// The robot has been put at a place of the map, with this port behind it.
    ///
    /// # Errors
    /// [`CpmError::Turn`] if the map has no such port.
    pub fn place(&mut self, at: Port) -> Result<(), CpmError> {
        let degree = self.map().degree(at.junction);
        Turn::BACK.exit(at.number, degree)?;
        let map = self.map().clone();
        self.knowledge = Knowledge::new(self.config.mapping, Mapper { map, at });
        Ok(())
    }

    fn is_done(&self, aim: Aim) -> Option<Done> {
        let here = self.at().junction;
        let reached = match aim {
            Aim::Find(landmark) => self.has(here, landmark),
            Aim::WayBack => self.has(here, Landmark::Start),
            Aim::Explore | Aim::Shortest => false,
        };
        reached.then_some(Done::Reached)
    }

    fn has(&self, junction: JunctionId, landmark: Landmark) -> bool {
        let place = self.map().junction(junction);
        place.is_some_and(|place| place.landmark == Some(landmark))
    }

    /// The first leg of the shortest known way to a landmark.
    fn towards(&self, landmark: Landmark) -> Option<Leg> {
        self.first_leg(|id| self.has(id, landmark))
    }

    fn first_leg(&self, wanted: impl Fn(JunctionId) -> bool) -> Option<Leg> {
        let plan = self.map().plan(self.at(), wanted)?;
        let first = plan.legs.first()?;
        Some(Leg {
            turn: first.turn,
            known: Some(first.enter),
            give_up_after: None,
        })
    }

    fn explore(&self, rng: &mut impl Rng) -> Option<Leg> {
        if !self.config.mapping.looks_at_map(self.traversals) {
            return self.wander(rng);
        }
        let here = self.map().junction(self.at().junction)?;
        let open: Vec<u32> = here.open_ports().collect();
        // "1) If the current junction has some remaining unknown ports, it randomly chooses one and moves on."
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

    /// A port at random, but not the one behind; out of a dead end there is no other.
    fn wander(&self, rng: &mut impl Rng) -> Option<Leg> {
        let degree = self.map().junction(self.at().junction)?.degree();
        let turn = if degree == 1 {
            Turn::BACK
        } else {
            Turn(rng.random_range(1..degree))
        };
        let port = self.knowledge.mapper().exit(turn).ok()?;
        self.leg_to(port.number, None)
    }

    fn leg_to(&self, number: u32, give_up_after: Option<u32>) -> Option<Leg> {
        let at = self.at();
        let degree = self.map().junction(at.junction)?.degree();
        let port = Port { number, ..at };
        Some(Leg {
            turn: Turn::between(at.number, number, degree).ok()?,
            known: self.map().end_at(port),
            give_up_after,
        })
    }

    /// "Before the robot follows the map …, the robot tries to enter another different path-fragment … As long as the new
    /// path length is less than the old path length, the robot continues moving along the new path."
    fn way_back(&self, rng: &mut impl Rng) -> Option<Leg> {
        let home = self
            .map()
            .plan(self.at(), |id| self.has(id, Landmark::Start));
        // "It does not try the new path-fragment because the junction connects to A_s."
        let is_last = home.as_ref().is_some_and(|plan| plan.legs.len() == 1);
        if !is_last && let Some(leg) = self.shortcut(Landmark::Goal, rng) {
            return Some(leg);
        }
        match home {
            Some(_) => self.towards(Landmark::Start),
            // The start is not on the map; a robot that has not come from there has to look for it.
            None => self.explore(rng),
        }
    }

    /// An unknown port here that may lead to a shorter way between start and goal.
    fn shortcut(&self, from: Landmark, rng: &mut impl Rng) -> Option<Leg> {
        let here = self.at().junction;
        let room = self.room(here, from)?;
        let ports = (0..).zip(&self.map().junction(here)?.ports);
        let helpful: Vec<u32> = ports
            .filter(|(_, port)| matches!(port, PortState::Open { at_least } if *at_least < room))
            .map(|(number, _)| number)
            .collect();
        self.leg_to(choose(&helpful, rng)?, Some(room))
    }

    /// How many observations an unknown fragment at a junction has to stay below to shorten the way between start and goal, of
    /// which the part on this side of it begins at one of them; none if none can. Where no way is known, all may.
    fn room(&self, junction: JunctionId, from: Landmark) -> Option<u32> {
        let is_goal = |id| self.has(id, Landmark::Goal);
        // A start in a corridor may be on the map twice; the first is where the robot will be put again.
        let start = self.map().landmarks(Landmark::Start).next()?;
        let length = |from, wanted: &dyn Fn(JunctionId) -> bool| {
            let port = Port {
                junction: from,
                number: 0,
            };
            self.map().plan(port, wanted).map(|plan| plan.length)
        };
        let near = match from {
            Landmark::Goal => length(junction, &is_goal)?,
            _ => length(start, &|id| id == junction)?,
        };
        let known = length(start, &is_goal).unwrap_or(u32::MAX);
        known.checked_sub(near).filter(|room| *room > 1)
    }

    /// The nearest unknown port that may lead to a shorter way between start and goal.
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

/// Offline and online: on the one map there is, what is similar is the same.
fn reason(
    mapper: &mut Mapper,
    turn: Turn,
    walk: &Traversal,
    config: &CpmConfig,
    is_online: bool,
    dictionary: &Dictionary,
) -> Result<Arrival, NoSuchTurn> {
    let exit = mapper.exit(turn)?;
    let walked = mapper.walk(exit, walk, |map, known, sense| {
        !is_online || trusts(config, dictionary, map, walk, known, sense)
    });
    let (new, arrival) = match walked {
        Walked::Known => return Ok(Arrival::Known),
        Walked::New(new) => (new, Arrival::New),
        Walked::Contradicted(new) => (new, Arrival::Contradiction),
    };
    let merges = if is_online {
        mapper.unify_with_similar(new, &config.comparison(dictionary))
    } else {
        None
    };
    Ok(match (merges, arrival) {
        (Some(_), Arrival::New) => Arrival::Duplicate,
        _ => arrival,
    })
}

impl From<Belief> for Arrival {
    fn from(belief: Belief) -> Self {
        match belief {
            Belief::NewPlace => Self::New,
            Belief::NewWay => Self::Loop,
            Belief::Duplicate => Self::Duplicate,
            Belief::Known => Self::Known,
        }
    }
}

fn check(sighting: Sighting) -> Result<(), CpmError> {
    match sighting.degree {
        0 => Err(CpmError::NoPorts),
        degree if degree > MOST_PORTS => Err(CpmError::TooManyPorts {
            degree,
            most: MOST_PORTS,
        }),
        _ => Ok(()),
    }
}

fn check_bearings(walk: &Traversal) -> Result<(), CpmError> {
    let degree = walk.sighting.degree;
    match &walk.bearings {
        Some(bearings) if bearings.count() != degree => Err(CpmError::Bearings {
            bearings: bearings.count(),
            degree,
        }),
        _ => Ok(()),
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
