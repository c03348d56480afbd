//! The updater: it "adjusts the parameters of states in the representation, for example, the position of a known point".

use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::{
    Action, Config, Diktiometry, Estim, Excluded, Exits, Expected, Link, LinkId, Place, PlaceId,
    Projection,
};

/// The track went from one place to another: the link between them is counted, and the boxes at both its ends are narrowed,
/// that of the place arrived at by the one it left (as in the paper) and back.
///
/// `robot` is where the robot was projected to be in the frame of the place arrived at.
///
/// # Errors
/// [`Excluded`] if the displacement contradicts what is known of the two frames; the boxes then stay as they were.
pub(super) fn arrive(
    map: &mut Diktiometry,
    projection: &Projection,
    to: PlaceId,
    robot: PointBox,
    config: &Config,
) -> (LinkId, Result<(), Excluded>) {
    let Projection { from, action, .. } = *projection;
    let link = map.paths.link_to(from, action, to);
    let blocked = &mut map.place_mut(from).blocked;
    blocked.retain(|blocked| *blocked != action);
    let taken = Taken {
        link,
        length: length(projection.displacement),
    };
    expect(map, from, action, Some(taken), config);
    let taken = map.link_mut(link);
    taken.traversed = taken.traversed.saturating_add(1);
    let place = map.place_mut(to);
    place.visits = place.visits.saturating_add(1);
    estimate(place, robot, config.separation);
    (link, narrow(map, from, to, projection.displacement))
}

/// An action led nowhere: no plan uses it until it leads somewhere again, and the links it should have gone along were expected
/// in vain.
pub(super) fn block(map: &mut Diktiometry, from: PlaceId, action: Action, config: &Config) {
    let blocked = &mut map.place_mut(from).blocked;
    if !blocked.contains(&action) {
        blocked.push(action);
    }
    expect(map, from, action, None, config);
}

/// Narrows what is known of two places by an estimate of the displacement between them.
fn narrow(
    map: &mut Diktiometry,
    from: PlaceId,
    to: PlaceId,
    displacement: PointBox,
) -> Result<(), Excluded> {
    let [(start, begins), (end, ends)] = [from, to].map(|place| map.site(place));
    let frames = begins + displacement - ends;
    map.reference.relate(start, end, frames)?;
    let end_from_start = map.reference.known(start, end).unwrap_or(frames);
    // Forward, as the paper does, and backward.
    contract(map.place_mut(to), begins + displacement - end_from_start);
    contract(map.place_mut(from), ends + end_from_start - displacement);
    Ok(())
}

fn contract(place: &mut Place, estimate: PointBox) {
    if let Some(both) = place.position.intersection(estimate) {
        place.position = both;
    }
}

/// Takes an estimate of a place's position into its nominal envelope and, if it is not too wide to tell one place from the next, its
/// estims: the middle of a wide box is no point where the place was seen.
fn estimate(place: &mut Place, robot: PointBox, separation: f64) {
    place.envelope = place.envelope.hull(robot);
    if robot.width() > separation {
        return;
    }
    place.estims.push(Estim {
        position: robot.middle(),
        weight: 1.0,
    });
    merge_estims(&mut place.estims, separation);
}

/// "All estims within δ_sep of each other are merged, with new positions gotten by weighted averaging, and new weights
/// the sum of the component's weights."
///
/// Averaging lets an estim swallow a mode exactly δ_sep away, so estims merge within half of it, the closest pair first, of
/// equal pairs the older.
pub(super) fn merge_estims(estims: &mut Vec<Estim>, separation: f64) {
    loop {
        let pairs =
            (0..estims.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
        let distance = |first: usize, second: usize| {
            let between = estims[first].position - estims[second].position;
            between.norm()
        };
        let near = pairs.map(|(first, second)| (distance(first, second), first, second));
        let near = near.filter(|(distance, ..)| *distance < 0.5 * separation);
        let Some((_, first, second)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return;
        };
        let b = estims.remove(second);
        let a = &mut estims[first];
        let weight = a.weight + b.weight;
        a.position =
            Point::from((a.position.coords * a.weight + b.position.coords * b.weight) / weight);
        a.weight = weight;
    }
}

/// The robot saw which actions could be tried at a place: links of all others were expected there in vain.
pub(super) fn see_exits(map: &mut Diktiometry, place: PlaceId, exits: &Exits, config: &Config) {
    if *exits == Exits::Unknown {
        return;
    }
    let links = map.paths.outgoing(place).map(|(_, link)| link.action);
    let mut shut: Vec<Action> = links.filter(|action| !exits.allow(*action)).collect();
    shut.sort_unstable();
    shut.dedup();
    for action in shut {
        expect(map, place, action, None, config);
    }
    // What is open leads where it always led, or, if it was shut, where it mostly led.
    let here = map.place(place);
    let outgoing = map.paths.outgoing(place);
    let open = outgoing.filter(|(_, link)| exits.allow(link.action));
    let told = open.filter(|(id, link)| {
        let alone = map.paths.along(place, link.action).count() == 1;
        let again = !here.exits.allow(link.action);
        alone || (again && map.paths.likeliest(place, link.action) == Some(*id))
    });
    let told: Vec<LinkId> = told.map(|(id, _)| id).collect();
    let now = map.paths.now;
    for id in told {
        map.link_mut(id).constancy.look(Expected::Met, now);
    }
    map.place_mut(place).exits = exits.clone();
}

/// The link along which an action led.
#[derive(Clone, Copy, Debug)]
struct Taken {
    link: LinkId,
    /// How far away it ended, m.
    length: f64,
}

/// Counts that the links of an action, and the places they lead to, were expected, and that one of them, if any, was met.
fn expect(
    map: &mut Diktiometry,
    from: PlaceId,
    action: Action,
    taken: Option<Taken>,
    config: &Config,
) {
    let (fading, now) = (config.transients.fading, map.paths.now);
    for id in map.place(from).outgoing.clone() {
        let Link {
            action: led, to, ..
        } = *map.link(id);
        if led != action {
            continue;
        }
        let is_met = taken.is_some_and(|taken| taken.link == id);
        let ends_there =
            |taken: Taken| !ends_before(map, from, to, taken.length, config.separation);
        let looked_for = is_met || taken.is_some_and(ends_there);
        let outcome = if is_met {
            Expected::Met
        } else {
            Expected::InVain
        };
        let link = map.link_mut(id);
        link.counts.expect(outcome, fading);
        link.constancy.look(outcome, now);
        let place = map.place_mut(to);
        place.counts.expect(outcome, fading);
        // Behind a shut door the place is still there, and so it is behind a new one.
        if looked_for {
            place.constancy.look(outcome, now);
        }
    }
}

/// Whether a way of this length from a place ends before another place: two places are δ_sep apart, so that it ends before it, and
/// not there, if it is shorter by more than half of that. By the middles of the boxes, along ways that do not turn.
fn ends_before(
    map: &Diktiometry,
    from: PlaceId,
    place: PlaceId,
    way: f64,
    separation: f64,
) -> bool {
    let there = map.related(from, place);
    there.is_some_and(|there| way + 0.5 * separation < length(there))
}

fn length(displacement: PointBox) -> f64 {
    displacement.middle().coords.norm()
}
