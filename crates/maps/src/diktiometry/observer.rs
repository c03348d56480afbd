use alloc::vec::Vec;

use tolman_geom::PointBox;
use tolman_planners::a_star;

use super::{
    Action, Config, Diktiometry, Exits, FirstPlace, Hints, Journal, JournalLength, Link,
    MoveOutcome, ObservedMove, ObservedMoveError, Percepts, PlaceId, PlanStep, Predicted, Rank,
    Restructured, Signature, StartError, StepReport, Track, TrackId, TrackReport, ViewIndex,
    deposit, remember, restructure, steps_along,
};

/// The adaptive state-space model: it observes any robot's moves and drives none.
///
/// Each [`step`](Self::step) is the loop of the paper's figure 1. The *estimator* (projector,
/// indexer, matching engine) finds where every track is; the *adapter* (updater, restructurer)
/// changes the map. A planner asks [`tracks`](Self::tracks), [`predict`](Self::predict),
/// [`plan`](Self::plan) and [`opportunities`](Self::opportunities).
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    pub(super) config: Config,
    pub(super) map: Diktiometry,
    pub(super) views: ViewIndex,
    /// The best first.
    pub(super) tracks: Vec<Track>,
    /// Whether tracks beside the best were alive before the last move.
    pub(super) rivals: bool,
    /// Tracks so far.
    pub(super) born: u32,
    /// Journal, which keeps the moves if the configuration says so.
    pub(super) journal: Journal,
}

impl Observer {
    /// Returns an observer of a robot at a place; the map is that place alone.
    ///
    /// # Errors
    /// [`StartError`] if the configuration is out of its bounds or the first percept does not fit
    /// it.
    pub fn new(config: Config, start: FirstPlace) -> Result<Self, StartError> {
        config.check()?;
        check_percept(&config, start.percept.as_ref())?;
        check_exits(&config, &start.exits)?;
        let journal = Journal {
            start: start.clone(),
            ..Journal::default()
        };
        let mut map = Diktiometry::default();
        let place = map.found_place();
        let first = map.place_mut(place);
        let mut views = ViewIndex::default();
        remember(first, start.percept.as_ref(), &config.percepts);
        first.exits = start.exits;
        first.visits = 1;
        if let Some(view) = &start.percept {
            views.insert(place, view, &config);
            map.looks.kinds = 1;
        }
        let track = Track::begun(&map, TrackId(0), place, 1.0);
        Ok(Self {
            config,
            map,
            views,
            rivals: false,
            tracks: Vec::from([track]),
            born: 1,
            journal,
        })
    }

    /// Returns the map in its present state.
    #[must_use]
    pub const fn map(&self) -> &Diktiometry {
        &self.map
    }

    /// Returns the configuration with which the observer was made.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// Returns the number of moves so far.
    #[must_use]
    pub const fn moves(&self) -> u64 {
        self.map.paths.now
    }

    /// Returns the estimate: all tracks, the best first. There is always at least one.
    #[must_use]
    pub fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Returns the place of the best track.
    #[must_use]
    pub fn place(&self) -> PlaceId {
        self.tracks[0].place
    }

    /// Returns the links by which an action leads from a place, by id. Empty if the action was
    /// never done there or the place is not known.
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

    /// Returns the plan from one place to another: a short way of actions that are likely to lead
    /// there. They follow links that probably work now
    /// ([`PathGraph::likely`](super::PathGraph::likely)). In a world that never changed it is the
    /// shortest. Empty if both are one place, `None` if no way
    /// is known. O(places + links · (degree + log links)).
    #[must_use]
    pub fn plan(&self, from: PlaceId, to: PlaceId) -> Option<Vec<PlanStep>> {
        let from = self.map.paths.resolve(from)?;
        let to = self.map.paths.resolve(to)?;
        let way = a_star(&self.map, from.0, |place| place == to.0, |_| 0)?.path;
        let ways = |place| self.map.paths.likely(place).map(|(_, link)| link.step());
        steps_along(&way, ways)
    }

