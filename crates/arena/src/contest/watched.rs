//! A run of a robot that somebody watched: what the judge needs of it.

use serde::Deserialize;
use thiserror::Error;
use tolman_geom::Point;
use tolman_maze::Maze;
use tolman_robot::VisitNaming;

use super::evidence::TrueVisits;
use super::judgement::MapJudgement;
use super::true_graph::{PlaceRule, TrueGraph};
use super::whereabouts::Squares;
use crate::named_map::NamedMap;

/// A run of a robot with its true positions, and what its system said of its map. It is a file of
/// JSON.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WatchedRun {
    /// Distance from the middle of one cell to that of the next, m. The south-west corner of the
    /// maze is the origin.
    pitch: f64,
    /// True position of the robot, m, before its first motion and after each.
    path: Vec<[f64; 2]>,
    /// All actions.
    actions: Vec<WatchedAction>,
    /// The system's answer to `visits`.
    visits: NamedVisits,
    /// The system's answer to `map`.
    map: NamedMap,
}

/// State after an action.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WatchedAction {
    /// Number of motions so far.
    motions: usize,
    /// Number of visits that the system has named so far.
    visits: usize,
    /// Place where the system believes to be.
    place: Option<u32>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct NamedVisits {
    naming: Naming,
    places: Vec<Option<u32>>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Naming {
    Never,
    EachStep,
    EachArrival,
}

/// Reason why a watched run cannot be judged.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WatchedError {
    /// The cells have no size.
    #[error("`pitch` is {pitch} m; give the distance between the middles of two cells")]
    Pitch {
        /// Value that was given.
        pitch: f64,
    },
    /// An action has no position.
    #[error(
        "action {action} ends after {motions} motions, and `path` has {positions} positions: give one before the first and one after each"
    )]
    Path {
        /// Number of the action, from 0.
        action: usize,
        /// Number of motions so far.
        motions: usize,
        /// Number of positions.
        positions: usize,
    },
}

impl WatchedRun {
    /// Returns the judgement of the map as one of `maze`, where `rule` says which cells are places.
    ///
    /// # Errors
    /// If the run is incomplete.
    pub fn judge(&self, maze: &Maze, rule: PlaceRule) -> Result<MapJudgement, WatchedError> {
        let pitch = self.pitch;
        if !(pitch.is_finite() && pitch > 0.0) {
            return Err(WatchedError::Pitch { pitch });
        }
        let squares = Squares {
            grid: maze.grid(),
            pitch,
            origin: Point::origin(),
        };
        let path: Vec<Point> = self.path.iter().map(|at| Point::from(*at)).collect();
        let naming = match self.visits.naming {
            Naming::Never => VisitNaming::Never,
            Naming::EachStep => VisitNaming::EachStep,
            Naming::EachArrival => VisitNaming::EachArrival,
        };
        let mut been = TrueVisits::default();
        let mut before = 0;
        for (number, action) in self.actions.iter().enumerate() {
            let at = |motions: usize| {
                path.get(motions).copied().ok_or(WatchedError::Path {
                    action: number,
                    motions,
                    positions: path.len(),
                })
            };
            let ends = [at(before)?, at(action.motions)?];
            been.add(naming, action.visits, || action.place, ends);
            before = action.motions;
        }
        let map = self.map.view();
        let named = (naming, self.visits.places.clone());
        let truth = TrueGraph::of(maze, rule);
        let evidence = been.of_map(&map, named, &path, 0, (squares, truth.spots().clone()));
        Ok(evidence.judge(&map, &truth))
    }
}
