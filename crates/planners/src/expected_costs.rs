use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;

use crate::{Arcs, costs_from};

/// Decisions with random results. Each state has some actions, each with a cost and its possible
/// ends.
#[derive(Clone, Debug, Default)]
pub struct Decisions {
    actions: usize,
    /// Actions of all states: those of state 0 first, each state's in the order of the actions.
    choices: Vec<Choice>,
    ends: Vec<(u32, f32)>,
}

#[derive(Clone, Copy, Debug)]
struct Choice {
    cost: f32,
    /// End of this choice's range in the list of ends. The range begins where that of the choice
    /// before it ends.
    ends: u32,
}

impl Decisions {
    /// Returns an empty list of decisions, in which each state will have `actions` actions.
    #[must_use]
    pub const fn between(actions: usize) -> Self {
        Self {
            actions,
            choices: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// Adds the next action of the present state, or the first one of the next state. `cost` is its
    /// cost and `ends` the states that it may lead to, each with its probability. If the
    /// probabilities add up to less than 1, the rest is the probability of staying.
    pub fn add(&mut self, cost: f64, ends: impl IntoIterator<Item = (u32, f64)>) {
        let ends = ends.into_iter();
        self.ends
            .extend(ends.map(|(state, probability)| (state, probability as f32)));
        self.choices.push(Choice {
            cost: cost as f32,
            ends: self.ends.len() as u32,
        });
    }

    /// Returns the number of actions in each state.
    #[must_use]
    pub const fn actions(&self) -> usize {
        self.actions
    }

    /// Returns the number of states.
    #[must_use]
    pub fn len(&self) -> usize {
        self.choices.len().checked_div(self.actions).unwrap_or(0)
    }

    /// Returns whether there are no states.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    /// Returns the average cost to reach a goal by this action of a state and then by the cheapest
    /// actions. It is infinite if no end leads to a goal. `costs` are the costs of the states.
    #[must_use]
    pub fn cost(&self, costs: &[f32], state: usize, action: usize) -> f32 {
        let index = state * self.actions + action;
        let Some(choice) = self.choices.get(index) else {
            return f32::INFINITY;
        };
        let first = index
            .checked_sub(1)
            .map_or(0, |before| self.choices[before].ends);
        let ends = &self.ends[first as usize..choice.ends as usize];
        let (mut sum, mut sure) = (choice.cost, 0.0);
        for (end, probability) in ends {
            if *end as usize != state {
                sum += probability * costs[*end as usize];
                sure += probability;
            }
        }
        // What stays tries again.
        if sure > f32::EPSILON {
            sum / sure
        } else {
            f32::INFINITY
        }
    }
}

/// Returns the average cost to reach one of the `goals` from each state by the actions that are
/// cheapest on average. It is at most `hopeless`, the cost of giving up.
///
/// Value iteration, in place, the states nearest to a goal first, until no cost changes by more
/// than `tolerance` or `sweeps` are made. O(sweeps · ends). R. Bellman: *A Markovian decision
/// process* (1957).
///
/// ```
/// use tolman_planners::{Decisions, expected_costs};
///
/// // State 0 is a step from goal 2, but the step fails half of the time; or two safe steps by way of 1.
/// let mut decisions = Decisions::between(2);
/// decisions.add(1.0, [(2, 0.5), (0, 0.5)]);
/// decisions.add(1.0, [(1, 1.0)]);
/// decisions.add(0.5, [(2, 1.0)]);
/// decisions.add(1.0, [(0, 1.0)]);
/// decisions.add(1.0, [(2, 1.0)]);
/// decisions.add(1.0, [(2, 1.0)]);
/// let costs = expected_costs(&decisions, &[2], 100.0, 1e-6, 100);
/// assert_eq!(costs, [1.5, 0.5, 0.0]);
/// ```
#[must_use]
pub fn expected_costs(
    decisions: &Decisions,
    goals: &[u32],
    hopeless: f32,
    tolerance: f32,
    sweeps: usize,
) -> Vec<f32> {
    let mut costs = vec![hopeless; decisions.len()];
    let mut order = if_all_goes_well(decisions, goals);
    for (state, cost) in &order {
        costs[*state as usize] = cost.min(hopeless);
    }
    let goals: BTreeSet<u32> = goals.iter().copied().collect();
    order.retain(|(state, _)| !goals.contains(state));
    for _ in 0..sweeps {
        let mut change: f32 = 0.0;
        for (state, _) in &order {
            let state = *state as usize;
            let actions =
                (0..decisions.actions).map(|action| decisions.cost(&costs, state, action));
            let cost = actions.fold(hopeless, f32::min);
            change = change.max((cost - costs[state]).abs());
            costs[state] = cost;
        }
        if change <= tolerance {
            break;
        }
    }
    costs
}

/// Number of parts per unit of cost in the first estimate, which is computed in whole numbers.
const PARTS: f32 = 64.0;

/// Returns the states that can lead to a goal, the nearest first, each with its cost if every
/// action has its best result.
fn if_all_goes_well(decisions: &Decisions, goals: &[u32]) -> Vec<(u32, f32)> {
    let mut arcs = Vec::new();
    let mut first = 0;
    for (index, choice) in decisions.choices.iter().enumerate() {
        let state = (index / decisions.actions) as u32;
        let cost = (choice.cost * PARTS) as u32;
        let ends = &decisions.ends[first..choice.ends as usize];
        arcs.extend(ends.iter().map(|(end, _)| (state, *end, cost)));
        first = choice.ends as usize;
    }
    let reversed = Arcs::new(decisions.len(), &arcs).reversed();
    let costs = costs_from(&reversed, goals.iter().copied());
    let reached = (0..).zip(costs);
    let reached = reached.filter_map(|(state, cost)| Some((state, cost? as f32 / PARTS)));
    let mut reached: Vec<(u32, f32)> = reached.collect();
    reached.sort_by(|a, b| a.1.total_cmp(&b.1));
    reached
}
