//! The restructurers: they integrate many observations, and repair what matching got wrong.

mod geometric;
mod merge;
mod transients;

use alloc::vec::Vec;

use super::config::Config;
use super::ids::PlaceId;
use super::map::Diktiometry;
use super::path_graph::Fate;
use super::report::Restructured;

/// What a restructurer says of a diagnosis.
///
/// "If a diagnosis of either monotopy or polytopy is proposed by at least one restructurer, and is not rejected by any, we
/// accept the diagnosis."
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Propose,
    Abstain,
    Reject,
}

/// Whether a diagnosis is accepted: proposed by one, rejected by none.
fn accepted(verdicts: &[Verdict]) -> bool {
    verdicts.contains(&Verdict::Propose) && !verdicts.contains(&Verdict::Reject)
}

/// Where something changed that may settle what was put off.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Hints {
    /// Places whose relations to their neighbours changed.
    pub(super) changed: Vec<PlaceId>,
    /// Places near enough that a change may narrow the box between them and another.
    pub(super) near: Vec<PlaceId>,
}

/// Restructures the map where the updater hints at, and where this in turn changes something: "it can be advantageous for
/// the updater to inform the restructuring module when it performs an update". Places that tracks are at (`occupied`) are
/// never elided.
pub(super) fn restructure(
    map: &mut Diktiometry,
    config: &Config,
    mut hints: Hints,
    occupied: &[PlaceId],
) -> Vec<Restructured> {
    let mut done = Vec::new();
    loop {
        let (hint, changed) = if let Some(hint) = hints.changed.pop() {
            (hint, true)
        } else if let Some(hint) = hints.near.pop() {
            (hint, false)
        } else {
            return done;
        };
        let Some(place) = map.paths.resolve(hint) else {
            continue;
        };
        let mut pairs = geometric::noted(map, place, config);
        if changed {
            done.extend(transients::elide(map, place, occupied, config));
            pairs.extend(geometric::neighbours(map, place));
        }
        for pair in pairs {
            let stands = |place: PlaceId| map.paths.places[place.index()].fate == Fate::Standing;
            if !stands(pair.a) || !stands(pair.b) || !accepted(&[geometric::merge(&pair, config)]) {
                continue;
            }
            if let Some(kept) = merge::merge(map, pair.a, pair.b, config) {
                let merged = if kept == pair.a { pair.b } else { pair.a };
                done.push(Restructured::Merged { kept, merged });
                hints.changed.push(kept);
            }
        }
    }
}
