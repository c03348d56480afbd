use tolman_maze::Direction;

use super::{RunState, SlalomTimes};

/// One move of a speed run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunMove {
    /// A number of cells straight on.
    Straight {
        /// Number of cells, 1 or more.
        cells: u16,
    },
    /// A number of cells straight on along a diagonal, from edge to edge.
    Diagonal {
        /// Number of cells, 1 or more.
        cells: u16,
    },
    /// A slalom turn.
    Turn {
        /// Kind of the slalom turn.
        slalom: Slalom,
        /// Side to which the mouse turns.
        side: Side,
    },
}

/// The slalom turns. Each contains the straight that it needs before and behind it.
///
/// The descriptions are for a mouse in the middle of a cell that looks north and turns right. Out
/// of a diagonal, the mouse stands on a cell's western edge, looks north-east and turns to its only
/// possible side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slalom {
    /// 45°: from the middle of a cell through the cell to the north onto that one's eastern edge.
    /// Also the reverse: from a diagonal through the northern edge into the middle of the cell
    /// there.
    F45,
    /// 90°: through the cell to the north into the middle of the cell east of that one.
    F90,
    /// 135°: through the cells to the north and north-east onto the southern edge of the latter.
    /// It is also driven the other way round.
    F135,
    /// 180°: through the cells to the north and north-east into the cell to the east.
    F180,
    /// 90° from diagonal to diagonal: through the northern edge and out through the western edge of
    /// the cell there.
    Fv90,
}

/// A move of a speed run and where it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunStep {
    /// State of the mouse before the step.
    pub from: RunState,
    /// Straight or turn of this step.
    pub run_move: RunMove,
}

impl RunStep {
    /// Returns the sides by which the mouse leaves the cells in turn, from the cell of
    /// [`RunStep::from`] to that of the state after the move.
    pub fn directions(self) -> impl Iterator<Item = Direction> {
        // The directions form a pattern, which starts again when it is used up.
        let (pattern, period, count) = match (self.from, self.run_move) {
            (RunState::Straight { heading, .. }, RunMove::Turn { slalom, side }) => {
                let to_side = match side {
                    Side::Left => heading.left(),
                    Side::Right => heading.right(),
                };
                let count = match slalom {
                    Slalom::F45 | Slalom::F90 => 2,
                    Slalom::F135 | Slalom::F180 | Slalom::Fv90 => 3,
                };
                ([heading, to_side, heading.opposite()], 3, count)
            }
            (RunState::Diagonal { into, out, .. }, RunMove::Turn { slalom, .. }) => {
                let count = if slalom == Slalom::F45 { 1 } else { 2 };
                ([out, into.opposite(), out], 3, count)
            }
            (
                RunState::Straight { heading, .. },
                RunMove::Straight { cells } | RunMove::Diagonal { cells },
            ) => ([heading; 3], 1, cells),
            (
                RunState::Diagonal { into, out, .. },
                RunMove::Straight { cells } | RunMove::Diagonal { cells },
            ) => ([out, into, out], 2, cells),
        };
        pattern.into_iter().take(period).cycle().take(count.into())
    }
}

impl RunStep {
    /// Returns the letter of the move as kerikun11/micromouse-maze-library has it
    /// (`RobotBase::FastAction`), and how often it is written: a straight of three cells is `SSS`.
    ///
    /// `S` is a cell straight on and `w` half a cell's diagonal. Turns to the left and right are
    /// `z` and `c` for F45, `q` and `Q` for F90, `a` and `d` for F135. They are `u` and `U` for
    /// F180, `p` and `P` for FV90. F45 and F135 out of a diagonal are `Z`, `C`, `A` and `D`.
    #[must_use]
    pub const fn letters(self) -> (char, u16) {
        let (slalom, side) = match self.run_move {
            RunMove::Straight { cells } => return ('S', cells),
            RunMove::Diagonal { cells } => return ('w', cells),
            RunMove::Turn { slalom, side } => (slalom, side),
        };
        let (left, right) = match (slalom, self.from) {
            (Slalom::F45, RunState::Straight { .. }) => ('z', 'c'),
            (Slalom::F45, RunState::Diagonal { .. }) => ('Z', 'C'),
            (Slalom::F135, RunState::Straight { .. }) => ('a', 'd'),
            (Slalom::F135, RunState::Diagonal { .. }) => ('A', 'D'),
            (Slalom::F90, _) => ('q', 'Q'),
            (Slalom::F180, _) => ('u', 'U'),
            (Slalom::Fv90, _) => ('p', 'P'),
        };
        match side {
            Side::Left => (left, 1),
            Side::Right => (right, 1),
        }
    }
}

/// Side of a turn: left or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The mouse turns counter-clockwise.
    Left,
    /// The mouse turns clockwise.
    Right,
}

impl SlalomTimes {
    /// Returns the duration of this turn, ms.
    #[must_use]
    pub const fn time_ms(&self, slalom: Slalom) -> u16 {
        match slalom {
            Slalom::F45 => self.f45_ms,
            Slalom::F90 => self.f90_ms,
            Slalom::F135 => self.f135_ms,
            Slalom::F180 => self.f180_ms,
            Slalom::Fv90 => self.fv90_ms,
        }
    }
}
