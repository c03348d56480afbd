use alloc::sync::Arc;

use tolman_geom::{Point, Pose};
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::{Model, PlaceError, Solo, StepError, Truth, World, Zone};

/// A simulated robot that senses landmarks and leaves a path.
#[derive(Debug)]
pub struct Simulated<M: Model> {
    solo: Solo<M>,
    landmarks: Landmarks,
    path: Vec<Pose>,
}

impl<M: Model> Simulated<M> {
    /// Puts the robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn new(
        world: Arc<World>,
        landmarks: Landmarks,
        robot: M,
        start: Pose,
        seed: u64,
    ) -> Result<Self, PlaceError> {
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
        self.landmarks.at(self.solo.truth().pose.position)
    }
}

/// The landmarks of a world, each with the zone where a robot's centre has to lie.
#[derive(Clone, Debug)]
pub struct Landmarks(Vec<(Landmark, Zone)>);

impl Landmarks {
    /// Returns the zones `start` and `destination` of a world.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let names = [(Landmark::Start, "start"), (Landmark::Goal, "destination")];
        let zones = names
            .into_iter()
            .filter_map(|(landmark, name)| Some((landmark, world.zone(name)?.clone())));
        Self(zones.collect())
    }

    /// Returns the goal alone.
    #[must_use]
    pub fn goal(zone: Zone) -> Self {
        Self(vec![(Landmark::Goal, zone)])
    }

    /// Returns the one that stands at a position.
    #[must_use]
    pub fn at(&self, here: Point) -> Option<Landmark> {
        let mut at = self.0.iter().filter(|(_, zone)| zone.contains(here));
        at.next().map(|(landmark, _)| *landmark)
    }
}
