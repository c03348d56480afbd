//! Moves the tracks: "the core of the estimator is the loop between projection and matching".

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::{
    Action, ActiveFrame, Candidate, Choice, Contradiction, Culprit, GeometricIndexing, Hints,
    LinkId, LinkStatus, Matcher, ObservedMove, Observer, PlaceId, Predicted, Projection,
    Similarity, Situation, StepReport, Track, TrackEntry, TrackId, TrackReport, Use, WorldKind,
    choose, expected, moved, plies, search,
};

/// Whether a track may change the map. Only the best track may, so that a dying hypothesis does not
/// damage the map; in the paper all do.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Best,
    Other,
}

impl Observer {
    /// Projects a track, finds what it matches, and lets its best match change the map if it is the
    /// best track. Every maximal matcher continues the track.
    pub(super) fn advance(
        &mut self,
        track: &Track,
        rank: Rank,
        step: &ObservedMove,
        report: &mut StepReport,
        hints: &mut Hints,
        next: &mut Vec<(Track, TrackReport)>,
    ) {
        let projection = self.project(track, step);
        let choice = self.matches(track, step, &projection);
        let predicted = self.likeliest(track.place, step.action);
        if rank == Rank::Best {
            let contradictions = self.contradictions(track.id, &projection, &choice);
            report.contradictions.extend(contradictions);
            report.reordered = choice.reordered;
        }
        for (number, chosen) in choice.matches.iter().enumerate() {
            let landed = if rank == Rank::Best && number == 0 {
                let contradictions = &mut report.contradictions;
                Some(self.write(track, step, &projection, &choice, contradictions, hints))
            } else {
                let link = |place| self.map.paths.between(track.place, step.action, place);
                chosen.place().map(|place| (place, link(place)))
            };
            let Some((place, link)) = landed else {
                continue; // Only the best track may make places.
            };
            let mut child = track.clone();
            (child.place, child.link) = (place, link);
            child.confidence =
                confidence_after(track.confidence, chosen.matcher, &choice, self.rivals);
            if number > 0 {
                child.id = self.next_id();
            }
            child.astray = match chosen.matcher {
                Matcher::Continue => 0.0,
                _ => projection.astray,
            };
            let entry = TrackEntry {
                place,
                action: Some(step.action),
                doubts: choice.doubts.clone(),
                since: PointBox::ORIGIN,
            };
            let moved = trusted_odometry(step, &choice, chosen.matcher);
            child.remember(entry, moved, self.config.tracks.history);
            self.carry_active(&mut child, &projection);
            let line = child.report(track.place, Some(chosen.matcher), predicted);
            next.push((child, line));
        }
        let lost = choice.excluded.is_some() || choice.look == Similarity::Unlike;
        if rank == Rank::Best && lost {
            self.suppose(track, step, next);
        }
    }

    /// Returns the likeliest result of an action, or `None` if the map has no link for it.
    fn likeliest(&self, from: PlaceId, action: Action) -> Option<Predicted> {
        let best = self.map.paths.likeliest(from, action)?;
        let mut all = self.predict(from, action).into_iter();
        all.find(|one| one.place == self.map.link(best).to)
    }

    /// Returns the contradictions between a track's expectation and what it met.
    fn contradictions(
        &self,
        track: TrackId,
        projection: &Projection,
        choice: &Choice,
    ) -> impl Iterator<Item = Contradiction> {
        let from = projection.from;
        let contradiction = |to: PlaceId, culprit: fn(LinkId) -> Culprit, known: PointBox| {
            let link = self.map.paths.between(from, projection.action, to)?;
            Some(Contradiction {
                track,
                culprit: culprit(link),
                known,
                estimate: projection.displacement,
            })
        };
        let excluded = choice.excluded.and_then(|excluded| {
            let culprit = if excluded.is_possible() {
                Culprit::Look
            } else {
                Culprit::Link
            };
            let known = self.motion(from, excluded.place);
            let known = known.unwrap_or(PointBox::UNBOUNDED);
            contradiction(excluded.place, culprit, known)
        });
        let best = choice.matches.first().and_then(|best| best.candidate);
        let strange = best.filter(|_| choice.look == Similarity::Unlike);
        let strange = strange.and_then(|there| {
            let known = there.offset + projection.displacement;
            contradiction(there.place, Culprit::Look, known)
        });
        excluded.into_iter().chain(strange)
    }

