use alloc::sync::Arc;

use rand::Rng;
use tolman_control::RingError;
use tolman_maps::scan_map::ScanChart;
use tolman_maze::Direction;
use tolman_robot::{
    Fitted, Guess, MapView, Mapper, Ring, RobotMeasures, Standing, Task, VisitNaming,
};

use super::better::{BetterConfig, BetterExplorer, BetterMap, BetterNavigator};
use crate::on_robot::needed;
use crate::{Brain, Doing, ForRobotError, LaserRobot, OnRobot, OwnHeading, RolledStep};

/// The better MSLST as a whole: it explores, makes its map ready, and then navigates.
///
/// Let an [`Actor`](crate::Actor) drive it. [`Task::Explore`] ends when no gap is left. If the
/// robot is put down elsewhere before that, exploration ends and it navigates by the map so far. As
/// long as it has not explored everything, it looks for a landmark that it is sent to, and maps on
/// the way, also if walls come and go.
#[derive(Clone, Debug)]
pub struct BetterMslst {
    config: BetterConfig,
    ring: Ring,
    phase: Phase,
}

#[derive(Clone, Debug)]
enum Phase {
    Exploration(Box<BetterExplorer>),
    /// The system has explored everything, and its robot has not moved since.
    Explored(Box<BetterExplorer>, Box<BetterNavigator>),
    Navigation(Box<BetterNavigator>),
}

impl BetterMslst {
    /// Returns a system without knowledge. `ring` is that of its robot's scans.
    #[must_use]
    pub fn new(config: BetterConfig, ring: Ring) -> Self {
        Self {
            config,
            ring,
            phase: Phase::Exploration(Box::new(BetterExplorer::new(config))),
        }
    }

    /// Returns a system without knowledge on a robot of these measures. All random numbers follow
    /// from `seed`.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no odometry.
    pub fn for_robot<R: LaserRobot>(
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, OwnHeading<Self>>, ForRobotError> {
        let mut config = BetterConfig::pioneer();
        config.odometry_sd = needed(measures.odometry_error, "odometry_error")?;
        config.check()?;
        let made = |ring, diameter| Self::new(BetterConfig { diameter, ..config }, ring);
        OwnHeading::for_robot(made, measures, robot, seed)
    }

    /// Returns the chart of the map so far. O(map).
    #[must_use]
    pub fn chart(&self) -> ScanChart {
        match &self.phase {
            Phase::Exploration(explorer) | Phase::Explored(explorer, _) => {
                explorer.learned().chart()
            }
            Phase::Navigation(navigator) => navigator.chart().clone(),
        }
    }

    /// Returns the number of known places.
    #[must_use]
    pub fn place_count(&self) -> usize {
        match &self.phase {
            Phase::Exploration(explorer) | Phase::Explored(explorer, _) => {
                explorer.learned().places().len()
            }
            Phase::Navigation(navigator) => navigator.chart().places().len(),
        }
    }

    /// Returns the phase under way.
    fn brain(&self) -> &dyn Brain<Observation = RolledStep, Error = core::convert::Infallible> {
        match &self.phase {
            Phase::Exploration(explorer) | Phase::Explored(explorer, _) => &**explorer,
            Phase::Navigation(navigator) => &**navigator,
        }
    }

    /// Makes the map of `explorer` ready. O(standpoints · tries · steps · beams).
    fn navigator(&self, explorer: &BetterExplorer) -> Result<Box<BetterNavigator>, RingError> {
        let map = BetterMap::of(explorer.learned().chart(), self.ring, &self.config)?;
        Ok(Box::new(BetterNavigator::new(Arc::new(map))))
    }

    /// Ends the exploration of a robot that is lifted during it.
    fn lifted(&mut self) -> Result<(), RingError> {
        if let Phase::Exploration(explorer) = &self.phase
            && !explorer.learned().places().is_empty()
        {
            self.phase = Phase::Navigation(self.navigator(explorer)?);
        }
        Ok(())
    }

    /// Changes to navigation once everything is explored. The robot stays where `seen` was sensed.
    fn advance(&mut self, seen: &RolledStep) -> Result<(), RingError> {
        if let Phase::Exploration(explorer) = &self.phase
            && explorer.standing(Task::Explore) == Standing::Done
        {
            let mut navigator = self.navigator(explorer)?;
            let mut here = seen.clone();
            here.step.doing = Doing::PutDown;
            let Ok(()) = navigator.observe(&here);
            self.phase = Phase::Explored(explorer.clone(), navigator);
        }
        Ok(())
    }
}

impl Mapper for BetterMslst {
    type Observation = RolledStep;
    type Error = RingError;

    fn observe(&mut self, seen: &RolledStep) -> Result<(), RingError> {
        if seen.step.doing == Doing::PutDown {
            self.lifted()?;
        }
        match &mut self.phase {
            Phase::Exploration(explorer) => {
                let Ok(()) = explorer.observe(seen);
                match seen.step.doing {
                    Doing::Ended(..) => self.advance(seen),
                    Doing::PutDown | Doing::UnderWay(_) => Ok(()),
                }
            }
            Phase::Explored(_, navigator) => {
                let Ok(()) = navigator.observe(seen);
                self.phase = Phase::Navigation(navigator.clone());
                Ok(())
            }
            Phase::Navigation(navigator) => {
                let Ok(()) = navigator.observe(seen);
                Ok(())
            }
        }
    }

    fn map(&self) -> MapView {
        self.brain().map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.brain().belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        self.brain().visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.brain().visits()
    }

    fn visit_count(&self) -> usize {
        self.brain().visit_count()
    }

    fn certainty(&self) -> Option<f64> {
        self.brain().certainty()
    }

    fn doubt(&self) -> Option<String> {
        match &self.phase {
            Phase::Exploration(explorer) | Phase::Explored(explorer, _) => explorer.doubt(),
            Phase::Navigation(navigator) => navigator.chart().doubt().map(ToOwned::to_owned),
        }
    }

    fn map_bytes(&self) -> Option<usize> {
        self.brain().map_bytes()
    }
}

impl Brain for BetterMslst {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        match &mut self.phase {
            Phase::Exploration(explorer) => explorer.choose(rng),
            Phase::Explored(_, navigator) | Phase::Navigation(navigator) => navigator.choose(rng),
        }
    }

    fn aim(&mut self, task: Task) {
        match &mut self.phase {
            Phase::Exploration(explorer) => explorer.aim(task),
            Phase::Explored(_, navigator) | Phase::Navigation(navigator) => navigator.aim(task),
        }
    }

    fn standing(&self, task: Task) -> Standing {
        match (&self.phase, task) {
            (Phase::Explored(_, navigator), Task::Reach(_) | Task::Localize) => {
                navigator.standing(task)
            }
            _ => self.brain().standing(task),
        }
    }

    fn sees_straight(&self) -> bool {
        self.brain().sees_straight()
    }

    fn words(&self) -> String {
        self.brain().words()
    }
}
