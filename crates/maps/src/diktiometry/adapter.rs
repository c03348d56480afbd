//! The adapter: it changes the map by what the best track matched.

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::estimator::trusted_odometry;
use super::ids::{LinkId, PlaceId};
use super::map::Site;
use super::matching::{Choice, Look, Matcher, remember};
use super::observation::Move;
use super::observer::Observer;
use super::path_graph::{Fate, Ground, Successor};
use super::projector::{Projection, between_places};
use super::report::{Contradiction, Culprit};
use super::restructuring::{Hints, elide_place};
use super::track::Track;
use super::updater::{arrive, see_exits};

/// How many of the places met before the last are related to a new one directly: two moves back, three, …
const SPAN: usize = 4;

impl Observer {
    /// The updater: the best track's best match changes the map.
    pub(super) fn write(
        &mut self,
        track: &Track,
        step: &Move,
        projection: &Projection,
        choice: &Choice,
        contradictions: &mut Vec<Contradiction>,
        hints: &mut Hints,
    ) -> (PlaceId, Option<LinkId>) {
        let from = track.place;
        let best = choice.matches[0];
        let (to, robot) = match best.candidate {
            Some(candidate) => (candidate.place, candidate.robot),
            None => self.make_place(projection),
        };
        if best.matcher == Matcher::Alpha {
            let frames = [from, to].map(|place| self.map.paths.places[place.index()].frame);
            self.map.reference.open(frames[0], frames[1]);
            let place = &mut self.map.paths.places[to.index()];
            place.position = place.position.hull(place.envelope).hull(robot);
            place.envelope = place.envelope.hull(robot);
        }
        self.traverse(from, projection);
        let (link, narrowed) = arrive(
            &mut self.map,
            from,
            step.action,
            to,
            projection,
            robot,
            &self.config,
        );
        if let Err(excluded) = narrowed {
            contradictions.push(Contradiction {
                track: track.id,
                culprit: Culprit::Relation { from, to },
                known: excluded.known,
                estimate: excluded.estimate,
            });
        }
        if let Some(before) = track.link {
            self.follow(before, link);
        }
        self.relate_lately(track, to, trusted_odometry(step, choice, best.matcher));
        // What looks like another place is no new view of this one: the robot may be there.
        let looks_elsewhere = match (choice.look, &step.percept) {
            (Look::Strange, Some(view)) => {
                let alike = self.views.alike(view, &self.config, &self.map.paths);
                !alike.is_empty()
            }
            _ => false,
        };
        if let (None, Some(view)) = (best.candidate, &step.percept) {
            self.learn_looks(to, view, hints);
        }
        let place = &mut self.map.paths.places[to.index()];
        let new_view =
            !looks_elsewhere && remember(place, step.percept.as_ref(), &self.config.percepts);
        if let (true, Some(view)) = (new_view, &step.percept) {
            self.views.insert(to, view, &self.config);
        }
        see_exits(&mut self.map, to, &step.exits, &self.config);
        let pairs = choice.doubts.iter().chain(&choice.twins);
        for &other in pairs.filter(|&&other| other != to) {
            self.map.paths.note(to, other, Ground::Position);
        }
        hints
            .near
            .extend(track.history.iter().map(|entry| entry.place));
        hints.changed.push(to);
        (to, Some(link))
    }

    /// Relates the places met lately to the one just met by the way between them. Where in a place the robot stopped matters at the
    /// ends of a way alone, while relations from each place to the next count it at both ends of every move; so nothing
    /// is to be won where robots stop at a point.
    fn relate_lately(&mut self, track: &Track, to: PlaceId, moved: PointBox) {
        if self.config.place_radius <= 0.0 {
            return;
        }
        let earlier = track.history.iter().rev().skip(1).take(SPAN);
        for entry in earlier {
            let way = between_places(entry.since + moved, &self.config);
            let Some(from) = self
                .map
                .paths
                .resolve(entry.place)
                .filter(|from| *from != to)
            else {
                continue;
            };
            if way.is_bounded() {
                let [start, end] = [from, to].map(|place| {
                    let place = &self.map.paths.places[place.index()];
                    (place.frame, place.position)
                });
                // A way that contradicts the relations was told of as a move already.
                let estimate = start.1 + way - end.1;
                if self.map.reference.allows(start.0, end.0, estimate).is_ok() {
                    let _ = self.map.reference.relate(start.0, end.0, estimate);
                }
            }
        }
    }

    /// A place where the track is projected to be, in the frame it came from or in one of its own.
    fn make_place(&mut self, projection: &Projection) -> (PlaceId, PointBox) {
        if projection.position.width() <= 2.0 * self.config.frame_half_width {
            let position = projection.position;
            let frame = projection.frame;
            let place = self.map.new_place(Site::InFrame { frame, position });
            return (place, position);
        }
        (self.map.new_place(Site::OwnFrame), PointBox::ORIGIN)
    }

    fn traverse(&mut self, from: PlaceId, projection: &Projection) {
        let place = &self.map.paths.places[from.index()];
        let [start, end] = [place.position, projection.position].map(PointBox::middle);
        let grid = &mut self.map.reference.frames[place.frame.index()].grid;
        grid.traverse(start, end, self.config.separation);
    }

    /// Counts that one link was taken after another.
    fn follow(&mut self, before: LinkId, link: LinkId) {
        let then = &mut self.map.paths.links[before.index()].then;
        match then.iter_mut().find(|successor| successor.link == link) {
            Some(successor) => successor.count = successor.count.saturating_add(1),
            None => then.push(Successor { link, count: 1 }),
        }
    }

    /// A track gives way to another: the places that it alone made, and that nobody has met since, are taken out of the map.
    pub(super) fn abandon(&mut self, loser: &Track, winner: PlaceId) {
        let made: Vec<PlaceId> = loser
            .history
            .iter()
            .rev()
            .map(|entry| entry.place)
            .take_while(|&place| {
                let place_there = &self.map.paths.places[place.index()];
                let alone = place_there.visits <= 1 && place_there.fate == Fate::Standing;
                alone && place != winner
            })
            .collect();
        for place in made {
            elide_place(&mut self.map, place);
        }
    }
}
