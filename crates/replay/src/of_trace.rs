//! Makes replays of traces.

use core::fmt;
use std::io::BufRead;

use thiserror::Error;
use tolman_geom::Pose;
use tolman_robot::epuck::{MOST_WHEEL_SPEED, WheelSpeeds};
use tolman_robot::{Ring, TurnTranslate};
use tolman_sim::robots::{
    CameraPioneer, CameraPioneerConfig, Epuck, LaserPioneer, LaserPioneerConfig, Pioneer2dx,
};
use tolman_sim::trace::{Reader, Recordable, ReplayError, TraceLine};
use tolman_sim::{DoorEvent, DoorState, World};

use super::difference::{Difference, first_difference};
use super::floor::Floor;
use super::{DoorChange, Fact, Mark, Marks, Replay, RobotTrack, Scenery, SceneryDoor, TimeSeries};

/// A kind of robot that replays can show. It adds the sensor and the commands to the body.
pub trait Portrait: Recordable {
    /// Returns the robot's range sensor, or `None` if the robot has none.
    fn ring(_config: &Self::Config) -> Option<Ring> {
        None
    }

    /// Returns the named parts of a command, as shares of their full rates.
    fn parts(command: &Self::Command) -> Vec<(&'static str, f64)>;
}

impl Portrait for LaserPioneer {
    fn ring(config: &LaserPioneerConfig) -> Option<Ring> {
        Some(config.ring)
    }

    fn parts(command: &TurnTranslate) -> Vec<(&'static str, f64)> {
        vec![("turn", command.turn), ("translate", command.translate)]
    }
}

impl Portrait for CameraPioneer {
    fn ring(config: &CameraPioneerConfig) -> Option<Ring> {
        Some(config.pioneer.ring)
    }

    fn parts(command: &TurnTranslate) -> Vec<(&'static str, f64)> {
        LaserPioneer::parts(command)
    }
}

impl Portrait for Pioneer2dx {
    fn parts(command: &TurnTranslate) -> Vec<(&'static str, f64)> {
        LaserPioneer::parts(command)
    }
}

impl Portrait for Epuck {
    fn parts(command: &WheelSpeeds) -> Vec<(&'static str, f64)> {
        let share = |speed: f64| speed / MOST_WHEEL_SPEED;
        vec![
            ("left wheel", share(command.left)),
            ("right wheel", share(command.right)),
        ]
    }
}

/// A trace in memory: the parts that a replay shows, and that are compared with other traces.
#[derive(Debug)]
pub struct Trace<M: Recordable> {
    /// Name of the trace.
    pub name: String,
    world: World,
    seed: u64,
    step_us: u64,
    /// Text of the world in the trace, for comparison.
    world_text: String,
    robots: Vec<RobotTrace<M>>,
    doors: Vec<(u32, String, DoorState)>,
}

/// One robot of a trace.
#[derive(Debug)]
pub(super) struct RobotTrace<M: Recordable> {
    config: M::Config,
    /// Poses; one more than there are commands.
    pub(super) poses: Vec<Pose>,
    pub(super) commands: Vec<M::Command>,
    /// Whether each command ended in a bump.
    pub(super) bumps: Vec<bool>,
    /// Numbers of the steps after which the robot was lifted.
    lifts: Vec<u32>,
}

/// Reason why traces cannot be shown together.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CompareError {
    /// No trace was given.
    #[error("there is no trace to show; give at least one")]
    None,
    /// The traces are from different worlds.
    #[error(
        "{second} was recorded in another world than {first}; give traces of the same world, or replay each by itself"
    )]
    Worlds {
        /// Name of the first trace.
        first: String,
        /// Name of the trace that differs from the first.
        second: String,
    },
    /// The time steps have different lengths.
    #[error(
        "the time steps of {second} last {second_us} µs, those of {first} {first_us} µs; replay each by itself"
    )]
    Steps {
        /// Name of the first trace.
        first: String,
        /// Time step of the first trace, µs.
        first_us: u64,
        /// Name of the trace that differs from the first.
        second: String,
        /// Time step of the second trace, µs.
        second_us: u64,
    },
    /// The robot of a trace cannot be built again.
    #[error("{trace}: robot {robot} cannot be built; record the trace again")]
    Robot {
        /// Name of the trace.
        trace: String,
        /// Index of the robot, from 0.
        robot: usize,
        /// Reason why the robot cannot be built.
        source: Box<dyn core::error::Error + Send + Sync>,
    },
}

