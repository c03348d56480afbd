//! Mazes of corridors and junctions without a robot: layer 3's view of a maze, true or noisy, in
//! microseconds.
//!
//! A [`PlaneMaze`] is a plane graph. Its places have positions, and ports in the order of the
//! corridors' bearings. Its corridors look from each end like a sequence of common patterns. A
//! [`PlaneWalker`] walks it and reports what an e-puck's lower layers would, with [`WalkerNoise`].
//! The world tells whether a map is [right](PlaneMaze::check), and the length of the
//! [shortest walk](PlaneMaze::covering_walk) through all corridors.

mod check;
mod generate;
mod rover;

use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::{Heading, Point};

pub(crate) use check::MapCheck;
pub(crate) use generate::{Likeness, MazeConfig, MazeConfigError};
pub(crate) use rover::{PlaneWalker, Reckoning, WalkOutcome, WalkerNoise};

use tolman_arena::cpm::covering_walk;
use tolman_maps::cpm::{Dictionary, DictionaryError, PatternId, Sighting, Sign};
use tolman_planners::Graph;
use tolman_robot::Landmark;

/// A maze as a plane graph. Its places and corridors are numbered from 0.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlaneMaze {
    dictionary: Dictionary,
    places: Vec<MazePlace>,
    corridors: Vec<MazeCorridor>,
    start: WorldPort,
}

/// A junction, a dead end or a landmark in a corridor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MazePlace {
    /// Position, m.
    pub(crate) position: Point,
    /// The landmark of the place; `None` without one.
    pub(crate) landmark: Option<Landmark>,
    /// Ends of corridors at the place, counter-clockwise.
    pub(crate) ports: Vec<CorridorEnd>,
}

/// One end of a corridor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct CorridorEnd {
    /// Number of the corridor.
    pub(crate) corridor: u32,
    /// Sign of the end: *minus* where the corridor's drawing began.
    pub(crate) sign: Sign,
}

/// A port of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct WorldPort {
    /// Number of the place.
    pub(crate) place: u32,
    /// Number of the port at its place, counter-clockwise from 0.
    pub(crate) number: u32,
}

/// A path fragment as it truly is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MazeCorridor {
    /// Patterns observed from − to +.
    pub(crate) patterns: Vec<PatternId>,
    /// Middle line of the corridor, from − to +, both places included, m.
    pub(crate) line: Vec<Point>,
    /// Port at the − end of the corridor.
    pub(crate) minus: WorldPort,
    /// Port at the + end of the corridor.
    pub(crate) plus: WorldPort,
}

impl MazeCorridor {
    /// Returns the port of an end.
    #[must_use]
    pub(crate) const fn port(&self, sign: Sign) -> WorldPort {
        match sign {
            Sign::Minus => self.minus,
            Sign::Plus => self.plus,
        }
    }

    const fn port_mut(&mut self, sign: Sign) -> &mut WorldPort {
        match sign {
            Sign::Minus => &mut self.minus,
            Sign::Plus => &mut self.plus,
        }
    }

    /// Returns the direction in which a robot leaves by an end.
    #[must_use]
    pub(crate) fn bearing(&self, sign: Sign) -> Heading {
        match (sign, self.line.as_slice()) {
            (Sign::Minus, [here, next, ..]) => Heading::of(*next - *here),
            (Sign::Plus, [.., next, here]) => Heading::of(*next - *here),
            _ => Heading::EAST,
        }
    }
}

/// Draws a world: places, then the corridors between them.
#[derive(Clone, Debug)]
pub(crate) struct WorldBuilder {
    dictionary: Dictionary,
    places: Vec<MazePlace>,
    corridors: Vec<MazeCorridor>,
}

/// Reason why a drawing is not a valid world.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub(crate) enum PlaneMazeError {
    /// A place with this number does not exist.
    #[error("place {place} does not exist, there are {count}: add it first")]
    NoSuchPlace {
        /// Number of the place.
        place: u32,
        /// Number of places in the drawing.
        count: u32,
    },
    /// No corridor leads to a place.
    #[error("no corridor leads to place {place}: draw one, or leave it out")]
    Isolated {
        /// Number of the place.
        place: u32,
    },
    /// A point of a corridor or place is NaN or infinite.
    #[error("corridor {corridor} has a point that is not finite; give finite numbers")]
    NotFinite {
        /// The corridor's number.
        corridor: u32,
    },
    /// A pattern is not in the dictionary.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
}

impl WorldBuilder {
    /// Returns an empty sheet.
    #[must_use]
    pub(crate) const fn new(dictionary: Dictionary) -> Self {
        Self {
            dictionary,
            places: Vec::new(),
            corridors: Vec::new(),
        }
    }

    /// Adds a place and returns its number.
    pub(crate) fn place(&mut self, position: Point, landmark: Option<Landmark>) -> u32 {
        self.places.push(MazePlace {
            position,
            landmark,
            ports: Vec::new(),
        });
        self.places.len() as u32 - 1
    }

