use alloc::sync::Arc;
use std::io::Write;

use serde::Serialize;
use tolman_geom::Pose;
use tolman_robot::Robot;

use super::lines::{FORMAT, Header, Start, VERSION};
use super::{RecordError, Recordable, StepRecord, TraceLine};
use crate::{DoorState, RobotId, Simulation, World};

/// Detail in which a run is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Commands, poses and bumps.
    Poses,
    /// Also the robots' readings.
    Sensing,
}

/// A simulation that is recorded as it runs. With one robot it is a [`Robot`](tolman_robot::Robot).
#[derive(Debug)]
pub struct Recording<M: Recordable, W: Write> {
    simulation: Simulation<M>,
    writer: W,
    detail: Detail,
}

impl<M: Recordable, W: Write> Recording<M, W> {
    /// Puts `robots` into `world` and writes the first line. Pass a buffered writer.
    ///
    /// # Errors
    /// If a robot cannot stand where it is put, no robot is given, or the line cannot be written.
    pub fn start(
        world: impl Into<Arc<World>>,
        seed: u64,
        robots: Vec<(M, Pose)>,
        writer: W,
        detail: Detail,
    ) -> Result<Self, RecordError> {
        let mut simulation = Simulation::new(world, seed);
        let mut starts = Vec::new();
        let mut step_us = 0;
        for (model, pose) in robots {
            step_us = model.step_us();
            starts.push(Start {
                config: model.config().clone(),
                pose,
                disturbances: model.disturbances(),
            });
            simulation.add(model, pose)?;
        }
        if starts.is_empty() {
            return Err(RecordError::NoRobots);
        }
        let header = Header::<M> {
            format: FORMAT.to_owned(),
            version: VERSION,
            seed,
            step_us,
            robots: starts,
            world: serde_json::from_str(&simulation.world().to_json()?)?,
        };
        let mut recording = Self {
            simulation,
            writer,
            detail,
        };
        recording.write(&header)?;
        Ok(recording)
    }

    fn write(&mut self, line: &impl Serialize) -> Result<(), RecordError> {
        let mut line = serde_json::to_vec(line)?;
        line.push(b'\n');
        Ok(self.writer.write_all(&line)?)
    }

    /// Lets one time step pass, as [`Simulation::step`] does, and writes it down.
    ///
    /// # Errors
    /// If the step is not made, or cannot be written. In the latter case the run can continue, but
    /// the trace cannot.
    pub fn step(&mut self, commands: &[M::Command]) -> Result<(), RecordError> {
        self.simulation.step(commands)?;
        for (robot, command) in self.simulation.robots().zip(commands) {
            let line = TraceLine::Step(self.line(robot, command));
            self.write(&line)?;
        }
        Ok(())
    }

    /// Returns the record of one robot's step.
    pub(super) fn line(&self, robot: RobotId, command: &M::Command) -> StepRecord<M> {
        let truth = self.simulation.truth(robot);
        let sensing = match self.detail {
            Detail::Poses => None,
            Detail::Sensing => Some(self.simulation.sensing(robot).clone()),
        };
        StepRecord {
            tick: truth.tick,
            time_us: truth.time_us,
            robot,
            command: command.clone(),
            pose: truth.pose,
            bump: truth.bump,
            sensing,
        }
    }

    /// Lifts a robot and puts it down, as [`Simulation::place`] does, and records that.
    ///
    /// # Errors
    /// If it cannot stand there, there is no such robot, or the line cannot be written.
    pub fn place(&mut self, robot: RobotId, pose: Pose) -> Result<(), RecordError> {
        self.simulation.place(robot, pose)?;
        self.write(&TraceLine::<M>::Place { robot, pose })
    }

    /// Opens or shuts a door, as [`Simulation::set_door`] does, and records that.
    ///
    /// # Errors
    /// If there is no such door, or the line cannot be written.
    pub fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), RecordError> {
        self.simulation.set_door(name, state)?;
        self.write(&TraceLine::<M>::Door {
            name: name.to_owned(),
            state,
        })
    }

    /// Returns the simulation in its present state.
    #[must_use]
    pub fn simulation(&self) -> &Simulation<M> {
        &self.simulation
    }

    /// Ends the trace and returns the simulation.
    ///
    /// # Errors
    /// If the rest of it cannot be written.
    pub fn finish(mut self) -> Result<Simulation<M>, RecordError> {
        self.writer.flush()?;
        Ok(self.simulation)
    }
}

impl<M: Recordable, W: Write> Robot for Recording<M, W> {
    type Command = M::Command;
    type Sensing = M::Sensing;
    type Error = RecordError;

    fn sensing(&self) -> &M::Sensing {
        self.simulation.sensing(RobotId(0))
    }

    fn step(&mut self, command: &M::Command) -> Result<(), RecordError> {
        self.step(core::slice::from_ref(command))
    }
}
