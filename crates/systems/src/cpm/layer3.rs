use core::f64::consts::PI;
use core::ops::ControlFlow;

use rand::Rng;
use tolman_geom::{Heading, Interval, IntervalError, PointBox, Pose};
use tolman_maps::cpm::{
    Bearings, CpMap, CpmError, DeadReckoning, Junction, MapUpdate, PatternId, Plan, PlanLeg, Port,
    Sighting, Traversal, Turn,
};
use tolman_robot::Landmark;

use super::common_patterns::CommonPatterns;
use super::config::CpmConfig;
use super::decision::{Aim, Done, Leg};
use super::episode::{Begun, EpisodeSummary};
use super::explorer::Explorer;
use super::failure::{CpmFailure, CpmResult};
use super::robot::CpmRobot;
use super::walker::{Observation, WalkError, Walker};
use super::walker_config::HeadingBy;

/// Layer 3: maps by common patterns, reasons at junctions, plans (section 4, figure 2).
///
/// It has no body. It is lent the robot by its lower layers, a [`Walker`], for one fragment at a
/// time.
#[derive(Clone, Debug)]
pub struct Layer3 {
    /// The common patterns, including those learned on the way.
    pub patterns: CommonPatterns,
    /// Distance from all patterns beyond which an observation becomes a new pattern; `None` to
    /// learn no more.
    pub novelty: Option<f64>,
    /// The explorer, which decides by the map.
    pub explorer: Explorer,
}

/// Bound on the error of dead reckoning along a fragment, m: a third of a corridor's width, so that
/// neighbouring cells stay distinct.
const POSITION_MARGIN: f64 = 0.08;

/// Bound on the error of a heading, rad. A branch's heading is the middle of a gap between walls.
const HEADING_MARGIN: f64 = 0.6;

/// Input that CPM learns from: the start of a map, or a walk along a fragment.
#[derive(Clone, Debug, PartialEq)]
pub enum CpmObservation {
    /// Place where the robot began, with its first way out behind it.
    Began(Sighting),
    /// A walk along a fragment.
    Walked(Walked),
}

/// A walk along a fragment.
#[derive(Clone, Debug, PartialEq)]
pub struct Walked {
    /// Turn made at the place where the fragment begins.
    pub turn: Turn,
    /// Observations on the way, up to the end or to the point where the robot turned round.
    pub observations: Vec<Observation>,
    /// Place at the fragment's end; `None` if the robot turned round before the end.
    pub sighting: Option<Sighting>,
    /// Displacement by dead reckoning; `None` if that is not trusted, as in the paper.
    pub motion: Option<DeadReckoning>,
    /// Bearings of the ways out of the place at the fragment's end; `None` if the ways only have
    /// numbers, as in the paper.
    pub bearings: Option<Bearings>,
}

/// Result at the end of a fragment.
#[derive(Clone, Debug, PartialEq)]
pub struct FragmentStep {
    /// Decision of layer 3.
    pub leg: Leg,
    /// Places and fragments that the robot met on the way.
    pub walked: Walked,
    /// Change of the map by the arrival; `None` if the robot turned back.
    pub arrival: Option<MapUpdate>,
}

impl Layer3 {
    /// Lets a robot look round and begin its map there. An
    /// observation farther than `novelty` from all patterns becomes a new pattern (section 8, "the
    /// CPs must be learned incrementally").
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn begin<B: CpmRobot>(
        walker: &mut Walker<B>,
        patterns: CommonPatterns,
        novelty: Option<f64>,
        config: CpmConfig,
    ) -> CpmResult<Self, B> {
        Ok(Self {
            patterns,
            novelty,
            explorer: Explorer::new(config, walker.begin()?)?,
        })
    }

    /// Returns layer 3 of a robot with a map in these patterns, at a port of that map.
    ///
    /// # Errors
    /// [`CpmError`] if the map has no such port.
    pub fn resume_at(
        patterns: CommonPatterns,
        config: CpmConfig,
        map: CpMap,
        at: Port,
    ) -> Result<Self, CpmError> {
        Ok(Self {
            patterns,
            novelty: None,
            explorer: Explorer::resume(config, map, at)?,
        })
    }

    /// Takes in that the robot was put back to the beginning of its map.
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn placed_at_start<B: CpmRobot>(&mut self, walker: &mut Walker<B>) -> CpmResult<(), B> {
        let start = self.map().start().ok_or(CpmFailure::NoStart)?;
        walker.begin()?;
        Ok(self.explorer.mapper.place(start)?)
    }

    /// Returns the present map.
    #[must_use]
    pub fn map(&self) -> &CpMap {
        self.explorer.mapper.map()
    }

    /// Takes in a walk, and returns the change on the map; `None` if the robot turned back.
    ///
    /// # Errors
    /// [`CpmError`]; the map is then unchanged.
    pub fn take_in(&mut self, walked: &Walked) -> Result<Option<MapUpdate>, CpmError> {
        let Some(sighting) = walked.sighting else {
            let observations = walked.observations.len() as u32;
            self.explorer
                .mapper
                .turned_back(walked.turn, observations)?;
            return Ok(None);
        };
        let traversal = Traversal {
            patterns: self.perceive(&walked.observations)?,
            motion: walked.motion,
            sighting,
            bearings: walked.bearings.clone(),
        };
        let (explorer, dictionary) = (&mut self.explorer, self.patterns.dictionary());
        Ok(Some(explorer.arrive(
            walked.turn,
            &traversal,
            dictionary,
        )?))
    }

