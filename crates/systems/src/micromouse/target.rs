use tolman_maze::{Cell, Direction, Walls};
use tolman_planners::moves::Leap;
use tolman_planners::{Passages, StepMap, TooLarge, Unknown};

use super::SIDE;
use super::driver::{Next, Search, SearchView};

/// The paper's *target search* (section 3.3.2). It drives "in each timestamp" to the nearest of the
/// cells of largest uncertainty, by the shortest path, with unknown walls open. It ends when a goal
/// was visited and the open path is as short as the closed path, both in cells.
///
/// The paper leaves open which shortest path is taken. Here it is one that goes straight on if
/// possible.
#[derive(Clone, Debug, Default)]
pub struct TargetSearch {
    /// Whether a goal was visited.
    arrived: bool,
}

impl TargetSearch {
    /// Returns a search without observations.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

impl Search for TargetSearch {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        self.arrived |= view.goals.contains(&view.at);
        let cells = |unknown| {
            let passages = Passages::<SIDE>::new(view.map, unknown)?;
            let steps = StepMap::new(&passages, view.goals.iter().copied());
            Ok(steps.steps(view.start))
        };
        let Some(open) = cells(Unknown::Open)? else {
            return Ok(Next::Stuck);
        };
        let path = if cells(Unknown::Closed)? == Some(open) {
            if self.arrived {
                return Ok(Next::Reset);
            }
            // "let the robot goes to any of the goal location if the goal is never actually
            // visited"
            let known = Passages::new(view.map, Unknown::Closed)?;
            path(&known, view.at, view.goals)
        } else {
            // The most uncertain cell.
            let doubts = |cell| {
                let uncertainty = view.map.uncertainty(cell);
                (uncertainty > 0).then_some(u8::MAX - uncertainty)
            };
            path_to_least(view, doubts)?.unwrap_or_default()
        };
        Ok(leap(view, &path)?.map_or(Next::Turn, Next::Drive))
    }
}

/// Returns a path, on which unknown walls count as open, to the cell of the least rank, then the
/// nearest, then the first. `None` if no cell with a rank is within reach.
pub(super) fn path_to_least<K: Ord + Copy>(
    view: &SearchView<'_>,
    rank: impl Fn(Cell) -> Option<K>,
) -> Result<Option<Vec<Direction>>, TooLarge> {
    let hoped = Passages::<SIDE>::new(view.map, Unknown::Open)?;
    let steps = StepMap::new(&hoped, [view.at]);
    let cells = view.map.grid().cells();
    let reached = cells.filter_map(|cell| Some((rank(cell)?, steps.steps(cell)?, cell)));
    let target = reached.min_by_key(|(rank, steps, _)| (*rank, *steps));
    Ok(target.map(|(_, _, cell)| path(&hoped, view.at, &[cell])))
}

/// Returns the leap along the path that one step allows.
pub(super) fn leap(view: &SearchView<'_>, path: &[Direction]) -> Result<Option<Leap>, TooLarge> {
    let known = Passages::<SIDE>::new(view.map, Unknown::Closed)?;
    let Some(&direction) = path.first() else {
        return Ok(None);
    };
    let straight = path.iter().take_while(|side| **side == direction);
    let leaps = Leap::along(&known, view.at, direction).zip(straight);
    Ok(leaps.map(|(leap, _)| leap).last())
}

/// Returns a shortest path to the nearest of `targets`, straight on if possible: the sides by which
/// it leaves its cells.
pub(super) fn path(passages: &Passages<SIDE>, from: Cell, targets: &[Cell]) -> Vec<Direction> {
    let steps = StepMap::new(passages, targets.iter().copied());
    let mut path = Vec::new();
    let mut at = from;
    while steps.steps(at).is_some_and(|steps| steps > 0) {
        let order = path.last().copied().into_iter().chain(Direction::ALL);
        let Some(direction) = steps.descend(passages, at, order) else {
            break;
        };
        let Some(leap) = Leap::along(passages, at, direction).next() else {
            break;
        };
        path.push(direction);
        at = leap.end;
    }
    path
}
