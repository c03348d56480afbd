use core::ops::ControlFlow;

use rand::Rng;
use tolman_robot::Standing;
use tolman_systems::cpm::{
    Aim, Begun, CpmResult, CpmRobot, Done, EpisodeSummary, FragmentStep, Layer3, Relocalization,
    Walker,
};

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

/// Lets a robot walk until the aim is reached: the first episode, or the way back. Calls `see` with
/// every fragment.
///
/// # Errors
/// If the robot fails, or its map refuses what it met.
pub fn pursue<B: CpmRobot>(
    layer: &mut Layer3,
    walker: &mut Walker<B>,
    aim: Aim,
    rng: &mut impl Rng,
    mut see: impl FnMut(&Layer3, &Walker<B>, &FragmentStep),
) -> CpmResult<EpisodeSummary, B> {
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

/// Lets a robot that was put down anywhere search until it knows where it is, or has come to the
/// maximum number of places. Calls `see` with every place it comes to.
///
/// # Errors
/// If the robot fails, or the search refuses what it met.
pub(super) fn find_out<B: CpmRobot>(
    search: &mut Relocalization,
    walker: &mut Walker<B>,
    rng: &mut impl Rng,
    mut see: impl FnMut(&Walker<B>),
) -> CpmResult<(), B> {
    run::until_done(walker, |walker| -> CpmResult<Standing, B> {
        let flow = search.advance(walker, rng)?;
        see(walker);
        Ok(match flow {
            ControlFlow::Continue(()) => Standing::UnderWay,
            ControlFlow::Break(()) => Standing::Done,
        })
    })?;
    Ok(())
}
