use alloc::borrow::Cow;
use core::ops::ControlFlow;

use rand::Rng;
use thiserror::Error;
use tolman_geom::{Interval, IntervalError, PointBox, Pose};
use tolman_maps::cpm::{
    Aim, Arrival, Bearings, CpMap, CpmConfig, CpmError, Decision, Done, Explorer, Junction,
    Landmark, Leg, Motion, PatternId, Plan, Port, Sighting, Traversal,
};

use super::body::Body;
use super::common_patterns::CommonPatterns;
use super::walker::{HeadingBy, Observation, Walk, WalkError, Walker};

/// Layer 3: maps by common patterns, reasons at junctions, plans (section 4, figure 2).
#[derive(Debug)]
pub struct Cpm<'a, B: Body> {
    walker: Walker<B>,
    patterns: Cow<'a, CommonPatterns>,
    /// How far from all patterns an observation is that becomes one itself; none if all were learned before.
    novelty: Option<f64>,
    explorer: Explorer,
}

/// How far dead reckoning may be off along one fragment, m: a third of a corridor's width, so that neighbouring cells are told apart.
const POSITION_MARGIN: f64 = 0.08;

/// How far a heading may be off, rad: that of a branch is the middle of a gap between walls.
const HEADING_MARGIN: f64 = 0.6;

/// What became of an episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Episode {
    /// Why it ended.
    pub done: Done,
    /// How long it took, s.
    pub seconds: f64,
    /// How many observations were made.
    pub observations: u32,
}

/// When an episode began.
pub(super) struct Begun {
    time_us: u64,
    observations: u32,
}

impl Begun {
    pub(super) fn now<B: Body>(walker: &Walker<B>) -> Self {
        Self {
            time_us: walker.time_us(),
            observations: walker.observations(),
        }
    }

    pub(super) fn ended<B: Body>(&self, done: Done, walker: &Walker<B>) -> Episode {
        Episode {
            done,
            seconds: (walker.time_us() - self.time_us) as f64 * 1e-6,
            observations: walker.observations() - self.observations,
        }
    }
}

/// What happened at the end of a fragment.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What layer 3 had decided.
    pub leg: Leg,
    /// What the arrival taught; none where the robot turned back.
    pub arrival: Option<Arrival>,
    /// The place it came to.
    pub sighting: Option<Sighting>,
    /// The observations.
    pub walk: Walk,
}

impl<'a, B: Body> Cpm<'a, B> {
    /// A robot that looks where it is and begins its map there.
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn begin(
        walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
    ) -> Result<Self, AgentError<B::Error>> {
        Self::begin_with(walker, Cow::Borrowed(patterns), None, config)
    }

    /// A robot that has learned no patterns before: what it observes becomes one if it is so far from all that it knows (section 8, "the CPs
    /// must be learned incrementally").
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn begin_unlearned(
        walker: Walker<B>,
        novelty: f64,
        config: CpmConfig,
    ) -> Result<Self, AgentError<B::Error>> {
        let none = CommonPatterns::none().map_err(CpmError::from)?;
        Self::begin_with(walker, Cow::Owned(none), Some(novelty), config)
    }

    fn begin_with(
        mut walker: Walker<B>,
        patterns: Cow<'a, CommonPatterns>,
        novelty: Option<f64>,
        config: CpmConfig,
    ) -> Result<Self, AgentError<B::Error>> {
        let start = walker.begin()?;
        Ok(Self {
            walker,
            patterns,
            novelty,
            explorer: Explorer::new(config, start)?,
        })
    }

