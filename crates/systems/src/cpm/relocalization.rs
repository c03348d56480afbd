use core::ops::ControlFlow;

use rand::{Rng, RngExt};
use tolman_maps::cpm::{CpMap, LocalizeError, Localizer, LocalizerConfig, Turn};

use super::common_patterns::CommonPatterns;
use super::failure::CpmResult;
use super::robot::CpmRobot;
use super::walker::{BeforePlace, Prospect, Walk, WalkError, WalkResult, Walker};
use super::whereabouts::{Approach, SURE, Whereabouts};

/// Parameters of localization. Walks of one robot along the same fragment differ by less than one
/// stride in twenty.
const CONFIG: LocalizerConfig = {
    let mut config = LocalizerConfig::usual();
    config.slip = 0.05;
    config
};

/// Finds a robot's place on one of several maps. The robot was put down anywhere, even in
/// mid-fragment (section 8, "the start point is changed").
///
/// The robot goes to the place ahead by its approach. From there it takes random fragments that its
/// maps have. The search ends when it is sure, or after a set number of places. The paper's robot
/// begins to observe at the first place; ours does at once.
#[derive(Clone, Debug)]
pub struct Relocalization {
    patterns: CommonPatterns,
    localizer: Localizer,
    approach: Approach,
    /// Maximum number of places visited after the first.
    last: usize,
    found: Whereabouts,
    /// Number of ways out of the robot's present place.
    degree: u32,
}

impl Relocalization {
    /// Returns a search on `maps` that ends after `most_places` places, at least one.
    ///
    /// # Errors
    /// [`LocalizeError`] if the maps are empty or have other patterns.
    pub fn new(
        maps: &[CpMap],
        patterns: &CommonPatterns,
        approach: Approach,
        most_places: u32,
    ) -> Result<Self, LocalizeError> {
        Ok(Self {
            patterns: patterns.clone(),
            localizer: Localizer::new(maps, patterns.dictionary(), CONFIG)?,
            approach,
            last: most_places.saturating_sub(1) as usize,
            found: Whereabouts::default(),
            degree: 0,
        })
    }

    /// Returns the result so far. At the end of a fragment, `Location::ahead` in
    /// [`Whereabouts::here`] is the port behind the robot.
    #[must_use]
    pub const fn found(&self) -> &Whereabouts {
        &self.found
    }

    /// Drives to the next place. Breaks when the robot is sure, or has visited the maximum number
    /// of places.
    ///
    /// # Errors
    /// [`CpmFailure`](super::CpmFailure).
    pub fn advance<B: CpmRobot>(
        &mut self,
        walker: &mut Walker<B>,
        rng: &mut impl Rng,
    ) -> CpmResult<ControlFlow<()>, B> {
        let place = self.found.at_places.len();
        let walk = if place == 0 {
            self.set_off(walker)?
        } else {
            let mut turn = onward(&self.localizer, self.degree, rng);
            // No map may have as many ways out as there are here.
            if self.localizer.turn(turn).is_err() {
                turn = Turn::BACK;
                self.localizer.turn(turn)?;
            }
            walker.walk(turn.0 as usize, 0, None)?
        };
        self.arrive(walker, walk)?;
        if place == self.last || is_sure(&self.localizer) {
            return Ok(ControlFlow::Break(()));
        }
        Ok(ControlFlow::Continue(()))
    }

    fn set_off<B: CpmRobot>(&mut self, walker: &mut Walker<B>) -> WalkResult<Walk, B> {
        walker.set_off(|prospect| {
            if self.approach == Approach::StraightOn {
                return BeforePlace::Enter;
            }
            let mut ahead = self.localizer.clone();
            // What cannot be taken in here cannot be taken in at the place either, and is reported
            // there.
            if take_in(&mut ahead, prospect, &self.patterns).is_err() || is_sure(&ahead) {
                return BeforePlace::Enter;
            }
            ahead.turn_round();
            self.localizer = ahead;
            self.found.has_turned_round = true;
            BeforePlace::TurnRound
        })
    }

    fn arrive<B: CpmRobot>(&mut self, walker: &Walker<B>, walk: Walk) -> CpmResult<(), B> {
        let sighting = walk.sighting.ok_or(WalkError::Lost)?;
        let prospect = Prospect {
            observations: walk.observations,
            glimpse: walk.glimpse,
            landmark: sighting.landmark,
        };
        let found = &mut self.found;
        let is_whole = !found.at_places.is_empty() || found.has_turned_round;
        let has_seen = is_whole || prospect.glimpse.is_some() || !prospect.observations.is_empty();
        take_in(&mut self.localizer, &prospect, &self.patterns)?;
        let belief = has_seen.then(|| self.localizer.location());
        found.under_way.push(belief);
        if is_whole {
            found.walks.push(prospect.observations);
        }
        self.localizer.arrive(sighting, walker.bearings().as_ref());
        found.at_places.push(self.localizer.location());
        self.degree = sighting.degree;
        Ok(())
    }
}

/// Takes in the view of a place as it comes into sight.
fn take_in(
    localizer: &mut Localizer,
    prospect: &Prospect,
    patterns: &CommonPatterns,
) -> Result<(), LocalizeError> {
    for pattern in patterns.patterns(&prospect.observations) {
        localizer.observe(pattern)?;
    }
    localizer.end_in_sight(prospect.landmark, prospect.glimpse.as_ref());
    Ok(())
}

fn is_sure(localizer: &Localizer) -> bool {
    localizer.location().probability > SURE
}

/// Returns a random turn among those that its maps most likely have. Other turns would teach it
/// nothing.
fn onward(localizer: &Localizer, degree: u32, rng: &mut impl Rng) -> Turn {
    let turns = || (1..degree).map(Turn);
    let best = turns()
        .map(|turn| localizer.knows(turn))
        .fold(0.0, f64::max);
    let known: Vec<Turn> = turns()
        .filter(|turn| localizer.knows(*turn) >= best / 2.0)
        .collect();
    match known.len() as u32 {
        0 => Turn::BACK,
        count => known[rng.random_range(0..count) as usize],
    }
}
