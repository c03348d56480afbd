use tolman_maze::Maze;
use tolman_robot::Ring;
use tolman_systems::micromouse::noisy::{MotionSource, NoisyMouse, NoisyMouseConfig};

use super::micromouse::{WALLS, brief_from, too_large};
use crate::pioneer::{CORRIDOR_WIDTH, body};
use crate::registry::{Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing};

/// [`NoisyMouse`], which is told the same as the micromouse and has no compass. It localizes with a
/// particle filter over the walls it believes in: what many would choose instead.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallBeliefEntry;

/// Number of the laser's beams that its filter weighs.
const BEAMS: u32 = 8;

impl SystemEntry for WallBeliefEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "Wall belief",
            about: "believes in walls, as a noisy micromouse, and knows where it is by particles",
            needs: "needs a laser ring and encoders",
            why_no_log: WALLS,
            for_robot: Err("it is told the maze's size, and the measures do not give it"),
            ..SystemFacts::new("wall-belief")
        }
    }

    fn abstains(&self, maze: &Maze) -> Option<String> {
        too_large(maze)
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        setup.settings.none()?;
        setup.terrain.maze("the wall belief")?;
        let mut config = setup.robot.laser_config();
        config.ring = Ring::full(BEAMS, config.ring.max_range);
        let course = setup.course(&body(), CORRIDOR_WIDTH)?;
        let start = setup.start(&course, || course.anywhere(setup.seed))?;
        let mut mouse = NoisyMouseConfig::new(
            course.corridor_width,
            config.turn_per_step,
            config.translate_per_step,
        );
        mouse.motion = MotionSource::Encoders;
        let mouse = NoisyMouse::new(brief_from(&course, start), mouse, setup.seed)?;
        let robot = setup.laser_at(&course, start, config)?;
        Ok(setup.send(self.name(), course, robot, mouse))
    }
}
