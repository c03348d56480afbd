use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Pose;
use tolman_maps::cpm::CpMap;
use tolman_robot::Landmark;
use tolman_systems::cpm::{
    Aim, CommonPatterns, CpmConfig, EpisodeSummary, FragmentStep, Layer3, Walker,
};

use super::pursue::pursue;
use super::robots::SimulatedEpuck;
use super::trial::CpmTrialError;

/// To the goal, back, and to the goal again, as the real robot went (sections 6 and 7, figure 11).
/// "On the way back, the robot tries a new path-fragment" as long as it may be shorter than the
/// known way.
///
/// The paper's robot made 20 observations to the goal, 13 on the way back and 4 on its second way.
/// These are the `observations` of the three episodes.
#[derive(Clone, Debug)]
pub struct RoundTrip {
    /// First way, from the start until the goal was found.
    pub there: EpisodeSummary,
    /// Way back to the start, or `None` if the robot did not find the goal.
    pub back: Option<EpisodeSummary>,
    /// Second way to the goal, the shortest that is known then. `None` if the robot did not come
    /// back.
    pub again: Option<EpisodeSummary>,
    /// Number of unknown fragments that the robot entered on the way back.
    pub tried: u32,
    /// Number of these in which the robot turned round, as they "will never be shorter".
    pub given_up: u32,
    /// Common patterns from start to goal on the shortest way of the map before the way back.
    pub length_before: u32,
    /// Length of the shortest way after the way back, which is not longer.
    pub length_after: u32,
    /// The map at the end.
    pub map: CpMap,
    /// Pose of the robot after every step.
    pub path: Vec<Pose>,
    /// Step at which the way back began.
    pub back_from: usize,
    /// Step at which the second way to the goal began.
    pub again_from: usize,
}

impl RoundTrip {
    /// Plays the way to the goal, back and there again, from where the robot stands. Calls `see`
    /// with every fragment of the first two.
    ///
    /// # Errors
    /// [`CpmTrialError`].
    pub fn watch(
        walker: &mut Walker<SimulatedEpuck>,
        patterns: &CommonPatterns,
        config: CpmConfig,
        seed: u64,
        mut see: impl FnMut(&Layer3, &Walker<SimulatedEpuck>, &FragmentStep),
    ) -> Result<Self, CpmTrialError> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut layer = Layer3::begin(walker, patterns.clone(), None, config)?;
        let there = pursue(
            &mut layer,
            walker,
            Aim::Find(Landmark::Goal),
            &mut rng,
            &mut see,
        )?;
        let mut trip = Self {
            there,
            back: None,
            again: None,
            tried: 0,
            given_up: 0,
            length_before: 0,
            length_after: 0,
            map: CpMap::default(),
            path: Vec::new(),
            back_from: walker.body().path().len(),
            again_from: 0,
        };
        if layer.map().has_goal() {
            layer.optimize()?;
            let home = layer.explorer().mapper.plan(Landmark::Start);
            trip.length_before = home.map_or(0, |plan| plan.length);
            let see = |layer: &Layer3, walker: &Walker<SimulatedEpuck>, step: &FragmentStep| {
                see(layer, walker, step);
                trip.tried += u32::from(step.leg.known.is_none());
                trip.given_up += u32::from(step.walked.sighting.is_none());
            };
            let back = pursue(&mut layer, walker, Aim::WayBack, &mut rng, see)?;
            trip.back = Some(back);
            trip.again_from = walker.body().path().len();
            if let Some(plan) = layer.explorer().mapper.plan(Landmark::Goal) {
                trip.length_after = plan.length;
                trip.again = Some(layer.drive_plan(walker, &plan)?);
            }
        }
        trip.map = layer.map().clone();
        trip.path = walker.body().path().to_vec();
        Ok(trip)
    }
}
