use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_maps::cpm::{CpMap, LocalizeError, Localizer, LocalizerConfig, Location, Turn};

use super::body::Body;
use super::common_patterns::CommonPatterns;
use super::walker::{Observation, Walk, WalkError, Walker};

/// Which way a robot goes first that was put down amid a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approach {
    /// To the place ahead: it "continues moving forward until the first junction is found" (section 8).
    StraightOn,
    /// Back to the place behind, and from there along the whole fragment to the place ahead. Ours: what it has seen of the fragment before
    /// it leaves it is all of it.
    BackFirst,
}

impl Approach {
    /// How many places it comes to before the one that was ahead where it was put down.
    #[must_use]
    pub const fn places_before(self) -> usize {
        match self {
            Self::StraightOn => 0,
            Self::BackFirst => 1,
        }
    }
}

/// What a robot that was put down somewhere found out about where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// What it believed at each place it came to: the fragment it came by, and the port behind it.
    pub at_places: Vec<Location>,
    /// What it believed before each of them, when it first saw it ahead; none if it had observed nothing at all, and so does
    /// not know.
    pub under_way: Vec<Option<Location>>,
    /// What it saw along each fragment it walked whole.
    pub walks: Vec<Vec<Observation>>,
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
/// Where it is then, `at_places.last()` says: [`Location::ahead`] is the port behind it.
///
/// # Errors
/// [`WhereaboutsError`].
pub fn find_out<B: Body>(
    walker: &mut Walker<B>,
    maps: &[CpMap],
    patterns: &CommonPatterns,
    approach: Approach,
    most_places: u32,
    rng: &mut impl Rng,
    mut see: impl FnMut(&Walker<B>),
) -> Result<Whereabouts, WhereaboutsError<B::Error>> {
    let mut localizer = Localizer::new(maps, patterns.dictionary(), CONFIG)?;
    let mut found = Whereabouts::default();
    if approach == Approach::BackFirst {
        walker.turn_round()?;
    }
    let first_ahead = approach.places_before();
    let mut walk = walker.set_off()?;
    let last = first_ahead + most_places.saturating_sub(1) as usize;
    for place in 0..=last {
        let Walk::Arrived {
            observations,
            glimpse,
            sighting,
        } = walk
        else {
            return Err(WalkError::Lost.into());
        };
        let seen = patterns.patterns(&observations);
        let has_seen = place > 0 || !seen.is_empty() || glimpse.is_some();
        for pattern in seen {
            localizer.observe(pattern)?;
        }
        localizer.end_in_sight(sighting.landmark, glimpse.as_ref());
        let belief = has_seen.then(|| localizer.location());
        found.under_way.push(belief);
        if place > 0 {
            found.walks.push(observations);
        }
        localizer.arrive(sighting, walker.bearings().as_ref());
        let here = localizer.location();
        found.at_places.push(here);
        see(walker);
        if place == last || place >= first_ahead && here.probability > SURE {
            break;
        }
        let turn = if place < first_ahead {
            Turn::BACK
        } else {
            onward(&localizer, sighting.degree, rng)
        };
        localizer.turn(turn)?;
        walk = walker.walk(turn.0 as usize, 0, None)?;
    }
    Ok(found)
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