    fn next_id(&mut self) -> TrackId {
        self.born += 1;
        TrackId(self.born - 1)
    }

    /// Adds tracks at all places that look like the robot's, however far away, since the robot is
    /// not at the expected place. "Good candidate places can be found based on perceptual cues,
    /// even if they are geometrically distant."
    fn suppose(
        &mut self,
        track: &Track,
        step: &ObservedMove,
        next: &mut Vec<(Track, TrackReport)>,
    ) {
        let Some(percept) = &step.percept else {
            return;
        };
        let views = &self.views;
        for place in views.most_alike(percept, &self.config, &self.map.paths) {
            let taken = next.iter().any(|(other, _)| other.place == place);
            if taken || next.len() >= self.config.tracks.cap {
                continue;
            }
            let id = self.next_id();
            let supposed = Track::begun(&self.map, id, place, SUPPOSED);
            let line = supposed.report(track.place, None, None);
            next.push((supposed, line));
        }
    }

    /// Indexes and matches candidates for one track, and returns the choice.
    fn matches(&self, track: &Track, step: &ObservedMove, projection: &Projection) -> Choice {
        let situation = Situation {
            map: &self.map,
            config: &self.config,
            percept: step.percept.as_ref(),
            exits: &step.exits,
            led: self.well_tried(track.place, step),
            astray: projection.astray,
            traversals: self.traversals(projection),
            confidence: track.confidence,
        };
        let expected = match self.config.indexing.expectational {
            Use::On => expected(&self.map, projection, &self.config),
            Use::Off => Vec::new(),
        };
        choose(&situation, &expected, || self.geometric(track, projection))
    }

    /// Returns the place of a static world to which a move leads, if the way was gone [`TRIED`]
    /// times and the exits are that place's. Other odometry is an outlier then, even if it fits
    /// another place.
    fn well_tried(&self, from: PlaceId, step: &ObservedMove) -> Option<PlaceId> {
        if self.config.world == WorldKind::Changing {
            return None;
        }
        let ways = self.map.paths.along(from, step.action);
        let (_, way) = ways.max_by_key(|(_, way)| way.traversed)?;
        let back = self.config.reverse(step.action);
        let back = back.and_then(|back| self.map.paths.between(way.to, back, from));
        let back = back.map_or(0, |back| self.map.link(back).traversed);
        let times = way.traversed.saturating_add(back);
        let exits = [&self.map.place(way.to).exits, &step.exits];
        (times >= TRIED && self.config.may_be_same(exits)).then_some(way.to)
    }

    fn geometric(&self, track: &Track, projection: &Projection) -> Vec<Vec<Candidate>> {
        let reached = match self.config.indexing.geometric {
            GeometricIndexing::Off => Vec::new(),
            GeometricIndexing::Search => {
                search(&self.map.reference, projection.frame, &self.config.search)
            }
            GeometricIndexing::ActiveFrames => {
                let before = projection.position - projection.displacement;
                let active = track.active.iter();
                active.map(|active| active.seen_from(before)).collect()
            }
        };
        plies(&self.map, &reached, projection)
    }

    /// Returns the number of times that the robot had gone the last way before.
    fn traversals(&self, projection: &Projection) -> u32 {
        let [from, to] = self.ends(projection);
        let grid = &self.map.frame(projection.frame).grid;
        grid.traversals(from, to, self.config.separation)
    }

    fn carry_active(&self, track: &mut Track, projection: &Projection) {
        if self.config.indexing.geometric == GeometricIndexing::ActiveFrames {
            let here = ActiveFrame::at(&self.map, track.place);
            let cap = self.config.search.frames;
            track.active = moved(&self.map, &track.active, projection.displacement, here, cap);
        }
    }

