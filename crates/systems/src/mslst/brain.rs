use alloc::sync::Arc;
use core::convert::Infallible;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::{Fitted, Guess, MapView, Mapper, RobotMeasures, Standing, Task};

use super::{MslstConfig, MslstMap, Navigator, ScanRecorder, States, StatesError, Topology};
use crate::{Actor, Brain, Doing, ForRobotError, LaserRobot, OnRobot, TimeStep};

/// MSLST as a whole: it records scans (Phase I), makes states of them and maps their topology
/// (Phase II), and then navigates (Phase III).
///
/// It learns from the time steps that it observes, whatever drives the robot. Let an
/// [`Actor`](crate::Actor) drive it, and [`Task::Explore`] is Phases I and II, [`Task::Reach`] with
/// the landmark of the goal is Phase III.
#[derive(Clone, Debug)]
pub struct Mslst {
    config: MslstConfig,
    phase: Phase,
}

#[derive(Clone, Debug)]
enum Phase {
    Scans(ScanRecorder),
    Topology(Box<Topology>),
    Navigation(Navigator),
}

impl Mslst {
    /// Returns a brain without knowledge.
    #[must_use]
    pub fn new(config: MslstConfig) -> Self {
        Self {
            config,
            phase: Phase::Scans(ScanRecorder::new(config.scan_steps)),
        }
    }

    /// Returns a brain without knowledge on a robot of these measures, which explores as in the
    /// paper's Large maze. All random numbers follow from `seed`.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no compass.
    pub fn for_robot<R: LaserRobot>(
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, Actor<Self>>, ForRobotError> {
        let made = |_, _| Self::new(MslstConfig::large(50.0));
        Actor::for_robot(made, measures, robot, seed)
    }

    /// Returns a brain with a learned `map`.
    #[must_use]
    pub fn knowing(map: Arc<MslstMap>, config: MslstConfig) -> Self {
        let navigator = Navigator::new(map, &config);
        Self {
            config,
            phase: Phase::Navigation(navigator),
        }
    }

    /// Returns the learned map; `None` before the end of Phase II.
    #[must_use]
    pub const fn learned(&self) -> Option<&Arc<MslstMap>> {
        match &self.phase {
            Phase::Scans(_) | Phase::Topology(_) => None,
            Phase::Navigation(navigator) => Some(navigator.knows()),
        }
    }

    /// Returns the number of nodes of its graph so far. Their ids count up from 0.
    #[must_use]
    pub fn node_count(&self) -> usize {
        match &self.phase {
            Phase::Scans(_) => 0,
            Phase::Topology(topology) => topology.nodes().len(),
            Phase::Navigation(navigator) => navigator.knows().graph.len(),
        }
    }

    /// Returns the phase under way.
    fn brain(&self) -> &dyn Brain<Observation = TimeStep, Error = Infallible> {
        match &self.phase {
            Phase::Scans(scans) => scans,
            Phase::Topology(topology) => &**topology,
            Phase::Navigation(navigator) => navigator,
        }
    }

    fn brain_mut(&mut self) -> &mut dyn Brain<Observation = TimeStep, Error = Infallible> {
        match &mut self.phase {
            Phase::Scans(scans) => scans,
            Phase::Topology(topology) => &mut **topology,
            Phase::Navigation(navigator) => navigator,
        }
    }

    /// Changes to the next phase once one is complete. The robot stays where `seen` was sensed.
    fn advance(&mut self, seen: &TimeStep) -> Result<(), StatesError> {
        if let Phase::Scans(scans) = &self.phase
            && scans.is_complete()
        {
            let states = States::learn(scans.scans(), self.config.threshold)?;
            let topology = Topology::new(states, self.config.graph_actions, seen);
            self.phase = Phase::Topology(Box::new(topology));
        }
        if let Phase::Topology(topology) = &self.phase
            && topology.is_complete()
        {
            let map = Arc::new(topology.finished());
            let mut navigator = Navigator::new(map, &self.config);
            navigator.begin(seen);
            self.phase = Phase::Navigation(navigator);
        }
        Ok(())
    }
}

impl Mapper for Mslst {
    type Observation = TimeStep;
    type Error = StatesError;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), StatesError> {
        let Ok(()) = self.brain_mut().observe(seen);
        match seen.doing {
            Doing::UnderWay(_) => Ok(()),
            Doing::PutDown | Doing::Ended(..) => self.advance(seen),
        }
    }

    fn map(&self) -> MapView {
        self.brain().map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.brain().belief()
    }

    fn doubt(&self) -> Option<String> {
        let graph = &self.learned()?.graph;
        if !graph.ids().any(|id| graph.is_destination(id)) {
            return Some("the robot never came to the destination".to_owned());
        }
        let lost = graph.ids().filter(|id| graph.distance(*id).is_none());
        let lost = lost.count();
        (2 * lost > graph.len()).then(|| {
            format!(
                "no way to the destination is known from {lost} of {} nodes",
                graph.len()
            )
        })
    }

    fn map_bytes(&self) -> Option<usize> {
        self.learned().map(|map| map.bytes())
    }
}

impl Brain for Mslst {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.brain_mut().choose(rng)
    }

    fn standing(&self, task: Task) -> Standing {
        match (&self.phase, self.brain().standing(task)) {
            // After the scans come the states and the graph.
            (Phase::Scans(_), Standing::Done) => Standing::UnderWay,
            (_, standing) => standing,
        }
    }

    fn words(&self) -> String {
        self.brain().words()
    }
}
