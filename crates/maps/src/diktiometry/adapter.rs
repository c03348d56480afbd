//! Changes the map by the best match of the best track.

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::{
    Choice, Contradiction, Culprit, Fate, Ground, Hints, LinkId, Matcher, ObservedMove, Observer,
    PlaceId, Projection, Similarity, Successor, Track, WorldKind, elide_place, remember,
    trusted_odometry,
};

/// Number of earlier places, before the last, that are related directly to a new one.
const SPAN: usize = 4;

impl Observer {
    /// Updates the map by the best match of the best track. Returns the place where the robot now
    /// is, and the link that it took.
    pub(super) fn write(
        &mut self,
        track: &Track,
        step: &ObservedMove,
        projection: &Projection,
        choice: &Choice,
        contradictions: &mut Vec<Contradiction>,
        hints: &mut Hints,
    ) -> (PlaceId, Option<LinkId>) {
        let from = track.place;
        let best = choice.matches[0];
        let (to, robot) = match best.candidate {
            // "The track is then 'snapped' to the place."
            Some(candidate) if best.matcher == Matcher::Beta => {
                (candidate.place, self.map.place(candidate.place).position)
            }
            Some(candidate) => (candidate.place, candidate.robot),
            None => self.make_place(projection),
        };
        if best.matcher == Matcher::Alpha {
            let frames = [from, to].map(|place| self.map.place(place).frame);
            self.map.reference.open(frames[0], frames[1]);
            let place = self.map.place_mut(to);
            place.position = place.position.hull(place.envelope).hull(robot);
            place.envelope = place.envelope.hull(robot);
        }
        self.traverse(projection);
        let link = self.arrive(projection, to, robot);
        if let Err(excluded) = self.narrow(from, to, projection.displacement) {
            contradictions.push(Contradiction {
                track: track.id,
                culprit: Culprit::Relation { from, to },
                known: excluded.known,
                estimate: excluded.estimate,
            });
        }
        if let Some(before) = track.link {
            let next = Successor { link, count: 1 };
            self.map.link_mut(before).follow(next);
        }
        self.relate_lately(track, to, trusted_odometry(step, choice, best.matcher));
        // What looks like another place is not a new view of this one: the robot may be there.
        let alike = |view| self.views.alike(view, &self.config, &self.map.paths);
        let looks_elsewhere = |view| choice.look == Similarity::Unlike && !alike(view).is_empty();
        if let Some(view) = &step.percept {
            let is_new_view = !looks_elsewhere(view);
            if best.candidate.is_none() {
                self.learn_looks(to, view, hints);
            }
            let place = self.map.place_mut(to);
            if is_new_view && remember(place, Some(view), &self.config.percepts) {
                self.views.insert(to, view, &self.config);
            }
        }
        self.see_exits(to, &step.exits);
        let pairs = choice.doubts.iter().chain(&choice.twins);
        for &other in pairs.filter(|&&other| other != to) {
            self.map.paths.note(to, other, Ground::Position);
        }
        let met = track.history.iter().map(|entry| entry.place);
        hints.near.extend(met);
        hints.changed.push(to);
        (to, Some(link))
    }

    /// Relates the recent places to the present one by the way between them.
    ///
    /// The robot's stopping point within a place matters only at the two ends of such a way. A
    /// chain of relations counts it at both ends of every move. With a place radius of 0 there is
    /// nothing to gain, so nothing is done.
    fn relate_lately(&mut self, track: &Track, to: PlaceId, moved: PointBox) {
        if self.config.place_radius <= 0.0 {
            return;
        }
        let earlier = track.history.iter().rev().skip(1).take(SPAN);
        for entry in earlier {
            let way = self.config.between_places(entry.since + moved);
            let from = self.map.paths.resolve(entry.place);
            let Some(from) = from.filter(|from| *from != to && way.is_bounded()) else {
                continue;
            };
            let [(start, begins), (end, ends)] = [from, to].map(|place| self.map.site(place));
            let estimate = begins + way - ends;
            // A way that contradicts the relations was told of as a move already.
            let is_allowed = self.map.reference.allows(start, end, estimate).is_ok();
            if is_allowed || self.config.world == WorldKind::Static {
                let _ = self.relate(start, end, estimate);
            }
        }
    }

    /// Adds a place where the track is projected to be, in the current frame or in a new one.
    /// Returns it with the robot's position in its frame.
    fn make_place(&mut self, projection: &Projection) -> (PlaceId, PointBox) {
        let position = projection.position;
        if position.width() <= 2.0 * self.config.frame_half_width {
            return (self.map.add_place(projection.frame, position), position);
        }
        (self.map.found_place(), PointBox::ORIGIN)
    }

    fn traverse(&mut self, projection: &Projection) {
        let [start, end] = self.ends(projection);
        let grid = &mut self.map.frame_mut(projection.frame).grid;
        grid.traverse(start, end, self.config.separation);
    }

    /// Drops a track in favour of another. Removes the places that only it made and that were not
    /// met since.
    pub(super) fn abandon(&mut self, loser: &Track, winner: PlaceId) {
        let lately = loser.history.iter().rev().map(|entry| entry.place);
        let made = lately.take_while(|&place| {
            let there = self.map.place(place);
            there.visits <= 1 && there.fate == Fate::Standing && place != winner
        });
        for place in made.collect::<Vec<PlaceId>>() {
            elide_place(&mut self.map, place);
        }
    }
}
