use alloc::sync::Arc;
use core::convert::Infallible;

use rand::Rng;
use tolman_maps::mslst_graph::{GraphMapper, Localization, Memory, NodeZone, localize, overlay};
use tolman_maze::Direction;
use tolman_planners::compressed;
use tolman_robot::{Goal, Guess, Landmark, MapView, Mapper, Position, Standing, Task};

use super::north_scan::north_scan;
use super::{MslstConfig, MslstMap};
use crate::baselines::AvoidBrain;
use crate::{Brain, Doing, TimeStep};

/// The brain of Phase III, *Navigation Using the Graph*.
///
/// "MSLST navigates by matching its current and past sensory states and actions with part of the
/// graph, then following the actions encoded in the graph that lead to the nearest destination node
/// (first simplifying that set of actions by compressing the path). Once it reaches a destination
/// node (and thus believes it has solved the maze), it acts randomly (like Avoid) for eight actions
/// … If it can't match its current state with any node in the graph or if the actions the graph
/// suggests fail, it chooses an action randomly."
#[derive(Clone, Debug)]
pub struct Navigator {
    map: Arc<MslstMap>,
    config: MslstConfig,
    memory: Memory,
    matches: Matches,
    /// Graph of what was walked since it was put down, if it matches that.
    walked: Option<GraphMapper>,
    /// State of the last perception that had one.
    state: Option<u32>,
    /// Actions that failed since the robot last moved.
    failed: Vec<Direction>,
    /// Avoid, which makes the random actions.
    wander: AvoidBrain,
    /// Number of random actions still to come after the robot believed that it had arrived.
    doubts_left: u32,
    situation: NavigationState,
}

/// What a navigator matches with its graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Matches {
    /// The last experiences, as the paper does.
    #[default]
    Window,
    /// A second graph, built while it navigates: the paper's next step.
    SecondGraph,
}

/// State of a navigator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum NavigationState {
    /// The robot acts randomly: it has no state yet, or the graph suggests only actions that have
    /// failed.
    #[default]
    Lost,
    /// The robot acts randomly because it falsely believes that it has arrived.
    Doubtful,
    /// The robot is at a node and follows the path from there.
    OnPath {
        /// Possible places of the robot.
        belief: Localization,
        /// Actions to the destination, the next one first.
        path: Vec<Direction>,
    },
}

impl Navigator {
    /// Returns a brain that knows `map` and has an empty memory.
    #[must_use]
    pub fn new(map: Arc<MslstMap>, config: &MslstConfig) -> Self {
        Self {
            map,
            config: *config,
            memory: Memory::new(config.memory as usize),
            matches: Matches::default(),
            walked: None,
            state: None,
            failed: Vec::new(),
            wander: AvoidBrain::default(),
            doubts_left: 0,
            situation: NavigationState::Lost,
        }
    }

    /// Returns the navigator with another localization: it builds a second graph while it navigates
    /// and [overlays](overlay) it on its map, where the paper compares its last experiences.
    #[must_use]
    pub const fn overlaying(mut self) -> Self {
        self.matches = Matches::SecondGraph;
        self
    }

    /// Returns the map by which it navigates.
    #[must_use]
    pub const fn knows(&self) -> &Arc<MslstMap> {
        &self.map
    }

    /// Returns the navigator's state.
    #[must_use]
    pub const fn situation(&self) -> &NavigationState {
        &self.situation
    }

    /// Forgets everything but the map: the robot has been put down, and senses `seen`.
    pub(super) fn begin(&mut self, seen: &TimeStep) {
        let matches = self.matches;
        *self = Self::new(Arc::clone(&self.map), &self.config);
        self.matches = matches;
        self.state = self.sense(seen);
        if let Some(state) = self.state {
            self.memory.start(state);
            self.walked = self.first_walked(state);
        }
        self.situation = self.consult();
    }

    /// Remembers an action and its state: "At every action, it stores its current state and the
    /// action that got it there into a list (leaving out failed actions and the states they
    /// resulted in)."
    fn remember(&mut self, action: Direction, seen: &TimeStep) {
        self.failed.clear();
        // Blind for a moment: what was sensed before still holds.
        self.state = self.sense(seen).or(self.state);
        if let Some(state) = self.state {
            self.memory.moved(action, state);
            match &mut self.walked {
                Some(walked) => {
                    walked.succeeded(action, state, NodeZone::Elsewhere);
                }
                None => self.walked = self.first_walked(state),
            }
        }
    }

