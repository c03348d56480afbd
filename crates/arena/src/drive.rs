//! A robot on a course that carries out high-level actions through its layers, one time step at a time.

use rand_chacha::ChaCha8Rng;
use tolman_control::{Proposal, Stack, View};
use tolman_geom::Pose;
use tolman_maze::Direction;
use tolman_robot::{LaserSensing, Robot};
use tolman_sim::Solo;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};

use crate::course::Course;
use crate::episode::EpisodeError;

/// The robot, its layers and the chance they draw.
#[derive(Debug)]
pub struct Drive<'a> {
    course: &'a Course,
    solo: Solo<LaserPioneer>,
    stack: Stack,
    rng: ChaCha8Rng,
    steps: u32,
}

impl<'a> Drive<'a> {
    /// A robot at `start`, at rest. `seed` is that of the simulation, `rng` is the layers' own.
    ///
    /// # Errors
    /// If the robot cannot be built for the course or cannot stand there.
    pub fn new(
        course: &'a Course,
        robot: &LaserPioneerConfig,
        start: Pose,
        seed: u64,
        rng: ChaCha8Rng,
    ) -> Result<Self, EpisodeError> {
        let model = LaserPioneer::new(robot.clone())?;
        Ok(Self {
            course,
            solo: Solo::new(course.world.clone(), model, start, seed)?,
            stack: Stack::paper(robot.ring, 2.0 * robot.radius, course.corridor_width)?,
            rng,
            steps: 0,
        })
    }

    /// Starts an action.
    pub fn begin(&mut self, action: Direction) {
        self.stack.begin(action);
    }

    /// One time step of the action under way: what the layers proposed and the robot did.
    ///
    /// # Errors
    /// If the simulator refuses the command.
    pub fn step(&mut self) -> Result<Proposal, EpisodeError> {
        let sensing = self.solo.sensing();
        let proposal = match (&sensing.scan, sensing.compass) {
            (Some(scan), Some(heading)) => {
                self.stack.correct(View { scan, heading }, &mut self.rng)
            }
            // Blind for a moment: stand still until the sensors are back.
            _ => Proposal::default(),
        };
        let made = self.solo.step(&proposal.command);
        made.map_err(|source| EpisodeError::Step {
            step: self.steps,
            source,
        })?;
        self.steps += 1;
        Ok(proposal)
    }

    /// The robot in its world.
    #[must_use]
    pub const fn robot(&self) -> &Solo<LaserPioneer> {
        &self.solo
    }

    /// What the robot senses now.
    #[must_use]
    pub fn sensing(&self) -> &LaserSensing {
        self.solo.sensing()
    }

    /// Time steps made so far.
    #[must_use]
    pub const fn steps(&self) -> u32 {
        self.steps
    }

    /// Whether the robot's centre lies in the destination.
    #[must_use]
    pub fn is_in_destination(&self) -> bool {
        let position = self.solo.truth().pose.position;
        self.course.destination().contains(position)
    }
}
