use alloc::sync::Arc;

use tolman_geom::Pose;
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::{DoorError, DoorState, Model, PlaceError, Solo, StepError, Truth, World, Zone};

/// A simulated robot that senses the zones `start` and `destination` of its world as landmarks, and leaves a path.
#[derive(Debug)]
pub struct Simulated<M: Model> {
    solo: Solo<M>,
    /// With the zones where its centre has to lie.
    landmarks: Vec<(Landmark, Zone)>,
    path: Vec<Pose>,
}

impl<M: Model> Simulated<M> {
    /// Puts the robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn new(world: Arc<World>, robot: M, start: Pose, seed: u64) -> Result<Self, PlaceError> {
        let names = [(Landmark::Start, "start"), (Landmark::Goal, "destination")];
        let zones = names.into_iter();
        let zones =
            zones.filter_map(|(landmark, name)| Some((landmark, world.zone(name)?.clone())));
        let landmarks = zones.collect();
        Ok(Self {
            solo: Solo::new(world, robot, start, seed)?,
            landmarks,
            path: vec![start],
        })
    }

    /// What really is, for scoring; no system sees it.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        self.solo.truth()
    }

    /// Where it was after every step.
    #[must_use]
    pub fn path(&self) -> &[Pose] {
        &self.path
    }

    /// In how many steps it touched something.
    #[must_use]
    pub const fn bumps(&self) -> u32 {
        self.solo.bumps()
    }

    /// Lifts it and sets it down elsewhere.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn place(&mut self, pose: Pose) -> Result<(), PlaceError> {
        self.solo.place(pose)
    }

    /// Opens or shuts a door of the world it is in.
    ///
    /// # Errors
    /// If there is no such door.
    pub fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), DoorError> {
        self.solo.simulation_mut().set_door(name, state)
    }

    /// The world it is in.
    #[must_use]
    pub fn world(&self) -> &World {
        self.solo.simulation().world()
    }
}

impl<M: Model> Robot for Simulated<M> {
    type Command = M::Command;
    type Sensing = M::Sensing;
    type Error = StepError;

    fn sensing(&self) -> &M::Sensing {
        self.solo.sensing()
    }

    fn step(&mut self, command: &M::Command) -> Result<(), StepError> {
        self.solo.step(command)?;
        self.path.push(self.solo.truth().pose);
        Ok(())
    }
}

impl<M: Model> SensesLandmarks for Simulated<M> {
    fn landmark(&self) -> Option<Landmark> {
        let here = self.truth().pose.position;
        let mut at = self.landmarks.iter();
        let at = at.find(|(_, zone)| zone.contains(here));
        at.map(|(landmark, _)| *landmark)
    }
}
