//! Plays both runs of one mouse in one maze.

use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::Standing;
use tolman_systems::micromouse::{Driver, Order, Search, Sight};

use super::{MAX_STEPS, Referee, Ruling, ScoreSheet};
use crate::BoxError;
use crate::registry::because;
use crate::run::{TaskEnd, within};

/// Result of one mouse in one maze.
#[derive(Clone, Debug, PartialEq)]
pub struct MouseTrial {
    /// Every order that counted, in order.
    pub steps: Vec<RefereedStep>,
    /// Records of the referee.
    pub verdict: ScoreSheet,
    /// End of both runs.
    pub end: TaskEnd,
}

/// One step of a trial, as the referee saw it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefereedStep {
    /// Reading before the order.
    pub sight: Sight,
    /// Order of the mouse.
    pub order: Order,
    /// Ruling on the order.
    pub event: Ruling,
    /// Cell of the mouse afterwards.
    pub cell: Cell,
    /// Heading of the mouse afterwards.
    pub heading: Direction,
}

/// Side of a cell that a mouse has looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SideSeen {
    /// Cell to which the side belongs.
    pub cell: Cell,
    /// Side of the cell.
    pub side: Direction,
    /// Whether a wall stands on that side.
    pub stands: bool,
}

/// Returns the sides of cells that a mouse sees from `cell`, with `heading`: those along its three
/// lines of sight, up to the first wall.
#[must_use]
pub fn sides_seen(sight: Sight, cell: Cell, heading: Direction) -> Vec<SideSeen> {
    let lines = [
        (heading.left(), sight.left),
        (heading, sight.front),
        (heading.right(), sight.right),
    ];
    let line = |(side, open): (Direction, u16)| {
        let (east, north) = side.step();
        (0..=open).map(move |steps| SideSeen {
            cell: Cell::new(
                cell.x.wrapping_add_signed(i16::from(east) * steps as i16),
                cell.y.wrapping_add_signed(i16::from(north) * steps as i16),
            ),
            side,
            stands: steps == open,
        })
    };
    lines.into_iter().flat_map(line).collect()
}

impl MouseTrial {
    /// Lets the mouse run until it is done, gives up or has no step left. Calls `see` with every
    /// step as soon as it is made, and with the mouse after it.
    ///
    /// # Errors
    /// If the referee refuses the maze or an order.
    pub fn play<S: Search>(
        maze: &Maze,
        mouse: &mut Driver<S>,
        mut see: impl FnMut(&RefereedStep, &Driver<S>),
    ) -> Result<Self, BoxError> {
        let mut referee = Referee::new(maze)?;
        let mut steps = Vec::new();
        let ended = within(MAX_STEPS, || {
            let sight = referee.sight();
            let order = match mouse.next(sight) {
                Ok(order) => order,
                Err(error) => return Ok(Standing::gave_up(error.to_string())),
            };
            let event = referee.take(order).map_err(|error| {
                because(
                    "the mouse broke the rules; correct the order that it gave",
                    error,
                )
            })?;
            let (cell, heading) = referee.pose();
            let step = RefereedStep {
                sight,
                order,
                event,
                cell,
                heading,
            };
            see(&step, mouse);
            steps.push(step);
            Ok::<_, BoxError>(match event {
                Ruling::Finished => Standing::Done,
                _ => Standing::UnderWay,
            })
        })?;
        Ok(Self {
            steps,
            verdict: referee.verdict(),
            end: ended.end,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_sight_end_at_the_first_wall() {
        let sight = Sight {
            left: 0,
            front: 2,
            right: 1,
        };
        let seen = sides_seen(sight, Cell::new(3, 4), Direction::South);
        let told = seen
            .iter()
            .map(|seen| (seen.cell.x, seen.cell.y, seen.side, seen.stands));
        use Direction::{East, South, West};
        let expect = [
            (3, 4, East, true),
            (3, 4, South, false),
            (3, 3, South, false),
            (3, 2, South, true),
            (3, 4, West, false),
            (2, 4, West, true),
        ];
        assert_eq!(told.collect::<Vec<_>>(), expect);
    }
}
