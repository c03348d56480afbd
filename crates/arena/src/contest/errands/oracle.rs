use tolman_maze::{Cell, Direction, Maze};

use super::Errands;
use super::plan::ErrandPlan;

/// Returns the metres that an oracle drives until each delivery, from the middle of a cell on. It
/// knows the world, with its doors as they stand, and takes the shortest way of each errand along
/// the middles of the corridors. `None` if it cannot reach a landmark.
pub(super) fn deliveries(mut plan: ErrandPlan, from: Cell, pitch: f64) -> Option<Vec<f64>> {
    let mut at = Spot {
        cell: from,
        entered: None,
    };
    let (mut driven, mut deliveries) = (0.0, Vec::new());
    for _ in 0..Errands::OF_THE_ORACLE {
        let to = plan.next().to;
        let (there, way) = nearest(plan.maze(), at, to)?;
        at = there;
        driven += way * pitch;
        deliveries.push(driven);
    }
    Some(deliveries)
}

/// Where a robot stands that has just come into a cell, or is in the middle of its first one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Spot {
    pub(super) cell: Cell,
    /// Side of the cell on which it came in.
    pub(super) entered: Option<Direction>,
}

/// Returns where a robot comes into the nearest cell of a landmark, and how far that is, in cells.
///
/// A landmark is sensed in all of its cell, so a robot delivers as soon as it comes in, and saves a
/// cell if it leaves on the same side.
pub(super) fn nearest(maze: &Maze, from: Spot, landmark: u32) -> Option<(Spot, f64)> {
    let cells = maze.landmarks().iter().filter(|(_, of)| **of == landmark);
    let cells: Vec<Cell> = cells.map(|(cell, _)| *cell).collect();
    if cells.contains(&from.cell) {
        return Some((from, 0.0));
    }
    let steps = maze.steps_to(&cells);
    let left = |cell: Cell| steps[maze.grid().index(cell)];
    let begun = |side: Direction| match from.entered {
        None => 0.5,
        Some(entered) if entered == side => 0.0,
        Some(_) => 1.0,
    };
    let ways = maze.neighbours(from.cell);
    let ways =
        ways.filter_map(|(side, next)| Some((begun(side) + f64::from(left(next)?), side, next)));
    let (metres, mut side, mut at) = ways.min_by(|a, b| a.0.total_cmp(&b.0))?;
    while !cells.contains(&at) {
        let mut onward = maze.neighbours(at);
        (side, at) = onward.find(|(_, next)| left(*next) < left(at))?;
    }
    let entered = Some(side.opposite());
    Some((Spot { cell: at, entered }, metres))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oracle_turns_where_it_comes_in() {
        let text = "o---o---o---o---o---o\n| 1   S       2   G |\no---o---o---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        let start = Spot {
            cell: Cell::new(1, 0),
            entered: None,
        };
        let (two, way) = nearest(&maze, start, 2).unwrap();
        assert_eq!(
            (two.cell, two.entered, way),
            (Cell::new(3, 0), Some(Direction::West), 1.5)
        );
        let (one, way) = nearest(&maze, two, 1).unwrap();
        assert_eq!(
            (one.cell, one.entered, way),
            (Cell::new(0, 0), Some(Direction::East), 2.0)
        );
        assert_eq!(nearest(&maze, one, 1), Some((one, 0.0)));
        assert_eq!(nearest(&maze, one, 3), None);
        // From its other side it is a cell more.
        let beyond = Spot {
            cell: Cell::new(3, 0),
            entered: Some(Direction::East),
        };
        assert_eq!(nearest(&maze, beyond, 1).map(|(_, way)| way), Some(3.0));
    }
}
