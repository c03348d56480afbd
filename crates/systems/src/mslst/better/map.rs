use tolman_control::heading_of;
use tolman_maps::scan_map::{ScanMap, ScanMapConfig, Standpoints};
use tolman_maze::Direction;
use tolman_planners::{Decisions, expected_costs};
use tolman_robot::Ring;

use super::BetterConfig;
use super::reckoning::unit;

/// What the better system has learned, made ready for navigation: where it can stand, what it sees there, and what it costs to
/// get to the goal.
#[derive(Clone, Debug)]
pub struct BetterMap {
    pub(super) scans: ScanMap,
    pub(super) standpoints: Standpoints,
    decisions: Decisions,
    /// Time steps to the goal on average, by [`state`].
    costs: Vec<f32>,
}

/// The axes a robot faces along: east–west, north–south.
const AXES: [Direction; 2] = [Direction::East, Direction::North];
/// Time steps that a quarter turn takes on average.
const TURN_STEPS: f64 = 1.5;
/// Time steps of a translation.
const WAY_STEPS: f64 = 2.0;
/// Shares of an action's way that it leads, with their probabilities.
const WAYS: [(f64, f64); 5] = [(0.6, 0.1), (0.8, 0.23), (1.0, 0.34), (1.2, 0.23), (1.4, 0.1)];
/// An action that leads no farther than that has failed, m.
const NO_WAY: f64 = 0.08;

impl BetterMap {
    /// Works out where its robot can stand and what the ways to the goal cost. O(standpoints · (beams + sweeps)).
    #[must_use]
    pub fn of(scans: ScanMap, ring: Ring, config: &BetterConfig) -> Self {
        let radius = ScanMapConfig::for_robot(config.diameter).radius;
        let standpoints = Standpoints::of(&scans, ring, radius);
        let decisions = decisions(&scans, &standpoints, config);
        let goals = (0..standpoints.len() as u32)
            .filter(|number| standpoints.is_goal(*number))
            .flat_map(|number| [0, 1].map(|axis| state(number, axis) as u32));
        let goals: Vec<u32> = goals.collect();
        let costs = expected_costs(&decisions, &goals, 0.01, 200);
        Self {
            scans,
            standpoints,
            decisions,
            costs,
        }
    }

    /// Returns the time steps to the goal on average from a standpoint by an action, facing along an axis; infinite where it does
    /// not lead there.
    pub(super) fn cost(&self, number: u32, axis: usize, action: Direction) -> f64 {
        let cost = self
            .decisions
            .cost(&self.costs, state(number, axis), action.index());
        f64::from(cost)
    }
}

/// The axis of an action.
pub(super) fn axis_of(action: Direction) -> usize {
    usize::from(action != AXES[0] && action != AXES[0].opposite())
}

fn state(number: u32, axis: usize) -> usize {
    number as usize * AXES.len() + axis
}

fn decisions(scans: &ScanMap, standpoints: &Standpoints, config: &BetterConfig) -> Decisions {
    let clearings = scans.clearings();
    let mut decisions = Decisions::between(Direction::ALL.len());
    for (number, at) in (0..).zip(standpoints.positions()) {
        let ways = Direction::ALL.map(|action| {
            let clear = standpoints.clearance(number, heading_of(action));
            let refused = clear.is_some_and(|clear| clear < config.buffer);
            let free = clearings.straight(*at, unit(action), 1.5 * config.action_way);
            let leads = !refused && free > NO_WAY;
            leads.then(|| {
                WAYS.map(|(share, probability)| {
                    let way = (share * config.action_way).min(free);
                    (standpoints.at(at + unit(action) * way), probability)
                })
            })
        });
        for axis in 0..AXES.len() {
            for (action, ways) in Direction::ALL.into_iter().zip(&ways) {
                let to = axis_of(action);
                let turn = if to == axis { 0.0 } else { TURN_STEPS };
                let ends = ways.iter().flatten().filter_map(|(end, probability)| {
                    Some((state((*end)?, to) as u32, *probability))
                });
                let steps = if ways.is_some() { WAY_STEPS } else { 1.0 };
                decisions.add(turn + steps, ends);
            }
        }
    }
    decisions
}
