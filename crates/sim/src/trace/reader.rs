// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use std::io::{BufRead, Lines};

use serde::de::DeserializeOwned;
use tolman_geom::Pose;

use super::lines::{FORMAT, Header, VERSION};
use super::{Recordable, ReplayError, TraceLine};
use crate::World;
use crate::world::Head;

/// Reads a trace line by line, without simulating anything. It gives the lines that
/// [`replay`](super::replay) compares, for showing a run without repeating it.
///
/// The lines of a tick must be one per robot in order. Memory: one line.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_robot::TurnTranslate;
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
/// use tolman_sim::trace::{Detail, Reader, Recording, TraceLine};
/// use tolman_sim::{WallSegment, World};
///
/// let wall = WallSegment::between(Point::new(3.0, -2.0), Point::new(3.0, 2.0));
/// let world = World::from_segments(vec![wall])?;
/// let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?;
/// let start = Pose::new(Point::origin(), Heading::EAST);
/// let mut file = Vec::new();
/// let mut recording = Recording::start(world, 7, vec![(robot, start)], &mut file, Detail::Poses)?;
/// recording.step(&[TurnTranslate { turn: 0.0, translate: 0.5 }])?;
/// recording.finish()?;
///
/// let mut trace = Reader::<LaserPioneer, _>::open(file.as_slice())?;
/// assert_eq!(trace.seed(), 7);
/// let (_, event) = trace.next().unwrap()?;
/// assert!(matches!(event, TraceLine::Step(step) if !step.bump && step.tick == 1));
/// assert!(trace.next().is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Reader<M: Recordable, R> {
    lines: Lines<R>,
    /// The number of the last line read, from 1.
    line: usize,
    world: World,
    header: Header<M>,
    /// Tick in progress, and the number of its lines read so far.
    tick: u64,
    read: usize,
}

impl<M: Recordable, R: BufRead> Reader<M, R> {
    /// Reads the first line.
    ///
    /// # Errors
    /// If it is not the first line of a trace of such robots.
    pub fn open(trace: R) -> Result<Self, ReplayError> {
        let mut lines = trace.lines();
        let first = lines.next().ok_or(ReplayError::Empty)??;
        let head: Head = parse(&first, 1)?;
        if head.format != FORMAT {
            return Err(ReplayError::Format { found: head.format });
        }
        if head.version != VERSION {
            return Err(ReplayError::Version {
                found: head.version,
            });
        }
        let header: Header<M> = parse(&first, 1)?;
        if header.step_us == 0 {
            let source = "`step_us`, the length of a step, is 0; record the trace again".into();
            return Err(ReplayError::Refused { line: 1, source });
        }
        let world = World::from_json(&header.world.to_string())?;
        Ok(Self {
            lines,
            line: 1,
            world,
            header,
            tick: 0,
            read: 0,
        })
    }

    /// Returns the world of the trace.
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// Returns the seed of all random numbers.
    pub const fn seed(&self) -> u64 {
        self.header.seed
    }

    /// Returns the length of a time step, µs.
    pub const fn step_us(&self) -> u64 {
        self.header.step_us
    }

    /// Returns the configuration and the first pose of each robot.
    pub fn robots(&self) -> impl ExactSizeIterator<Item = (&M::Config, Pose)> {
        self.header
            .robots
            .iter()
            .map(|start| (&start.config, start.pose))
    }

    /// Returns the names of the disturbances of each robot from outside its configuration: see
    /// [`Recordable::disturbances`].
    pub fn disturbances(&self) -> impl ExactSizeIterator<Item = &[String]> {
        let robots = self.header.robots.iter();
        robots.map(|start| start.disturbances.as_slice())
    }

    /// Checks that a line stands where it may.
    fn in_order(&mut self, event: &TraceLine<M>) -> Result<(), ReplayError> {
        let robots = self.header.robots.len();
        match event {
            TraceLine::Step(step) => {
                if self.read == robots || self.tick == 0 {
                    (self.tick, self.read) = (self.tick + 1, 0);
                }
                if (step.robot.0 as usize, step.tick) != (self.read, self.tick) {
                    return Err(self.disorder());
                }
                self.read += 1;
                Ok(())
            }
            TraceLine::Place { .. } if self.is_within_a_tick() => Err(self.disorder()),
            TraceLine::Place { .. } | TraceLine::Door { .. } => Ok(()),
        }
    }

    fn is_within_a_tick(&self) -> bool {
        self.tick > 0 && self.read < self.header.robots.len()
    }

    fn disorder(&self) -> ReplayError {
        ReplayError::Order {
            line: self.line,
            robot: self.read,
            tick: self.tick,
        }
    }
}

impl<M: Recordable, R: BufRead> Iterator for Reader<M, R> {
    /// Number of a line, from 1, with its contents.
    type Item = Result<(usize, TraceLine<M>), ReplayError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.line += 1;
        let text = match self.lines.next() {
            Some(Ok(text)) => text,
            Some(Err(error)) => return Some(Err(error.into())),
            None if self.is_within_a_tick() => {
                let error = self.disorder();
                // Said once; after that there is nothing more.
                self.read = self.header.robots.len();
                return Some(Err(error));
            }
            None => return None,
        };
        let event = parse::<TraceLine<M>>(&text, self.line);
        let event = event.and_then(|event| self.in_order(&event).map(|()| event));
        Some(event.map(|event| (self.line, event)))
    }
}

fn parse<T: DeserializeOwned>(text: &str, line: usize) -> Result<T, ReplayError> {
    serde_json::from_str(text).map_err(|error| ReplayError::of_line(line, &error))
}