    /// A robot that looks where it is and has a map that begins there.
    ///
    /// # Errors
    /// [`AgentError`], also if it stands somewhere else.
    pub fn resume(
        mut walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
        map: CpMap,
    ) -> Result<Self, AgentError<B::Error>> {
        let start = map.landmarks(Landmark::Start).next();
        let junction = start.ok_or(AgentError::NoStart)?;
        let expected = map.junction(junction).map(Junction::sighting);
        let found = walker.begin()?;
        if expected != Some(found) {
            return Err(AgentError::NotTheStart { found });
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
    /// [`AgentError`] if the map has no such port.
    pub fn resume_at(
        walker: Walker<B>,
        patterns: &'a CommonPatterns,
        config: CpmConfig,
        map: CpMap,
        at: Port,
    ) -> Result<Self, AgentError<B::Error>> {
        Ok(Self {
            walker,
            patterns: Cow::Borrowed(patterns),
            novelty: None,
            explorer: Explorer::resume(config, map, at)?,
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
        &self.patterns
    }

    /// The map and what decides by it.
    pub const fn explorer(&self) -> &Explorer {
        &self.explorer
    }

    /// Walks until the aim is reached: the first episode, or the way back. `see` is told of every fragment.
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn pursue(
        &mut self,
        aim: Aim,
        rng: &mut impl Rng,
        mut see: impl FnMut(&Self, &Step),
    ) -> Result<Episode, AgentError<B::Error>> {
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
    /// [`AgentError`].
    pub fn advance(
        &mut self,
        aim: Aim,
        rng: &mut impl Rng,
    ) -> Result<ControlFlow<Done, Step>, AgentError<B::Error>> {
        // "At the junction layer 3 activates …": it decides, and takes the robot over for a turn.
        let leg = match self.explorer.decide(aim, rng) {
            Decision::Done(done) => return Ok(ControlFlow::Break(done)),
            Decision::Go(leg) => leg,
        };
        // "… then it lets the lower layers regain the control of the robot."
        let from = self.walker.pose();
        let walk = self
            .walker
            .walk(leg.turn.0 as usize, 0, leg.give_up_after)?;
        let (arrival, sighting) = match &walk {
            Walk::Arrived {
                observations,
                sighting,
                ..
            } => {
                let traversal = Traversal {
                    patterns: self.perceive(observations)?,
                    motion: self.motion(from)?,
                    sighting: *sighting,
                    bearings: self.bearings(),
                };
                let dictionary = self.patterns.dictionary();
                let arrival = self.explorer.arrive(leg.turn, &traversal, dictionary)?;
                (Some(arrival), Some(*sighting))
            }
            Walk::TurnedBack { observations } => {
                let count = observations.len() as u32;
                self.explorer.turned_back(leg.turn, count)?;
                (None, None)
            }
        };
        Ok(ControlFlow::Continue(Step {
            leg,
            arrival,
            sighting,
            walk,
        }))
    }

    /// The patterns of what was seen on a way, some of them perhaps new.
    fn perceive(
        &mut self,
        observations: &[Observation],
    ) -> Result<Vec<PatternId>, AgentError<B::Error>> {
        match self.novelty {
            None => Ok(self.patterns.patterns(observations)),
            Some(novelty) => {
                let patterns = self.patterns.to_mut().learn_on(observations, novelty);
                Ok(patterns.map_err(CpmError::from)?)
            }
        }
    }

    /// Where the ways lead from where the robot is; none for the paper's, which numbers them and no more.
    fn bearings(&self) -> Option<Bearings> {
        match self.walker.config().heading {
            HeadingBy::Encoders => None,
            HeadingBy::Walls => self.walker.bearings(),
        }
    }

    /// What dead reckoning says of the walk from one place to where the robot is now; none if it is not trusted, as in the paper.
    fn motion(&self, from: Pose) -> Result<Option<Motion>, AgentError<B::Error>> {
        if self.walker.config().heading == HeadingBy::Encoders {
            return Ok(None);
        }
        let to = self.walker.pose();
        let left = self.walker.departed();
        let displacement = PointBox::about((to.position - from.position).into(), POSITION_MARGIN)?;
        let about = |pose: Pose| Interval::about(pose.heading.radians(), HEADING_MARGIN);
        Ok(Some(Motion {
            displacement,
            departure: about(left)?,
            arrival: about(to)?,
        }))
    }

    /// The second episode: drives the shortest known way to the goal, skipping observations.
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn drive_plan(&mut self, plan: &Plan) -> Result<Episode, AgentError<B::Error>> {
        let begun = Begun::now(&self.walker);
        // It may stand at the goal already.
        let here = self.explorer.map().junction(self.explorer.at().junction);
        let mut sighting = here.map(Junction::sighting);
        for leg in &plan.legs {
            // "The length of the fragments is used to estimate how many observation the robot can skip."
            let skip = self.walker.strides(leg.observations);
            match self.walker.walk(leg.turn.0 as usize, skip, None)? {
                Walk::Arrived { sighting: at, .. } => sighting = Some(at),
                Walk::TurnedBack { .. } => return Err(AgentError::Walk(WalkError::Lost)),
            }
            let expected = self
                .explorer
                .map()
                .junction(leg.arrive.junction)
                .map(Junction::sighting);
            if expected != sighting {
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
    /// [`AgentError`].
    pub fn optimize(&mut self) -> Result<usize, AgentError<B::Error>> {
        Ok(self.explorer.optimize(self.patterns.dictionary())?)
    }

    /// The robot was put back to where its map begins.
    ///
    /// # Errors
    /// [`AgentError`].
    pub fn placed_at_start(&mut self) -> Result<(), AgentError<B::Error>> {
        let start = self.explorer.map().landmarks(Landmark::Start).next();
        let Some(junction) = start else {
            return Err(AgentError::NoStart);
        };
        self.walker.begin()?;
        self.explorer.place(Port {
            junction,
            number: 0,
        })?;
        Ok(())
    }
}

/// Why an episode could not be played to its end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AgentError<E> {
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
