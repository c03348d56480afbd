//! Drives of the better system from several starts by one map, each compared with the Unlocalized
//! oracle.

use alloc::sync::Arc;

use crate::venue::{Played, Venue};
use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, Episode, Lifted, Trial};
use tolman_experiment::{BoxError, Metric, Table, record, run_seed};
use tolman_sim::robots::LaserPioneerConfig;
use tolman_systems::mslst::better::{BetterMap, BetterNavigator};

record! {
    /// A world and some starts in it.
    pub(super) struct DrivenRun {
        /// Share of starts from which the destination is reached within the time limit.
        success_percent: f64 => higher("success").percent().decimals(1),
        /// Mean number of time steps. A run that does not arrive counts as its limit.
        steps: f64 => lower("steps").at_least(0),
        /// Mean number of time steps of the Unlocalized oracle from the same starts. Its robot has
        /// the same calibration.
        oracle_steps: f64 => neither("Unlocalized oracle's steps").at_least(0),
    }
}

impl DrivenRun {
    /// Returns a table of such runs, without its rows.
    pub(super) fn table(name: &str, title: &str) -> Table {
        let over = Metric::ratio(
            "steps_over_unlocalized_oracle",
            Self::steps,
            Self::oracle_steps,
        );
        let least = Metric::least("least_success_percent", Self::success_percent);
        Table::of::<Self>(name, title)
            .metric(Metric::mean(Self::success_percent))
            .metric(Metric::mean(Self::steps))
            .metric(over.titled("steps / Unlocalized oracle's"))
            .metric(least.titled("lowest success"))
    }
}

/// Minimum number of starts by a map.
const LEAST_STARTS: u32 = 5;

/// Divides `runs` starts among maps. Returns the number of maps, at most `most`, and the number of
/// starts by each.
pub(super) fn shared_out(runs: u32, most: u32) -> (u32, u32) {
    let maps = (runs / LEAST_STARTS).clamp(1, most);
    (maps, (runs / maps).max(LEAST_STARTS))
}

/// A system that drives, its world and its starts.
pub(super) struct Driver<'a> {
    pub(super) venue: &'a Venue,
    pub(super) robot: &'a LaserPioneerConfig,
    pub(super) map: &'a Arc<BetterMap>,
    pub(super) starts: u32,
    /// Seed of starts and noise.
    pub(super) seed: u64,
}

impl Driver<'_> {
    /// Drives from every start and returns the result. `lifted` tells for each start whether the
    /// robot is put elsewhere on the way. `watch` is called with each episode and the oracle's.
    pub(super) fn drive(
        &self,
        lifted: impl Fn(u32) -> Option<Lifted>,
        mut watch: impl FnMut(&Episode, &Episode),
    ) -> Result<DrivenRun, BoxError> {
        let (mut driven, mut by_oracles) = (Played::default(), Played::default());
        for start in 0..self.starts {
            let undisturbed = self.venue.trial(run_seed(self.seed, "starts", start));
            let mut oracle = self.venue.mind(Agent::UnlocalizedOracle)?;
            let by_oracle = episode::run(&undisturbed, &mut oracle, |_| {})?;
            let trial = Trial {
                robot: self.robot.clone(),
                ..undisturbed
            };
            let brain = BetterNavigator::new(Arc::clone(self.map));
            let mut mind = Mind::Rolling(Box::new(brain));
            let episode = episode::run_lifted(&trial, &mut mind, lifted(start), |_| {})?;
            driven.add(&episode);
            by_oracles.add(&by_oracle);
            watch(&episode, &by_oracle);
        }
        Ok(DrivenRun {
            success_percent: driven.success_percent(),
            steps: driven.steps(),
            oracle_steps: by_oracles.steps(),
        })
    }
}
