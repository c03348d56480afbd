//! The estimator: "the core of the estimator is the loop between projection and matching".

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::config::{GeometricIndexing, Use};
use super::ids::{PlaceId, TrackId};
use super::indexing::{ActiveFrame, Candidate, expected, moved, plies};
use super::matching::{Choice, Look, Matcher, Situation, Traversal, choose};
use super::observation::Move;
use super::observer::Observer;
use super::path_graph::Standing;
use super::projector::{Projection, project};
use super::reference_graph::search;
use super::report::{Contradiction, Culprit, StepReport, TrackReport};
use super::restructuring::Hints;
use super::track::{Match, Track};

/// Whether a track may change the map. Only the best may, lest a dying hypothesis damage it; in the paper all do.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Best,
    Other,
}

impl Observer {
    /// Projects a track, finds what it matches, and lets its best match change the map if it is the best track. Every
    /// maximal matcher carries the track on.
    pub(super) fn advance(
        &mut self,
        track: &Track,
        rank: Rank,
        step: &Move,
        report: &mut StepReport,
        hints: &mut Hints,
        next: &mut Vec<(Track, TrackReport)>,
    ) {
        let from = track.place;
        let projection = project(&self.map, track, step, &self.config);
        let choice = self.matches(track, step, &projection);
        let predicted = self
            .map
            .paths
            .likeliest(from, step.action)
            .and_then(|best| {
                let to = self.map.paths.links[best.index()].to;
                let all = self.predict(from, step.action);
                all.into_iter().find(|one| one.place == to)
            });
        if let (Rank::Best, Some(excluded)) = (rank, choice.excluded)
            && let Some(link) = self.map.paths.between(from, step.action, excluded.place)
        {
            let known = self.motion(from, excluded.place);
            report.contradictions.push(Contradiction {
                track: track.id,
                culprit: if excluded.is_possible() {
                    Culprit::Look(link)
                } else {
                    Culprit::Link(link)
                },
                known: known.unwrap_or(PointBox::UNBOUNDED),
                estimate: projection.displacement,
            });
        }
        if choice.look == Look::Strange
            && rank == Rank::Best
            && let Some(there) = choice.matches.first().and_then(|best| best.candidate)
            && let Some(link) = self.map.paths.between(from, step.action, there.place)
        {
            report.contradictions.push(Contradiction {
                track: track.id,
                culprit: Culprit::Look(link),
                known: there.offset + projection.displacement,
                estimate: projection.displacement,
            });
        }
        let surprise = if choice.look == Look::Strange {
            Surprise::Look
        } else if choice.excluded.is_some() {
            Surprise::Excluded
        } else if self.rivals {
            Surprise::Rivals
        } else {
            Surprise::None
        };
        for (number, chosen) in choice.matches.iter().enumerate() {
            let writes = rank == Rank::Best && number == 0;
            let landed = if writes {
                let contradictions = &mut report.contradictions;
                Some(self.write(track, step, &projection, &choice, contradictions, hints))
            } else {
                let there = chosen.candidate.map(|candidate| candidate.place);
                let paths = &self.map.paths;
                there.map(|place| (place, paths.between(from, step.action, place)))
            };
            let Some((place, link)) = landed else {
                continue; // Only the best track may make places.
            };
            let id = if number == 0 {
                track.id
            } else {
                self.born += 1;
                TrackId(self.born - 1)
            };
            let mut child = Track {
                id,
                place,
                link,
                confidence: confidence_after(track.confidence, chosen.matcher, surprise),
                ..track.clone()
            };
            child.astray = match chosen.matcher {
                Matcher::Continue => 0.0,
                _ => track.astray + projection.displacement.norm().middle(),
            };
            let entry = Match {
                place,
                action: Some(step.action),
                doubts: choice.doubts.clone(),
                since: PointBox::ORIGIN,
            };
            let moved = trusted_odometry(step, &choice, chosen.matcher);
            child.remember(entry, moved, self.config.tracks.history);
            self.carry_active(&mut child, &projection);
            let line = TrackReport {
                track: id,
                from,
                matcher: Some(chosen.matcher),
                place,
                confidence: child.confidence,
                predicted,
                motion: None,
            };
            next.push((child, line));
        }
        let lost = choice.excluded.is_some() || choice.look == Look::Strange;
        if rank == Rank::Best && lost {
            self.suppose(track, step, next);
        }
    }

    /// The robot is not where it was expected to be: it may be wherever it looks like here, however far away. "Good candidate
    /// places can be found based on perceptual cues, even if they are geometrically distant."
    fn suppose(&mut self, track: &Track, step: &Move, next: &mut Vec<(Track, TrackReport)>) {
        let Some(percept) = &step.percept else {
            return;
        };
        let alike = self
            .views
            .most_alike(percept, &self.config, &self.map.paths);
        for place in alike {
            let taken = next.iter().any(|(other, _)| other.place == place);
            if taken || next.len() >= self.config.tracks.cap {
                continue;
            }
            let id = TrackId(self.born);
            self.born += 1;
            let there = &self.map.paths.places[place.index()];
            let at = ActiveFrame {
                frame: there.frame,
                robot: there.position,
            };
            let supposed = Track::begun(id, place, SUPPOSED, at);
            let line = TrackReport {
                track: id,
                from: track.place,
                matcher: None,
                place,
                confidence: SUPPOSED,
                predicted: None,
                motion: None,
            };
            next.push((supposed, line));
        }
    }

