use alloc::vec::Vec;

use tolman_geom::{Interval, PointBox};

use super::Diagnosis;
use crate::diktiometry::{Counts, Diktiometry, Estim, Link, LinkId, LinkStatus, PlaceId};

/// Splits a place in two; the new one is in the same frame.
///
/// By estims, "the two new places created by a split each take the sides of the original position
/// estimate indicated by their respective estims. Action link sets are pruned eventually by the
/// transient elision mechanism": both have all links. By links, each takes the incoming links of
/// its side and the links taken after them.
pub(super) fn split(map: &mut Diktiometry, place: PlaceId, diagnosis: &Diagnosis) -> PlaceId {
    let here = map.place(place).clone();
    let new = map.add_place(here.frame, here.position);
    let (incoming, outgoing) = match diagnosis {
        Diagnosis::Estims { stays, leaves } => {
            let [kept, left] = halves(here.envelope, stays, leaves);
            for (place, half, estim) in [(place, kept, stays), (new, left, leaves)] {
                let place = map.place_mut(place);
                place.position = half;
                place.envelope = half;
                place.estims = Vec::from([*estim]);
            }
            (here.incoming.clone(), here.outgoing.clone())
        }
        Diagnosis::Links { incoming } => {
            let after = incoming.iter().flat_map(|id| &map.link(*id).then);
            let mut outgoing: Vec<LinkId> = after.map(|one| one.link).collect();
            outgoing.sort_unstable();
            outgoing.dedup();
            map.place_mut(new).envelope = here.envelope;
            (incoming.clone(), outgoing)
        }
    };
    let moved = matches!(diagnosis, Diagnosis::Links { .. });
    let traversed = incoming.iter().map(|id| map.link(*id).traversed);
    let visits = traversed.fold(0, u32::saturating_add);
    let twin = map.place_mut(new);
    twin.views = here.views;
    twin.exits = here.exits;
    twin.blocked = here.blocked;
    twin.visits = visits.min(here.visits);
    for id in incoming {
        let link = map.link(id).clone();
        if link.from == place {
            continue; // A link from the place to itself stays with it.
        }
        let copied = copy(map, &link, link.from, new);
        if moved {
            let new = map.link_mut(copied);
            new.traversed = link.traversed;
            new.counts = link.counts;
            new.constancy = link.constancy;
            map.paths.remove_link(id);
        }
    }
    for id in outgoing {
        let link = map.link(id).clone();
        if link.to != place && link.standing == LinkStatus::Standing && link.from == place {
            copy(map, &link, new, link.to);
        }
    }
    new
}

/// Returns a link of the same action as another, with a count of one, since it is not proven yet.
fn copy(map: &mut Diktiometry, link: &Link, from: PlaceId, to: PlaceId) -> LinkId {
    let id = map.paths.link_to(from, link.action, to);
    let new = map.link_mut(id);
    if new.traversed == 0 {
        new.traversed = 1;
        new.counts = Counts::ONCE;
    }
    id
}

/// Cuts a box in two across the axis along which the estims lie farther apart.
fn halves(whole: PointBox, one: &Estim, other: &Estim) -> [PointBox; 2] {
    let way = other.position - one.position;
    let along_x = way.x.abs() >= way.y.abs();
    let cut = |side: Interval, a: f64, b: f64| {
        let middle = 0.5 * (a + b);
        let half = |low: f64, high: f64| Interval::new(low, high).unwrap_or(side);
        let parts = [half(side.low(), middle), half(middle, side.high())];
        if a <= b { parts } else { [parts[1], parts[0]] }
    };
    if along_x {
        cut(whole.x, one.position.x, other.position.x).map(|x| PointBox::new(x, whole.y))
    } else {
        cut(whole.y, one.position.y, other.position.y).map(|y| PointBox::new(whole.x, y))
    }
}
