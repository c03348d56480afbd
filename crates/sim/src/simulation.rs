use alloc::sync::Arc;

use thiserror::Error;
use tolman_geom::Pose;

use crate::scene::{Crowd, Placed, Scene};
use crate::{
    BodyError, Chance, CommandError, DoorState, Model, Motion, Surroundings, WallSegment, World,
    body, contact,
};

/// A robot of a simulation, by its index in the order of adding, from 0.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(transparent)]
pub struct RobotId(pub u32);

/// The truth about a robot, for scoring; no robot knows it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Truth {
    /// Pose of the robot.
    pub pose: Pose,
    /// Motion in the last step.
    pub motion: Motion,
    /// Whether that motion was cut by a contact.
    pub bump: bool,
    /// Number of steps since the run began.
    pub tick: u64,
    /// Microseconds since the run began.
    pub time_us: u64,
}

/// Robots in a world.
///
/// Robots act one by one in the order they were added, then all sense. The run depends only on the
/// world, the seed, the robots and their commands.
///
/// ```
/// use tolman_robot::TurnTranslate;
/// use tolman_sim::geom::{Heading, Point, Pose};
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
/// use tolman_sim::{Simulation, WallSegment, World};
///
/// let wall = WallSegment::between(Point::new(0.0, 9.0), Point::new(9.0, 9.0));
/// let mut simulation = Simulation::new(World::from_segments(vec![wall])?, 7);
/// let mut add = |x, heading| {
///     let robot = LaserPioneer::new(LaserPioneerConfig::noiseless()).unwrap();
///     simulation.add(robot, Pose::new(Point::new(x, 0.0), heading))
/// };
/// let (left, right) = (add(0.0, Heading::EAST)?, add(2.0, Heading::WEST)?);
/// // They drive towards each other until they meet.
/// let ahead = TurnTranslate { turn: 0.0, translate: 1.0 };
/// while !simulation.truth(left).bump {
///     simulation.step(&[ahead, ahead])?;
/// }
/// assert!(simulation.truth(right).pose.position.x > simulation.truth(left).pose.position.x);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation<M: Model> {
    world: Arc<World>,
    chance: Chance,
    tick: u64,
    step_us: u64,
    doors: Doors,
    robots: Vec<Running<M>>,
    /// The robots' bodies, in the same order.
    bodies: Crowd,
    obstacles: contact::Obstacles,
}

#[derive(Debug)]
struct Running<M: Model> {
    model: M,
    truth: Truth,
    sensing: M::Sensing,
}

impl<M: Model> Simulation<M> {
    /// Returns a world without robots at time 0. `run` seeds all random numbers.
    pub fn new(world: impl Into<Arc<World>>, run: u64) -> Self {
        let world = world.into();
        let doors = Doors::of(&world);
        Self {
            world,
            chance: Chance::of_run(run),
            tick: 0,
            step_us: 0,
            doors,
            robots: Vec::new(),
            bodies: Crowd::default(),
            obstacles: contact::Obstacles::default(),
        }
    }

    /// Adds a robot at `pose` and lets it sense.
    ///
    /// # Errors
    /// If the robot cannot stand there, or its time step differs from that of the others.
    pub fn add(&mut self, model: M, pose: Pose) -> Result<RobotId, PlaceError> {
        body::check(model.body())?;
        let step_us = model.step_us();
        if step_us == 0 || (!self.robots.is_empty() && step_us != self.step_us) {
            return Err(PlaceError::Step {
                step_us,
                expected_us: self.step_us,
            });
        }
        let index = self.robots.len();
        let id = RobotId(
            u32::try_from(index)
                .ok()
                .filter(|id| *id < 1 << 24)
                .ok_or(PlaceError::TooMany)?,
        );
        let placed = Placed::new(model.body().clone(), pose);
        self.check_place(index, &placed)?;
        self.step_us = step_us;
        self.bodies.push(placed);
        let truth = Truth {
            pose,
            motion: Motion::default(),
            bump: false,
            tick: self.tick,
            time_us: self.time_us(),
        };
        let sensing = model.silent();
        self.robots.push(Running {
            model,
            truth,
            sensing,
        });
        self.sense(index);
        Ok(id)
    }

    /// Takes one command per robot, in the order of adding, and lets one time step pass.
    ///
    /// # Errors
    /// If there is not one command per robot, or a command is not a number. Nothing has moved then.
    pub fn step(&mut self, commands: &[M::Command]) -> Result<(), StepError> {
        if commands.len() != self.robots.len() {
            let (commands, robots) = (commands.len(), self.robots.len());
            return Err(StepError::Commands { commands, robots });
        }
        for (index, (running, command)) in self.robots.iter().zip(commands).enumerate() {
            running
                .model
                .check(command)
                .map_err(|source| StepError::Command {
                    robot: RobotId(index as u32),
                    source,
                })?;
        }
        self.tick += 1;
        self.doors.advance(self.tick * self.step_us, &self.bodies);
        for (index, command) in commands.iter().enumerate() {
            self.act(index, command);
        }
        for index in 0..self.robots.len() {
            self.sense(index);
        }
        Ok(())
    }

