use tolman_geom::Pose;
use tolman_robot::{Landmark, LaserSensing, Robot, SensesLandmarks, TurnTranslate};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{Solo, StepError, Truth};

use crate::course::Course;
use crate::episode::EpisodeError;

/// A simulated Pioneer on a course, which senses the goal where its centre lies in the destination.
#[derive(Debug)]
pub struct CoursePioneer<'a> {
    course: &'a Course,
    solo: Solo<LaserPioneer>,
}

impl<'a> CoursePioneer<'a> {
    /// Returns a robot at `start`, at rest. `seed` is that of the simulation.
    ///
    /// # Errors
    /// If the robot cannot be built or cannot stand there.
    pub fn new(
        course: &'a Course,
        robot: &LaserPioneerConfig,
        start: Pose,
        seed: u64,
    ) -> Result<Self, EpisodeError> {
        let model = LaserPioneer::new(robot.clone())?;
        let solo = Solo::new(course.world.clone(), model, start, seed)?;
        Ok(Self { course, solo })
    }

    /// Returns what really is; no system sees it.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        self.solo.truth()
    }
}

impl Robot for CoursePioneer<'_> {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = StepError;

    fn sensing(&self) -> &LaserSensing {
        self.solo.sensing()
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), StepError> {
        self.solo.step(command)
    }
}

impl SensesLandmarks for CoursePioneer<'_> {
    fn landmark(&self) -> Option<Landmark> {
        let destination = self.course.destination();
        let arrived = destination.contains(self.truth().pose.position);
        arrived.then_some(Landmark::Goal)
    }
}
