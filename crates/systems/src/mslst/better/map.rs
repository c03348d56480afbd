use tolman_control::RingError;
use tolman_geom::Point;
use tolman_maps::scan_map::{CorridorMap, ScanChart, Standpoints};
use tolman_maze::Direction;
use tolman_planners::expected_costs;
use tolman_robot::Ring;

use super::BetterConfig;
use super::costs::{ActionCosts, HOPELESS};
use super::rehearsal::{rehearse, state};

/// A learned map made ready for navigation: standpoints, their views, and the costs of reaching the
/// goal.
///
/// With the navigator's belief it takes less than 1 KiB per place. Preparing the plan takes some
/// hundred times as much.
#[derive(Clone, Debug)]
pub struct BetterMap {
    pub(super) config: BetterConfig,
    pub(super) standpoints: Standpoints,
    corridors: CorridorMap,
    costs: ActionCosts,
}

/// Change of costs below which they count as settled, time steps; the rounds below are the limit.
const SETTLED: f32 = 0.01;
const MOST_SWEEPS: usize = 200;
/// Distance within which a standpoint counts as near the robot, m.
const ABOUT: f64 = 0.25;

impl BetterMap {
    /// Computes where the robot can stand and the costs of the ways to the goal.
    ///
    /// # Errors
    /// If the layers cannot read the ring.
    pub fn of(chart: ScanChart, ring: Ring, config: &BetterConfig) -> Result<Self, RingError> {
        let corridors = CorridorMap::of(&chart, config.corridor_width);
        let standpoints = Standpoints::of(chart, ring);
        let costs = costs_to(standpoints.goals(), &standpoints, config)?;
        Ok(Self {
            config: *config,
            standpoints,
            corridors,
            costs,
        })
    }

    /// Returns the costs of the ways to the goal.
    pub(super) const fn costs(&self) -> &ActionCosts {
        &self.costs
    }

    /// Returns the costs of the ways to all standpoints that are `there`; `None` if none is.
    pub(super) fn costs_to(&self, there: impl Fn(Point) -> bool) -> Option<ActionCosts> {
        let numbered = (0..).zip(self.standpoints.positions());
        let there = numbered.filter(|(_, at)| there(*at));
        let there: Vec<u32> = there.map(|(number, _)| number).collect();
        if there.is_empty() {
            return None;
        }
        costs_to(&there, &self.standpoints, &self.config).ok()
    }

    /// Returns the map with additional walls at these points, or `None` if the layers cannot read
    /// the ring.
    pub(super) fn with_walls(&self, at: &[Point]) -> Option<Self> {
        let chart = self.chart().with_walls(at);
        Self::of(chart, self.standpoints.ring(), &self.config).ok()
    }

    /// Returns the learned map.
    #[must_use]
    pub const fn chart(&self) -> &ScanChart {
        self.standpoints.chart()
    }

    /// Returns the learned places and ways.
    #[must_use]
    pub const fn corridors(&self) -> &CorridorMap {
        &self.corridors
    }

    /// Returns whether a way leads to the goal from near a point.
    pub(super) fn leads_on(&self, from: Point) -> bool {
        let numbered = (0..).zip(self.standpoints.positions());
        let near = numbered.filter(|(_, at)| (at - from).norm() < ABOUT);
        let leads = |(number, _)| {
            Direction::ALL
                .into_iter()
                .any(|action| self.costs.cost(number, 0, action) < f64::from(HOPELESS) / 2.0)
        };
        near.into_iter().any(leads)
    }
}

/// Returns the costs of the ways to some standpoints. O(standpoints · tries · steps · beams).
fn costs_to(
    ends: &[u32],
    standpoints: &Standpoints,
    config: &BetterConfig,
) -> Result<ActionCosts, RingError> {
    let decisions = rehearse(standpoints, standpoints.ring(), config)?;
    let ends = ends
        .iter()
        .flat_map(|number| [0, 1].map(|axis| state(*number, axis) as u32));
    let ends: Vec<u32> = ends.collect();
    let states = expected_costs(&decisions, &ends, HOPELESS, SETTLED, MOST_SWEEPS);
    Ok(ActionCosts::of(&decisions, &states))
}
