//! The updater: it "adjusts the parameters of states in the representation, for example, the
//! position of a known point".

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use tolman_geom::{Point, PointBox};

use super::{
    Action, Estim, Excluded, Exits, Expected, FrameId, LinkId, Observer, Place, PlaceId,
    Projection, WorldKind,
};

impl Observer {
    /// Takes in that the track went from one place to another. Counts the link between them and
    /// returns it.
    ///
    /// `robot` is the robot's projected position in the frame of the place of arrival.
    pub(super) fn arrive(
        &mut self,
        projection: &Projection,
        to: PlaceId,
        robot: PointBox,
    ) -> LinkId {
        let Projection { from, action, .. } = *projection;
        let link = self.map.paths.link_to(from, action, to);
        let blocked = &mut self.map.place_mut(from).blocked;
        blocked.retain(|blocked| *blocked != action);
        self.expect(from, action, Some((link, projection.displacement)));
        let taken = self.map.link_mut(link);
        taken.traversed = taken.traversed.saturating_add(1);
        let place = self.map.place_mut(to);
        place.visits = place.visits.saturating_add(1);
        estimate(place, robot, self.config.separation);
        link
    }

    /// Takes in that an action led nowhere. No plan uses it until it leads somewhere again, and its
    /// links were expected in vain.
    pub(super) fn block(&mut self, from: PlaceId, action: Action) {
        let blocked = &mut self.map.place_mut(from).blocked;
        if !blocked.contains(&action) {
            blocked.push(action);
        }
        self.expect(from, action, None);
    }

    /// Narrows the bounds of two places by an estimate of the displacement between them. It narrows
    /// the second's box by the first's (as in the paper) and back.
    ///
    /// # Errors
    /// [`Excluded`] if it contradicts the known relation of the two frames; the boxes then stay as
    /// they were.
    pub(super) fn narrow(
        &mut self,
        from: PlaceId,
        to: PlaceId,
        displacement: PointBox,
    ) -> Result<(), Excluded> {
        let map = &self.map;
        let [(start, begins), (end, ends)] = [from, to].map(|place| map.site(place));
        let frames = begins + displacement - ends;
        self.relate(start, end, frames)?;
        let map = &mut self.map;
        let end_from_start = map.reference.known(start, end).unwrap_or(frames);
        // Forward, as the paper does, and backward.
        contract(map.place_mut(to), begins + displacement - end_from_start);
        contract(map.place_mut(from), ends + end_from_start - displacement);
        Ok(())
    }

    /// Takes in an estimate of the displacement between two frames.
    ///
    /// # Errors
    /// [`Excluded`] if it contradicts their known relation.
    pub(super) fn relate(
        &mut self,
        from: FrameId,
        to: FrameId,
        estimate: PointBox,
    ) -> Result<(), Excluded> {
        let reference = &mut self.map.reference;
        let allowed = reference.relate(from, to, estimate);
        // Where the world may change, the later estimate may be of another way.
        if allowed.is_err() && self.config.world == WorldKind::Static {
            reference.dispute(from, to, estimate);
        }
        allowed
    }

    /// Records which actions seem possible at a place. Links of all others were expected in vain.
    pub(super) fn see_exits(&mut self, place: PlaceId, exits: &Exits) {
        if *exits == Exits::Unknown {
            return;
        }
        let links = self.map.paths.outgoing(place).map(|(_, link)| link.action);
        let shut: BTreeSet<Action> = links.filter(|action| !exits.allow(*action)).collect();
        for action in shut {
            self.expect(place, action, None);
        }
        // What is open leads where it always led, or, if it was shut, where it mostly led.
        let paths = &self.map.paths;
        let here = self.map.place(place);
        let open = paths
            .outgoing(place)
            .filter(|(_, link)| exits.allow(link.action));
        let told = open.filter(|(id, link)| {
            let alone = paths.along(place, link.action).count() == 1;
            let again = !here.exits.allow(link.action);
            alone || (again && paths.likeliest(place, link.action) == Some(*id))
        });
        let told: Vec<LinkId> = told.map(|(id, _)| id).collect();
        let now = paths.now;
        for id in told {
            self.map.link_mut(id).constancy.look(Expected::Met, now);
        }
        self.map.place_mut(place).exits = exits.clone();
    }

    /// Counts that the links of an action, and the places at their ends, were expected. `taken` is
    /// the link that was met, with the displacement of the move.
    fn expect(&mut self, from: PlaceId, action: Action, taken: Option<(LinkId, PointBox)>) {
        let (fading, now) = (self.config.transients.fading, self.map.paths.now);
        let along = self.map.paths.along(from, action);
        let along: Vec<(LinkId, PlaceId)> = along.map(|(id, link)| (id, link.to)).collect();
        for (id, to) in along {
            let met = taken.is_some_and(|(link, _)| link == id);
            let looked_for = met || taken.is_some_and(|(_, way)| !self.ends_before(from, to, way));
            let outcome = if met { Expected::Met } else { Expected::InVain };
            let link = self.map.link_mut(id);
            link.counts.expect(outcome, fading);
            link.constancy.look(outcome, now);
            let place = self.map.place_mut(to);
            place.counts.expect(outcome, fading);
            // Behind a shut door the place is still there, and so it is behind a new one.
            if looked_for {
                place.constancy.look(outcome, now);
            }
        }
    }

    /// Returns whether a way from a place ends before another place. It does if it is shorter by
    /// more than half of δ_sep, as two places are δ_sep apart. Measured between the middles of the
    /// boxes, along straight ways.
    fn ends_before(&self, from: PlaceId, place: PlaceId, way: PointBox) -> bool {
        let length = |displacement: PointBox| displacement.middle().coords.norm();
        let there = self.map.related(from, place);
        there.is_some_and(|there| length(way) + 0.5 * self.config.separation < length(there))
    }
}

fn contract(place: &mut Place, estimate: PointBox) {
    if let Some(both) = place.position.intersection(estimate) {
        place.position = both;
    }
}

/// Adds an estimate of a place's position to its nominal envelope. It is added to the estims only
/// if it is narrow enough to tell neighbouring places apart. The middle of a wide box is not an
/// observation.
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

/// Merges estims. "All estims within δ_sep of each other are merged, with new positions gotten by
/// weighted averaging, and new weights the sum of the component's weights."
///
/// Averaging lets an estim swallow a mode exactly δ_sep away. Estims therefore merge within half of
/// it, the closest pair first, of equal pairs the older.
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
