use alloc::sync::Arc;

use tolman_geom::Pose;
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::trace::{Detail, Recording};
use tolman_sim::{DoorError, DoorState, Model, PlaceError, Solo, StepError, Truth, World, Zone};

use crate::{BoxError, Depicted};

/// A simulated robot that senses the zones `start`, `destination` and `landmark 1` to `landmark 8`
/// of its world as landmarks, and leaves a path.
#[derive(Debug)]
pub struct Simulated<M: Model> {
    solo: Solo<M>,
    seed: u64,
    /// Landmarks, with the zones where the robot's centre has to lie.
    landmarks: Vec<(Landmark, Zone)>,
    path: Vec<Pose>,
    commands: Vec<M::Command>,
    bumped: Vec<u32>,
}

impl<M: Model> Simulated<M> {
    /// Puts the robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn new(world: Arc<World>, robot: M, start: Pose, seed: u64) -> Result<Self, PlaceError> {
        let zones = world.zones().iter();
        let landmarks = zones.filter_map(|zone| Some((landmark_of(zone)?, zone.clone())));
        let landmarks = landmarks.collect();
        Ok(Self {
            solo: Solo::new(world, robot, start, seed)?,
            seed,
            landmarks,
            path: vec![start],
            commands: Vec::new(),
            bumped: Vec::new(),
        })
    }

    /// Returns the truth, for scoring; no system sees it.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        self.solo.truth()
    }

    /// Returns the robot's model.
    #[must_use]
    pub fn model(&self) -> &M {
        self.solo.model()
    }

    /// Returns the true pose after every step.
    #[must_use]
    pub fn path(&self) -> &[Pose] {
        &self.path
    }

    /// Returns the number of steps in which it touched something.
    #[must_use]
    pub const fn bumps(&self) -> u32 {
        self.solo.bumps()
    }

    /// Returns the steps in which it touched something, counted from 1 like those of its
    /// [`path`](Self::path).
    #[must_use]
    pub fn bumped(&self) -> &[u32] {
        &self.bumped
    }

    /// Lifts the robot and sets it down at `pose`.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn place(&mut self, pose: Pose) -> Result<(), PlaceError> {
        self.solo.place(pose)
    }

    /// Opens or shuts a door of its world.
    ///
    /// # Errors
    /// If there is no such door.
    pub fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), DoorError> {
        self.solo.simulation_mut().set_door(name, state)
    }

    /// Returns the world that the robot is in.
    #[must_use]
    pub fn world(&self) -> &World {
        self.solo.simulation().world()
    }
}

impl<M: Depicted> Simulated<M> {
    /// Returns the trace of the run from its first pose on, as JSON lines. They hold the world, the
    /// robot, and every step's command, true pose, bump and readings.
    ///
    /// The run is repeated for it: the same commands make the same run, unless the robot was lifted
    /// or a door was moved.
    ///
    /// # Errors
    /// If the robot cannot be built again by its configuration alone, or a line has no JSON form.
    pub fn trace(&self) -> Result<Vec<u8>, BoxError> {
        let disturbances = self.model().disturbances();
        if !disturbances.is_empty() {
            let disturbances = disturbances.join(", ");
            return Err(format!(
                "a robot with {disturbances} is not built by its configuration alone"
            )
            .into());
        }
        let world = Arc::clone(self.solo.simulation().world());
        let model = self.model().again()?;
        trace_of(world, model, self.path[0], self.seed, &self.commands)
    }
}

/// Returns the landmark that is sensed in a zone; `None` if there is none.
pub(crate) fn landmark_of(zone: &Zone) -> Option<Landmark> {
    match zone.name() {
        "start" => Some(Landmark::Start),
        "destination" => Some(Landmark::Goal),
        name => {
            let number = name.strip_prefix("landmark ")?.parse().ok()?;
            Some(Landmark::Numbered(number))
        }
    }
}

/// Returns the trace of a robot that begins at `start` and is given these commands, as JSON lines.
/// They hold the world, the robot, and every step's command, true pose, bump and readings.
///
/// # Errors
/// If the robot cannot begin there, or a line has no JSON form.
pub fn trace_of<M: Depicted>(
    world: Arc<World>,
    robot: M,
    start: Pose,
    seed: u64,
    commands: &[M::Command],
) -> Result<Vec<u8>, BoxError> {
    let mut lines = Vec::new();
    let robots = vec![(robot, start)];
    let mut recording = Recording::start(world, seed, robots, &mut lines, Detail::Sensing)?;
    for command in commands {
        recording.step(core::slice::from_ref(command))?;
    }
    recording.finish()?;
    Ok(lines)
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
        self.commands.push(command.clone());
        if self.solo.truth().bump {
            self.bumped.push(self.commands.len() as u32);
        }
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
