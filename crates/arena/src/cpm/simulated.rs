use alloc::sync::Arc;

use tolman_geom::{Point, Pose};
use tolman_robot::epuck::{EpuckSensing, WheelSpeeds};
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::robots::Epuck;
use tolman_sim::{PlaceError, Solo, StepError, Truth, World, Zone};

/// The simulated e-puck. Its maze's zones `start` and `destination` are its landmarks.
#[derive(Debug)]
pub struct SimulatedEpuck {
    solo: Solo<Epuck>,
    landmarks: Landmarks,
    path: Vec<Pose>,
}

impl SimulatedEpuck {
    /// Puts the robot at `start`.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn new(
        world: impl Into<Arc<World>>,
        robot: Epuck,
        start: Pose,
        seed: u64,
    ) -> Result<Self, PlaceError> {
        let world = world.into();
        let landmarks = Landmarks::of(&world);
        Ok(Self {
            solo: Solo::new(world, robot, start, seed)?,
            landmarks,
            path: vec![start],
        })
    }

    /// What really is, for scoring.
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

impl Robot for SimulatedEpuck {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = StepError;

    fn sensing(&self) -> &EpuckSensing {
        self.solo.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), StepError> {
        self.solo.step(command)?;
        self.path.push(self.solo.truth().pose);
        Ok(())
    }
}

impl SensesLandmarks for SimulatedEpuck {
    fn landmark(&self) -> Option<Landmark> {
        self.landmarks.at(self.solo.truth().pose.position)
    }
}

/// The landmarks of a world: its zones `start` and `destination`.
#[derive(Clone, Debug)]
pub struct Landmarks(Vec<(Landmark, Zone)>);

impl Landmarks {
    /// Returns those of a world.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let names = [(Landmark::Start, "start"), (Landmark::Goal, "destination")];
        let zones = names
            .into_iter()
            .filter_map(|(landmark, name)| Some((landmark, world.zone(name)?.clone())));
        Self(zones.collect())
    }

    /// Returns the one that stands at a position.
    #[must_use]
    pub fn at(&self, here: Point) -> Option<Landmark> {
        let mut at = self.0.iter().filter(|(_, zone)| zone.contains(here));
        at.next().map(|(landmark, _)| *landmark)
    }
}
