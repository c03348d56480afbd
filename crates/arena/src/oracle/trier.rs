use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::{Stack, View};
use tolman_geom::Pose;
use tolman_maze::Direction;
use tolman_robot::{Robot, TurnTranslate};
use tolman_sim::Solo;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};

use crate::course::Course;
use crate::episode::layers;
use crate::episode_error::{EpisodeError, step_failed};

/// Time steps after which an action counts as failed: it swings to and fro.
const LONGEST_ACTION: u32 = 40;

/// A robot that is set down anywhere to try an action with its own layers.
pub(super) struct Trier<'a> {
    course: &'a Course,
    robot: Solo<LaserPioneer>,
    stack: Stack,
    rng: ChaCha8Rng,
}

/// Result of an action that was tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tried {
    pub(super) pose: Pose,
    /// Number of time steps that the action took.
    pub(super) steps: u32,
    pub(super) moved: bool,
    /// Whether the robot ended in the destination.
    pub(super) arrived: bool,
}

impl<'a> Trier<'a> {
    /// Returns `robot`, built as `config` says, with the paper's layers.
    pub(super) fn new(
        course: &'a Course,
        robot: Solo<LaserPioneer>,
        config: &LaserPioneerConfig,
    ) -> Result<Self, EpisodeError> {
        Ok(Self {
            course,
            robot,
            stack: layers(course, config)?,
            // The layers draw only to get out of corners; a fixed seed makes it repeatable.
            rng: ChaCha8Rng::seed_from_u64(0),
        })
    }

    /// Carries out one action from `pose`, or `None` if the robot cannot stand or see there.
    pub(super) fn carry_out(
        &mut self,
        action: Direction,
        pose: Pose,
    ) -> Result<Option<Tried>, EpisodeError> {
        if self.robot.place(pose).is_err() {
            return Ok(None);
        }
        self.stack.begin(action);
        // It was lifted here: one step at rest and it sees where it is.
        let rest = self.robot.step(&TurnTranslate::STOP);
        rest.map_err(|source| step_failed(0, source))?;
        let mut moved = None;
        let mut steps = 0;
        while moved.is_none() && steps < LONGEST_ACTION {
            let sensing = self.robot.sensing();
            let (Some(scan), Some(heading)) = (&sensing.scan, sensing.compass) else {
                return Ok(None);
            };
            let proposal = self.stack.correct(View { scan, heading }, &mut self.rng);
            steps += 1;
            self.robot
                .step(&proposal.command)
                .map_err(|source| step_failed(steps, source))?;
            let pose = self.robot.truth().pose;
            if self.course.is_destination(pose.position) {
                return Ok(Some(Tried {
                    pose,
                    steps,
                    moved: true,
                    arrived: true,
                }));
            }
            moved = proposal.ends.map(tolman_control::Outcome::moved);
        }
        Ok(Some(Tried {
            pose: self.robot.truth().pose,
            steps,
            moved: moved.unwrap_or(false),
            arrived: false,
        }))
    }
}
