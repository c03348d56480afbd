use alloc::sync::Arc;

use tolman_geom::Pose;
use tolman_robot::Robot;

use crate::{Model, PlaceError, RobotId, Simulation, StepError, Truth, World};

/// One robot alone in a world: all that a brain needs of a simulator.
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

    /// Returns the simulation it runs in.
    #[must_use]
    pub fn simulation(&self) -> &Simulation<M> {
        &self.simulation
    }

    /// Returns the simulation it runs in, to open a door or lift the robot. It must stay alone in
    /// it.
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