    /// Returns a second graph that begins in a state; `None` if it builds none.
    fn first_walked(&self, state: u32) -> Option<GraphMapper> {
        let builds = self.matches == Matches::SecondGraph;
        builds.then(|| GraphMapper::new(state, NodeZone::Elsewhere))
    }

    fn localize(&self) -> Localization {
        match &self.walked {
            Some(walked) => overlay(&self.map.graph, walked),
            None => localize(&self.map.graph, &self.memory),
        }
    }

    /// Returns "the number of the GNG state that most closely matches the current input vector".
    fn sense(&self, seen: &TimeStep) -> Option<u32> {
        self.map.states.nearest(&north_scan(seen)?).ok()
    }

    /// Returns the navigation state that follows from the graph: on a path, doubtful or lost.
    fn consult(&mut self) -> NavigationState {
        if self.doubts_left > 0 {
            self.doubts_left -= 1;
            return NavigationState::Doubtful;
        }
        let belief = self.localize();
        let Some(node) = belief.node else {
            return NavigationState::Lost;
        };
        if self.map.graph.is_destination(node) {
            // This action is the first of them.
            self.doubts_left = self.config.doubt.saturating_sub(1);
            return NavigationState::Doubtful;
        }
        match self.path_from(node) {
            Some(path) if !path.is_empty() => NavigationState::OnPath { belief, path },
            _ => NavigationState::Lost,
        }
    }

    /// Returns the path to the nearest destination node, "fully simplified". The path is
    /// compressed. Then "if the first action in the path is one the robot just failed at, we remove
    /// it from the path and begin with the next action".
    fn path_from(&self, node: u32) -> Option<Vec<Direction>> {
        let path = self.map.graph.path_to_destination(node, &self.failed)?;
        let path = compressed(&path, |action| action.opposite());
        let failed = |action: &Direction| self.failed.contains(action);
        Some(path.into_iter().skip_while(failed).collect())
    }
}

impl Navigator {
    /// Returns the state of localization: done if exactly one node fits the robot's memory.
    fn localized(&self) -> Standing {
        let Localization {
            candidates,
            matched,
            ..
        } = self.localize();
        match candidates.len() {
            1 => Standing::Done,
            count if count > 1 && matched >= self.config.memory as usize => Standing::gave_up(
                format!("{count} nodes fit all {matched} experiences that it remembers"),
            ),
            _ => Standing::UnderWay,
        }
    }
}

impl Mapper for Navigator {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        self.wander.learn(seen.doing);
        match seen.doing {
            Doing::UnderWay(_) => return Ok(()),
            Doing::PutDown => {
                self.begin(seen);
                return Ok(());
            }
            Doing::Ended(action, outcome) if !outcome.moved() => {
                self.failed.push(action);
                if let Some(walked) = &mut self.walked {
                    walked.failed(action);
                }
            }
            Doing::Ended(action, _) => self.remember(action, seen),
        }
        self.situation = self.consult();
        Ok(())
    }

    fn map(&self) -> MapView {
        self.map.view()
    }

    /// Returns the belief; empty while it acts randomly.
    fn belief(&self) -> Vec<Guess> {
        let NavigationState::OnPath { belief, .. } = &self.situation else {
            return Vec::new();
        };
        let guess = |weight: f64| {
            move |id: u32| Guess {
                at: Position::Place(id),
                weight,
            }
        };
        let others = belief.candidates.iter().copied();
        let others = others.filter(|id| belief.node != Some(*id));
        let share = 1.0 / belief.candidates.len() as f64;
        let best = belief.node.into_iter().map(guess(1.0));
        best.chain(others.map(guess(share))).collect()
    }
}

impl Brain for Navigator {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        match &self.situation {
            NavigationState::OnPath { path, .. } => path[0],
            NavigationState::Lost | NavigationState::Doubtful => self.wander.wander(rng),
        }
    }

    fn standing(&self, task: Task) -> Standing {
        match task {
            Task::Explore => Standing::Done,
            Task::Reach(Goal::Landmark(Landmark::Goal)) => Standing::UnderWay,
            Task::Reach(_) => {
                Standing::gave_up("its graph leads to the landmark of the goal alone")
            }
            Task::Localize => self.localized(),
        }
    }

    fn words(&self) -> String {
        match &self.situation {
            NavigationState::Lost => "lost: acts randomly".to_owned(),
            NavigationState::Doubtful => "believes to have arrived: acts randomly".to_owned(),
            NavigationState::OnPath { belief, path } => format!(
                "one of {} nodes that match {}, {} actions to go",
                belief.candidates.len(),
                belief.matched,
                path.len()
            ),
        }
    }
}
