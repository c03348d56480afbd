use alloc::borrow::Cow;
use core::ops::ControlFlow;

use rand::Rng;
use tolman_geom::{Interval, IntervalError, PointBox, Pose};
use tolman_maps::cpm::{
    Arrival, Bearings, CpmError, Junction, Motion, PatternId, PlanLeg, Sighting, Traversal, Turn,
};

use super::common_patterns::CommonPatterns;
use super::decision::{Aim, Decision, Done, Leg};
use super::explorer::Explorer;
use super::reasoner::ReasonerError;
use super::robot::CpmRobot;
use super::walker::{Observation, Walk, WalkError, Walker};
use super::walker_config::HeadingBy;

/// Layer 3: maps by common patterns, reasons at junctions, plans (section 4, figure 2).
///
/// It has no body: it takes the robot over from its lower layers, a [`Walker`], for one fragment at a time.
#[derive(Clone, Debug)]
pub struct Layer3<'a> {
    patterns: Cow<'a, CommonPatterns>,
    /// How far from all patterns an observation is that becomes one itself; `None` if all were learned before.
    novelty: Option<f64>,
    explorer: Explorer,
}

/// How far dead reckoning may be off along one fragment, m: a third of a corridor's width, so that neighbouring cells are told apart.
const POSITION_MARGIN: f64 = 0.08;

/// How far a heading may be off, rad: that of a branch is the middle of a gap between walls.
const HEADING_MARGIN: f64 = 0.6;

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

/// What CPM learns from: where a map begins, or a fragment that was walked.
#[derive(Clone, Debug, PartialEq)]
pub enum Experience {
    /// The place at which the robot began, with its first way out behind it.
    Began(Sighting),
    /// A fragment walked to its end.
    Arrived {
        /// The turn made at the place it leads from.
        turn: Turn,
        /// What was seen on the way.
        observations: Vec<Observation>,
        /// What dead reckoning says of the way; `None` if it is not trusted, as in the paper.
        motion: Option<Motion>,
        /// What stands at its end.
        sighting: Sighting,
        /// Where the ways out of its end lead; `None` where they are numbered alone, as in the paper.
        bearings: Option<Bearings>,
    },
    /// A fragment in which the robot turned round.
    TurnedBack {
        /// The turn made at the place it leads from.
        turn: Turn,
        /// Number of observations until it turned round.
        observations: u32,
    },
}

impl<'a> Layer3<'a> {
    /// Returns layer 3 of a robot that knows these patterns and decides by `explorer`. `novelty` is how far
    /// from all patterns an observation is that becomes one itself; `None` learns no further ones.
    #[must_use]
    pub const fn new(
        patterns: Cow<'a, CommonPatterns>,
        novelty: Option<f64>,
        explorer: Explorer,
    ) -> Self {
        Self {
            patterns,
            novelty,
            explorer,
        }
    }

    /// Returns the common patterns, those learned on the way among them.
    #[must_use]
    pub fn patterns(&self) -> &CommonPatterns {
        &self.patterns
    }

    /// Returns the map and what decides by it.
    #[must_use]
    pub const fn explorer(&self) -> &Explorer {
        &self.explorer
    }

    /// Returns the map and what decides by it, to be put elsewhere.
    pub const fn explorer_mut(&mut self) -> &mut Explorer {
        &mut self.explorer
    }

    /// Takes in what the robot met, and returns what that taught; `None` where it turned back.
    ///
    /// # Errors
    /// [`CpmError`]; the map is as before then.
    pub fn take_in(&mut self, experience: &Experience) -> Result<Option<Arrival>, CpmError> {
        match experience {
            Experience::Began(sighting) => {
                self.explorer.begin_anew(*sighting)?;
                Ok(None)
            }
            Experience::Arrived {
                turn,
                observations,
                motion,
                sighting,
                bearings,
            } => {
                let traversal = Traversal {
                    patterns: self.perceive(observations)?,
                    motion: *motion,
                    sighting: *sighting,
                    bearings: bearings.clone(),
                };
                let dictionary = self.patterns.dictionary();
                let arrival = self.explorer.arrive(*turn, &traversal, dictionary)?;
                Ok(Some(arrival))
            }
            Experience::TurnedBack { turn, observations } => {
                self.explorer.turned_back(*turn, *observations)?;
                Ok(None)
            }
        }
    }