    /// The indexer and the matching engine for one track.
    fn matches(&self, track: &Track, step: &Move, projection: &Projection) -> Choice {
        let map = &self.map;
        let situation = Situation {
            map,
            config: &self.config,
            percept: step.percept.as_ref(),
            astray: track.astray + projection.displacement.norm().middle(),
        };
        let expected = match self.config.indexing.expectational {
            Use::On => expected(map, track.place, step.action, projection),
            Use::Off => Vec::new(),
        };
        choose(
            &situation,
            self.traversal(track.place, projection),
            track.confidence,
            &expected,
            || self.geometric(track, projection),
        )
    }

    fn geometric(&self, track: &Track, projection: &Projection) -> Vec<Vec<Candidate>> {
        match self.config.indexing.geometric {
            GeometricIndexing::Off => Vec::new(),
            GeometricIndexing::Search => {
                let limits = &self.config.search;
                let reached = search(&self.map.reference, projection.frame, limits);
                plies(&self.map, &reached, projection)
            }
            GeometricIndexing::ActiveFrames => {
                let here = projection.position;
                let reached: Vec<_> = track
                    .active
                    .iter()
                    .map(|active| active.seen_from(here - projection.displacement))
                    .collect();
                plies(&self.map, &reached, projection)
            }
        }
    }

    /// Whether the way just gone was gone often before.
    fn traversal(&self, place: PlaceId, projection: &Projection) -> Traversal {
        let place = &self.map.paths.places[place.index()];
        let grid = &self.map.reference.frames[place.frame.index()].grid;
        let [from, to] = [place.position, projection.position].map(PointBox::middle);
        if grid.traversals(from, to, self.config.separation) >= self.config.matching.well_traversed
        {
            Traversal::Well
        } else {
            Traversal::Poorly
        }
    }

    fn carry_active(&self, track: &mut Track, projection: &Projection) {
        if self.config.indexing.geometric != GeometricIndexing::ActiveFrames {
            return;
        }
        let place = &self.map.paths.places[track.place.index()];
        let here = ActiveFrame {
            frame: place.frame,
            robot: place.position,
        };
        track.active = moved(
            &self.map,
            &track.active,
            projection.displacement,
            Some(here),
            self.config.search.frames,
        );
    }

    /// The tracks that live on: of those at one place the most trusted, none that is trusted too little, at most as many as
    /// allowed; the best first.
    pub(super) fn select(&mut self, mut tracks: Vec<Track>) -> Vec<Track> {
        // The best track stays the best until it has lost confidence and another has won it.
        let tracking = self.config.tracks;
        let Some(mut best) = tracks.first().map(|track| track.id) else {
            return tracks;
        };
        if tracks[0].confidence <= tracking.low {
            let confident = tracks
                .iter()
                .filter(|track| track.confidence >= tracking.high)
                .max_by(|a, b| {
                    let confidence = a.confidence.total_cmp(&b.confidence);
                    confidence.then(b.id.cmp(&a.id))
                });
            if let Some(winner) = confident {
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

    /// After a split, tracks that came along a link which now leads to the new place are there.
    pub(super) fn take_sides(&mut self, kept: PlaceId, new: PlaceId) {
        let links = &self.map.paths.links;
        for track in self.tracks.iter_mut().filter(|track| track.place == kept) {
            let came = track.link.map(|link| &links[link.index()]);
            let moved = came.filter(|link| link.standing == Standing::Removed);
            if let Some(link) = moved
                && let Some(id) = self.map.paths.between(link.from, link.action, new)
            {
                track.place = new;
                track.link = Some(id);
            }
        }
    }

    /// After places were merged, split or elided: tracks are called by the places' new names.
    pub(super) fn rename_tracks(&mut self) {
        let best = self.tracks.first().map(|track| track.id);
        let paths = &self.map.paths;
        self.tracks
            .retain_mut(|track| match paths.resolve(track.place) {
                Some(place) => {
                    track.place = place;
                    track.link = track
                        .link
                        .filter(|link| paths.links[link.index()].to == place);
                    true
                }
                None => Some(track.id) == best,
            });
        let mut seen: Vec<PlaceId> = Vec::new();
        self.tracks.retain(|track| {
            let new = !seen.contains(&track.place);
            seen.push(track.place);
            new
        });
    }
}

/// The odometry of a move, if nothing says that it is wrong or that the robot was carried off.
pub(super) fn trusted_odometry(step: &Move, choice: &Choice, matcher: Matcher) -> PointBox {
    let plain = matches!(
        matcher,
        Matcher::Continue | Matcher::Link | Matcher::NewPlace
    );
    if plain && choice.excluded.is_none() && choice.look == Look::Known {
        step.odometry.position
    } else {
        PointBox::UNBOUNDED
    }
}

/// The confidence of a track that begins because a place looks like what the robot sees.
const SUPPOSED: f64 = 0.5;

/// What else speaks against a track.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Surprise {
    None,
    /// The place looks different.
    Look,
    /// It expected another place.
    Excluded,
    /// Other tracks explain the same moves.
    Rivals,
}

/// How far a track is trusted after a match: a CONTINUE wins confidence, whatever posits an error or looks
/// strange loses it. A new place
/// posits one where another place was expected, or where another track needs none.
fn confidence_after(confidence: f64, matcher: Matcher, surprise: Surprise) -> f64 {
    match (matcher, surprise) {
        (_, Surprise::Look) => 0.7 * confidence,
        (Matcher::Continue, _) => confidence + 0.2 * (1.0 - confidence),
        (Matcher::NewPlace, Surprise::Excluded) => 0.9 * confidence,
        (Matcher::NewPlace, Surprise::Rivals) => 0.7 * confidence,
        (Matcher::Link, _) | (Matcher::NewPlace, Surprise::None) => confidence,
        (Matcher::Alpha, _) => 0.7 * confidence,
        (Matcher::Beta, _) => 0.5 * confidence,
    }
}
