use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::path_to;

use super::config::{Config, GeometricIndexing, Percepts, Use};
use super::error::{StartError, StepError};
use super::ids::{Action, LinkId, PlaceId, TrackId};
use super::indexing::{ActiveFrame, Candidate, expected, moved, plies};
use super::journal::{Distinction, Recorder};
use super::map::{Diktiometry, Site};
use super::matching::{Choice, Matcher, Situation, Traversal, choose, remember};
use super::observation::{Exits, Move, Outcome, Start};
use super::opportunities::{Opportunity, actions_along, opportunities};
use super::path_graph::{Note, Standing, Successor};
use super::projector::{Projection, project};
use super::reference_graph::search;
use super::report::{
    Contradiction, Culprit, Plan, PlanStep, Predicted, Restructured, StepReport, TrackReport,
};
use super::restructuring::{Hints, deposit, restructure};
use super::signature::Signature;
use super::track::{Match, Track};
use super::updater::arrive;

/// The adaptive state-space model: an observer that any robot can feed, and that drives none.
///
/// Each [`step`](Self::step) is the loop of the paper's figure 1: the *estimator* (projector, indexer, matching engine) finds
/// where every track is, the *adapter* (updater, restructurer) changes the map by it. A planner asks
/// [`tracks`](Self::tracks), [`predict`](Self::predict), [`plan`](Self::plan) and
/// [`opportunities`](Self::opportunities), and does with the answers what it likes.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    config: Config,
    map: Diktiometry,
    tracks: Vec<Track>,
    born: u32,
    moves: u64,
    distinctions: Vec<Distinction>,
    pub(super) recorder: Option<Recorder>,
}

impl Observer {
    /// An observer of a robot that stands at a place: the map is that place.
    ///
    /// # Errors
    /// [`StartError`] if the configuration is out of its bounds or the first percept does not fit it.
    pub fn new(config: Config, start: Start) -> Result<Self, StartError> {
        config.check()?;
        check_percept(&config, start.percept.as_ref())?;
        check_exits(&config, &start.exits)?;
        let recorder = Recorder::new(&config, &start);
        let mut map = Diktiometry::default();
        let place = map.new_place(Site::OwnFrame);
        let first = &mut map.paths.places[place.index()];
        remember(first, start.percept.as_ref(), &config.percepts);
        first.exits = start.exits;
        first.visits = 1;
        let frame = first.frame;
        let track = Track {
            id: TrackId(0),
            place,
            confidence: 1.0,
            link: None,
            astray: 0.0,
            history: Vec::from([Match {
                place,
                action: None,
                doubts: Vec::new(),
            }]),
            active: Vec::from([ActiveFrame {
                frame,
                robot: PointBox::ORIGIN,
            }]),
        };
        Ok(Self {
            config,
            map,
            tracks: Vec::from([track]),
            born: 1,
            moves: 0,
            distinctions: Vec::new(),
            recorder,
        })
    }

    /// The map as it is.
    #[must_use]
    pub const fn map(&self) -> &Diktiometry {
        &self.map
    }

    /// What it was told at first.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// Moves taken in so far.
    #[must_use]
    pub const fn moves(&self) -> u64 {
        self.moves
    }

    /// The estimate: all tracks, the best first; never none.
    #[must_use]
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// The place of the best track.
    #[must_use]
    pub fn place(&self) -> PlaceId {
        self.tracks[0].place
    }

    /// Takes in that places are different.
    pub(super) fn distinguish(&mut self, distinctions: &[Distinction]) {
        self.distinctions = distinctions.to_vec();
        if let Some(recorder) = &mut self.recorder {
            recorder.journal.distinctions = distinctions.to_vec();
        }
    }

    /// Where an action leads from a place, as far as is known, by the link's id. Empty if it was never done there or the
    /// place is not known.
    #[must_use]
    pub fn predict(&self, place: PlaceId, action: Action) -> Vec<Predicted> {
        let Some(place) = self.map.paths.resolve(place) else {
            return Vec::new();
        };
        let all: f64 = self
            .map
            .outcomes(place, action)
            .map(|(_, _, traversed)| f64::from(traversed))
            .sum();
        self.map
            .outcomes(place, action)
            .map(|(_, to, traversed)| Predicted {
                place: to,
                probability: f64::from(traversed) / all,
                displacement: self.motion(place, to),
            })
            .collect()
    }

    /// The fewest actions from one place to another along the likeliest links, ties to the older links; none if no way is known.
    /// O(places + links · degree).
    #[must_use]
    pub fn plan(&self, from: PlaceId, to: PlaceId) -> Option<Plan> {
        let from = self.map.paths.resolve(from)?;
        let to = self.map.paths.resolve(to)?;
        let way = path_to(&self.map.paths, from.0, |place| place == to.0)?;
        let actions = actions_along(&self.map, &way)?;
        let ends = way.iter().skip(1).map(|&place| PlaceId(place));
        let steps = actions
            .into_iter()
            .zip(ends)
            .map(|(action, to)| PlanStep { action, to })
            .collect();
        Some(Plan { steps })
    }

