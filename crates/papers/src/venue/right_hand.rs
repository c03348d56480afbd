//! Tours that keep the right hand on the wall.

use alloc::collections::BTreeSet;

use tolman_maze::{Cell, Direction, Maze};

/// Returns the percentage of starts, each a cell with a direction, from which an exact right-hand
/// tour never reaches a goal. They are on a loop round an island of walls. O(cells²).
pub(super) fn trapped_percent(maze: &Maze) -> f64 {
    let steps = maze.steps_to_goal();
    let leads_on = |cell: &Cell| steps[maze.grid().index(*cell)].is_some_and(|steps| steps > 0);
    let cells = maze.grid().cells().filter(leads_on);
    let starts: Vec<(Cell, Direction)> = cells
        .flat_map(|cell| Direction::ALL.map(|direction| (cell, direction)))
        .collect();
    let trapped = starts.iter().filter(|start| is_trapped(maze, **start));
    100.0 * trapped.count() as f64 / starts.len().max(1) as f64
}

fn is_trapped(maze: &Maze, start: (Cell, Direction)) -> bool {
    let (mut cell, mut ahead) = start;
    let mut seen = BTreeSet::new();
    while seen.insert((cell, ahead)) {
        if maze.goals().contains(&cell) {
            return false;
        }
        let order = [ahead.right(), ahead, ahead.left(), ahead.opposite()];
        let mut ways = order.into_iter();
        let way = ways.find_map(|way| Some((maze.beside(cell, way)?, way)));
        let Some(next) = way else {
            return true;
        };
        (cell, ahead) = next;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks a cycle of corridors round a block, whose goal is beyond a door in the outer wall.
    #[test]
    fn who_keeps_to_the_island_goes_round_for_ever() {
        let maze = tolman_maze::read(
            "\
o---o---o---o---o
|           |   |
o   o---o   o   o
|   |   |   |   |
o   o---o   o   o
|             G |
o---o---o---o---o
",
        )
        .unwrap()
        .maze;
        let at = |x, y, direction| is_trapped(&maze, (Cell::new(x, y), direction));
        // North up the western side: the outer wall is on the left, the island on the right.
        assert!(at(0, 1, Direction::North));
        assert!(!at(0, 1, Direction::South));
        let percent = trapped_percent(&maze);
        assert!(percent > 20.0 && percent < 60.0, "{percent}");
    }

    #[test]
    fn without_a_loop_nobody_is_trapped() {
        let maze = super::super::j_maze().unwrap().maze;
        assert!(trapped_percent(&maze).abs() < 1e-12);
    }
}
