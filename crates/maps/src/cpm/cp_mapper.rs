use thiserror::Error;

use super::beam::{Beam, Understood};
use super::bearings::Bearings;
use super::config::{CpMapperConfig, Mapping};
use super::doubt::MapDoubt;
use super::map::{CpMap, Port};
use super::mapper::{Comparison, Mapper};
use super::pattern::{Dictionary, DictionaryError};
use super::plan::Plan;
use super::traversal::{Sighting, Traversal};
use super::turn::{NoSuchTurn, Turn};
use tolman_robot::Landmark;

/// Learns a [`CpMap`] from walks along its fragments: the "path-fragment representation" of layer
/// 3.
///
/// It also keeps the robot's place on the map. It does not choose where to go next.
#[derive(Clone, Debug)]
pub struct CpMapper {
    config: CpMapperConfig,
    knowledge: Knowledge,
    traversals: u32,
    before_duplicate: Option<u32>,
    contradictions: u32,
}

/// Knowledge of the maze, and the robot's place in it.
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

/// Result of an arrival for the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapUpdate {
    /// A fragment that was not on the map.
    New,
    /// A fragment that was on the map, walked from a place where the map has it.
    Known,
    /// A duplicate: the fragment was on the map, and the robot did not know that it was there. A
    /// loop is closed.
    Duplicate,
    /// A fragment that was not on the map, to a place that was: a loop is closed on arrival.
    Loop,
    /// Another explanation of all observations has become the likeliest: the whole map may have
    /// changed.
    Revised,
    /// The map expected another place or fragment. The robot adds what it found, separate from the
    /// rest until it recognizes something.
    Contradiction,
}

impl MapUpdate {
    /// Returns whether the fragment had been walked before.
    const fn came_again(self) -> bool {
        matches!(self, Self::Known | Self::Duplicate)
    }
}

/// Reason why an exploration cannot begin or a walk cannot be taken in. The map is as before.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CpmError {
    /// No way leads out of a place.
    #[error("the place has no ports; give at least 1, by which the robot came in")]
    NoPorts,
    /// More ways lead out of a place than any has.
    #[error("the place has {degree} ports; give at most {most}")]
    TooManyPorts {
        /// Number of ports.
        degree: u32,
        /// Maximum number of ports.
        most: u32,
    },
    /// The place's ways were counted twice with different results.
    #[error(
        "the place has {degree} ports but {bearings} bearings; give one for each port, or none"
    )]
    Bearings {
        /// Number of bearings.
        bearings: u32,
        /// Number of ports.
        degree: u32,
    },
    /// The junction has no such turn.
    #[error(transparent)]
    Turn(#[from] NoSuchTurn),
    /// A pattern is not in the dictionary, or the map uses another dictionary.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
}

/// Probability below which a map is doubtful.
const SURE: f64 = 0.5;

/// Maximum number of ports of a junction.
pub(super) const MOST_PORTS: u32 = 1000;

impl CpMapper {
    /// Starts at a place that ends fragments, as if the robot had come in by port 0. At a dead end,
    /// port 0 is the only one; elsewhere it is the first opening counter-clockwise from straight
    /// behind.
    ///
    /// A robot that stands in mid-fragment drives on to the first such place before, as in the
    /// paper.
    ///
    /// # Errors
    /// [`CpmError`] if the place has no ports.
    pub fn new(config: CpMapperConfig, start: Sighting) -> Result<Self, CpmError> {
        check(start, None)?;
        Ok(Self::of(config, Mapper::new(start)))
    }

    /// Continues with a map that was learned before, at one of its ports.
    ///
    /// # Errors
    /// [`CpmError::Turn`] if the map has no such port.
    pub fn resume(config: CpMapperConfig, map: CpMap, at: Port) -> Result<Self, CpmError> {
        Turn::BACK.exit(at.number, map.degree(at.junction))?;
        Ok(Self::of(config, Mapper { map, at }))
    }

    fn of(config: CpMapperConfig, mapper: Mapper) -> Self {
        Self {
            config,
            knowledge: Knowledge::new(config.mapping, mapper),
            traversals: 0,
            before_duplicate: None,
            contradictions: 0,
        }
    }

    /// Returns the map as it is now. Offline it holds duplicates until it is
    /// [optimized](Self::optimize).
    #[must_use]
    pub fn map(&self) -> &CpMap {
        &self.knowledge.mapper().map
    }

    /// Returns the robot's place on the map: the port behind it.
    #[must_use]
    pub fn at(&self) -> Port {
        self.knowledge.mapper().at
    }

    /// Returns the probability of the map, 0 to 1, among all maps that explain the observations.
    /// Places are at least `apart` m apart. It follows from dead reckoning and from the fragments'
    /// patterns. `None` for a mapper that keeps one hypothesis. O(width · places² · ports).
    #[must_use]
    pub fn certainty(&self, apart: f64) -> Option<f64> {
        match &self.knowledge {
            Knowledge::Map(_) => None,
            Knowledge::Beam(beam) => Some(beam.certainty(apart)),
        }
    }

