use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::geometric::Pair;
use crate::diktiometry::{
    Config, Diktiometry, Exits, Fate, Link, LinkId, Percepts, PlaceId, Relation, Successor,
    merge_estims,
};

/// Merges two places into the older one. Returns `None`, with nothing changed, if the relations of
/// their frames forbid it. If the two exclude each other by their bounds, it drops the relations of
/// the younger that forbid it.
///
/// O(relations and links of the younger · log degree of the older).
pub(super) fn merge(map: &mut Diktiometry, pair: &Pair, config: &Config) -> Option<PlaceId> {
    let (kept, lost) = (pair.a.min(pair.b), pair.a.max(pair.b));
    let bounds = if pair.offset.contains(Point::origin()) {
        Bounds::Hold
    } else {
        Bounds::Broken
    };
    let shift = join_frames(map, kept, lost, bounds)?;
    move_links(map, kept, lost);
    let gone = map.paths.bury(lost, Fate::MergedInto(kept));
    let place = map.place_mut(kept);
    place.envelope = place.envelope.hull(gone.envelope + shift);
    let middle = shift.middle();
    let estims = gone.estims.iter().map(|estim| estim.shifted(middle));
    place.estims.extend(estims);
    merge_estims(&mut place.estims, config.separation);
    if let Percepts::Signatures(kind) = config.percepts {
        let room = kind.views.saturating_sub(place.views.len());
        place.views.extend(gone.views.into_iter().take(room));
    }
    place.visits = place.visits.saturating_add(gone.visits);
    place.counts.join(gone.counts);
    place.constancy.join(gone.constancy);
    // The younger place was made later: mostly it was seen later, too.
    if gone.exits != Exits::Unknown {
        place.exits = gone.exits;
    }
    for action in gone.blocked {
        if !place.blocked.contains(&action) {
            place.blocked.push(action);
        }
    }
    place.histories.extend(gone.histories);
    let left = place.histories.len().saturating_sub(config.tracks.history);
    place.histories.drain(..left);
    place.notes.extend(gone.notes);
    let mut seen = Vec::from([kept, lost]);
    place.notes.retain(|note| {
        let new = !seen.contains(&note.other);
        seen.push(note.other);
        new
    });
    Some(kept)
}

/// Whether a bound of the relations of two places was broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bounds {
    Hold,
    Broken,
}

/// Puts both places at one point and transfers the relations of one's frame to the other's. Returns
/// the position of the abandoned frame in that of `kept`. `None`, with nothing done, if that
/// contradicts a relation, unless a bound was broken.
fn join_frames(
    map: &mut Diktiometry,
    kept: PlaceId,
    lost: PlaceId,
    bounds: Bounds,
) -> Option<PointBox> {
    let [(home, there), (left, here)] = [kept, lost].map(|place| map.site(place));
    let shift = if home == left {
        PointBox::ORIGIN
    } else {
        there - here
    };
    let both = there.intersection(here + shift)?;
    let empties = home != left && map.frame(left).places.len() == 1;
    let may_drop = empties && bounds == Bounds::Broken;
    if !may_drop {
        map.reference.allows(home, left, shift).ok()?;
    }
    let relations: Vec<Relation> = map.reference.relations(left).collect();
    let moved = relations.iter().map(|one| (one.to, shift + one.position));
    let allows = |(to, estimate)| map.reference.allows(home, to, estimate).is_ok();
    if empties && !may_drop && !moved.clone().all(allows) {
        return None;
    }
    map.frame_mut(left).places.retain(|place| *place != lost);
    if empties {
        map.reference.clear(left);
        for (to, estimate) in moved.filter(|(to, _)| *to != home) {
            if map.reference.allows(home, to, estimate).is_ok() {
                let _ = map.reference.relate(home, to, estimate);
            }
        }
    } else if home != left {
        let _ = map.reference.relate(home, left, shift);
    }
    let place = map.place_mut(kept);
    place.position = both;
    place.envelope = place.envelope.hull(both);
    Some(shift)
}

/// Moves the ends of the links of `lost` to `kept`. Links that become equal add their counts.
fn move_links(map: &mut Diktiometry, kept: PlaceId, lost: PlaceId) {
    let mut renamed: Vec<(LinkId, LinkId)> = Vec::new();
    let mut ids = map.place(lost).links();
    ids.sort_unstable();
    ids.dedup();
    for id in ids {
        let link = map.link_mut(id);
        let [from, to] = [link.from, link.to].map(|end| if end == lost { kept } else { end });
        [link.from, link.to] = [from, to];
        let link = link.clone();
        let is_same =
            |(other, way): (LinkId, &Link)| (other != id && way.to == to).then_some(other);
        let same = map.paths.along(from, link.action).find_map(is_same);
        if let Some(same) = same {
            map.paths.remove_link(id);
            let kept = map.link_mut(same);
            kept.traversed = kept.traversed.saturating_add(link.traversed);
            kept.counts.join(link.counts);
            kept.constancy.join(link.constancy);
            for next in link.then {
                kept.follow(next);
            }
            renamed.push((id, same));
        } else {
            insert(&mut map.place_mut(from).outgoing, id);
            insert(&mut map.place_mut(to).incoming, id);
        }
    }
    for (old, new) in renamed {
        rename(map, old, new);
    }
}

fn insert(list: &mut Vec<LinkId>, id: LinkId) {
    if let Err(at) = list.binary_search(&id) {
        list.insert(at, id);
    }
}

/// Renames a link where it is listed as a successor of other links.
fn rename(map: &mut Diktiometry, old: LinkId, new: LinkId) {
    let tail = map.link(new).from;
    for before in map.place(tail).incoming.clone() {
        let before = map.link_mut(before);
        if let Some(found) = before.then.iter().position(|one| one.link == old) {
            let count = before.then.remove(found).count;
            before.follow(Successor { link: new, count });
        }
    }
}
