use core::convert::Infallible;
use core::f64::consts::PI;

use rand::{Rng, RngExt};
use tolman_control::heading_of;
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{Mapper, Scan};

use super::AvoidBrain;
use crate::{Brain, Doing, TimeStep};

/// MSLST's Wall-follow brain: "always sticks to the wall on its right".
///
/// If the laser sees no wall on the right, it turns right. Otherwise it tries ahead, then left,
/// then back, relative to the direction it last travelled in. A successful action gives the new
/// direction; the first one is drawn.
///
/// The paper does not say that this brain uses the laser, but its figures do. An action takes 2.1
/// time steps in both mazes, which is the cost of actions that hardly ever fail. A brain that feels
/// for the wall by trying to turn into it fails every other action (1.7 steps; see
/// `docs/notebook/mslst.md`).
#[derive(Clone, Debug)]
pub struct WallFollow {
    corridor_width: f64,
    /// Memory of its actions' outcomes, as Avoid's.
    memory: AvoidBrain,
    /// The last scan and the robot's heading then; `None` while either sensor drops out.
    view: Option<(Scan, Heading)>,
}

/// Angle on both sides of a direction within which a beam shows a wall, rad. A beam shows a wall if
/// its range is below the corridor's width. Through an opening in which the robot fits it reaches
/// farther.
const WATCHED: f64 = PI / 12.0;

impl WallFollow {
    /// Returns a wall follower in corridors `corridor_width` metres wide.
    #[must_use]
    pub fn new(corridor_width: f64) -> Self {
        Self {
            corridor_width,
            memory: AvoidBrain::default(),
            view: None,
        }
    }

    /// Returns whether the laser sees a wall beside the robot in the direction of `heading`.
    /// Without a scan the brain assumes an opening and tries it.
    fn wall_towards(&self, heading: Heading) -> bool {
        let Some((scan, robot)) = &self.view else {
            return false;
        };
        (0_u32..).zip(&scan.ranges).any(|(beam, range)| {
            let beam_heading = robot.turned(scan.ring.bearing(beam));
            beam_heading.turn_to(heading).abs() <= WATCHED && *range < self.corridor_width
        })
    }
}

impl Mapper for WallFollow {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        self.memory.learn(seen.doing);
        if matches!(seen.doing, Doing::UnderWay(_)) {
            return Ok(());
        }
        self.view = seen.scan.clone().zip(seen.heading);
        Ok(())
    }
}

impl Brain for WallFollow {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        let travelling = *self
            .memory
            .travelling
            .get_or_insert_with(|| Direction::ALL[rng.random_range(0..4_u32) as usize]);
        let right = travelling.right();
        let is_wall = self.wall_towards(heading_of(right));
        let failed = &mut self.memory.failed;
        if is_wall && !failed.contains(&right) {
            failed.push(right);
        }
        let order = [right, travelling, travelling.left(), travelling.opposite()];
        order
            .into_iter()
            .find(|action| !failed.contains(action))
            .unwrap_or_else(|| {
                failed.clear();
                travelling
            })
    }
}
