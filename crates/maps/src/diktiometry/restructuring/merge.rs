use alloc::vec::Vec;

use tolman_geom::PointBox;

use crate::diktiometry::config::{Config, Percepts};
use crate::diktiometry::ids::{LinkId, PlaceId};
use crate::diktiometry::map::Diktiometry;
use crate::diktiometry::observation::Exits;
use crate::diktiometry::path_graph::{Estim, Fate, Note, PathGraph, Standing, Successor};
use crate::diktiometry::updater::merge_estims;

/// Makes one place of two, the older; none, and nothing done, if what is known of their frames forbids it.
///
/// O(relations and links of the younger · log degree of the older).
pub(super) fn merge(
    map: &mut Diktiometry,
    a: PlaceId,
    b: PlaceId,
    config: &Config,
) -> Option<PlaceId> {
    let (kept, lost) = (a.min(b), a.max(b));
    let shift = join_frames(map, kept, lost)?;
    move_links(&mut map.paths, kept, lost);
    let gone = map.paths.bury(lost, Fate::MergedInto(kept));
    let place = &mut map.paths.places[kept.index()];
    place.envelope = place.envelope.hull(gone.envelope + shift);
    let middle = shift.middle();
    place.estims.extend(gone.estims.iter().map(|estim| Estim {
        position: estim.position + middle.coords,
        weight: estim.weight,
    }));
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
    let own = |note: &Note| note.other == kept || note.other == lost;
    place.notes.extend(gone.notes);
    place.notes.retain(|note| !own(note));
    let mut seen: Vec<PlaceId> = Vec::new();
    place.notes.retain(|note| {
        let new = !seen.contains(&note.other);
        seen.push(note.other);
        new
    });
    Some(kept)
}

/// Puts both places at one point, and brings what is known of the one's frame to the other's. Where the frame that was left
/// lies in that of `kept`; none, and nothing done, if that contradicts a relation.
fn join_frames(map: &mut Diktiometry, kept: PlaceId, lost: PlaceId) -> Option<PointBox> {
    let [(home, there), (left, here)] = [kept, lost].map(|place| {
        let place = &map.paths.places[place.index()];
        (place.frame, place.position)
    });
    let shift = if home == left {
        PointBox::ORIGIN
    } else {
        there - here
    };
    let both = there.intersection(here + shift)?;
    let empties = home != left && map.reference.frames[left.index()].places.len() == 1;
    let relations = map.reference.frames[left.index()].relations.clone();
    map.reference.allows(home, left, shift).ok()?;
    let mut moved = relations.iter().filter(|_| empties);
    let allowed = moved.all(|relation| {
        let estimate = shift + relation.position;
        map.reference.allows(home, relation.to, estimate).is_ok()
    });
    if !allowed {
        return None;
    }
    map.reference.frames[left.index()]
        .places
        .retain(|place| *place != lost);
    if empties {
        map.reference.clear(left);
        for relation in relations.iter().filter(|relation| relation.to != home) {
            // It was allowed just now.
            let _ = map
                .reference
                .relate(home, relation.to, shift + relation.position);
        }
    } else if home != left {
        let _ = map.reference.relate(home, left, shift);
    }
    let place = &mut map.paths.places[kept.index()];
    place.position = both;
    place.envelope = place.envelope.hull(both);
    Some(shift)
}

/// Lets the links of `lost` begin and end at `kept`; what becomes the same link is counted together.
fn move_links(paths: &mut PathGraph, kept: PlaceId, lost: PlaceId) {
    let outgoing = core::mem::take(&mut paths.places[lost.index()].outgoing);
    let incoming = core::mem::take(&mut paths.places[lost.index()].incoming);
    let mut renamed: Vec<(LinkId, LinkId)> = Vec::new();
    let mut ids: Vec<LinkId> = outgoing.iter().chain(&incoming).copied().collect();
    ids.sort_unstable();
    ids.dedup();
    for id in ids {
        let link = &mut paths.links[id.index()];
        let (from, to) = (link.from, link.to);
        let ends = [from, to].map(|end| if end == lost { kept } else { end });
        [link.from, link.to] = ends;
        let action = link.action;
        let same = paths
            .along(ends[0], action)
            .find(|(other, link)| *other != id && link.to == ends[1])
            .map(|(other, _)| other);
        match same {
            None => {
                insert(&mut paths.places[ends[0].index()].outgoing, id);
                insert(&mut paths.places[ends[1].index()].incoming, id);
            }
            Some(other) => {
                let link = &mut paths.links[id.index()];
                link.standing = Standing::Removed;
                let then = core::mem::take(&mut link.then);
                let (traversed, counts, constancy) = (link.traversed, link.counts, link.constancy);
                for (end, list) in [(ends[0], End::Tail), (ends[1], End::Head)] {
                    let place = &mut paths.places[end.index()];
                    let list = match list {
                        End::Tail => &mut place.outgoing,
                        End::Head => &mut place.incoming,
                    };
                    list.retain(|one| *one != id);
                }
                let link = &mut paths.links[other.index()];
                link.traversed = link.traversed.saturating_add(traversed);
                link.counts.join(counts);
                link.constancy.join(constancy);
                for successor in then {
                    match link.then.iter_mut().find(|one| one.link == successor.link) {
                        Some(one) => one.count = one.count.saturating_add(successor.count),
                        None => link.then.push(successor),
                    }
                }
                renamed.push((id, other));
            }
        }
    }
    rename(paths, &renamed);
}

enum End {
    Tail,
    Head,
}

fn insert(list: &mut Vec<LinkId>, id: LinkId) {
    if let Err(at) = list.binary_search(&id) {
        list.insert(at, id);
    }
}

/// Calls links by their new names where they follow other links.
fn rename(paths: &mut PathGraph, renamed: &[(LinkId, LinkId)]) {
    for &(old, new) in renamed {
        let tail = paths.links[new.index()].from;
        for at in 0..paths.places[tail.index()].incoming.len() {
            let before = paths.places[tail.index()].incoming[at];
            let then = &mut paths.links[before.index()].then;
            let Some(found) = then.iter().position(|one| one.link == old) else {
                continue;
            };
            let count = then.remove(found).count;
            match then.iter_mut().find(|one| one.link == new) {
                Some(one) => one.count = one.count.saturating_add(count),
                None => then.push(Successor { link: new, count }),
            }
        }
    }
}