    /// Adds a corridor from a place to another, or back to the same, over the points `via`, and
    /// returns its number. `patterns` are observed along it.
    ///
    /// # Errors
    /// [`PlaneMazeError`] if a place does not exist, a point is not finite, or a pattern is not in
    /// the dictionary.
    pub(crate) fn corridor(
        &mut self,
        minus: u32,
        plus: u32,
        via: &[Point],
        patterns: &[PatternId],
    ) -> Result<u32, PlaneMazeError> {
        let count = self.places.len() as u32;
        let number = self.corridors.len() as u32;
        self.dictionary.check(patterns)?;
        let mut line = Vec::with_capacity(via.len() + 2);
        for place in [minus, plus] {
            let end = self.places.get(place as usize);
            line.push(
                end.ok_or(PlaneMazeError::NoSuchPlace { place, count })?
                    .position,
            );
        }
        line.splice(1..1, via.iter().copied());
        if line
            .iter()
            .any(|point| !(point.x.is_finite() && point.y.is_finite()))
        {
            return Err(PlaneMazeError::NotFinite { corridor: number });
        }
        for (place, sign) in [(minus, Sign::Minus), (plus, Sign::Plus)] {
            let corridor = number;
            let ports = &mut self.places[place as usize].ports;
            ports.push(CorridorEnd { corridor, sign });
        }
        let unnumbered = |place| WorldPort { place, number: 0 };
        self.corridors.push(MazeCorridor {
            patterns: patterns.to_vec(),
            line,
            minus: unnumbered(minus),
            plus: unnumbered(plus),
        });
        Ok(number)
    }

    /// Returns the world, with ports in the order of their bearings, and a robot that will start at
    /// a place with port 0 behind it.
    ///
    /// # Errors
    /// [`PlaneMazeError`] if no corridor leads to a place, or the start is not one.
    pub(crate) fn finish(self, start: u32) -> Result<PlaneMaze, PlaneMazeError> {
        let Self {
            dictionary,
            mut places,
            mut corridors,
        } = self;
        let count = places.len() as u32;
        if start >= count {
            let place = start;
            return Err(PlaneMazeError::NoSuchPlace { place, count });
        }
        for (number, place) in (0..).zip(&mut places) {
            if place.ports.is_empty() {
                return Err(PlaneMazeError::Isolated { place: number });
            }
            let corridor = |end: &CorridorEnd| &corridors[end.corridor as usize];
            let bearing = |end: &CorridorEnd| corridor(end).bearing(end.sign).radians();
            place
                .ports
                .sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
            for (port, end) in (0..).zip(&place.ports) {
                corridors[end.corridor as usize].port_mut(end.sign).number = port;
            }
        }
        Ok(PlaneMaze {
            dictionary,
            places,
            corridors,
            start: WorldPort {
                place: start,
                number: 0,
            },
        })
    }
}

impl PlaneMaze {
    /// Returns the common patterns of its corridors.
    #[must_use]
    pub(crate) const fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }

    /// Returns the places by number.
    #[must_use]
    pub(crate) fn places(&self) -> &[MazePlace] {
        &self.places
    }

    /// Returns the corridors by number.
    #[must_use]
    pub(crate) fn corridors(&self) -> &[MazeCorridor] {
        &self.corridors
    }

    /// Returns the port at which the robot starts.
    #[must_use]
    pub(crate) const fn start(&self) -> WorldPort {
        self.start
    }

    /// Returns the sighting of a place; a place that does not exist looks like a dead end.
    #[must_use]
    pub(crate) fn sighting(&self, place: u32) -> Sighting {
        match self.places.get(place as usize) {
            Some(place) => Sighting {
                degree: place.ports.len() as u32,
                landmark: place.landmark,
            },
            None => Sighting::plain(1),
        }
    }

    /// Returns the corridor's end at a port, or `None` if there is no such port.
    #[must_use]
    pub(crate) fn end_at(&self, port: WorldPort) -> Option<CorridorEnd> {
        let place = self.places.get(port.place as usize)?;
        place.ports.get(port.number as usize).copied()
    }

    /// Returns the port at which a robot arrives if it leaves by `port`. `None` if there is no such
    /// port.
    #[must_use]
    pub(crate) fn beyond(&self, port: WorldPort) -> Option<WorldPort> {
        let end = self.end_at(port)?;
        let corridor = self.corridors.get(end.corridor as usize)?;
        Some(corridor.port(end.sign.opposite()))
    }

    /// Returns the number of corridors of the [shortest walk](covering_walk) from the start through
    /// all that can be reached.
    #[must_use]
    pub(crate) fn covering_walk(&self) -> Option<u32> {
        covering_walk(self, self.start.place)
    }
}

/// Graph of a world's places, with an arc from each to its neighbours along corridors.
impl Graph for PlaneMaze {
    fn node_count(&self) -> usize {
        self.places.len()
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for number in 0..self.sighting(node).degree {
            let port = WorldPort {
                place: node,
                number,
            };
            if let Some(beyond) = self.beyond(port) {
                visit(beyond.place, 1);
            }
        }
    }
}
