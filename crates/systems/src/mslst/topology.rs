use core::convert::Infallible;

use rand::Rng;
use tolman_maps::mslst_graph::{GraphMapper, Node, NodeZone};
use tolman_maze::Direction;
use tolman_robot::{Guess, Landmark, MapView, Mapper, Position, Standing, Task};

use super::map::view;
use super::north_scan::north_scan;
use super::scan_recorder::standing_of_phase;
use super::{MslstMap, States};
use crate::baselines::AvoidBrain;
use crate::{Brain, Doing, TimeStep};

/// Phase II: "the robot wanders at random as in Phase I, but this time instead of recording sensor
/// data it determines the closest-matching GNG state at the start of every high-level action". It
/// adds that state to the graph.
///
/// An action that was cut short after a step succeeded ("MSLST will not record it as a failed
/// action"). If the robot is put down again, the graph begins again.
#[derive(Clone, Debug)]
pub struct Topology {
    states: States,
    mapper: GraphMapper,
    /// State of the last place that had one.
    state: u32,
    actions: u32,
    wanted: u32,
    wander: AvoidBrain,
}

impl Topology {
    /// Returns the graph of the one place where `first` was sensed, to be grown for `actions`
    /// actions.
    #[must_use]
    pub fn new(states: States, actions: u32, first: &TimeStep) -> Self {
        let state = state_of(&states, first).unwrap_or(0);
        Self {
            states,
            mapper: GraphMapper::new(state, zone(first)),
            state,
            actions: 0,
            wanted: actions,
            wander: AvoidBrain::default(),
        }
    }

    /// Returns the nodes made so far, by id.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        self.mapper.nodes()
    }

    /// Returns the number of actions that were observed.
    #[must_use]
    pub const fn actions(&self) -> u32 {
        self.actions
    }

    /// Returns whether all actions were observed.
    #[must_use]
    pub const fn is_complete(&self) -> bool {
        self.actions >= self.wanted
    }

    /// Returns the learned map, with every node's distance to the destination. O(nodes + edges).
    #[must_use]
    pub fn finished(&self) -> MslstMap {
        MslstMap {
            states: self.states.clone(),
            graph: self.mapper.clone().finish(),
        }
    }

    fn ended(&mut self, action: Direction, seen: &TimeStep) {
        // Blind for a moment, or a scan of another ring: what was sensed before still holds.
        self.state = state_of(&self.states, seen).unwrap_or(self.state);
        self.mapper.succeeded(action, self.state, zone(seen));
    }
}

impl Mapper for Topology {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        self.wander.learn(seen.doing);
        match seen.doing {
            Doing::PutDown => *self = Self::new(self.states.clone(), self.wanted, seen),
            Doing::UnderWay(_) => {}
            Doing::Ended(action, outcome) => {
                self.actions += 1;
                if outcome.moved() {
                    self.ended(action, seen);
                } else {
                    self.mapper.failed(action);
                }
            }
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        view(self.nodes())
    }

    fn belief(&self) -> Vec<Guess> {
        vec![Guess {
            at: Position::Place(self.mapper.at()),
            weight: 1.0,
        }]
    }
}

impl Brain for Topology {
    fn choose(&mut self, rng: &mut dyn Rng) -> Direction {
        self.wander.wander(rng)
    }

    fn standing(&self, task: Task) -> Standing {
        let why = "its graph is not finished yet: let it explore first";
        standing_of_phase(task, self.is_complete(), why)
    }

    fn words(&self) -> String {
        let nodes = self.nodes().len();
        format!(
            "maps action {} of {}: {nodes} nodes",
            self.actions, self.wanted
        )
    }
}

fn state_of(states: &States, seen: &TimeStep) -> Option<u32> {
    states.nearest(&north_scan(seen)?).ok()
}

fn zone(seen: &TimeStep) -> NodeZone {
    match seen.landmark {
        Some(Landmark::Goal) => NodeZone::Destination,
        _ => NodeZone::Elsewhere,
    }
}