    /// Walks one fragment towards the aim, or returns why there is nothing to walk.
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn advance<B: CpmRobot>(
        &mut self,
        walker: &mut Walker<B>,
        aim: Aim,
        rng: &mut impl Rng,
    ) -> CpmResult<ControlFlow<Done, FragmentStep>, B> {
        // "At the junction layer 3 activates …": it decides, and takes the robot over for a turn.
        let leg = match self.explorer.decide(aim, rng) {
            ControlFlow::Break(done) => return Ok(ControlFlow::Break(done)),
            ControlFlow::Continue(leg) => leg,
        };
        // "… then it lets the lower layers regain the control of the robot."
        let from = walker.pose();
        let walk = walker.walk(leg.turn.0 as usize, 0, leg.give_up_after)?;
        let walked = Walked {
            turn: leg.turn,
            observations: walk.observations,
            sighting: walk.sighting,
            motion: motion(walker, from)?,
            bearings: bearings(walker),
        };
        let arrival = self.take_in(&walked)?;
        Ok(ControlFlow::Continue(FragmentStep {
            leg,
            walked,
            arrival,
        }))
    }

    /// Drives one fragment of a plan, skipping observations, and returns the sighting at its end.
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn drive<B: CpmRobot>(walker: &mut Walker<B>, leg: &PlanLeg) -> CpmResult<Sighting, B> {
        // "The length of the fragments is used to estimate how many observation the robot can
        // skip."
        let skip = walker.strides(leg.observations);
        let walk = walker.walk(leg.turn.0 as usize, skip, None)?;
        Ok(walk.sighting.ok_or(WalkError::Lost)?)
    }

    /// Drives the shortest known way to the goal, skipping observations: the second episode.
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn drive_plan<B: CpmRobot>(
        &self,
        walker: &mut Walker<B>,
        plan: &Plan,
    ) -> CpmResult<EpisodeSummary, B> {
        let begun = Begun::now(walker);
        // The robot may be at the goal already.
        let here = self.map().junction(self.explorer.mapper.at().junction);
        let mut sighting = here.map(Junction::sighting);
        for leg in &plan.legs {
            sighting = Some(Self::drive(walker, leg)?);
            if self.expected(leg) != sighting {
                break;
            }
        }
        let arrived = sighting.is_some_and(|at| at.landmark == Some(Landmark::Goal));
        let done = if arrived {
            Done::Reached
        } else {
            Done::NotThere
        };
        Ok(begun.ended(done, walker))
    }

    /// Returns the sighting that the map expects at the end of a fragment of a plan.
    #[must_use]
    pub fn expected(&self, leg: &PlanLeg) -> Option<Sighting> {
        let place = self.map().junction(leg.arrive.junction);
        place.map(Junction::sighting)
    }

    /// Merges all similar fragments: the last step of the offline CPM. Returns the number of
    /// merges. Online there is nothing left to merge.
    ///
    /// # Errors
    /// [`CpmError`].
    pub fn optimize(&mut self) -> Result<usize, CpmError> {
        self.explorer.mapper.optimize(self.patterns.dictionary())
    }

    /// Returns the patterns of the observations, some of which may be new.
    fn perceive(&mut self, observations: &[Observation]) -> Result<Vec<PatternId>, CpmError> {
        match self.novelty {
            None => Ok(self.patterns.patterns(observations)),
            Some(novelty) => Ok(self.patterns.learn_on(observations, novelty)?),
        }
    }
}

/// Returns the bearings of the ways out of the robot's place; `None` in the paper's mode, which
/// only numbers them.
fn bearings<B: CpmRobot>(walker: &Walker<B>) -> Option<Bearings> {
    match walker.config().heading {
        HeadingBy::Encoders => None,
        HeadingBy::Walls => walker.bearings(),
    }
}

/// Returns the displacement by dead reckoning from one place to the robot's present pose; `None` if
/// that is not trusted, as in the paper.
fn motion<B: CpmRobot>(
    walker: &Walker<B>,
    from: Pose,
) -> Result<Option<DeadReckoning>, IntervalError> {
    if walker.config().heading == HeadingBy::Encoders {
        return Ok(None);
    }
    let to = walker.pose();
    let left = walker.departed();
    // In a bend the robot may face along the way in or the way out. The way it came by says where
    // it came from.
    let behind = walker.branches().first().copied().unwrap_or(PI);
    let came = to.heading.turned(behind + PI);
    let displacement = PointBox::about((to.position - from.position).into(), POSITION_MARGIN)?;
    let about = |heading: Heading| Interval::about(heading.radians(), HEADING_MARGIN);
    Ok(Some(DeadReckoning {
        displacement,
        departure: about(left.heading)?,
        arrival: about(came)?,
    }))
}