    /// Walks one fragment towards the aim, or says why there is none to walk.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn advance<B: CpmRobot>(
        &mut self,
        walker: &mut Walker<B>,
        aim: Aim,
        rng: &mut impl Rng,
    ) -> Result<ControlFlow<Done, Step>, ReasonerError<B::Error>> {
        // "At the junction layer 3 activates …": it decides, and takes the robot over for a turn.
        let leg = match self.explorer.decide(aim, rng) {
            Decision::Done(done) => return Ok(ControlFlow::Break(done)),
            Decision::Go(leg) => leg,
        };
        // "… then it lets the lower layers regain the control of the robot."
        let from = walker.pose();
        let walk = walker.walk(leg.turn.0 as usize, 0, leg.give_up_after)?;
        let (experience, sighting) = experienced(walker, leg.turn, &walk, from)?;
        let arrival = self.take_in(&experience)?;
        Ok(ControlFlow::Continue(Step {
            leg,
            arrival,
            sighting,
            walk,
        }))
    }

    /// Drives one fragment of a plan, skipping observations, and returns what stands at its end.
    ///
    /// # Errors
    /// [`ReasonerError`].
    pub fn drive<B: CpmRobot>(
        walker: &mut Walker<B>,
        leg: &PlanLeg,
    ) -> Result<Sighting, ReasonerError<B::Error>> {
        // "The length of the fragments is used to estimate how many observation the robot can skip."
        let skip = walker.strides(leg.observations);
        match walker.walk(leg.turn.0 as usize, skip, None)? {
            Walk::Arrived { sighting, .. } => Ok(sighting),
            Walk::TurnedBack { .. } => Err(ReasonerError::Walk(WalkError::Lost)),
        }
    }

    /// Returns what the map expects at the end of a fragment of a plan.
    #[must_use]
    pub fn expected(&self, leg: &PlanLeg) -> Option<Sighting> {
        let place = self.explorer.map().junction(leg.arrive.junction);
        place.map(Junction::sighting)
    }

    /// Merges all that is similar: the offline CPM's last step. Online nothing is left to merge.
    ///
    /// # Errors
    /// [`CpmError`].
    pub fn optimize(&mut self) -> Result<usize, CpmError> {
        self.explorer.optimize(self.patterns.dictionary())
    }

    /// Returns the patterns of what was seen on a way, some of them perhaps new.
    fn perceive(&mut self, observations: &[Observation]) -> Result<Vec<PatternId>, CpmError> {
        match self.novelty {
            None => Ok(self.patterns.patterns(observations)),
            Some(novelty) => Ok(self.patterns.to_mut().learn_on(observations, novelty)?),
        }
    }
}

/// Returns what a walk gave that began at the pose `from`, and what stands at its end.
fn experienced<B: CpmRobot>(
    walker: &Walker<B>,
    turn: Turn,
    walk: &Walk,
    from: Pose,
) -> Result<(Experience, Option<Sighting>), IntervalError> {
    Ok(match walk {
        Walk::Arrived {
            observations,
            sighting,
            ..
        } => {
            let experience = Experience::Arrived {
                turn,
                observations: observations.clone(),
                motion: motion(walker, from)?,
                sighting: *sighting,
                bearings: bearings(walker),
            };
            (experience, Some(*sighting))
        }
        Walk::TurnedBack { observations } => {
            let observations = observations.len() as u32;
            (Experience::TurnedBack { turn, observations }, None)
        }
    })
}

/// Returns where the ways lead from where the robot is; `None` for the paper's, which numbers them and no more.
fn bearings<B: CpmRobot>(walker: &Walker<B>) -> Option<Bearings> {
    match walker.config().heading {
        HeadingBy::Encoders => None,
        HeadingBy::Walls => walker.bearings(),
    }
}

/// Returns what dead reckoning says of the walk from one place to where the robot is now; `None` if it is not trusted, as in the paper.
fn motion<B: CpmRobot>(walker: &Walker<B>, from: Pose) -> Result<Option<Motion>, IntervalError> {
    if walker.config().heading == HeadingBy::Encoders {
        return Ok(None);
    }
    let to = walker.pose();
    let left = walker.departed();
    let displacement = PointBox::about((to.position - from.position).into(), POSITION_MARGIN)?;
    let about = |pose: Pose| Interval::about(pose.heading.radians(), HEADING_MARGIN);
    Ok(Some(Motion {
        displacement,
        departure: about(left)?,
        arrival: about(to)?,
    }))
}
