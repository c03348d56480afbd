//! Mazes of corridors and junctions without a robot: layer 3's view of a maze, true or noisy, in
//! microseconds.
//!
//! A [`PlaneMaze`] is a plane graph. Its places have positions, and ports in the order of the
//! corridors' bearings. Its corridors look from each end like a sequence of common patterns. A
//! [`PlaneWalker`] walks it and reports what an e-puck's lower layers would, with [`WalkerNoise`].
//! The world tells whether a map is [right](PlaneMaze::check), and the length of the
//! [shortest walk](PlaneMaze::shortest_covering_walk) through all corridors.

mod check;
mod generate;
mod postman;
mod rover;

use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::{Heading, Point};

pub use check::MapCheck;
pub use generate::{Likeness, MazeConfig, MazeConfigError};
pub(super) use postman::shortest_covering_walk;
pub use rover::{PlaneWalker, Reckoning, WalkOutcome, WalkerNoise};

use tolman_maps::cpm::{Dictionary, DictionaryError, PatternId, Sighting, Sign};
use tolman_robot::Landmark;

/// A maze as a plane graph. Its places and corridors are numbered from 0.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneMaze {
    dictionary: Dictionary,
    places: Vec<MazePlace>,
    corridors: Vec<MazeCorridor>,
    start: WorldPort,
}

/// A junction, a dead end or a landmark in a corridor.
#[derive(Clone, Debug, PartialEq)]
pub struct MazePlace {
    /// Position, m.
    pub position: Point,
    /// The landmark of the place; `None` without one.
    pub landmark: Option<Landmark>,
    /// Ends of corridors at the place, counter-clockwise.
    pub ports: Vec<CorridorEnd>,
}

/// One end of a corridor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CorridorEnd {
    /// Number of the corridor.
    pub corridor: u32,
    /// Sign of the end: *minus* where the corridor's drawing began.
    pub sign: Sign,
}

/// A port of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct WorldPort {
    /// Number of the place.
    pub place: u32,
    /// Number of the port at its place, counter-clockwise from 0.
    pub number: u32,
}

/// A path fragment as it truly is.
#[derive(Clone, Debug, PartialEq)]
pub struct MazeCorridor {
    /// Patterns observed from − to +.
    pub patterns: Vec<PatternId>,
    /// Middle line of the corridor, from − to +, both places included, m.
    pub line: Vec<Point>,
    /// Port at the − end of the corridor.
    pub minus: WorldPort,
    /// Port at the + end of the corridor.
    pub plus: WorldPort,
}

impl MazeCorridor {
    /// Returns the port of an end.
    #[must_use]
    pub const fn port(&self, sign: Sign) -> WorldPort {
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
    pub fn bearing(&self, sign: Sign) -> Heading {
        match (sign, self.line.as_slice()) {
            (Sign::Minus, [here, next, ..]) => Heading::of(*next - *here),
            (Sign::Plus, [.., next, here]) => Heading::of(*next - *here),
            _ => Heading::EAST,
        }
    }
}

/// Draws a world: places, then the corridors between them.
///
/// ```
/// use tolman_geom::Point;
/// use tolman_maps::cpm::{Dictionary, PatternId, Turn};
/// use tolman_robot::Landmark;
/// use tolman_arena::cpm::world::{PlaneWalker, Reckoning, WalkOutcome, WalkerNoise, WorldBuilder};
///
/// let mut dictionary = Dictionary::new(1);
/// let wall = dictionary.learn(&[0.0], &[0.0], 0.1)?;
/// let door = dictionary.learn(&[1.0], &[1.0], 0.1)?;
/// // A dead end in the west, from which a corridor leads to a fork.
/// let mut drawing = WorldBuilder::new(dictionary);
/// let west = drawing.place(Point::new(0.0, 0.0), Some(Landmark::Start));
/// let fork = drawing.place(Point::new(1.0, 0.0), None);
/// let north = drawing.place(Point::new(1.0, 1.0), None);
/// let goal = drawing.place(Point::new(1.0, -1.0), Some(Landmark::Goal));
/// drawing.corridor(west, fork, &[], &[wall, wall, door])?;
/// drawing.corridor(fork, north, &[], &[wall, door])?;
/// drawing.corridor(fork, goal, &[], &[door])?;
/// let world = drawing.finish(west)?;
///
/// let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
/// let mut rng = rand_chacha::ChaCha8Rng::from_seed([0; 32]);
/// let WalkOutcome::Arrived(walk) = rover.go(Turn::BACK, None, &mut rng)? else { panic!() };
/// assert_eq!(walk.patterns, [wall, wall, door]);
/// assert_eq!(walk.sighting.degree, 3);
/// // Counter-clockwise from the way it came, the first port is the right hand one.
/// rover.go(Turn(1), None, &mut rng)?;
/// assert_eq!(rover.sighting().landmark, Some(Landmark::Goal));
/// # use rand::SeedableRng;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct WorldBuilder {
    dictionary: Dictionary,
    places: Vec<MazePlace>,
    corridors: Vec<MazeCorridor>,
}

/// Reason why a drawing is not a valid world.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlaneMazeError {
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
    pub const fn new(dictionary: Dictionary) -> Self {
        Self {
            dictionary,
            places: Vec::new(),
            corridors: Vec::new(),
        }
    }

    /// Adds a place and returns its number.
    pub fn place(&mut self, position: Point, landmark: Option<Landmark>) -> u32 {
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
    pub fn corridor(
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
    pub fn finish(self, start: u32) -> Result<PlaneMaze, PlaneMazeError> {
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
    pub const fn dictionary(&self) -> &Dictionary {
        &self.dictionary
    }

    /// Returns the places by number.
    #[must_use]
    pub fn places(&self) -> &[MazePlace] {
        &self.places
    }

    /// Returns the corridors by number.
    #[must_use]
    pub fn corridors(&self) -> &[MazeCorridor] {
        &self.corridors
    }

    /// Returns the port at which the robot starts.
    #[must_use]
    pub const fn start(&self) -> WorldPort {
        self.start
    }

    /// Returns the sighting of a place; a place that does not exist looks like a dead end.
    #[must_use]
    pub fn sighting(&self, place: u32) -> Sighting {
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
    pub fn end_at(&self, port: WorldPort) -> Option<CorridorEnd> {
        let place = self.places.get(port.place as usize)?;
        place.ports.get(port.number as usize).copied()
    }

    /// Returns the port at which a robot arrives if it leaves by `port`. `None` if there is no such
    /// port.
    #[must_use]
    pub fn beyond(&self, port: WorldPort) -> Option<WorldPort> {
        let end = self.end_at(port)?;
        let corridor = self.corridors.get(end.corridor as usize)?;
        Some(corridor.port(end.sign.opposite()))
    }
}
