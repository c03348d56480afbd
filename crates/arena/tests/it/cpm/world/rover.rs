use core::ops::ControlFlow;

use alloc::vec::Vec;

use rand::{Rng, RngExt};
use tolman_geom::{Heading, Interval, Point, PointBox, Vector};

use super::{CorridorEnd, MazeCorridor, PlaneMaze, WorldPort};
use tolman_maps::cpm::{
    Bearings, CpmError, DeadReckoning, MapUpdate, NoSuchTurn, PatternId, Sighting, Sign, Traversal,
    Turn,
};
use tolman_systems::cpm::{Aim, Done, Explorer, Leg};

/// Errors of a walker's senses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WalkerNoise {
    /// Probability that an observation is replaced by another random pattern, 0 … 1.
    pub(crate) substitution: f64,
    /// Probability of an additional random observation after each, 0 to 1.
    pub(crate) insertion: f64,
    /// Probability that an observation is not made; 0 to 1.
    pub(crate) deletion: f64,
    /// Slip: maximum error of a fragment's length, as a share of it; 0 to less than 1. The number
    /// of observations changes with it.
    pub(crate) slip: f64,
    /// Maximum error of the believed heading, rad; not negative.
    pub(crate) heading: f64,
}

impl WalkerNoise {
    /// A rover without errors.
    pub(crate) const NONE: Self = Self {
        substitution: 0.0,
        insertion: 0.0,
        deletion: 0.0,
        slip: 0.0,
        heading: 0.0,
    };

    /// Errors like those of the paper's robot, and more: 10 % slip, one observation in ten
    /// mistaken.
    pub(crate) const NOISY: Self = Self {
        substitution: 0.1,
        insertion: 0.03,
        deletion: 0.03,
        slip: 0.1,
        heading: 0.1,
    };
}

/// Ways in which a rover counts its steps and looks round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reckoning {
    /// The rover does neither, as in the paper.
    None,
    /// The rover has dead reckoning with bounds that hold, and bearings.
    Bounded,
}

/// A walker in a world.
#[derive(Clone, Debug)]
pub(crate) struct PlaneWalker<'a> {
    world: &'a PlaneMaze,
    noise: WalkerNoise,
    reckoning: Reckoning,
    at: WorldPort,
}

/// Result of a walk.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum WalkOutcome {
    /// The rover reached the end of the fragment.
    Arrived(Traversal),
    /// The rover gave up after these observations. It has returned to its place, and the tried port
    /// is behind it.
    TurnedBack(Vec<PatternId>),
}

impl<'a> PlaneWalker<'a> {
    /// Returns a walker at the world's start.
    #[must_use]
    pub(crate) const fn new(
        world: &'a PlaneMaze,
        noise: WalkerNoise,
        reckoning: Reckoning,
    ) -> Self {
        Self {
            world,
            noise,
            reckoning,
            at: world.start,
        }
    }

    /// Returns the true place of the rover: the port behind it.
    #[must_use]
    pub(crate) const fn at(&self) -> WorldPort {
        self.at
    }

    /// Puts the rover down at a place, with the port `at` behind it. A port that does not exist
    /// leaves the rover where it is.
    pub(crate) fn place(&mut self, at: WorldPort) {
        if self.world.end_at(at).is_some() {
            self.at = at;
        }
    }

    /// Returns the sighting of its present place.
    #[must_use]
    pub(crate) fn sighting(&self) -> Sighting {
        self.world.sighting(self.at.place)
    }

    /// Turns and walks to the end of the fragment; gives up if it has not arrived after
    /// `give_up_after` observations.
    ///
    /// # Errors
    /// If the place has no such turn.
    pub(crate) fn go(
        &mut self,
        turn: Turn,
        give_up_after: Option<u32>,
        rng: &mut impl Rng,
    ) -> Result<WalkOutcome, NoSuchTurn> {
        let WorldPort { place, number } = self.at;
        let degree = self.sighting().degree;
        let number = turn.exit(number, degree)?;
        let exit = WorldPort { place, number };
        let (Some(end), Some(arrival)) = (self.world.end_at(exit), self.world.beyond(exit)) else {
            return Err(NoSuchTurn { turn, degree });
        };
        let corridor = &self.world.corridors[end.corridor as usize];
        let stretch = 1.0 + self.noise.slip * (2.0 * uniform(rng) - 1.0);
        let truth = self.truth(corridor, end.sign);
        let mut patterns = self.observe(&truth, stretch, rng);
        let motion = match self.reckoning {
            Reckoning::None => None,
            Reckoning::Bounded => self.reckon(corridor, end.sign, stretch, rng),
        };
        if let Some(most) = give_up_after
            && patterns.len() >= most.max(1) as usize
        {
            patterns.truncate(most.max(1) as usize);
            self.at = exit;
            return Ok(WalkOutcome::TurnedBack(patterns));
        }
        self.at = arrival;
        let sighting = self.sighting();
        Ok(WalkOutcome::Arrived(Traversal {
            patterns,
            motion,
            sighting,
            bearings: self.looked(rng),
        }))
    }