    fn act(&mut self, index: usize, command: &M::Command) {
        let time_us = self.time_us();
        let running = &mut self.robots[index];
        let chance = self.chance.at(index as u32, self.tick);
        let motion = running.model.motion(command, &chance);
        let bump = contact::advance(
            &self.world,
            self.doors.shut(),
            &mut self.bodies,
            index,
            motion,
            running.model.contact(),
            &mut self.obstacles,
        );
        let (before, pose) = (running.truth.pose, self.bodies.body(index).pose());
        let motion = if bump {
            contact::motion_between(before, pose)
        } else {
            motion
        };
        running.truth = Truth {
            pose,
            motion,
            bump,
            tick: self.tick,
            time_us,
        };
    }

    fn sense(&mut self, index: usize) {
        let Running {
            model,
            truth,
            sensing,
        } = &mut self.robots[index];
        let surroundings = Surroundings {
            scene: Scene {
                world: &self.world,
                shut: self.doors.shut(),
                bodies: &self.bodies,
            },
            robot: index,
            truth,
        };
        model.sense(
            &surroundings,
            &self.chance.at(index as u32, self.tick),
            sensing,
        );
    }

    /// Lifts a robot and puts it down at `pose`: a kidnapping. The robot notices at its next step
    /// at the earliest.
    ///
    /// # Errors
    /// If there is no such robot, or it cannot stand there; it then keeps its pose.
    pub fn place(&mut self, robot: RobotId, pose: Pose) -> Result<(), PlaceError> {
        let index = robot.0 as usize;
        let body = match self.robots.get(index) {
            Some(running) => running.model.body().clone(),
            None => return Err(PlaceError::NoRobot { robot }),
        };
        let placed = Placed::new(body, pose);
        self.check_place(index, &placed)?;
        self.robots[index].truth.pose = pose;
        self.bodies.change(index, |body| *body = placed);
        Ok(())
    }

    fn check_place(&self, index: usize, placed: &Placed) -> Result<(), PlaceError> {
        let pose = placed.pose();
        if !pose.is_finite() {
            return Err(PlaceError::NotFinite { pose });
        }
        if !self.world.is_floor(pose.position) {
            return Err(PlaceError::NotOnFloor { pose });
        }
        if !contact::is_clear(&self.world, self.doors.shut(), placed) {
            let doors = self
                .doors
                .shut()
                .iter()
                .map(|door| door.distance(pose.position));
            let free = doors.fold(self.world.nearest_wall_distance(pose.position), f64::min);
            return Err(PlaceError::InWall {
                pose,
                radius: placed.radius(),
                free,
            });
        }
        for (other, body) in self.bodies.iter().enumerate() {
            if other != index && contact::overlap(placed, body) {
                return Err(PlaceError::InRobot {
                    pose,
                    other: RobotId(other as u32),
                });
            }
        }
        Ok(())
    }

    /// Returns the latest readings of a robot.
    ///
    /// # Panics
    /// If `robot` is of another simulation.
    #[must_use]
    pub fn sensing(&self, robot: RobotId) -> &M::Sensing {
        &self.robots[robot.0 as usize].sensing
    }

    /// Returns the truth about a robot.
    ///
    /// # Panics
    /// If `robot` is of another simulation.
    #[must_use]
    pub fn truth(&self, robot: RobotId) -> &Truth {
        &self.robots[robot.0 as usize].truth
    }

    /// Returns the model of a robot.
    ///
    /// # Panics
    /// If `robot` is of another simulation.
    #[must_use]
    pub fn model(&self, robot: RobotId) -> &M {
        &self.robots[robot.0 as usize].model
    }

    /// Returns all robots, in the order of adding.
    pub fn robots(&self) -> impl ExactSizeIterator<Item = RobotId> + use<M> {
        (0..self.robots.len() as u32).map(RobotId)
    }

    /// Returns the world that the robots are in.
    #[must_use]
    pub fn world(&self) -> &Arc<World> {
        &self.world
    }

    /// Returns the number of steps since the run began.
    #[must_use]
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Returns the simulated time since the run began, µs.
    #[must_use]
    pub fn time_us(&self) -> u64 {
        self.tick * self.step_us
    }

    /// Returns the state of a door.
    ///
    /// # Errors
    /// If there is no such door.
    pub fn door(&self, name: &str) -> Result<DoorState, DoorError> {
        let index = self.doors.find(name)?;
        Ok(if self.doors.standing[index].is_shut {
            DoorState::Shut
        } else {
            DoorState::Open
        })
    }

    /// Opens or shuts a door, whatever its schedule. A door with a body in it shuts once the body
    /// is out.
    ///
    /// # Errors
    /// If there is no such door.
    pub fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), DoorError> {
        let index = self.doors.find(name)?;
        self.doors.standing[index].wanted = state;
        self.doors.settle(&self.bodies);
        Ok(())
    }
}

