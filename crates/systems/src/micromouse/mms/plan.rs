use tolman_maze::{Cell, Direction, Grid, Walls};
use tolman_planners::lattice::{LatticePoint, LatticePose};
use tolman_planners::{Found, Passages, TooLarge, Unknown, a_star};

use super::roads::{Roads, TurnsAtStart, edges};

/// Returns the score of the best run to the middle of a maze of at most 32 × 32 cells, in
/// half-steps. The tenth of all movements is not part of it. Unknown walls count as standing.
/// `None` if no way leads there. O(n log n) for n cells.
///
/// # Errors
/// If the maze has more than 32 columns or rows.
pub fn best_score(walls: &impl Walls) -> Result<Option<f32>, TooLarge> {
    let grid = walls.grid();
    let passages = Passages::<32>::new(walls, Unknown::Closed)?;
    let roads = Roads::new(grid, &passages, TurnsAtStart::Free);
    let goals: Vec<Cell> = grid.middle().collect();
    let run = plan(&roads, LatticePose::START, |stand| ends_run(stand, &goals));
    Ok(run.map(|run| score(run.cost)))
}

/// Returns whether a movement that ends at a stand ends a run. In the smallest mazes the start lies
/// in the middle as well.
pub(super) fn ends_run(stand: LatticePose, goals: &[Cell]) -> bool {
    stand.place != LatticePoint::START && goals.contains(&stand.place.cell())
}

/// A plan: stands one movement apart, and the cost of the movements, in halves.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) stands: Vec<LatticePose>,
    pub(super) cost: u32,
}

impl Plan {
    /// Returns the sides of cells over which the plan drives.
    pub(super) fn edges(&self, grid: Grid) -> impl Iterator<Item = (Cell, Direction)> {
        let later = self.stands.iter().skip(1);
        let movements = self.stands.iter().zip(later);
        movements.flat_map(move |(from, to)| edges(grid, *from, *to))
    }
}

/// Returns the cheapest way from `from` to a stand for which `is_goal` is true.
pub(super) fn plan<const N: usize>(
    roads: &Roads<'_, N>,
    from: LatticePose,
    is_goal: impl Fn(LatticePose) -> bool,
) -> Option<Plan> {
    let Found { path, cost, .. } = a_star(
        roads,
        roads.node(from),
        |node| is_goal(roads.stand(node)),
        |_| 0,
    )?;
    let stands = path.into_iter().map(|node| roads.stand(node)).collect();
    Some(Plan { stands, cost })
}

/// Returns a cost in halves in the simulator's unit.
pub(super) fn score(halves: u32) -> f32 {
    halves as f32 / 2.0
}