    /// Takes in a move that has ended.
    ///
    /// # Errors
    /// [`ObservedMoveError`] if the move is invalid; nothing has changed then.
    pub fn step(&mut self, step: &ObservedMove) -> Result<StepReport, ObservedMoveError> {
        self.admit(step)?;
        self.map.paths.now += 1;
        let mut report = StepReport {
            number: self.moves(),
            tracks: Vec::new(),
            contradictions: Vec::new(),
            restructured: Vec::new(),
            reordered: false,
        };
        match step.outcome {
            MoveOutcome::Blocked => self.blocked(step, &mut report),
            MoveOutcome::Arrived => self.arrived(step, &mut report),
        }
        if self.config.journal == JournalLength::All {
            self.journal.moves.push(step.clone());
        }
        Ok(report)
    }

    fn admit(&self, step: &ObservedMove) -> Result<(), ObservedMoveError> {
        let actions = self.config.actions.len();
        let ObservedMove {
            action, odometry, ..
        } = *step;
        if action.0 as usize >= actions {
            return Err(ObservedMoveError::UnknownAction { action, actions });
        }
        if !odometry.position.is_bounded() {
            return Err(ObservedMoveError::Unbounded { odometry });
        }
        check_percept(&self.config, step.percept.as_ref())?;
        check_exits(&self.config, &step.exits)
    }

    /// Takes in a blocked move: the robot has not moved, and the action leads nowhere.
    fn blocked(&mut self, step: &ObservedMove, report: &mut StepReport) {
        let here = self.place();
        self.block(here, step.action);
        let lines = self.tracks.iter().map(|track| TrackReport {
            motion: Some(PointBox::ORIGIN),
            ..track.report(track.place, None, None)
        });
        report.tracks = lines.collect();
    }

    fn arrived(&mut self, step: &ObservedMove, report: &mut StepReport) {
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
        let apart = &self.journal.distinctions;
        report.restructured = restructure(&mut self.map, &self.config, hints, &occupied, apart);
        for change in &report.restructured {
            if let Restructured::Split { kept, new, .. } = *change {
                self.take_sides(kept, new);
            }
        }
        self.rename_tracks();
        if let Some(best) = self.tracks.first() {
            deposit(&mut self.map, best.place, &best.history, &self.config);
        }
        let lines = self.tracks.iter().filter_map(|track| {
            let line = lines.iter().find(|line| line.track == track.id)?;
            let from = self.map.paths.resolve(line.from);
            Some(TrackReport {
                motion: from.and_then(|from| self.motion(from, track.place)),
                ..track.report(line.from, line.matcher, line.predicted)
            })
        });
        report.tracks = lines.collect();
    }

    /// Returns the position of one place relative to another, m: from the relation of their frames,
    /// or else by a search.
    pub(super) fn motion(&self, from: PlaceId, to: PlaceId) -> Option<PointBox> {
        self.map
            .related(from, to)
            .or_else(|| self.map.displacement(from, to, &self.config.search))
    }
}

fn check_percept(config: &Config, percept: Option<&Signature>) -> Result<(), ObservedMoveError> {
    let expected = match config.percepts {
        Percepts::None => None,
        Percepts::Signatures(kind) => Some((kind.rows, kind.columns)),
    };
    let given = percept.map(|percept| (percept.rows(), percept.columns()));
    if given == expected {
        return Ok(());
    }
    let (rows, columns) = given.ok_or(ObservedMoveError::PerceptMissing)?;
    let (expected_rows, expected_columns) = expected.unwrap_or_default();
    Err(ObservedMoveError::PerceptSize {
        rows,
        columns,
        expected_rows,
        expected_columns,
    })
}

fn check_exits(config: &Config, exits: &Exits) -> Result<(), ObservedMoveError> {
    let actions = config.actions.len();
    let Exits::Seen(seen) = exits else {
        return Ok(());
    };
    match seen.iter().find(|action| action.0 as usize >= actions) {
        Some(&action) => Err(ObservedMoveError::UnknownExit { action, actions }),
        None => Ok(()),
    }
}
