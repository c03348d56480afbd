use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::a_star;

use super::config::{Config, Percepts};
use super::error::{StartError, StepError};
use super::estimator::Rank;
use super::ids::{Action, PlaceId, TrackId};
use super::indexing::{ActiveFrame, ViewIndex};
use super::journal::{Distinction, Recorder};
use super::map::{Diktiometry, Site};
use super::matching::remember;
use super::observation::{Exits, Move, Outcome, Start};
use super::opportunities::{Opportunity, actions_along, opportunities, untried};
use super::path_graph::Link;
use super::report::{Plan, PlanStep, Predicted, Restructured, StepReport, TrackReport};
use super::restructuring::{Hints, deposit, restructure};
use super::signature::Signature;
use super::track::Track;
use super::updater::block;

/// The adaptive state-space model: an observer that any robot can feed, and that drives none.
///
/// Each [`step`](Self::step) is the loop of the paper's figure 1: the *estimator* (projector, indexer, matching engine) finds
/// where every track is, the *adapter* (updater, restructurer) changes the map by it. A planner asks
/// [`tracks`](Self::tracks), [`predict`](Self::predict), [`plan`](Self::plan) and
/// [`opportunities`](Self::opportunities), and does with the answers what it likes.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    pub(super) config: Config,
    pub(super) map: Diktiometry,
    pub(super) views: ViewIndex,
    /// The best first.
    pub(super) tracks: Vec<Track>,
    /// Whether other tracks than the best were alive before the last move.
    pub(super) rivals: bool,
    /// Tracks so far.
    pub(super) born: u32,
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
        let mut views = ViewIndex::default();
        remember(first, start.percept.as_ref(), &config.percepts);
        if let Some(view) = &start.percept {
            views.insert(place, view, &config);
            map.looks.kinds = 1;
        }
        first.exits = start.exits;
        first.visits = 1;
        let at = ActiveFrame {
            frame: first.frame,
            robot: PointBox::ORIGIN,
        };
        let track = Track::begun(TrackId(0), place, 1.0, at);
        Ok(Self {
            config,
            map,
            views,
            rivals: false,
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
        let links = || self.map.paths.along(place, action);
        // What was met ages ago has faded to nothing.
        let weight = |link: &Link| link.counts.met().max(f64::MIN_POSITIVE);
        let all: f64 = links().map(|(_, link)| weight(link)).sum();
        links()
            .map(|(_, link)| Predicted {
                place: link.to,
                probability: weight(link) / all,
                displacement: self.motion(place, link.to),
            })
            .collect()
    }

    /// The actions from one place to another that are the likeliest to lead there and few, along links that probably work now
    /// ([`PathGraph::likely`](super::PathGraph::likely)); the fewest where the world never changed. None if no way is known.
    /// O(places + links · (degree + log links)).
    #[must_use]
    pub fn plan(&self, from: PlaceId, to: PlaceId) -> Option<Plan> {
        let from = self.map.paths.resolve(from)?;
        let to = self.map.paths.resolve(to)?;
        let way = a_star(&self.map.paths, from.0, |place| place == to.0, |_| 0)?.path;
        let links = |place| {
            let likely = self.map.paths.likely(place);
            likely.map(|(_, link)| (link.action, link.to))
        };
        let actions = actions_along(&way, links)?;
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

    /// Returns the actions that were never tried at `place` and may lead somewhere, by number; none
    /// if `place` is not on the map. O(actions · degree).
    #[must_use]
    pub fn untried(&self, place: PlaceId) -> Vec<Action> {
        let place = self.map.paths.resolve(place);
        place.map_or_else(Vec::new, |place| untried(&self.map, place, &self.config))
    }

    /// Takes in a move that has ended.
    ///
    /// # Errors
    /// [`StepError`] if it is none; everything then is as it was.
    pub fn step(&mut self, step: &Move) -> Result<StepReport, StepError> {
        self.admit(step)?;
        self.moves += 1;
        self.map.paths.now = self.moves;
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
        block(
            &mut self.map,
            self.tracks[0].place,
            step.action,
            &self.config,
        );
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
        self.rivals = tracks.len() > 1;
        for (rank, track) in tracks.into_iter().enumerate() {
            let rank = if rank == 0 { Rank::Best } else { Rank::Other };
            self.advance(&track, rank, step, report, &mut hints, &mut next);
        }
        let (children, lines): (Vec<Track>, Vec<TrackReport>) = next.into_iter().unzip();
        self.tracks = self.select(children);
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
        for mut line in lines {
            let Some(now) = self.tracks.iter().find(|track| track.id == line.track) else {
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

    /// Where one place lies as seen from another by what is known of their two frames, m; by a search only if they
    /// are not related.
    pub(super) fn motion(&self, from: PlaceId, to: PlaceId) -> Option<PointBox> {
        self.map
            .related(from, to)
            .or_else(|| self.map.displacement(from, to, &self.config.search))
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
