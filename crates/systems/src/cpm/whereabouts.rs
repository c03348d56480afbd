use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_maps::cpm::{CpMap, LocalizeError, Localizer, LocalizerConfig, Location, Turn};

use super::common_patterns::CommonPatterns;
use super::robot::CpmRobot;
use super::walker::{BeforePlace, Observation, Prospect, Walk, WalkError, Walker};

/// How a robot goes to the first place that was put down amid a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approach {
    /// To the one ahead: it "continues moving forward until the first junction is found" (section 8).
    StraightOn,
    /// To the one ahead; but if it is not sure where it is when that comes into sight, it turns round and goes to the one at the other end.
    /// Ours: before it enters any place it has seen the whole fragment, and both ends.
    ToAndFro,
}

/// What a robot that was put down somewhere found out about where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// Whether it turned round before the first place.
    pub has_turned_round: bool,
    /// What it believed at each place it came to: the fragment it came by, and the port behind it.
    pub at_places: Vec<Location>,
    /// What it believed before each of them, when it first saw it ahead; none if it had observed nothing at all, and so does
    /// not know.
    pub under_way: Vec<Option<Location>>,
    /// What it saw along each fragment it walked whole, from end to end.
    pub walks: Vec<Vec<Observation>>,
}

impl Whereabouts {
    /// Where it believes to be in the end: at the place to which that fragment has led it.
    #[must_use]
    pub fn here(&self) -> Option<Location> {
        self.at_places.last().copied()
    }
}

/// Walks of this robot along one fragment differ by less than one stride in twenty.
const CONFIG: LocalizerConfig = LocalizerConfig {
    slip: 0.05,
    ..LocalizerConfig::usual()
};

/// How sure a robot is that knows where it is: it looks no further.
const SURE: f64 = 0.95;

/// Lets a robot that was put down anywhere, also in mid-fragment, find out on which of some maps it is, and where: it comes to the place ahead
/// by its approach and then, at random, along further fragments that its maps have, until it is sure or has come to so many places after the first
/// (section 8, "the start point is changed"). The paper's robot begins to observe at that junction; ours does at once. `see` is told of
/// every place it comes to.
///
/// Where it is then, [`Whereabouts::here`] says: [`Location::ahead`] is the port behind it.
///
/// # Errors
/// [`WhereaboutsError`].
pub fn find_out<B: CpmRobot>(
    walker: &mut Walker<B>,
    maps: &[CpMap],
    patterns: &CommonPatterns,
    approach: Approach,
    most_places: u32,
    rng: &mut impl Rng,
    mut see: impl FnMut(&Walker<B>),
) -> Result<Whereabouts, WhereaboutsError<B::Error>> {
    let mut localizer = Localizer::new(maps, patterns.dictionary(), CONFIG)?;
    let mut has_turned_round = false;
    let mut walk = walker.set_off(|prospect| {
        if approach == Approach::StraightOn {
            return BeforePlace::Enter;
        }
        let mut ahead = localizer.clone();
        // What cannot be taken in here cannot be at the place either, and is told of there.
        if take_in(&mut ahead, prospect, patterns).is_err() || is_sure(&ahead) {
            return BeforePlace::Enter;
        }
        ahead.turn_round();
        localizer = ahead;
        has_turned_round = true;
        BeforePlace::TurnRound
    })?;
    let mut found = Whereabouts {
        has_turned_round,
        ..Whereabouts::default()
    };
    let last = most_places.saturating_sub(1) as usize;
    for place in 0..=last {
        let Walk::Arrived {
            observations,
            glimpse,
            sighting,
        } = walk
        else {
            return Err(WalkError::Lost.into());
        };
        let prospect = Prospect {
            observations,
            glimpse,
            landmark: sighting.landmark,
        };
        let is_whole = place > 0 || has_turned_round;
        let has_seen = is_whole || prospect.glimpse.is_some() || !prospect.observations.is_empty();
        take_in(&mut localizer, &prospect, patterns)?;
        let belief = has_seen.then(|| localizer.location());
        found.under_way.push(belief);
        if is_whole {
            found.walks.push(prospect.observations);
        }
        localizer.arrive(sighting, walker.bearings().as_ref());
        found.at_places.push(localizer.location());
        see(walker);
        if place == last || is_sure(&localizer) {
            break;
        }
        let turn = onward(&localizer, sighting.degree, rng);
        localizer.turn(turn)?;
        walk = walker.walk(turn.0 as usize, 0, None)?;
    }
    Ok(found)
}

/// What is known when a place comes into sight.
fn take_in(
    localizer: &mut Localizer<'_>,
    prospect: &Prospect,
    patterns: &CommonPatterns,
) -> Result<(), LocalizeError> {
    for pattern in patterns.patterns(&prospect.observations) {
        localizer.observe(pattern)?;
    }
    localizer.end_in_sight(prospect.landmark, prospect.glimpse.as_ref());
    Ok(())
}

fn is_sure(localizer: &Localizer<'_>) -> bool {
    localizer.location().probability > SURE
}

/// A turn at random among those that its maps most likely know: by others it would learn nothing.
fn onward(localizer: &Localizer<'_>, degree: u32, rng: &mut impl Rng) -> Turn {
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

/// Why a robot cannot look where it is.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WhereaboutsError<E> {
    /// The robot.
    #[error(transparent)]
    Walk(#[from] WalkError<E>),
    /// The maps.
    #[error(transparent)]
    Maps(#[from] LocalizeError),
}
