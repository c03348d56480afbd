use core::ops::ControlFlow;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::CpmError;
use tolman_robot::{Landmark, Standing};
use tolman_systems::cpm::{
    Aim, Begun, CommonPatterns, CpmResult, CpmRobot, Done, EpisodeSummary, FragmentStep, Layer3,
    Mode, Walker, WalkerConfig,
};

use super::robots::SimulatedEpuck;
use crate::run::{self, InRun};

/// Number of time steps after which a robot on CPM has failed, in any case: 36 hours of the
/// paper's.
const STEP_LIMIT: u32 = 10_000_000;

impl<B: CpmRobot> InRun for Walker<B> {
    fn steps(&self) -> u32 {
        Self::steps(self)
    }

    fn is_out_of_time(&self) -> bool {
        Self::steps(self) >= STEP_LIMIT
    }
}

/// A run of the paper's system: layer 3 with the robot that it drives.
///
/// The aims that it pursues and the observer of its fragments make it a trial, an exploration or a
/// round trip.
#[derive(Debug)]
pub struct CpmRun<B: CpmRobot = SimulatedEpuck> {
    /// The lower layers, with the robot's body.
    pub walker: Walker<B>,
    /// Layer 3, with the map.
    pub layer: Layer3,
    rng: ChaCha8Rng,
}

impl<B: CpmRobot> CpmRun<B> {
    /// Sends out a robot. It looks round, and its map begins there.
    ///
    /// It knows `patterns` from a lesson, unless it learns them on the way in its `mode`. The mode
    /// sets the source of headings in `walker`. `seed` seeds all its random numbers.
    ///
    /// # Errors
    /// If the robot fails, or sees no way out.
    pub fn begin(
        body: B,
        mut walker: WalkerConfig,
        patterns: &CommonPatterns,
        mode: Mode,
        seed: u64,
    ) -> CpmResult<Self, B> {
        walker.heading = mode.heading();
        let mut walker = Walker::new(body, walker);
        let novelty = mode.novelty();
        let patterns = match novelty {
            Some(_) => CommonPatterns::none().map_err(CpmError::from)?,
            None => patterns.clone(),
        };
        Ok(Self {
            layer: Layer3::begin(&mut walker, patterns, novelty, mode.config())?,
            walker,
            rng: ChaCha8Rng::seed_from_u64(seed),
        })
    }

    /// Walks until the aim is reached: the first episode, or the way back. Calls `see` with every
    /// fragment.
    ///
    /// # Errors
    /// If the robot fails, or its map refuses what it met.
    pub fn pursue(
        &mut self,
        aim: Aim,
        mut see: impl FnMut(&Layer3, &Walker<B>, &FragmentStep),
    ) -> CpmResult<EpisodeSummary, B> {
        let Self { walker, layer, rng } = self;
        let begun = Begun::now(walker);
        let mut done = Done::OutOfPatience;
        run::until_done(walker, |walker| -> CpmResult<Standing, B> {
            Ok(match layer.advance(walker, aim, rng)? {
                ControlFlow::Continue(step) => {
                    see(layer, walker, &step);
                    Standing::UnderWay
                }
                ControlFlow::Break(end) => {
                    done = end;
                    Standing::Done
                }
            })
        })?;
        Ok(begun.ended(done, walker))
    }

    /// Drives the shortest known way to the goal, skipping observations: the second episode. `None`
    /// if the map has no such way.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn drive_to_goal(&mut self) -> CpmResult<Option<EpisodeSummary>, B> {
        let plan = self.layer.explorer.mapper.plan(Landmark::Goal);
        let driven = plan.map(|plan| self.layer.drive_plan(&mut self.walker, &plan));
        driven.transpose()
    }
}
