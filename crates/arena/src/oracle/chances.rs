use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_geom::{Heading, Pose, Vector};
use tolman_maze::Direction;

use super::policy::Lattice;
use super::trier::{Tried, Trier};
use crate::episode_error::EpisodeError;

/// Number of trials of each action at a node.
pub(super) const SAMPLES: usize = 8;

/// Maximum angle between a robot's heading and the axis of its node, rad either way: about the
/// error that the layers leave.
const ASKEW: f64 = 6.0 * core::f64::consts::PI / 180.0;

/// Maximum change of a cost in a sweep at which the costs count as settled, time steps.
const SETTLED: f64 = 0.01;

/// Sweeps after which costs are taken as they are.
const MOST_SWEEPS: u32 = 2000;

/// Cost without a known way, time steps: the initial value of all costs.
const HOPELESS: f64 = 1e5;

/// Expected time steps by action.
pub(super) type Costs = [f64; 4];

/// Results of each action at each node where the robot can stand, with their frequencies.
#[derive(Default)]
pub(super) struct Chances {
    nodes: Vec<NodeChances>,
}

struct NodeChances {
    node: u32,
    outcomes: [Vec<Chance>; 4],
}

#[derive(Clone, Copy)]
struct Chance {
    steps: f64,
    /// Node where the action ended, or `None` in the destination.
    end: Option<u32>,
    moved: bool,
}

impl Chances {
    /// Tries every action about a node.
    pub(super) fn try_all(
        &mut self,
        node: u32,
        lattice: &Lattice,
        robot: &mut Trier<'_>,
    ) -> Result<(), EpisodeError> {
        let rng = &mut ChaCha8Rng::seed_from_u64(u64::from(node));
        let mut outcomes = [const { Vec::new() }; 4];
        for _ in 0..SAMPLES {
            let pose = about(lattice, node, rng);
            for action in Direction::ALL {
                let tried = robot.carry_out(action, pose)?;
                let chance = |tried: Tried| Chance {
                    steps: f64::from(tried.steps),
                    end: (!tried.arrived).then(|| lattice.nearest(tried.pose)),
                    moved: tried.moved,
                };
                outcomes[action.index()].extend(tried.map(chance));
            }
        }
        if outcomes.iter().all(|outcomes| !outcomes.is_empty()) {
            self.nodes.push(NodeChances { node, outcomes });
        }
        Ok(())
    }

    /// Returns the least expected steps to the destination by node and first action, by value
    /// iteration in place. O(sweeps · nodes · [`SAMPLES`]); sweeps are about as many as actions on
    /// the longest way.
    pub(super) fn costs(mut self, lattice: &Lattice) -> Vec<Costs> {
        let mut costs = vec![[HOPELESS; 4]; lattice.node_count()];
        self.forget_gaps(lattice);
        for sweep in 0..MOST_SWEEPS {
            let mut change = 0.0_f64;
            // To and fro, so that it runs along every way's direction now and then.
            let nodes: &mut dyn Iterator<Item = &NodeChances> = match sweep % 2 {
                0 => &mut self.nodes.iter(),
                _ => &mut self.nodes.iter().rev(),
            };
            for node in nodes {
                for action in Direction::ALL {
                    let expected = node.expected(action, &costs);
                    let cost = &mut costs[node.node as usize][action.index()];
                    change = change.max((*cost - expected).abs());
                    *cost = expected;
                }
            }
            if change < SETTLED {
                break;
            }
        }
        costs
    }

    /// Leaves out results at nodes where no sample could stand, as their continuation is unknown.
    fn forget_gaps(&mut self, lattice: &Lattice) {
        let mut known = vec![false; lattice.node_count()];
        for node in &self.nodes {
            known[node.node as usize] = true;
        }
        for node in &mut self.nodes {
            for outcomes in &mut node.outcomes {
                outcomes.retain(|chance| chance.end.is_none_or(|end| known[end as usize]));
            }
        }
    }
}

impl NodeChances {
    fn expected(&self, action: Direction, costs: &[Costs]) -> f64 {
        let outcomes = &self.outcomes[action.index()];
        if outcomes.is_empty() {
            return HOPELESS;
        }
        let total: f64 = outcomes
            .iter()
            .map(|chance| {
                let rest = chance.end.map_or(0.0, |end| {
                    let barred = (!chance.moved).then_some(action);
                    best_but(&costs[end as usize], barred)
                });
                (chance.steps + rest).min(HOPELESS)
            })
            .sum();
        total / outcomes.len() as f64
    }
}

/// Returns the least cost of all actions except the one that has just failed.
fn best_but(costs: &Costs, barred: Option<Direction>) -> f64 {
    let allowed = Direction::ALL
        .into_iter()
        .filter(|action| Some(*action) != barred);
    allowed
        .map(|action| costs[action.index()])
        .fold(HOPELESS, f64::min)
}

/// Returns a pose that has this node for its nearest.
fn about(lattice: &Lattice, node: u32, rng: &mut ChaCha8Rng) -> Pose {
    let half = 0.5 * lattice.spacing;
    let offset = Vector::new(
        rng.random_range(-half..=half),
        rng.random_range(-half..=half),
    );
    let Pose { position, heading } = lattice.pose(node);
    let askew = rng.random_range(-ASKEW..=ASKEW);
    Pose::new(
        position + offset,
        Heading::from_radians(heading.radians() + askew),
    )
}
