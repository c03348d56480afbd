use tolman_geom::PointBox;

use crate::diktiometry::config::{Config, Identity, Use};
use crate::diktiometry::indexing::{Candidate, Expectation};
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::signature::Signature;

use super::view::agrees;

/// How a track came to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Matcher {
    /// "Matches a place that was expected with consistent position estimate and view."
    Continue,
    /// "Matches a place with consistent position estimate and view which was unexpected."
    Link,
    /// α-MATCH "matches a place such that the projected robot position is consistent with the place's nominal envelope".
    Alpha,
    /// "A new place is added with a track's projected state."
    NewPlace,
    /// β-MATCH "allows a match with a place near the track's projected position; the track is then 'snapped' to the place".
    Beta,
}

/// What matchers look at beside the candidate.
#[derive(Clone, Copy, Debug)]
pub(in crate::diktiometry) struct Situation<'a> {
    pub(in crate::diktiometry) map: &'a Diktiometry,
    pub(in crate::diktiometry) config: &'a Config,
    pub(in crate::diktiometry) percept: Option<&'a Signature>,
    /// Distance since the last CONTINUE, m.
    pub(in crate::diktiometry) astray: f64,
}

/// What a candidate turned out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diktiometry) enum Applicable {
    /// A matcher applies.
    Matcher(Matcher),
    /// None does, but the robot may be there: the box is too wide to tell.
    Doubtful,
    /// The robot is elsewhere.
    None,
}

/// What there is to say of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diktiometry) struct Finding {
    pub(in crate::diktiometry) applicable: Applicable,
    pub(in crate::diktiometry) look: Look,
    pub(in crate::diktiometry) certainty: Certainty,
}

/// Whether a place looks like what the robot sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::diktiometry) enum Look {
    /// It does, or nothing is known of its look.
    #[default]
    Known,
    /// It does not.
    Strange,
}

/// Whether the robot can be at no other place than the candidate: no other is near enough to it, or none that looks
/// like what the robot sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diktiometry) enum Certainty {
    /// It cannot.
    Certain,
    /// It may.
    Uncertain,
}

/// Holds a candidate against the matchers. Its views are compared with the percept once.
pub(in crate::diktiometry) fn find(candidate: &Candidate, situation: &Situation<'_>) -> Finding {
    let Situation { map, config, .. } = *situation;
    let place = &map.paths.places[candidate.place.index()];
    let (look, least_distance) = if agrees(place, situation.percept, &config.percepts) {
        (Look::Known, config.least_alike_distance())
    } else {
        (Look::Strange, config.least_distance())
    };
    let certainty = if candidate.is_certain(least_distance) {
        Certainty::Certain
    } else {
        Certainty::Uncertain
    };
    Finding {
        applicable: applicable(candidate, situation, look, certainty),
        look,
        certainty,
    }
}

/// The matcher that applies to a candidate.
///
/// The paper asks for a consistent view as well. Here an expected place where it is expected, and one that no other
/// can be near, may look new: its view set grows.
fn applicable(
    candidate: &Candidate,
    situation: &Situation<'_>,
    look: Look,
    certainty: Certainty,
) -> Applicable {
    let Situation { map, config, .. } = *situation;
    let place = &map.paths.places[candidate.place.index()];
    let continues =
        candidate.expectation == Expectation::Expected && config.matching.continuation == Use::On;
    let certain = certainty == Certainty::Certain;
    // What stands where nothing else can looks new, but is the same.
    let settled = config.matching.identity == Identity::Certain
        && ((continues && candidate.is_possible()) || certain);
    if look == Look::Strange && !settled {
        return Applicable::None;
    }
    if candidate.is_possible() {
        return match config.matching.identity {
            _ if continues => Applicable::Matcher(Matcher::Continue),
            _ if config.matching.link == Use::Off => Applicable::Doubtful,
            Identity::Meets => Applicable::Matcher(Matcher::Link),
            Identity::Certain if certain => Applicable::Matcher(Matcher::Link),
            Identity::Certain => Applicable::Doubtful,
        };
    }
    let grown = place.envelope.hull(place.position);
    if config.matching.alpha == Use::On && grown.meets(candidate.robot) {
        let expected = candidate.expectation == Expectation::Expected;
        let near = (grown - candidate.robot).norm().high() < config.least_distance();
        if config.matching.identity == Identity::Meets || expected || near {
            return Applicable::Matcher(Matcher::Alpha);
        }
    }
    let reach = config
        .separation
        .min(config.matching.beta_reach * situation.astray);
    if config.matching.beta == Use::On && gap(candidate.offset) <= reach {
        // Near it, but nowhere near another.
        let lone = candidate.offset.norm().high() < config.least_distance();
        if config.matching.identity == Identity::Meets || lone {
            return Applicable::Matcher(Matcher::Beta);
        }
    }
    Applicable::None
}

/// The least length of a displacement, m.
fn gap(offset: PointBox) -> f64 {
    offset.norm().low()
}
