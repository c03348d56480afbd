use tolman_maze::Walls;
use tolman_planners::{Passages, StepMap, TooLarge, Unknown};

use super::SIDE;
use super::driver::{Next, Search, SearchView};
use super::target::{leap, path};

/// A search for the whole maze: it goes to the nearest unvisited cell until no such cell can be
/// reached.
#[derive(Clone, Copy, Debug, Default)]
pub struct WholeMaze;

impl Search for WholeMaze {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        let hoped = Passages::<SIDE>::new(view.map, Unknown::Open)?;
        let steps = StepMap::new(&hoped, [view.at]);
        let cells = view.map.grid().cells();
        let new = cells.filter(|cell| view.map.visits(*cell) == 0);
        let reached = new.filter_map(|cell| Some((steps.steps(cell)?, cell)));
        let Some((_, nearest)) = reached.min_by_key(|(steps, _)| *steps) else {
            return Ok(Next::Reset);
        };
        let path = path(&hoped, view.at, &[nearest]);
        Ok(leap(view, &path)?.map_or(Next::Turn, Next::Drive))
    }
}