    /// What would help the map, the most worthwhile first: scripts from where the best track is. Nothing depends on whether they are
    /// done. O(places + links · degree).
    #[must_use]
    pub fn opportunities(&self) -> Vec<Opportunity> {
        opportunities(&self.map, &self.tracks[0], &self.config)
    }

    /// Takes in a move that has ended.
    ///
    /// # Errors
    /// [`StepError`] if it is none; everything then is as it was.
    pub fn step(&mut self, step: &Move) -> Result<StepReport, StepError> {
        self.admit(step)?;
        self.moves += 1;
        let mut report = StepReport {
            number: self.moves,
            tracks: Vec::new(),
            contradictions: Vec::new(),
            restructured: Vec::new(),
        };
        match step.outcome {
            Outcome::Blocked => self.blocked(step, &mut report),
            Outcome::Arrived => self.arrived(step, &mut report),
        }
        self.record(step);
        Ok(report)
    }

    fn admit(&self, step: &Move) -> Result<(), StepError> {
        let actions = self.config.actions.len();
        if step.action.0 as usize >= actions {
            return Err(StepError::UnknownAction {
                action: step.action,
                actions,
            });
        }
        if !step.odometry.position.is_bounded() {
            return Err(StepError::Unbounded {
                odometry: step.odometry,
            });
        }
        check_percept(&self.config, step.percept.as_ref())?;
        check_exits(&self.config, &step.exits)
    }

    /// The robot is where it was, and now knows that the action leads nowhere.
    fn blocked(&mut self, step: &Move, report: &mut StepReport) {
        let place = &mut self.map.paths.places[self.tracks[0].place.index()];
        if !place.blocked.contains(&step.action) {
            place.blocked.push(step.action);
        }
        report.tracks = self
            .tracks
            .iter()
            .map(|track| TrackReport {
                track: track.id,
                from: track.place,
                matcher: None,
                place: track.place,
                confidence: track.confidence,
                predicted: None,
                motion: Some(PointBox::ORIGIN),
            })
            .collect();
    }

    fn arrived(&mut self, step: &Move, report: &mut StepReport) {
        let mut hints = Hints::default();
        let tracks = core::mem::take(&mut self.tracks);
        let mut next = Vec::new();
        for (rank, track) in tracks.into_iter().enumerate() {
            let rank = if rank == 0 { Rank::Best } else { Rank::Other };
            self.advance(&track, rank, step, report, &mut hints, &mut next);
        }
        self.tracks = self.select(next.iter().map(|(track, _)| track.clone()).collect());
        let occupied: Vec<PlaceId> = self.tracks.iter().map(|track| track.place).collect();
        report.restructured = restructure(
            &mut self.map,
            &self.config,
            hints,
            &occupied,
            &self.distinctions,
        );
        for change in &report.restructured {
            if let Restructured::Split { kept, new } = *change {
                self.take_sides(kept, new);
            }
        }
        self.rename_tracks();
        if let Some(best) = self.tracks.first() {
            deposit(&mut self.map, best.place, &best.history, &self.config);
        }
        for (track, mut line) in next {
            let Some(now) = self.tracks.iter().find(|other| other.id == track.id) else {
                continue;
            };
            line.confidence = now.confidence;
            line.place = now.place;
            line.motion = self
                .map
                .paths
                .resolve(line.from)
                .and_then(|from| self.motion(from, now.place));
            report.tracks.push(line);
        }
        report.tracks.sort_by_key(|line| {
            let at = self.tracks.iter().position(|track| track.id == line.track);
            at.unwrap_or(usize::MAX)
        });
    }