    /// Returns the reason not to trust the map in a world whose places are at least `apart` m
    /// apart. `None` if nothing contradicts it, and for a mapper that keeps one hypothesis, which
    /// cannot tell. Complexity as [`certainty`](Self::certainty).
    #[must_use]
    pub fn doubt(&self, apart: f64) -> Option<MapDoubt> {
        let certainty = self.certainty(apart)?;
        let doubt = self.map().doubt(self.at().junction, apart);
        let percent = 100.0 * certainty;
        doubt.or_else(|| (certainty < SURE).then_some(MapDoubt::Unsure { percent }))
    }

    /// Returns the number of fragments that were walked to their end.
    #[must_use]
    pub const fn traversals(&self) -> u32 {
        self.traversals
    }

    /// Returns n_p of Theorem 1, the number of fragments passed before one was met again, or `None`
    /// if none was.
    #[must_use]
    pub const fn before_duplicate(&self) -> Option<u32> {
        self.before_duplicate
    }

    /// Returns the number of times that the map contradicted the robot's observations.
    #[must_use]
    pub const fn contradictions(&self) -> u32 {
        self.contradictions
    }

    /// Takes in a walk: the turn that was performed, and what the robot observed. O(fragments)
    /// comparisons.
    ///
    /// # Errors
    /// [`CpmError`]; the explorer is as before then.
    pub fn arrive(
        &mut self,
        turn: Turn,
        walk: &Traversal,
        dictionary: &Dictionary,
    ) -> Result<MapUpdate, CpmError> {
        check(walk.sighting, walk.bearings.as_ref())?;
        dictionary.check(&walk.patterns)?;
        self.map().check(dictionary)?;
        let judge = self.config.comparison(dictionary);
        let (arrival, came_again) = match &mut self.knowledge {
            Knowledge::Map(mapper) => {
                let is_online = self.config.mapping.looks_at_map(self.traversals);
                let arrival = reason(mapper, turn, walk, is_online.then_some(&judge))?;
                (arrival, arrival.came_again())
            }
            Knowledge::Beam(beam) => match beam.walked(turn, walk, &judge)? {
                Understood::As(arrival) => (arrival, arrival.came_again()),
                Understood::Anew(arrival) => (MapUpdate::Revised, arrival.came_again()),
                Understood::Not => (MapUpdate::Contradiction, false),
            },
        };
        if came_again {
            self.before_duplicate.get_or_insert(self.traversals);
        }
        self.knowledge.map_mut().version = Some(dictionary.version());
        self.traversals += 1;
        if arrival == MapUpdate::Contradiction {
            self.contradictions += 1;
        }
        Ok(arrival)
    }

    /// Notes that the robot has turned round in an unknown fragment after `observations`
    /// observations, and is back at the junction it came from.
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

    /// Merges all similar fragments: the last step of offline CPM. Returns the number of
    /// duplicates. With hypotheses, similar fragments may differ, so nothing happens. O(fragments²)
    /// comparisons.
    ///
    /// # Errors
    /// [`CpmError::Dictionary`] if the map is another dictionary's.
    pub fn optimize(&mut self, dictionary: &Dictionary) -> Result<usize, CpmError> {
        self.map().check(dictionary)?;
        Ok(match &mut self.knowledge {
            Knowledge::Map(mapper) => mapper.optimize(&self.config.comparison(dictionary)),
            Knowledge::Beam(_) => 0,
        })
    }

    /// Returns whether the map is optimized now, so that looking at it helps. Offline CPM does not
    /// look until its patience ends.
    #[must_use]
    pub const fn looks_at_map(&self) -> bool {
        self.config.mapping.looks_at_map(self.traversals)
    }

    /// Returns the shortest known way from here to a landmark, or `None` if none is known.
    #[must_use]
    pub fn plan(&self, landmark: Landmark) -> Option<Plan> {
        let map = self.map();
        map.plan(self.at(), |id| map.has(id, landmark))
    }

    /// Takes in that the robot was put at a place of the map, with port `at` behind it.
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
}

/// Takes a walk into the only map, offline and online. Online, similar fragments are one; offline
/// compares nothing.
fn reason(
    mapper: &mut Mapper,
    turn: Turn,
    walk: &Traversal,
    judge: Option<&Comparison<'_>>,
) -> Result<MapUpdate, NoSuchTurn> {
    let exit = mapper.exit(turn)?;
    let is_filled = mapper.map.end_at(exit).is_some();
    if mapper.follow(exit, walk, judge) {
        return Ok(MapUpdate::Known);
    }
    let new = if is_filled {
        mapper.go_adrift(exit, walk)
    } else {
        mapper.append(exit, walk)
    };
    let merges = judge.and_then(|judge| mapper.unify_with_similar(new, judge));
    Ok(match merges {
        _ if is_filled => MapUpdate::Contradiction,
        Some(_) => MapUpdate::Duplicate,
        None => MapUpdate::New,
    })
}

fn check(sighting: Sighting, bearings: Option<&Bearings>) -> Result<(), CpmError> {
    let (degree, most) = (sighting.degree, MOST_PORTS);
    match bearings.map(Bearings::count) {
        _ if degree == 0 => Err(CpmError::NoPorts),
        _ if degree > most => Err(CpmError::TooManyPorts { degree, most }),
        Some(bearings) if bearings != degree => Err(CpmError::Bearings { bearings, degree }),
        _ => Ok(()),
    }
}
