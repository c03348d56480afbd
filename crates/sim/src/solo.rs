use alloc::sync::Arc;

use tolman_geom::Pose;
use tolman_robot::Robot;

use crate::{Model, PlaceError, RobotId, Simulation, StepError, Truth, World};

/// One robot alone in a world: all that a brain needs of a simulator.
///
/// ```
/// use tolman_robot::{Robot, TurnTranslate};
/// use tolman_sim::geom::{Heading, Point, Pose};
/// use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
/// use tolman_sim::{Solo, WallSegment, World};
///
/// let wall = WallSegment::between(Point::new(2.0, -1.0), Point::new(2.0, 1.0));
/// let world = World::from_segments(vec![wall])?;
/// let robot = LaserPioneer::new(LaserPioneerConfig::noiseless())?;
/// let start = Pose::new(Point::new(0.0, 0.0), Heading::EAST);
/// let mut solo = Solo::new(world, robot, start, 7)?;
/// solo.step(&TurnTranslate { turn: 0.0, translate: 1.0 })?;
/// // What it senses, and the truth, which no brain sees.
/// assert!(solo.sensing().scan.is_some());
/// assert!(solo.truth().pose.position.x > 0.0 && solo.bumps() == 0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Solo<M: Model> {
    simulation: Simulation<M>,
    robot: RobotId,
    bumps: u32,
}

impl<M: Model> Solo<M> {
    /// Returns a robot at `pose`. `run` seeds all random numbers.
    ///
    /// # Errors
    /// If the robot cannot stand there.
    pub fn new(
        world: impl Into<Arc<World>>,
        model: M,
        pose: Pose,
        run: u64,
    ) -> Result<Self, PlaceError> {
        let mut simulation = Simulation::new(world, run);
        let robot = simulation.add(model, pose)?;
        Ok(Self {
            simulation,
            robot,
            bumps: 0,
        })
    }

    /// Returns the truth about the robot.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        self.simulation.truth(self.robot)
    }

    /// Returns the robot's model.
    #[must_use]
    pub fn model(&self) -> &M {
        self.simulation.model(self.robot)
    }

    /// Returns the number of time steps in which the robot touched something.
    #[must_use]
    pub const fn bumps(&self) -> u32 {
        self.bumps
    }

    /// Lifts the robot and sets it down at `pose`.
    ///
    /// # Errors
    /// If it cannot stand there; it then stays where it is.
    pub fn place(&mut self, pose: Pose) -> Result<(), PlaceError> {
        self.simulation.place(self.robot, pose)
    }

    /// Returns the simulation that the robot runs in.
    #[must_use]
    pub fn simulation(&self) -> &Simulation<M> {
        &self.simulation
    }

    /// Returns the simulation that the robot runs in, to open a door or lift the robot. It must
    /// stay alone in it.
    pub fn simulation_mut(&mut self) -> &mut Simulation<M> {
        &mut self.simulation
    }
}

impl<M: Model> Robot for Solo<M> {
    type Command = M::Command;
    type Sensing = M::Sensing;
    type Error = StepError;

    fn sensing(&self) -> &M::Sensing {
        self.simulation.sensing(self.robot)
    }

    fn step(&mut self, command: &M::Command) -> Result<(), StepError> {
        self.simulation.step(core::slice::from_ref(command))?;
        self.bumps += u32::from(self.truth().bump);
        Ok(())
    }
}
