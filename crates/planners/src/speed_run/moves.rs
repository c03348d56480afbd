use tolman_maze::Direction;

use super::RunState;

/// One move of a speed run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunMove {
    /// Straight on, between the middles of cells and of their sides.
    Straight {
        /// Number of half cells, 1 or more.
        half_cells: u16,
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
    /// 90° within a cell, as most first mice have it: from the middle of the side through which
    /// the mouse enters a cell to the middle of the side to the right. Driven as a curve or, with a
    /// stop in the middle of the cell, in place.
    Fs90,
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
        let to = |heading: Direction, side| match side {
            Side::Left => heading.left(),
            Side::Right => heading.right(),
        };
        let (pattern, period, count) = match (self.from, self.run_move) {
            (RunState::Straight { heading, .. }, RunMove::Turn { slalom, side }) => {
                let count = match slalom {
                    Slalom::F45 | Slalom::F90 | Slalom::Fs90 => 2,
                    Slalom::F135 | Slalom::F180 | Slalom::Fv90 => 3,
                };
                ([heading, to(heading, side), heading.opposite()], 3, count)
            }
            (RunState::Edge { heading, .. }, RunMove::Turn { side, .. }) => {
                ([to(heading, side); 3], 1, 1)
            }
            (RunState::Diagonal { into, out, .. }, RunMove::Turn { slalom, .. }) => {
                let count = if slalom == Slalom::F45 { 1 } else { 2 };
                ([out, into.opposite(), out], 3, count)
            }
            (RunState::Straight { heading, .. }, RunMove::Straight { half_cells }) => {
                ([heading; 3], 1, half_cells.div_ceil(2))
            }
            (RunState::Edge { heading, .. }, RunMove::Straight { half_cells }) => {
                ([heading; 3], 1, half_cells / 2)
            }
            (
                RunState::Straight { heading, .. } | RunState::Edge { heading, .. },
                RunMove::Diagonal { cells },
            ) => ([heading; 3], 1, cells),
            (
                RunState::Diagonal { into, out, .. },
                RunMove::Straight { half_cells: cells } | RunMove::Diagonal { cells },
            ) => ([out, into, out], 2, cells),
        };
        pattern.into_iter().take(period).cycle().take(count.into())
    }
}

impl RunStep {
    /// Returns the letter of the move as kerikun11/micromouse-maze-library has it
    /// (`RobotBase::FastAction`), and how often it is written: a straight of three cells is `SSS`,
    /// one with an odd number of half cells has `s` for each of them.
    ///
    /// `S` is a cell straight on, `s` half a cell, `w` half a cell's diagonal. Turns to the left
    /// and right are `z` and `c` for F45, `q` and `Q` for F90, `a` and `d` for F135. They are `u`
    /// and `U` for F180, `p` and `P` for FV90, `L` and `R` for FS90. F45 and F135 out of a diagonal
    /// are `Z`, `C`, `A` and `D`.
    #[must_use]
    pub const fn letters(self) -> (char, u16) {
        let (slalom, side) = match self.run_move {
            RunMove::Straight { half_cells } if half_cells % 2 == 0 => {
                return ('S', half_cells / 2);
            }
            RunMove::Straight { half_cells } => return ('s', half_cells),
            RunMove::Diagonal { cells } => return ('w', cells),
            RunMove::Turn { slalom, side } => (slalom, side),
        };
        let (left, right) = match (slalom, self.from) {
            (Slalom::F45, RunState::Diagonal { .. }) => ('Z', 'C'),
            (Slalom::F45, _) => ('z', 'c'),
            (Slalom::F135, RunState::Diagonal { .. }) => ('A', 'D'),
            (Slalom::F135, _) => ('a', 'd'),
            (Slalom::F90, _) => ('q', 'Q'),
            (Slalom::F180, _) => ('u', 'U'),
            (Slalom::Fv90, _) => ('p', 'P'),
            (Slalom::Fs90, _) => ('L', 'R'),
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

impl Side {
    /// Returns the other side.
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}
