use tolman_control::RingError;
use tolman_maps::scan_map::{ScanMap, Standpoints};
use tolman_maze::Direction;
use tolman_planners::{Decisions, expected_costs};
use tolman_robot::Ring;

use super::BetterConfig;
use super::rehearsal::{rehearse, state};

/// What the better system has learned, made ready for navigation: where it can stand, what it sees there, and what it costs to
/// get to the goal.
#[derive(Clone, Debug)]
pub struct BetterMap {
    pub(super) config: BetterConfig,
    pub(super) scans: ScanMap,
    pub(super) standpoints: Standpoints,
    decisions: Decisions,
    /// Time steps to the goal on average, by [`state`].
    costs: Vec<f32>,
}

/// What it costs to be where no way leads to the goal, time steps.
pub(super) const HOPELESS: f32 = 1e4;
/// Costs count as settled when none changes by more, time steps; and at the latest after so many rounds.
const SETTLED: f32 = 0.01;
const MOST_SWEEPS: usize = 200;

impl BetterMap {
    /// Works out where its robot can stand and what the ways to the goal cost.
    ///
    /// # Errors
    /// If the layers cannot read the ring.
    pub fn of(scans: ScanMap, ring: Ring, config: &BetterConfig) -> Result<Self, RingError> {
        let standpoints = Standpoints::of(&scans, ring);
        let decisions = rehearse(&scans.clearings(), &standpoints, ring, config)?;
        let goals = (0..standpoints.len() as u32)
            .filter(|number| standpoints.is_goal(*number))
            .flat_map(|number| [0, 1].map(|axis| state(number, axis) as u32));
        let goals: Vec<u32> = goals.collect();
        let costs = expected_costs(&decisions, &goals, HOPELESS, SETTLED, MOST_SWEEPS);
        Ok(Self {
            config: *config,
            scans,
            standpoints,
            decisions,
            costs,
        })
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
