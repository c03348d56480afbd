//! Non-local path constraints: "when two places have enough histories consistent with each other,
//! the histories are used to 'sew up' a portion of the path graph".

use super::Verdict;
use super::geometric::Pair;
use crate::diktiometry::{Config, Diktiometry, PlaceId, TrackEntry, Use};

/// Minimum number of moves of a history that counts as evidence.
const LEAST: usize = 3;

/// Leaves a copy of a track's history at the place it matched, if the history has any doubt and
/// paths alone may justify a merge. "When a track matches a place, it deposits copies of its
/// histories at the place".
pub(crate) fn deposit(
    map: &mut Diktiometry,
    place: PlaceId,
    history: &[TrackEntry],
    config: &Config,
) {
    let limits = &config.restructuring;
    let used = limits.non_local_merge == Use::On && limits.geometric_merge.trusts_paths();
    if !used || history.len() < LEAST || history.iter().all(|entry| entry.doubts.is_empty()) {
        return;
    }
    let histories = &mut map.place_mut(place).histories;
    histories.push(history.to_vec());
    let surplus = histories.len().saturating_sub(config.tracks.history);
    histories.drain(..surplus);
}

/// Returns whether enough histories that ended at one place could have ended at the other.
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    if config.restructuring.non_local_merge == Use::Off {
        return Verdict::Abstain;
    }
    let consistent = |here: PlaceId, there: PlaceId| {
        let histories = map.place(here).histories.iter();
        let long = histories.filter(|history| seam(map, history, there) >= LEAST);
        long.count()
    };
    let count = consistent(pair.a, pair.b) + consistent(pair.b, pair.a);
    let limits = &config.restructuring;
    Verdict::propose_if(limits.geometric_merge.trusts_paths() && count >= limits.histories)
}

/// Returns the number of places along a history at which the track could also have been, ending at
/// the other place with the same actions. Those places were considered but rejected. Counts from
/// the newest on, as far back as the map has the links.
fn seam(map: &Diktiometry, history: &[TrackEntry], other: PlaceId) -> usize {
    let mut pairs = 0;
    let mut there = other;
    for (number, entry) in history.iter().enumerate().rev() {
        // Where the two ways have met, nothing is left to be sewn up.
        let here = map.paths.resolve(entry.place);
        if here.is_none_or(|here| here == there) {
            break;
        }
        let doubts = entry.doubts.iter();
        let mut names = doubts.filter_map(|doubt| map.paths.resolve(*doubt));
        let only = names.next() == Some(there) && names.all(|doubt| doubt == there);
        if !only {
            break;
        }
        pairs += 1;
        let (Some(action), true) = (entry.action, number > 0) else {
            break;
        };
        let mut before = map.paths.incoming(there);
        let Some((_, link)) = before.find(|(_, link)| link.action == action) else {
            break;
        };
        there = link.from;
    }
    pairs
}
