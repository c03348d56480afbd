use tolman_maze::Direction;

use super::Leap;

/// A mouse's move in one step: first the turn, then the movement (the paper, section 1.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MouseStep {
    /// Turn in place before driving.
    pub turn: QuarterTurn,
    /// Number of cells to drive, −3 to 3; negative values drive back without turning round.
    pub cells: i8,
}

/// A quarter turn, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuarterTurn {
    /// A quarter turn counter-clockwise, −90°.
    Left,
    /// No turn, 0°.
    None,
    /// A quarter turn clockwise, 90°.
    Right,
}

impl QuarterTurn {
    /// Returns the turn in degrees, clockwise, as the paper counts it.
    #[must_use]
    pub const fn degrees(self) -> i32 {
        match self {
            Self::Left => -90,
            Self::None => 0,
            Self::Right => 90,
        }
    }

    /// Returns the heading after the turn of a mouse that looks to `heading`.
    #[must_use]
    pub const fn applied_to(self, heading: Direction) -> Direction {
        match self {
            Self::Left => heading.left(),
            Self::None => heading,
            Self::Right => heading.right(),
        }
    }
}

impl MouseStep {
    /// Returns the step by which a mouse that looks to `heading` makes `leap`. Sets `heading` to
    /// the mouse's new heading.
    #[must_use]
    pub fn of_leap(heading: &mut Direction, leap: Leap) -> Self {
        let cells = leap.cells.min(Leap::MOST_CELLS) as i8;
        let (turn, cells) = if leap.direction == heading.opposite() {
            (QuarterTurn::None, -cells)
        } else if leap.direction == heading.left() {
            (QuarterTurn::Left, cells)
        } else if leap.direction == heading.right() {
            (QuarterTurn::Right, cells)
        } else {
            (QuarterTurn::None, cells)
        };
        *heading = turn.applied_to(*heading);
        Self { turn, cells }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_is_a_right_angle_clockwise() {
        let turns = [QuarterTurn::Left, QuarterTurn::None, QuarterTurn::Right];
        assert_eq!(turns.map(QuarterTurn::degrees), [-90, 0, 90]);
    }
    use tolman_maze::Cell;

    #[test]
    fn every_leap_is_one_step_whatever_the_heading() {
        for before in Direction::ALL {
            for direction in Direction::ALL {
                let leap = Leap {
                    direction,
                    cells: 2,
                    end: Cell::new(5, 5),
                };
                let mut heading = before;
                let step = MouseStep::of_leap(&mut heading, leap);
                assert_eq!(step.turn.applied_to(before), heading);
                let driven = if step.cells < 0 {
                    heading.opposite()
                } else {
                    heading
                };
                assert_eq!((driven, step.cells.abs()), (direction, 2));
            }
        }
    }
}
