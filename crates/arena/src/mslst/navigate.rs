use alloc::sync::Arc;

use rand::Rng;
use tolman_maps::mslst_graph::{Localization, Memory, localize};
use tolman_maze::Direction;
use tolman_planners::compressed;

use super::{MslstConfig, MslstMap};
use crate::agents::{Avoid, Brain, Guess, Perception, Place, Thought};
use crate::pioneer::heading_free;

/// The MSLST brain: Phase III, *Navigation Using the Graph*.
///
/// "MSLST navigates by matching its current and past sensory states and actions with part of the graph, then
/// following the actions encoded in the graph that lead to the nearest destination node (first simplifying
/// that set of actions by compressing the path). Once it reaches a destination node (and thus believes it has
/// solved the maze), it acts randomly (like Avoid) for eight actions … If it can't match its current state
/// with any node in the graph or if the actions the graph suggests fail, it chooses an action randomly."
#[derive(Clone, Debug)]
pub struct Mslst {
    map: Arc<MslstMap>,
    memory: Memory,
    /// The state of the last perception that had one.
    state: Option<u32>,
    /// What failed since the robot last moved.
    failed: Vec<Direction>,
    /// Its random actions are those of Avoid.
    wander: Avoid,
    doubt: u32,
    /// How many random actions are still to come after it believed to have arrived.
    doubts_left: u32,
    situation: Situation,
}

/// What the brain makes of where it is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Situation {
    /// It acts randomly: it has no state yet, or the graph suggests nothing that has not failed.
    #[default]
    Lost,
    /// It acts randomly because it believes to have arrived where it has not.
    Doubtful,
    /// It is at a node and follows the path from there.
    OnPath {
        /// Where it may be.
        belief: Localization,
        /// The actions to the destination as it sees them, the next one first.
        path: Vec<Direction>,
    },
}

impl Mslst {
    /// A brain that knows `map` and remembers nothing yet.
    #[must_use]
    pub fn new(map: Arc<MslstMap>, config: &MslstConfig) -> Self {
        Self {
            map,
            memory: Memory::new(config.memory as usize),
            state: None,
            failed: Vec::new(),
            wander: Avoid::default(),
            doubt: config.doubt,
            doubts_left: 0,
            situation: Situation::Lost,
        }
    }

    /// What it made of where it was when it chose the last action.
    #[must_use]
    pub const fn situation(&self) -> &Situation {
        &self.situation
    }

    /// "At every action, it stores its current state and the action that got it there into a list (leaving
    /// out failed actions and the states they resulted in)."
    fn remember(&mut self, perception: &Perception<'_>) {
        self.wander.learn(perception.last);
        match perception.last {
            Some((action, outcome)) if !outcome.moved() => self.failed.push(action),
            last => {
                self.failed.clear();
                // Blind for a moment: what was sensed before still holds.
                self.state = self.sense(perception).or(self.state);
                match (last, self.state) {
                    (Some((action, _)), Some(state)) => self.memory.moved(action, state),
                    (None, Some(state)) => self.memory.start(state),
                    (_, None) => {}
                }
            }
        }
    }

    /// "The number of the GNG state that most closely matches the current input vector."
    fn sense(&self, perception: &Perception<'_>) -> Option<u32> {
        let scan = heading_free(perception.scan?, perception.heading?);
        self.map.states.nearest(&scan).ok()
    }

    /// What the graph suggests.
    fn consult(&mut self) -> Situation {
        if self.doubts_left > 0 {
            self.doubts_left -= 1;
            return Situation::Doubtful;
        }
        let belief = localize(&self.map.graph, &self.memory);
        let Some(node) = belief.node else {
            return Situation::Lost;
        };
        if self.map.graph.is_destination(node) {
            // This action is the first of them.
            self.doubts_left = self.doubt.saturating_sub(1);
            return Situation::Doubtful;
        }
        match self.path_from(node) {
            Some(path) if !path.is_empty() => Situation::OnPath { belief, path },
            _ => Situation::Lost,
        }
    }

    /// The path to the nearest destination node, "fully simplified": compressed, after which "if the first
    /// action in the path is one the robot just failed at, we remove it from the path and begin with the
    /// next action".
    fn path_from(&self, node: u32) -> Option<Vec<Direction>> {
        let path = self.map.graph.path_to_destination(node, &self.failed)?;
        let path = compressed(&path, |action| action.opposite());
        let failed = |action: &Direction| self.failed.contains(action);
        Some(path.into_iter().skip_while(failed).collect())
    }
}

fn said(words: &str) -> Thought {
    Thought {
        words: words.to_owned(),
        guesses: Vec::new(),
    }
}

impl Brain for Mslst {
    fn choose(&mut self, perception: &Perception<'_>, rng: &mut dyn Rng) -> Direction {
        self.remember(perception);
        self.situation = self.consult();
        match &self.situation {
            Situation::OnPath { path, .. } => path[0],
            Situation::Lost | Situation::Doubtful => self.wander.wander(rng),
        }
    }

    fn thought(&self) -> Thought {
        match &self.situation {
            Situation::Lost => said("lost: acts randomly"),
            Situation::Doubtful => said("believes to have arrived: acts randomly"),
            Situation::OnPath { belief, path } => {
                let (count, matched) = (belief.candidates.len(), belief.matched);
                let guess = |weight: f64| {
                    move |id: u32| Guess {
                        place: Place::Node(id),
                        weight,
                    }
                };
                let others = belief.candidates.iter().copied();
                let others = others.filter(|id| belief.node != Some(*id));
                Thought {
                    words: format!(
                        "one of {count} nodes that match {matched}, {} actions to go",
                        path.len()
                    ),
                    guesses: belief
                        .node
                        .into_iter()
                        .map(guess(1.0))
                        .chain(others.map(guess(1.0 / count as f64)))
                        .collect(),
                }
            }
        }
    }
}