    /// Walks as `explorer` decides until there is nothing more to do for `aim`. Calls `see` with
    /// every fragment that was walked to its end.
    ///
    /// # Errors
    /// [`CpmError`] if the explorer decides on a turn that does not exist, or refuses an
    /// observation.
    pub(crate) fn pursue<G: Rng>(
        &mut self,
        explorer: &mut Explorer,
        aim: Aim,
        rng: &mut G,
        mut see: impl FnMut(&Self, &Explorer, &Leg, MapUpdate),
    ) -> Result<Done, CpmError> {
        loop {
            let leg = match explorer.decide(aim, rng) {
                ControlFlow::Break(done) => return Ok(done),
                ControlFlow::Continue(leg) => leg,
            };
            match self.go(leg.turn, leg.give_up_after, rng)? {
                WalkOutcome::Arrived(walk) => {
                    let arrival =
                        explorer
                            .mapper
                            .arrive(leg.turn, &walk, &self.world.dictionary)?;
                    see(self, explorer, &leg, arrival);
                }
                WalkOutcome::TurnedBack(seen) => {
                    explorer.mapper.turned_back(leg.turn, seen.len() as u32)?;
                }
            }
        }
    }

    /// Puts the rover into a corridor, entered at an end, after `passed` observations, and lets it
    /// walk on to the other end. Returns `None` if there is no such corridor.
    pub(crate) fn walk_on(
        &mut self,
        enter: CorridorEnd,
        passed: u32,
        rng: &mut impl Rng,
    ) -> Option<Traversal> {
        let corridor = self.world.corridors.get(enter.corridor as usize)?;
        let stretch = 1.0 + self.noise.slip * (2.0 * uniform(rng) - 1.0);
        let truth = self.truth(corridor, enter.sign);
        let patterns = self.observe(truth.get(passed as usize..)?, stretch, rng);
        self.at = corridor.port(enter.sign.opposite());
        Some(Traversal {
            patterns,
            motion: None,
            sighting: self.sighting(),
            bearings: self.looked(rng),
        })
    }

    /// Returns the bearings of the ways out of the place, counted from the way by which the robot
    /// came. `None` if it does not look.
    fn looked(&self, rng: &mut impl Rng) -> Option<Bearings> {
        if self.reckoning == Reckoning::None {
            return None;
        }
        let WorldPort { place, number } = self.at;
        let degree = self.sighting().degree;
        let ways = (0..degree).map(|by| {
            let number = (number + by) % degree;
            let end = self.world.end_at(WorldPort { place, number })?;
            let corridor = self.world.corridors.get(end.corridor as usize)?;
            let error = self.noise.heading * (2.0 * uniform(rng) - 1.0);
            Some(corridor.bearing(end.sign).radians() + error)
        });
        let ways: Option<Vec<f64>> = ways.collect();
        Bearings::of_directions(&ways?).ok()
    }

    /// Returns the true observations of a corridor.
    fn truth(&self, corridor: &MazeCorridor, enter: Sign) -> Vec<PatternId> {
        match enter {
            Sign::Minus => corridor.patterns.clone(),
            Sign::Plus => {
                let inverse = self.world.dictionary.inverse(&corridor.patterns);
                inverse.unwrap_or_default()
            }
        }
    }

    fn observe(&self, truth: &[PatternId], stretch: f64, rng: &mut impl Rng) -> Vec<PatternId> {
        let dictionary = &self.world.dictionary;
        let count = libm::round(truth.len() as f64 * stretch).max(1.0) as usize;
        let any = |rng: &mut _| PatternId(RngExt::random_range(rng, 0..dictionary.len() as u32));
        let mut seen = Vec::with_capacity(count);
        for place in 0..count {
            let Some(pattern) = truth.get((2 * place + 1) * truth.len() / (2 * count)) else {
                break;
            };
            if uniform(rng) >= self.noise.deletion {
                let mistaken = uniform(rng) < self.noise.substitution;
                seen.push(if mistaken { any(rng) } else { *pattern });
            }
            if uniform(rng) < self.noise.insertion {
                seen.push(any(rng));
            }
        }
        seen
    }

    fn reckon(
        &self,
        corridor: &MazeCorridor,
        enter: Sign,
        stretch: f64,
        rng: &mut impl Rng,
    ) -> Option<DeadReckoning> {
        let (minus, plus) = (corridor.line.first()?, corridor.line.last()?);
        let truth = match enter {
            Sign::Minus => plus - minus,
            Sign::Plus => minus - plus,
        };
        let mut drift = || self.noise.heading * (2.0 * uniform(rng) - 1.0);
        let believed = rotated(truth, drift()) * stretch;
        // The truth is what is believed, less the slip, turned back by the drift. A nanometre makes
        // up for rounding.
        let (slip, heading) = (self.noise.slip, self.noise.heading + 1e-9);
        let scale = Interval::new(1.0 / (1.0 + slip), 1.0 / (1.0 - slip)).ok()?;
        let side = |value: f64| (Interval::of(value).ok()? * scale).widened(1e-9).ok();
        let displacement = PointBox::new(side(believed.x)?, side(believed.y)?)
            .rotated(Interval::about(0.0, heading).ok()?);
        let mut about = |truth: Heading| Interval::about(truth.radians() + drift(), heading).ok();
        Some(DeadReckoning {
            displacement,
            departure: about(corridor.bearing(enter))?,
            arrival: about(corridor.bearing(enter.opposite()).reversed())?,
        })
    }
}

/// Returns a random number from 0 to less than 1.
pub(super) fn uniform(rng: &mut impl Rng) -> f64 {
    f64::from(rng.random::<u32>()) / 4_294_967_296.0
}

fn rotated(vector: Vector, angle: f64) -> Vector {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    Point::new(
        vector.x * cos - vector.y * sin,
        vector.x * sin + vector.y * cos,
    )
    .coords
}
