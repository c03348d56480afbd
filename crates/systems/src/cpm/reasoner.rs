use alloc::borrow::Cow;
use core::ops::ControlFlow;

use rand::Rng;
use thiserror::Error;
use tolman_geom::IntervalError;
use tolman_maps::cpm::{CpMap, CpmError, Junction, Plan, Port, Sighting};
use tolman_robot::Landmark;

use super::common_patterns::CommonPatterns;
use super::config::CpmConfig;
use super::decision::{Aim, Done};
use super::episode::{Begun, Episode};
use super::explorer::Explorer;
use super::layer3::{Layer3, Step};
use super::robot::CpmRobot;
use super::walker::{WalkError, Walker};

/// A robot with all its layers: [`Layer3`] on a [`Walker`] that owns the body. It plays the paper's episodes.
#[derive(Debug)]
pub struct Reasoner<'a, B: CpmRobot> {
    walker: Walker<B>,
    layer: Layer3<'a>,
}

impl<'a, B: CpmRobot> Reasoner<'a, B> {
    /// A robot that looks where it is and begins its map there.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn begin(
        walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
    ) -> Result<Self, ReasonerError<B::Error>> {
        Self::begin_with(walker, Cow::Borrowed(patterns), None, config)
    }

    /// A robot that has learned no patterns before: what it observes becomes one if it is so far from all that it knows (section 8, "the CPs
    /// must be learned incrementally").
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn begin_unlearned(
        walker: Walker<B>,
        novelty: f64,
        config: CpmConfig,
    ) -> Result<Self, ReasonerError<B::Error>> {
        let none = CommonPatterns::none().map_err(CpmError::from)?;
        Self::begin_with(walker, Cow::Owned(none), Some(novelty), config)
    }

    fn begin_with(
        mut walker: Walker<B>,
        patterns: Cow<'a, CommonPatterns>,
        novelty: Option<f64>,
        config: CpmConfig,
    ) -> Result<Self, ReasonerError<B::Error>> {
        let start = walker.begin()?;
        let explorer = Explorer::new(config, start)?;
        Ok(Self {
            walker,
            layer: Layer3::new(patterns, novelty, explorer),
        })
    }

    /// A robot that looks where it is and has a map that begins there.
    ///
    /// # Errors
    /// [`ReasonerError`], also if it stands somewhere else.
    pub fn resume(
        mut walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
        map: CpMap,
    ) -> Result<Self, ReasonerError<B::Error>> {
        let start = map.landmarks(Landmark::Start).next();
        let junction = start.ok_or(ReasonerError::NoStart)?;
        let expected = map.junction(junction).map(Junction::sighting);
        let found = walker.begin()?;
        if expected != Some(found) {
            return Err(ReasonerError::NotTheStart { found });
        }
        let at = Port {
            junction,
            number: 0,
        };
        Self::resume_at(walker, patterns, config, map, at)
    }

    /// A robot that stands at a place of its map, with this port behind it.
    ///
    /// # Errors
    /// [`ReasonerError`] if the map has no such port.
    pub fn resume_at(
        walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
        map: CpMap,
        at: Port,
    ) -> Result<Self, ReasonerError<B::Error>> {
        let explorer = Explorer::resume(config, map, at)?;
        Ok(Self {
            walker,
            layer: Layer3::new(Cow::Borrowed(patterns), None, explorer),
        })
    }

    /// The lower layers.
    pub const fn walker(&self) -> &Walker<B> {
        &self.walker
    }

    /// The lower layers, where the robot is to forget its map.
    pub fn into_walker(self) -> Walker<B> {
        self.walker
    }

    /// The lower layers, to lift the robot.
    pub const fn walker_mut(&mut self) -> &mut Walker<B> {
        &mut self.walker
    }

    /// The common patterns, those learned on the way among them.
    pub fn patterns(&self) -> &CommonPatterns {
        self.layer.patterns()
    }

    /// The map and what decides by it.
    pub const fn explorer(&self) -> &Explorer {
        self.layer.explorer()
    }

    /// Walks until the aim is reached: the first episode, or the way back. `see` is told of every fragment.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn pursue(
        &mut self,
        aim: Aim,
        rng: &mut impl Rng,
        mut see: impl FnMut(&Self, &Step),
    ) -> Result<Episode, ReasonerError<B::Error>> {
        let begun = Begun::now(&self.walker);
        loop {
            match self.advance(aim, rng)? {
                ControlFlow::Continue(step) => see(self, &step),
                ControlFlow::Break(done) => return Ok(begun.ended(done, &self.walker)),
            }
        }
    }

    /// Walks one fragment towards the aim, or says why there is none to walk.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn advance(
        &mut self,
        aim: Aim,
        rng: &mut impl Rng,
    ) -> Result<ControlFlow<Done, Step>, ReasonerError<B::Error>> {
        self.layer.advance(&mut self.walker, aim, rng)
    }

    /// The second episode: drives the shortest known way to the goal, skipping observations.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn drive_plan(&mut self, plan: &Plan) -> Result<Episode, ReasonerError<B::Error>> {
        let begun = Begun::now(&self.walker);
        // It may stand at the goal already.
        let explorer = self.layer.explorer();
        let here = explorer.map().junction(explorer.at().junction);
        let mut sighting = here.map(Junction::sighting);
        for leg in &plan.legs {
            sighting = Some(Layer3::drive(&mut self.walker, leg)?);
            if self.layer.expected(leg) != sighting {
                break;
            }
        }
        let arrived = sighting.is_some_and(|at| at.landmark == Some(Landmark::Goal));
        let done = if arrived {
            Done::Reached
        } else {
            Done::NotThere
        };
        Ok(begun.ended(done, &self.walker))
    }

    /// The offline CPM's last step: merges all that is similar. Online nothing is left to merge.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn optimize(&mut self) -> Result<usize, ReasonerError<B::Error>> {
        Ok(self.layer.optimize()?)
    }

    /// The robot was put back to where its map begins.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn placed_at_start(&mut self) -> Result<(), ReasonerError<B::Error>> {
        let map = self.layer.explorer().map();
        let start = map.landmarks(Landmark::Start).next();
        let Some(junction) = start else {
            return Err(ReasonerError::NoStart);
        };
        self.walker.begin()?;
        self.layer.explorer_mut().place(Port {
            junction,
            number: 0,
        })?;
        Ok(())
    }
}

/// Why an episode could not be played to its end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReasonerError<E> {
    /// The robot.
    #[error(transparent)]
    Walk(#[from] WalkError<E>),
    /// The map.
    #[error(transparent)]
    Map(#[from] CpmError),
    /// Dead reckoning has no number.
    #[error(transparent)]
    Reckoning(#[from] IntervalError),
    /// The map has no start.
    #[error("the map has no start to be put back to; mark the start of the maze")]
    NoStart,
    /// The robot stands elsewhere than where its map begins.
    #[error(
        "the robot stands at {found}, where its map does not begin; put it to the start of the maze that the map was learned in"
    )]
    NotTheStart {
        /// What it sees.
        found: Sighting,
    },
}
