use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Pose;
use tolman_maps::cpm::{Aim, CpMap, Landmark};

use super::agent::{Cpm, Episode};
use super::body::SimulatedEpuck;
use super::trial::{Trial, TrialError};

/// One episode by itself: of a robot that learns a map to be kept, or drives by one that was kept.
#[derive(Clone, Debug)]
pub struct Errand {
    /// What became of it.
    pub episode: Episode,
    /// The map at its end.
    pub map: CpMap,
    /// Where the robot was after every step.
    pub path: Vec<Pose>,
    /// Time steps in which its body touched a wall.
    pub bumps: u32,
}

impl Trial<'_> {
    /// Walks from the start until the aim is reached, and optimizes the map.
    ///
    /// # Errors
    /// [`TrialError`].
    pub fn learn(&self, aim: Aim) -> Result<Errand, TrialError> {
        let mut agent = Cpm::begin(self.set_up()?, self.patterns, self.mode.config())?;
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let episode = agent.pursue(aim, &mut rng, |_, _| {})?;
        agent.optimize()?;
        Ok(Errand::of(&agent, episode))
    }

    /// Drives from the start to the goal by a map that was learned before.
    ///
    /// # Errors
    /// [`TrialError`], also if the map has no way to a goal, or does not begin where the robot stands.
    pub fn drive(&self, map: CpMap) -> Result<Errand, TrialError> {
        let mut agent = Cpm::resume(self.set_up()?, self.patterns, self.mode.config(), map)?;
        let plan = agent.explorer().plan(Landmark::Goal);
        let plan = plan.ok_or(TrialError::NoPlan)?;
        let episode = agent.drive_plan(&plan)?;
        Ok(Errand::of(&agent, episode))
    }
}

impl Errand {
    fn of(agent: &Cpm<'_, SimulatedEpuck>, episode: Episode) -> Self {
        let body = agent.walker().body();
        Self {
            episode,
            map: agent.explorer().map().clone(),
            path: body.path().to_vec(),
            bumps: body.bumps(),
        }
    }
}
