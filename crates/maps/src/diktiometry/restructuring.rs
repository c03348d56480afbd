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

/// Restructures the map around the places that the updater hints at, and around those that this changes.
pub(super) fn restructure(
    map: &mut Diktiometry,
    config: &Config,
    mut hints: Vec<PlaceId>,
    occupied: &[PlaceId],
) -> Vec<Restructured> {
    let mut done = Vec::new();
    while let Some(hint) = hints.pop() {
        let Some(place) = map.paths.resolve(hint) else {
            continue;
        };
        done.extend(transients::elide(map, place, occupied, config));
        for pair in geometric::pairs(map, place, config) {
            let stands = |place: PlaceId| map.paths.places[place.index()].fate == Fate::Standing;
            let geometry = geometric::merge(&pair, config);
            if !stands(pair.a) || !stands(pair.b) || !accepted(&[geometry]) {
                continue;
            }
            if let Some(kept) = merge::merge(map, pair.a, pair.b, config) {
                done.push(Restructured::Merged {
                    kept,
                    merged: if kept == pair.a { pair.b } else { pair.a },
                });
                hints.push(kept);
            }
        }
    }
    done
}