/// Comparison of a trace with the first one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceComparison {
    /// Name of the first trace.
    pub first: String,
    /// Name of the other trace.
    pub second: String,
    /// First difference, or `None` if they are the same bit for bit.
    pub difference: Option<Difference>,
}

impl fmt::Display for TraceComparison {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { first, second, .. } = self;
        match &self.difference {
            Some(difference) => write!(formatter, "{first} and {second} {difference}"),
            None => write!(formatter, "{first} and {second} are the same to the bit"),
        }
    }
}

impl<M: Portrait> Trace<M> {
    /// Reads a whole trace. It takes about 100 bytes of memory per step; sensor readings are not
    /// kept.
    ///
    /// # Errors
    /// If it cannot be read, with the line.
    pub fn read(name: impl Into<String>, trace: impl BufRead) -> Result<Self, ReplayError> {
        let reader = Reader::<M, _>::open(trace)?;
        let robots = reader.robots().map(|(config, pose)| RobotTrace {
            config: config.clone(),
            poses: vec![pose],
            commands: Vec::new(),
            bumps: Vec::new(),
            lifts: Vec::new(),
        });
        let mut trace = Self {
            name: name.into(),
            world: reader.world().clone(),
            world_text: reader.world().to_json()?,
            seed: reader.seed(),
            step_us: reader.step_us(),
            robots: robots.collect(),
            doors: Vec::new(),
        };
        let mut now = 0;
        for event in reader {
            match event?.1 {
                TraceLine::Step(step) => {
                    now = step.tick as u32;
                    if let Some(robot) = trace.robots.get_mut(step.robot.0 as usize) {
                        robot.poses.push(step.pose);
                        robot.commands.push(step.command);
                        robot.bumps.push(step.bump);
                    }
                }
                TraceLine::Place { robot, .. } => {
                    if let Some(robot) = trace.robots.get_mut(robot.0 as usize) {
                        robot.lifts.push(now + 1);
                    }
                }
                TraceLine::Door { name, state } => trace.doors.push((now, name, state)),
            }
        }
        Ok(trace)
    }

    pub(super) fn robots(&self) -> &[RobotTrace<M>] {
        &self.robots
    }

    fn steps(&self) -> u32 {
        self.robots
            .iter()
            .map(|robot| robot.bumps.len() as u32)
            .max()
            .unwrap_or(0)
    }

    fn scenery(&self) -> Scenery {
        let mut scenery = Scenery::of_world(&self.world);
        for (shown, door) in scenery.doors.iter_mut().zip(self.world.doors()) {
            self.open_and_shut(shown, &door.schedule);
        }
        let start = self.robots.first().and_then(|robot| robot.poses.first());
        let floor = start.and_then(|start| Floor::from(&self.world, start.position));
        if let Some(floor) = floor {
            scenery.zones.extend(floor.solid());
        }
        scenery
    }

    /// Adds the changes of a door, by its schedule and from outside. A door waits for a body in its
    /// way, which the trace does not show. So the replay may show it shut a little too early.
    fn open_and_shut(&self, door: &mut SceneryDoor, schedule: &[DoorEvent]) {
        let scheduled = schedule.iter().map(|event| DoorChange {
            step: (event.time_us / self.step_us.max(1)) as u32,
            state: event.state,
        });
        let moved = self.doors.iter().filter(|(_, name, _)| *name == door.name);
        let moved = moved.map(|(step, _, state)| DoorChange {
            step: *step,
            state: *state,
        });
        door.changes.extend(scheduled.chain(moved));
        door.changes.sort_by_key(|change| change.step);
    }

