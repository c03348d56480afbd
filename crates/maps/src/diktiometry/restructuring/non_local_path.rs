//! Non-local path constraints: "when two places have enough histories consistent with each other, the histories are used to
//! 'sew up' a portion of the path graph".

use alloc::vec::Vec;

use super::Verdict;
use super::geometric::Pair;
use crate::diktiometry::config::{Config, Use};
use crate::diktiometry::ids::PlaceId;
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::track::Match;

/// A history that tells of fewer moves in a row says nothing.
const LEAST: usize = 3;

/// Leaves a copy of a track's history at the place it matched, if there was ever a doubt in it: "when a track matches a place,
/// it deposits copies of its histories at the place".
pub(in crate::diktiometry) fn deposit(
    map: &mut Diktiometry,
    place: PlaceId,
    history: &[Match],
    config: &Config,
) {
    let used = config.restructuring.non_local_merge == Use::On;
    if !used || history.len() < LEAST || history.iter().all(|entry| entry.doubts.is_empty()) {
        return;
    }
    let histories = &mut map.paths.places[place.index()].histories;
    histories.push(history.to_vec());
    let surplus = histories.len().saturating_sub(config.tracks.history);
    histories.drain(..surplus);
}

/// Whether enough histories that ended at one place could have ended at the other.
pub(super) fn merge(map: &Diktiometry, pair: &Pair, config: &Config) -> Verdict {
    if config.restructuring.non_local_merge == Use::Off {
        return Verdict::Abstain;
    }
    let consistent = |here: PlaceId, there: PlaceId| {
        let histories = &map.paths.places[here.index()].histories;
        let all = histories.iter();
        all.filter(|history| seam(map, history, there).len() >= LEAST)
            .count()
    };
    let count = consistent(pair.a, pair.b) + consistent(pair.b, pair.a);
    if count >= config.restructuring.histories {
        Verdict::Propose
    } else {
        Verdict::Abstain
    }
}

/// The pairs of places along a history that ended at the one and, with the same actions, could have ended at the other
/// place: matched, and considered but rejected. The newest first; as far back as the map has the links.
pub(super) fn seam(
    map: &Diktiometry,
    history: &[Match],
    other: PlaceId,
) -> Vec<(PlaceId, PlaceId)> {
    let mut pairs = Vec::new();
    let mut there = other;
    for (number, entry) in history.iter().enumerate().rev() {
        let Some(here) = map.paths.resolve(entry.place) else {
            break;
        };
        if here == there {
            break; // The two ways have met: nothing is left to be sewn up.
        }
        let doubts = entry.doubts.iter();
        let mut names = doubts.filter_map(|doubt| map.paths.resolve(*doubt));
        let only = names.next() == Some(there) && names.all(|doubt| doubt == there);
        if !only {
            break;
        }
        pairs.push((here, there));
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
