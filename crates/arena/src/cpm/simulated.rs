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
    landmarks: Vec<(Landmark, Zone)>,
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
        let landmarks = landmarks(&world);
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
        landmark_at(&self.landmarks, self.solo.truth().pose.position)
    }
}

/// Returns the landmarks of a world: its zones `start` and `destination`.
pub(super) fn landmarks(world: &World) -> Vec<(Landmark, Zone)> {
    let names = [(Landmark::Start, "start"), (Landmark::Goal, "destination")];
    names
        .into_iter()
        .filter_map(|(landmark, name)| Some((landmark, world.zone(name)?.clone())))
        .collect()
}

/// Returns the landmark that stands at a position.
pub(super) fn landmark_at(landmarks: &[(Landmark, Zone)], here: Point) -> Option<Landmark> {
    let mut at = landmarks.iter().filter(|(_, zone)| zone.contains(here));
    at.next().map(|(landmark, _)| *landmark)
}