    fn tracks(&self, several: bool) -> Result<Vec<RobotTrack>, CompareError> {
        let tracks = self.robots.iter().enumerate().map(|(number, robot)| {
            let name = match (self.robots.len(), several) {
                (1, _) => self.name.clone(),
                (_, false) => format!("robot {number}"),
                (_, true) => format!("{} robot {number}", self.name),
            };
            let model = M::from_config(robot.config.clone());
            let model = model.map_err(|source| CompareError::Robot {
                trace: self.name.clone(),
                robot: number,
                source: Box::new(source),
            })?;
            let mut track = robot.track(name, model.body().clone());
            let destination = self.world.zone("destination");
            track.marks.push(arrival(&robot.poses, |pose| {
                destination.is_some_and(|zone| zone.contains(pose.position))
            }));
            if let Some(floor) = Floor::from(&self.world, robot.poses[0].position) {
                let path = robot.poses.iter().map(|pose| pose.position);
                track.series.insert(0, floor.coverage(path));
            }
            Ok(track)
        });
        tracks.collect()
    }
}

impl<M: Portrait> RobotTrace<M> {
    fn track(&self, name: String, body: tolman_robot::Body) -> RobotTrack {
        let mut track = RobotTrack::new(name, body, self.poses.clone());
        track.ring = M::ring(&self.config);
        track.lifts.clone_from(&self.lifts);
        let bumps = (1..).zip(&self.bumps);
        let bumps = bumps.filter_map(|(step, bump)| bump.then_some(step));
        track.marks = vec![
            Marks::new(Mark::Bump, "bump", bumps),
            Marks::new(Mark::Kidnapping, "kidnapped", self.lifts.clone()),
        ];
        for (step, command) in (1..).zip(&self.commands) {
            for (i, (name, share)) in M::parts(command).into_iter().enumerate() {
                if track.series.len() <= i {
                    track.series.push(TimeSeries::new(format!("{name}, %"), ""));
                }
                // Whole per cent are precise enough for a reader, and take few bytes.
                track.series[i].sample(step, libm::round(100.0 * share));
            }
        }
        track
    }
}

/// Returns a mark at the first step at which a robot is at its destination.
fn arrival(poses: &[Pose], there: impl Fn(&Pose) -> bool) -> Marks {
    let first = poses.iter().position(there);
    Marks::new(Mark::Arrival, "arrived", first.map(|step| step as u32))
}

impl Replay {
    /// Returns the replay of one trace, or of several in the same world side by side, and the
    /// comparison of each with the first. The first step at which one differs is marked.
    ///
    /// Linear in the length of the traces; nothing is simulated.
    ///
    /// # Errors
    /// [`CompareError`] if there is no trace, their worlds or time steps differ, or a robot cannot
    /// be built.
    pub fn of_traces<M: Portrait>(
        traces: &[Trace<M>],
    ) -> Result<(Self, Vec<TraceComparison>), CompareError> {
        let (first, others) = traces.split_first().ok_or(CompareError::None)?;
        let mut verdicts = Vec::new();
        for second in others {
            if first.world_text != second.world_text {
                return Err(CompareError::Worlds {
                    first: first.name.clone(),
                    second: second.name.clone(),
                });
            }
            if first.step_us != second.step_us {
                return Err(CompareError::Steps {
                    first: first.name.clone(),
                    first_us: first.step_us,
                    second: second.name.clone(),
                    second_us: second.step_us,
                });
            }
            let difference = first_difference(first, second);
            verdicts.push(TraceComparison {
                first: first.name.clone(),
                second: second.name.clone(),
                difference,
            });
        }
        let mut tracks = Vec::new();
        for trace in traces {
            tracks.extend(trace.tracks(traces.len() > 1)?);
        }
        let names: Vec<&str> = traces.iter().map(|trace| trace.name.as_str()).collect();
        let mut replay = Self::new(
            names.join(" and "),
            first.step_us as f64 * 1e-6,
            first.scenery(),
            tracks,
        );
        replay.facts = facts(traces, &verdicts);
        let differences = verdicts.iter().filter_map(|verdict| verdict.difference);
        let mut steps: Vec<u32> = differences.map(|difference| difference.step).collect();
        steps.sort_unstable();
        replay.marks = vec![Marks::new(Mark::Difference, "first difference", steps)];
        Ok((replay, verdicts))
    }
}

fn facts<M: Portrait>(traces: &[Trace<M>], verdicts: &[TraceComparison]) -> Vec<Fact> {
    let told = traces.iter().map(|trace| {
        let value = format!("{} steps, seed {}", trace.steps(), trace.seed);
        Fact::new(&trace.name, value)
    });
    let compared = verdicts
        .iter()
        .map(|verdict| Fact::new("verdict", verdict.to_string()));
    told.chain(compared).collect()
}