/// The doors of a running world.
#[derive(Debug)]
struct Doors {
    world: Arc<World>,
    standing: Vec<Standing>,
    /// The walls of the doors that are shut.
    shut: Vec<WallSegment>,
}

#[derive(Debug)]
struct Standing {
    wanted: DoorState,
    is_shut: bool,
    /// Number of events of the schedule that have passed.
    passed: usize,
}

impl Doors {
    fn of(world: &Arc<World>) -> Self {
        let standing = world
            .doors()
            .iter()
            .map(|door| Standing {
                wanted: door.state,
                is_shut: false,
                passed: 0,
            })
            .collect();
        let mut doors = Self {
            world: Arc::clone(world),
            standing,
            shut: Vec::new(),
        };
        doors.settle(&Crowd::default());
        doors
    }

    fn shut(&self) -> &[WallSegment] {
        &self.shut
    }

    fn find(&self, name: &str) -> Result<usize, DoorError> {
        let doors = self.world.doors();
        doors
            .iter()
            .position(|door| door.name == name)
            .ok_or_else(|| DoorError {
                name: name.to_owned(),
            })
    }

    /// Follows the schedules up to `time_us`.
    fn advance(&mut self, time_us: u64, bodies: &Crowd) {
        for (door, standing) in self.world.doors().iter().zip(&mut self.standing) {
            while let Some(event) = door
                .schedule
                .get(standing.passed)
                .filter(|event| event.time_us <= time_us)
            {
                standing.wanted = event.state;
                standing.passed += 1;
            }
        }
        self.settle(bodies);
    }

    /// Gives every door its wanted state, unless a body stands in it.
    fn settle(&mut self, bodies: &Crowd) {
        self.shut.clear();
        for (door, standing) in self.world.doors().iter().zip(&mut self.standing) {
            let wall = door.wall();
            standing.is_shut = standing.wanted == DoorState::Shut
                && (standing.is_shut
                    || bodies
                        .iter()
                        .all(|body| contact::gap_to_wall(body, &wall) > 0.0));
            if standing.is_shut {
                self.shut.push(wall);
            }
        }
    }
}

/// Reason why a robot cannot be placed at a pose.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlaceError {
    /// The pose has a number that is not finite.
    #[error(
        "the pose ({}, {}) m, heading {} rad has a number that is not finite; give finite numbers",
        pose.position.x, pose.position.y, pose.heading.radians()
    )]
    NotFinite {
        /// Pose that was given.
        pose: Pose,
    },
    /// The position is inside a wall or outside the world.
    #[error(
        "({}, {}) m lies inside a wall or outside the world; choose a position on the floor",
        pose.position.x, pose.position.y
    )]
    NotOnFloor {
        /// Pose that was given.
        pose: Pose,
    },
    /// The robot would overlap a wall or a shut door.
    #[error(
        "a robot of radius {radius} m does not fit at ({}, {}) m, heading {} rad: the nearest wall is \
         {free} m from there; choose another pose, a smaller robot or a wider corridor",
        pose.position.x, pose.position.y, pose.heading.radians()
    )]
    InWall {
        /// Pose that was given.
        pose: Pose,
        /// Clearance that the robot needs on every side, m.
        radius: f64,
        /// Distance of the nearest wall, m.
        free: f64,
    },
    /// The robot would overlap another one.
    #[error(
        "at ({}, {}) m the robot would overlap robot {}; choose another pose",
        pose.position.x, pose.position.y, other.0
    )]
    InRobot {
        /// Pose that was given.
        pose: Pose,
        /// The robot that stands there.
        other: RobotId,
    },
    /// The robot's time step differs from that of the others.
    #[error(
        "the robot's time step is {step_us} µs, the simulation's {expected_us} µs; make them equal and positive"
    )]
    Step {
        /// The robot's, µs.
        step_us: u64,
        /// Time step of the other robots, µs; 0 for the first robot.
        expected_us: u64,
    },
    /// There is no such robot.
    #[error("there is no robot {}; name one that was added", robot.0)]
    NoRobot {
        /// The robot asked for.
        robot: RobotId,
    },
    /// The maximum number of robots is reached.
    #[error("the simulation holds 2^24 robots already; start another one")]
    TooMany,
    /// The robot's body is invalid.
    #[error(transparent)]
    Body(#[from] BodyError),
}

/// Reason why a step was not made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// There is not one command per robot.
    #[error("there are {commands} commands for {robots} robots; give one command per robot")]
    Commands {
        /// Number of commands given.
        commands: usize,
        /// Number of robots.
        robots: usize,
    },
    /// A command cannot be carried out.
    #[error("robot {}: {source}", robot.0)]
    Command {
        /// Robot whose command is at fault.
        robot: RobotId,
        /// Fault of the command.
        source: CommandError,
    },
}

/// There is no door of this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("the world has no door named `{name}`; name one of its doors")]
pub struct DoorError {
    /// The name asked for.
    pub name: String,
}
