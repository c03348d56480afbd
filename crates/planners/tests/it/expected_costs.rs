//! Plans for actions that may fail, against Dijkstra's algorithm and against Bellman's equation.

use proptest::prelude::*;
use tolman_planners::{Arcs, Decisions, costs_from, expected_costs};

const STATES: u32 = 12;
const ACTIONS: usize = 3;
const HOPELESS: f32 = 500.0;

/// Returns the choices of every state: cost, end, other end, and the probability of the first end,
/// percent.
fn choices() -> impl Strategy<Value = Vec<(u32, u32, u32, u32)>> {
    let choice = (1..9_u32, 0..STATES, 0..STATES, 1..=100_u32);
    prop::collection::vec(choice, STATES as usize * ACTIONS)
}

proptest! {
    #[test]
    fn sure_actions_cost_what_dijkstra_says(choices in choices()) {
        let mut decisions = Decisions::between(ACTIONS);
        let mut arcs = Vec::new();
        for (index, (cost, end, _, _)) in choices.iter().enumerate() {
            decisions.add(f64::from(*cost), [(*end, 1.0)]);
            arcs.push(((index / ACTIONS) as u32, *end, *cost));
        }
        let expected = costs_from(&Arcs::new(STATES as usize, &arcs).reversed(), [0]);
        let costs = expected_costs(&decisions, &[0], HOPELESS, 1e-5, 1000);
        for (cost, expected) in costs.iter().zip(expected) {
            let expected = expected.map_or(HOPELESS, |steps| steps as f32);
            prop_assert!((cost - expected).abs() < 1e-3, "{cost} {expected}");
        }
    }

    #[test]
    fn costs_obey_bellman(choices in choices()) {
        let mut decisions = Decisions::between(ACTIONS);
        for (cost, end, other, percent) in choices {
            let likely = f64::from(percent) / 100.0;
            decisions.add(f64::from(cost), [(end, likely), (other, 1.0 - likely)]);
        }
        let costs = expected_costs(&decisions, &[0], HOPELESS, 1e-6, 100_000);
        prop_assert!(costs[0].abs() < 1e-9);
        for state in 1..STATES as usize {
            let best = (0..ACTIONS).map(|action| decisions.cost(&costs, state, action));
            let best = best.fold(HOPELESS, f32::min);
            prop_assert!((best - costs[state]).abs() <= 1e-3 * best, "{best} {}", costs[state]);
        }
    }
}

#[test]
fn decisions_count_states_and_actions() {
    let mut decisions = Decisions::between(2);
    assert_eq!(
        (decisions.actions(), decisions.len(), decisions.is_empty()),
        (2, 0, true)
    );
    for _ in 0..6 {
        decisions.add(1.0, [(0, 1.0)]);
    }
    assert_eq!(
        (decisions.actions(), decisions.len(), decisions.is_empty()),
        (2, 3, false)
    );
    assert_eq!(Decisions::between(5).actions(), 5);
}
