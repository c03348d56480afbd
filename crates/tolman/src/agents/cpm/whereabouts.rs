use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_maps::cpm::{CpMap, LocalizeError, Localizer, LocalizerConfig, Location, Turn};

use super::body::Body;
use super::common_patterns::CommonPatterns;
use super::walker::{Observation, Walk, WalkError, Walker};

/// What a robot that was put down somewhere found out about where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// What it believed after its last observation before the first place it came to; none if it made none, as where it was put down at a
    /// place.
    pub under_way: Option<Location>,
    /// What it believed at each place it came to: the fragment it came by, and the port behind it.
    pub at_places: Vec<Location>,
    /// What it saw along each fragment it walked whole.
    pub walks: Vec<Vec<Observation>>,
}

/// How sure a robot is that knows where it is: it looks no further.
const SURE: f64 = 0.95;

/// Lets a robot that was put down anywhere, also in mid-fragment, find out on which of some maps it is, and where: it drives on "until the
/// first junction is found" and then, at random, along further fragments, until it is sure or has come to so many places (section 8,
/// "the start point is changed"). The paper's robot begins to observe at that junction; ours does at once. `see` is told of every place it comes to.
///
/// Where it is then, `at_places.last()` says: [`Location::ahead`] is the port behind it.
///
/// # Errors
/// [`WhereaboutsError`].
pub fn find_out<B: Body>(
    walker: &mut Walker<B>,
    maps: &[CpMap],
    patterns: &CommonPatterns,
    most_places: u32,
    rng: &mut impl Rng,
    mut see: impl FnMut(&Walker<B>),
) -> Result<Whereabouts, WhereaboutsError<B::Error>> {
    let mut localizer = Localizer::new(maps, patterns.dictionary(), LocalizerConfig::usual())?;
    let mut found = Whereabouts::default();
    let mut walk = walker.set_off()?;
    for place in 0..most_places {
        let Walk::Arrived {
            observations,
            sighting,
        } = walk
        else {
            return Err(WalkError::Lost.into());
        };
        for pattern in patterns.patterns(&observations) {
            localizer.observe(pattern)?;
        }
        if place == 0 {
            found.under_way = (!observations.is_empty()).then(|| localizer.location());
        } else {
            found.walks.push(observations);
        }
        localizer.arrive(sighting);
        let here = localizer.location();
        found.at_places.push(here);
        see(walker);
        if here.probability > SURE || place + 1 == most_places {
            break;
        }
        let turn = match sighting.degree {
            1 => Turn::BACK,
            degree => Turn(rng.random_range(1..degree)),
        };
        localizer.turn(turn)?;
        walk = walker.walk(turn.0 as usize, 0, None)?;
    }
    Ok(found)
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
