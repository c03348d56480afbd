use alloc::vec::Vec;

use super::engine::Chosen;
use super::view::agrees;
use crate::diktiometry::{
    Candidate, Config, Diktiometry, Exits, Expectation, Identity, PlaceId, Signature, Similarity,
    Use, WorldKind,
};

/// Matcher by which a track came to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Matcher {
    /// "Matches a place that was expected with consistent position estimate and view."
    Continue,
    /// "Matches a place with consistent position estimate and view which was unexpected."
    Link,
    /// α-MATCH "matches a place such that the projected robot position is consistent with the
    /// place's nominal envelope".
    Alpha,
    /// "A new place is added with a track's projected state."
    NewPlace,
    /// β-MATCH "allows a match with a place near the track's projected position; the track is then
    /// 'snapped' to the place".
    Beta,
}

/// Input of the matchers beside the candidate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Situation<'a> {
    pub(crate) map: &'a Diktiometry,
    pub(crate) config: &'a Config,
    pub(crate) percept: Option<&'a Signature>,
    pub(crate) exits: &'a Exits,
    /// Place where the action led several times, in a static world. If odometry excludes it, no
    /// other is looked for.
    pub(crate) led: Option<PlaceId>,
    /// Distance since the last CONTINUE, m.
    pub(crate) astray: f64,
    /// Number of earlier traversals of the region just traversed.
    pub(crate) traversals: u32,
    /// The track's confidence.
    pub(crate) confidence: f64,
}

impl Situation<'_> {
    /// Returns whether the robot's place is one where it cannot be by its odometry. In a world
    /// where an action leads to one place, such odometry is an outlier.
    fn is_led_to(&self, candidate: &Candidate, look: Similarity) -> bool {
        candidate.expectation == Expectation::Expected
            && look == Similarity::Alike
            && self.config.world == WorldKind::Static
            && self.config.matching.identity == Identity::Certain
    }
}

/// Result of applying the matchers to a candidate.
enum Applicable {
    /// A matcher applies.
    Matcher(Matcher),
    /// No matcher applies, but the robot may be there: the box is too wide to decide.
    Doubtful,
    /// The robot is not at the candidate.
    None,
}

/// Returns the matcher that applies to a candidate. An undecided candidate goes to `doubts`. Its
/// views are compared with the percept once.
pub(super) fn find(
    candidate: &Candidate,
    situation: &Situation<'_>,
    doubts: &mut Vec<PlaceId>,
) -> Option<Chosen> {
    let config = situation.config;
    let place = situation.map.place(candidate.place);
    let look = Similarity::of(agrees(place, situation.percept, &config.percepts));
    let least_distance = config.least_distance_of(look, [&place.exits, situation.exits]);
    let is_certain = candidate.is_certain(config.apart, least_distance);
    match applicable(candidate, situation, look, is_certain) {
        Applicable::Matcher(matcher) => Some(Chosen {
            matcher,
            candidate: Some(*candidate),
            look,
            is_certain,
        }),
        Applicable::Doubtful => {
            doubts.push(candidate.place);
            None
        }
        Applicable::None => None,
    }
}

/// Returns the matcher that applies to a candidate.
///
/// The paper asks for a consistent view as well. Here two kinds of places may look new, and their
/// view set grows. One is an expected place at its expected position, the other a place without
/// others near.
fn applicable(
    candidate: &Candidate,
    situation: &Situation<'_>,
    look: Similarity,
    is_certain: bool,
) -> Applicable {
    let Situation { map, config, .. } = *situation;
    let place = map.place(candidate.place);
    let continues =
        candidate.expectation == Expectation::Expected && config.matching.continuation == Use::On;
    // What stands where nothing else can looks new, but is the same.
    let settled = config.matching.identity == Identity::Certain
        && ((continues && candidate.is_possible()) || is_certain);
    if look == Similarity::Unlike && !settled {
        return Applicable::None;
    }
    if candidate.is_possible() {
        return match config.matching.identity {
            _ if continues => Applicable::Matcher(Matcher::Continue),
            _ if config.matching.link == Use::Off => Applicable::Doubtful,
            Identity::Meets => Applicable::Matcher(Matcher::Link),
            Identity::Certain if is_certain => Applicable::Matcher(Matcher::Link),
            Identity::Certain => Applicable::Doubtful,
        };
    }
    let grown = place.envelope.hull(place.position);
    if config.matching.alpha == Use::On && grown.meets(candidate.robot) {
        let expected = candidate.expectation == Expectation::Expected;
        let near = config.apart.most(grown - candidate.robot) < config.least_distance();
        if config.matching.identity == Identity::Meets || expected || near {
            return Applicable::Matcher(Matcher::Alpha);
        }
    }
    if config.matching.beta == Use::On && situation.is_led_to(candidate, look) {
        return Applicable::Matcher(Matcher::Beta);
    }
    let reach = config.matching.beta_reach * situation.astray;
    let near = candidate.offset.norm().low() <= config.separation.min(reach);
    if config.matching.beta == Use::On && near {
        // Near it, but nowhere near another.
        let lone = config.apart.most(candidate.offset) < config.least_distance();
        if config.matching.identity == Identity::Meets || lone {
            return Applicable::Matcher(Matcher::Beta);
        }
    }
    Applicable::None
}
