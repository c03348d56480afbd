use tolman_maze::{Cell, Direction, Grid};
use tolman_planners::lattice::{Gate, LatticeHeading, LatticePoint, LatticePose};

use super::Simulator;
use super::simulator::eighths_of;
use crate::micromouse::SideSeen;

/// Line of a mouse, and the reply.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// Line of the mouse.
    pub line: String,
    /// Reply of the simulator; `None` for a command without a reply.
    pub reply: Option<String>,
    /// Pose of the mouse afterwards.
    pub pose: LatticePose,
    /// Whether the mouse moved, turned, ran into a wall or was put back.
    pub is_movement: bool,
}

impl Exchange {
    /// Lets `simulator` answer a line.
    pub fn of(simulator: &mut Simulator<'_>, line: &str) -> Self {
        let count = |simulator: &Simulator<'_>| simulator.movements() + simulator.crashes();
        let before = count(simulator);
        let reply = simulator.answer(line);
        let is_movement = count(simulator) > before || line.trim() == "ackReset";
        Self {
            line: line.trim().to_owned(),
            reply,
            pose: simulator.pose(),
            is_movement,
        }
    }

    /// Returns the sides of cells that the reply reveals in a maze of this size; empty unless it
    /// answers a wall query. If a wall stands within several half-steps, its side alone is not
    /// known to be open.
    #[must_use]
    pub fn sides_seen(
        &self,
        grid: Grid,
        is_open: impl Fn(Cell, Direction) -> bool,
    ) -> Vec<SideSeen> {
        let mut words = self.line.split_ascii_whitespace();
        let eighths = words.next().and_then(eighths_of);
        let (Some(eighths), Some(reply)) = (eighths, self.reply.as_deref()) else {
            return Vec::new();
        };
        let half_steps = words.next().map_or(1, |text| text.parse().unwrap_or(0));
        let stands = reply == "true";
        let seen = |(cell, side)| SideSeen { cell, side, stands };
        let sides = self.sides_within(half_steps.max(1), eighths, grid);
        if !stands {
            return sides.map(seen).collect();
        }
        let mut shut = sides.filter(|(cell, side)| !is_open(*cell, *side));
        match (shut.next(), shut.next()) {
            (Some(only), None) => vec![seen(only)],
            _ => Vec::new(),
        }
    }

    /// Returns the sides of cells within `half_steps` half-steps, up to the border or a post.
    fn sides_within(
        &self,
        half_steps: usize,
        eighths: i8,
        grid: Grid,
    ) -> impl Iterator<Item = (Cell, Direction)> {
        let heading = self.pose.heading.turned(eighths);
        let places = core::iter::successors(Some(self.pose.place), move |place| {
            let ends = place.gate(heading, grid) == Gate::Solid;
            (!ends).then(|| place.ahead(heading))
        });
        places
            .take(half_steps)
            .filter_map(move |place| ahead(place, heading, grid))
    }
}

/// Returns the side of a cell that lies half a step ahead of a place, or `None` if there is none.
fn ahead(place: LatticePoint, heading: LatticeHeading, grid: Grid) -> Option<(Cell, Direction)> {
    let is_middle = place.x % 2 == 1 && place.y % 2 == 1;
    match (place.gate(heading, grid), heading.side()) {
        (Gate::None, _) => None,
        // The border is a side, too.
        (_, Some(side)) if is_middle => Some((place.cell(), side)),
        (Gate::Edge(cell, side), _) => Some((cell, side)),
        (Gate::Solid, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_for_a_wall_tells_of_it() {
        let maze = "+---+---+\n|     G |\n+   +   +\n| S |   |\n+---+---+\n";
        let maze = tolman_maze::read(maze).unwrap().maze;
        let mut simulator = Simulator::new(&maze);
        let mut seen = |line: &str| {
            let exchange = Exchange::of(&mut simulator, line);
            let is_open = |cell: Cell, side| cell.y == 0 && side == Direction::North;
            (
                exchange.is_movement,
                exchange.sides_seen(maze.grid(), is_open),
            )
        };
        let side = |y, side, stands| SideSeen {
            cell: Cell::new(0, y),
            side,
            stands,
        };
        assert_eq!(
            seen("wallRight"),
            (false, vec![side(0, Direction::East, true)])
        );
        assert_eq!(
            seen("wallFront 2"),
            (false, vec![side(0, Direction::North, false)])
        );
        assert_eq!(
            seen("wallFront 9"),
            (false, vec![side(1, Direction::North, true)]),
            "what is left"
        );
        assert_eq!(seen("moveForward"), (true, vec![]));
        assert_eq!(
            seen("wallRight"),
            (false, vec![side(1, Direction::East, false)])
        );
        assert_eq!(seen("mazeWidth"), (false, vec![]));
    }
}