    /// Returns the surviving tracks, the best first. Of tracks at one place only the most trusted
    /// survives. Tracks below the minimum confidence or beyond the maximum number are dropped.
    pub(super) fn select(&mut self, mut tracks: Vec<Track>) -> Vec<Track> {
        // The best track stays the best until it has lost confidence and another has won it.
        let tracking = self.config.tracks;
        let Some(mut best) = tracks.first().map(|track| track.id) else {
            return tracks;
        };
        if tracks[0].confidence <= tracking.low {
            let confident = tracks
                .iter()
                .filter(|track| track.confidence >= tracking.high);
            let winner = confident.max_by(|a, b| {
                let confidence = a.confidence.total_cmp(&b.confidence);
                confidence.then(b.id.cmp(&a.id))
            });
            if let Some(winner) = winner {
                best = winner.id;
                let (loser, winner) = (tracks[0].clone(), winner.place);
                self.abandon(&loser, winner);
            }
        }
        tracks.sort_by(|a, b| {
            let first = (b.id == best).cmp(&(a.id == best));
            let confidence = b.confidence.total_cmp(&a.confidence);
            first.then(confidence).then(a.id.cmp(&b.id))
        });
        let mut kept: Vec<Track> = Vec::new();
        for track in tracks {
            let alive = kept.is_empty() || track.confidence >= tracking.least_confidence;
            let apart = kept.iter().all(|other| other.place != track.place);
            if alive && apart && kept.len() < tracking.cap {
                kept.push(track);
            }
        }
        kept
    }

    /// Moves tracks to the new place after a split, if they came along a link that now leads there.
    pub(super) fn take_sides(&mut self, kept: PlaceId, new: PlaceId) {
        for track in self.tracks.iter_mut().filter(|track| track.place == kept) {
            let came = track.link.map(|link| self.map.link(link));
            let moved = came.filter(|link| link.standing == LinkStatus::Removed);
            if let Some(link) = moved
                && let Some(id) = self.map.paths.between(link.from, link.action, new)
            {
                track.place = new;
                track.link = Some(id);
            }
        }
    }

    /// Gives tracks the new names of their places after a merge, split or elision.
    pub(super) fn rename_tracks(&mut self) {
        let best = self.tracks.first().map(|track| track.id);
        let mut seen: Vec<PlaceId> = Vec::new();
        self.tracks.retain_mut(|track| {
            if let Some(place) = self.map.paths.resolve(track.place) {
                track.place = place;
                track.link = track.link.filter(|link| self.map.link(*link).to == place);
            } else if Some(track.id) != best {
                return false;
            }
            let new = !seen.contains(&track.place);
            seen.push(track.place);
            new
        });
    }
}

/// Returns the odometry of a move, unbounded if there is a sign that it is wrong or that the robot
/// was carried off.
pub(super) fn trusted_odometry(step: &ObservedMove, choice: &Choice, matcher: Matcher) -> PointBox {
    let plain = matches!(
        matcher,
        Matcher::Continue | Matcher::Link | Matcher::NewPlace
    );
    if plain && choice.excluded.is_none() && choice.look == Similarity::Alike {
        step.odometry.position
    } else {
        PointBox::UNBOUNDED
    }
}

/// Number of times that a way of a static world is gone, to and fro, until it leads to one place.
const TRIED: u32 = 2;

/// Confidence of a track that begins because a place looks like the robot's view.
const SUPPOSED: f64 = 0.5;

/// Returns the confidence in a track after a match. A CONTINUE raises it; a posited error or a
/// strange look lowers it. A new place posits an error if another place was expected, or if another
/// track needs no new place.
fn confidence_after(confidence: f64, matcher: Matcher, choice: &Choice, rivals: bool) -> f64 {
    match matcher {
        _ if choice.look == Similarity::Unlike => 0.7 * confidence,
        Matcher::Continue => confidence + 0.2 * (1.0 - confidence),
        Matcher::NewPlace if choice.excluded.is_some() => 0.9 * confidence,
        Matcher::NewPlace if rivals => 0.7 * confidence,
        Matcher::Link | Matcher::NewPlace => confidence,
        Matcher::Alpha => 0.7 * confidence,
        Matcher::Beta => 0.5 * confidence,
    }
}
