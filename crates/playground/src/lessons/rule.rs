use core::convert::Infallible;

use rand::Rng;
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_systems::control::heading_of;
use tolman_systems::robot::{Mapper, Scan, Standing, Task};
use tolman_systems::{Brain, Doing, TimeStep};

/// A brain that obeys a pupil's rule: it goes to the first of some sides that is open. It has no
/// memory but its direction of travel.
#[derive(Clone, Debug)]
pub struct RuleBrain {
    rule: Vec<Direction>,
    corridor_width: f64,
    travelling: Direction,
    /// Last scan, and the robot's heading then.
    view: Option<(Scan, Heading)>,
}

impl RuleBrain {
    /// Returns a brain in corridors `corridor_width` metres wide that looks to `heading` first. The
    /// lines of `rule` are sides of the robot, where north is ahead.
    #[must_use]
    pub const fn new(rule: Vec<Direction>, corridor_width: f64, heading: Direction) -> Self {
        Self {
            rule,
            corridor_width,
            travelling: heading,
            view: None,
        }
    }

    /// Returns the direction in which the robot last travelled.
    #[must_use]
    pub const fn travelling(&self) -> Direction {
        self.travelling
    }

    /// Returns whether the laser reaches farther than the corridor is wide.
    fn is_open(&self, direction: Direction) -> bool {
        let view = self.view.as_ref();
        view.is_some_and(|(scan, robot)| {
            let bearing = robot.turn_to(heading_of(direction));
            let range = scan.range_towards(bearing, 0);
            range.is_some_and(|range| range >= self.corridor_width)
        })
    }

    /// Returns the first line of the rule whose side is open.
    fn choice(&self) -> Option<Direction> {
        let directions = self.rule.iter().map(|side| self.travelling.turned(*side));
        let mut open = directions.filter(|direction| self.is_open(*direction));
        open.next()
    }
}

impl Mapper for RuleBrain {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        if let Doing::Ended(action, outcome) = seen.doing
            && outcome.moved()
        {
            self.travelling = action;
        }
        if !matches!(seen.doing, Doing::UnderWay(_)) {
            self.view = seen.scan.clone().zip(seen.heading);
        }
        Ok(())
    }
}

impl Brain for RuleBrain {
    fn choose(&mut self, _rng: &mut dyn Rng) -> Direction {
        self.choice().unwrap_or(self.travelling)
    }

    fn standing(&self, _task: Task) -> Standing {
        match self.choice() {
            Some(_) => Standing::UnderWay,
            None => Standing::gave_up("no line of the rule names an open side"),
        }
    }
}
