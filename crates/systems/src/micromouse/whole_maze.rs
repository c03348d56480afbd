use tolman_planners::TooLarge;

use super::driver::{Next, Search, SearchView};
use super::target::{leap, path_to_least};

/// A search for the whole maze: it goes to the nearest unvisited cell until no such cell can be
/// reached.
#[derive(Clone, Copy, Debug, Default)]
pub struct WholeMaze;

impl Search for WholeMaze {
    fn next(&mut self, view: &SearchView<'_>) -> Result<Next, TooLarge> {
        let new = |cell| (view.map.visits(cell) == 0).then_some(());
        let Some(path) = path_to_least(view, new)? else {
            return Ok(Next::Reset);
        };
        Ok(leap(view, &path)?.map_or(Next::Turn, Next::Drive))
    }
}
