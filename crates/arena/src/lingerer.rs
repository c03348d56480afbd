use core::convert::Infallible;

use rand::Rng;
use tolman_maps::scan_map::ScanMap;
use tolman_maze::Direction;
use tolman_robot::{Guess, MapView, Mapper, Standing, Task};
use tolman_systems::baselines::AvoidBrain;
use tolman_systems::mslst::better::BetterExplorer;
use tolman_systems::{Brain, Doing, RolledStep};

/// An explorer that goes on wandering and learning for a while after it has been everywhere.
#[derive(Debug)]
pub(crate) struct Lingerer {
    explorer: BetterExplorer,
    wander: AvoidBrain,
    actions: u32,
    /// Number of actions until the explorer had been everywhere; `None` before.
    explored: Option<u32>,
    times: u32,
    /// Whether the robot wanders from the beginning.
    wanders: bool,
}

impl Lingerer {
    /// Returns a brain that makes `times` as many actions as `explorer` needs to be everywhere.
    pub(crate) fn new(explorer: BetterExplorer, times: u32) -> Self {
        Self {
            explorer,
            wander: AvoidBrain::default(),
            actions: 0,
            explored: None,
            times,
            wanders: false,
        }
    }

    /// Returns a brain that wanders until `explorer` finds that it has been everywhere.
    pub(crate) fn wandering(explorer: BetterExplorer) -> Self {
        Self {
            wanders: true,
            ..Self::new(explorer, 1)
        }
    }

    /// Returns the number of actions until the robot had been everywhere, or of all actions if it
    /// never was.
    pub(crate) fn explored(&self) -> u32 {
        self.explored.unwrap_or(self.actions)
    }

    pub(crate) const fn learned(&self) -> &ScanMap {
        self.explorer.learned()
    }

    pub(crate) fn into_learned(self) -> ScanMap {
        self.explorer.into_learned()
    }
}

impl Mapper for Lingerer {
    type Observation = RolledStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &RolledStep) -> Result<(), Infallible> {
        let Ok(()) = self.wander.observe(&seen.step);
        self.explorer.observe(seen)?;
        self.actions += u32::from(matches!(seen.step.doing, Doing::Ended(..)));
        if self.explored.is_none() && self.explorer.standing(Task::Explore) != Standing::UnderWay {
            self.explored = Some(self.actions);
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        self.explorer.map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.explorer.belief()
    }
}

impl Brain for Lingerer {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        if self.wanders || self.explored.is_some() {
            self.wander.choose(rng)
        } else {
            self.explorer.choose(rng)
        }
    }

    fn standing(&self, task: Task) -> Standing {
        match self.explored {
            Some(explored) if self.actions < explored * self.times => Standing::UnderWay,
            _ => self.explorer.standing(task),
        }
    }

    fn sees_straight(&self) -> bool {
        self.explorer.sees_straight()
    }
}
