//! Plans the second run from the known walls.

use tolman_maze::Cell;
use tolman_planners::moves::{Leap, MoveMap};
use tolman_planners::{Passages, StepMap};

use super::SIDE;

/// Criterion of the second run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunTwo {
    /// The fewest steps.
    FewestMoves,
    /// The path of fewest steps among the paths of fewest cells. In the paper, section 3.3.2, it is
    /// the value map of A* and, of several shortest paths, "the one with minimum moves".
    FewestCells,
}

impl RunTwo {
    /// Returns the leaps from `start` to a goal, or `None` where no way leads to one.
    #[must_use]
    pub fn plan(self, known: &Passages<SIDE>, start: Cell, goals: &[Cell]) -> Option<Vec<Leap>> {
        match self {
            Self::FewestMoves => {
                let map = MoveMap::new(known, goals.iter().copied());
                map.moves(start)?;
                Some(map.way(known, start).collect())
            }
            Self::FewestCells => fewest_cells(known, start, goals),
        }
    }
}

/// Returns a plan of fewest cells: breadth-first over leaps that stay on shortest paths.
fn fewest_cells(known: &Passages<SIDE>, start: Cell, goals: &[Cell]) -> Option<Vec<Leap>> {
    let value = StepMap::new(known, goals.iter().copied());
    // By cell reached: the leap that led there first.
    let mut reached: Vec<(Cell, Option<(usize, Leap)>)> = vec![(start, None)];
    let mut next = 0;
    while let Some(&(cell, _)) = reached.get(next) {
        let steps = value.steps(cell)?;
        if steps == 0 {
            return Some(trace_back(&reached, next));
        }
        for leap in Leap::all(known, cell) {
            let on_path = value.steps(leap.end) == steps.checked_sub(leap.cells.into());
            if on_path && !reached.iter().any(|(cell, _)| *cell == leap.end) {
                reached.push((leap.end, Some((next, leap))));
            }
        }
        next += 1;
    }
    None
}

fn trace_back(reached: &[(Cell, Option<(usize, Leap)>)], end: usize) -> Vec<Leap> {
    let mut leaps = Vec::new();
    let mut at = end;
    while let Some((before, leap)) = reached[at].1 {
        leaps.push(leap);
        at = before;
    }
    leaps.reverse();
    leaps
}

#[cfg(test)]
mod tests {
    use super::*;
    use tolman_maze::{Direction, Grid, Maze};
    use tolman_planners::Unknown;

    #[test]
    fn a_longer_path_may_take_fewer_steps() {
        // A staircase of four cells against two straights of six.
        let mut maze = Maze::solid(Grid::new(4, 4));
        for at in 0..2 {
            maze.set_wall(Cell::new(at, at), Direction::East, false);
            maze.set_wall(Cell::new(at + 1, at), Direction::North, false);
        }
        for at in 0..3 {
            maze.set_wall(Cell::new(0, at), Direction::North, false);
            maze.set_wall(Cell::new(at, 3), Direction::East, false);
        }
        maze.set_wall(Cell::new(3, 2), Direction::North, false);
        maze.set_wall(Cell::new(2, 2), Direction::East, false);
        let known = Passages::new(&maze, Unknown::Closed).unwrap();
        let steps = |run_two: RunTwo, goal| {
            let plan = run_two.plan(&known, Cell::new(0, 0), &[goal]);
            plan.map(|leaps| leaps.len())
        };
        let goal = Cell::new(3, 2);
        assert_eq!(steps(RunTwo::FewestCells, goal), Some(5));
        assert_eq!(steps(RunTwo::FewestMoves, goal), Some(3));
        assert_eq!(steps(RunTwo::FewestMoves, Cell::new(2, 0)), None);
        assert_eq!(steps(RunTwo::FewestCells, Cell::new(2, 0)), None);
    }
}