    /// Projects a track, finds what it matches, and lets its best match change the map if it is the best track. Every
    /// maximal matcher carries the track on.
    fn advance(
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
        if rank == Rank::Best
            && let Some(excluded) = choice.excluded
            && let Some((link, _)) = self
                .map
                .paths
                .along(from, step.action)
                .find(|(_, link)| link.to == excluded.place)
        {
            let known = self.motion(from, excluded.place);
            report.contradictions.push(Contradiction {
                track: track.id,
                culprit: Culprit::Link(link),
                known: known.unwrap_or(PointBox::UNBOUNDED),
                estimate: projection.displacement,
            });
        }
        for (number, chosen) in choice.matches.iter().enumerate() {
            let writes = rank == Rank::Best && number == 0;
            let landed = if writes {
                let contradictions = &mut report.contradictions;
                Some(self.write(track, step, &projection, &choice, contradictions, hints))
            } else {
                let there = chosen.candidate.map(|candidate| candidate.place);
                there.map(|place| (place, self.link(from, step.action, place)))
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
                confidence: confidence_after(
                    track.confidence,
                    chosen.matcher,
                    choice.excluded.is_some(),
                ),
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
            };
            child.remember(entry, self.config.tracks.history);
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

    /// The updater: the best track's best match changes the map.
    fn write(
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
        let place = &mut self.map.paths.places[to.index()];
        remember(place, step.percept.as_ref(), &self.config.percepts);
        if step.exits != Exits::Unknown {
            place.exits = step.exits.clone();
        }
        let (frame, position) = (place.frame, place.position);
        let grid = &mut self.map.reference.frames[frame.index()].grid;
        grid.visit(position.middle(), self.config.separation);
        let pairs = choice.doubts.iter().chain(&choice.twins);
        for &other in pairs.filter(|&&other| other != to) {
            self.note(to, other);
            self.note(other, to);
        }
        hints
            .near
            .extend(track.history.iter().map(|entry| entry.place));
        hints.changed.push(to);
        (to, Some(link))
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

    fn note(&mut self, at: PlaceId, other: PlaceId) {
        let notes = &mut self.map.paths.places[at.index()].notes;
        if notes.iter().all(|note| note.other != other) {
            notes.push(Note { other });
        }
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

    fn link(&self, from: PlaceId, action: Action, to: PlaceId) -> Option<LinkId> {
        let mut along = self.map.paths.along(from, action);
        along.find(|(_, link)| link.to == to).map(|(id, _)| id)
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
    fn select(&self, mut tracks: Vec<Track>) -> Vec<Track> {
        // The best track stays the best until it has lost confidence and another has won it.
        let tracking = &self.config.tracks;
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
            best = confident.map_or(best, |track| track.id);
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
    fn take_sides(&mut self, kept: PlaceId, new: PlaceId) {
        let links = &self.map.paths.links;
        for track in self.tracks.iter_mut().filter(|track| track.place == kept) {
            let came = track.link.map(|link| &links[link.index()]);
            let moved = came.filter(|link| link.standing == Standing::Removed);
            if let Some(link) = moved {
                let mut along = self.map.paths.along(link.from, link.action);
                if let Some((id, _)) = along.find(|(_, link)| link.to == new) {
                    track.place = new;
                    track.link = Some(id);
                }
            }
        }
    }

    /// After places were merged, split or elided: tracks are called by the places' new names.
    fn rename_tracks(&mut self) {
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

    /// Where one place lies as seen from another by what is known of their two frames, m; by a search only if they
    /// are not related.
    fn motion(&self, from: PlaceId, to: PlaceId) -> Option<PointBox> {
        let [start, end] = [from, to].map(|place| &self.map.paths.places[place.index()]);
        let frames = if start.frame == end.frame {
            Some(PointBox::ORIGIN)
        } else {
            let relation = self.map.reference.relation(start.frame, end.frame);
            relation.map(|relation| relation.position)
        };
        match frames {
            Some(frames) => Some(frames + end.position - start.position),
            None => self.map.displacement(from, to, &self.config.search),
        }
    }
}

/// Whether a track may change the map: "stops a dying hypothesis from damaging the shared map".
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rank {
    Best,
    Other,
}

/// How far a track is trusted after a match: a CONTINUE wins confidence, whatever posits an error loses it. A new place
/// posits one where another place was expected and is `excluded`.
fn confidence_after(confidence: f64, matcher: Matcher, excluded: bool) -> f64 {
    match matcher {
        Matcher::Continue => confidence + 0.2 * (1.0 - confidence),
        Matcher::NewPlace if excluded => 0.9 * confidence,
        Matcher::Link | Matcher::NewPlace => confidence,
        Matcher::Alpha => 0.7 * confidence,
        Matcher::Beta => 0.5 * confidence,
    }
}

fn check_percept(config: &Config, percept: Option<&Signature>) -> Result<(), StepError> {
    let size = |percept: &Signature| (percept.rows(), percept.columns());
    match (&config.percepts, percept) {
        (Percepts::None, None) => Ok(()),
        (Percepts::None, Some(percept)) => Err(StepError::PerceptSize {
            rows: percept.rows(),
            columns: percept.columns(),
            expected_rows: 0,
            expected_columns: 0,
        }),
        (Percepts::Signatures(_), None) => Err(StepError::PerceptMissing),
        (Percepts::Signatures(kind), Some(percept)) => {
            if size(percept) == (kind.rows, kind.columns) {
                return Ok(());
            }
            Err(StepError::PerceptSize {
                rows: percept.rows(),
                columns: percept.columns(),
                expected_rows: kind.rows,
                expected_columns: kind.columns,
            })
        }
    }
}

fn check_exits(config: &Config, exits: &Exits) -> Result<(), StepError> {
    let actions = config.actions.len();
    let Exits::Seen(seen) = exits else {
        return Ok(());
    };
    match seen.iter().find(|action| action.0 as usize >= actions) {
        Some(&action) => Err(StepError::UnknownExit { action, actions }),
        None => Ok(()),
    }
}
