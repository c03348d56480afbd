use tolman_maze::Direction;

use super::state::{Facing, Node, beside, left, opposite, right};
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

/// Returns whether `sides` (one byte per cell) has `cell` open to `direction`.
#[inline(always)]
pub(super) fn is_open(sides: &[u8], cell: usize, direction: usize) -> bool {
    sides
        .get(cell)
        .is_some_and(|open| open >> direction & 1 == 1)
}

/// Calls `visit` with every turn that can be made from `node`, always in the same order.
///
/// A turn onto a diagonal is made only if the diagonal leads out of the cell it enters: otherwise
/// nothing could follow.
#[inline(always)]
pub(super) fn for_each_turn<const N: usize>(
    sides: &[u8],
    node: Node,
    mut visit: impl FnMut(Slalom, Side, Node),
) {
    let open = |cell, direction| is_open(sides, cell, direction);
    match node.facing() {
        Facing::Straight(ahead) => {
            if !open(node.cell, ahead) {
                return;
            }
            let back = opposite(ahead);
            let next = beside::<N>(node.cell, ahead);
            for (side, to_side) in [(Side::Left, left(ahead)), (Side::Right, right(ahead))] {
                if !open(next, to_side) {
                    continue;
                }
                let far = beside::<N>(next, to_side);
                visit(Slalom::F90, side, Node::straight(far, to_side));
                if open(far, ahead) {
                    visit(Slalom::F45, side, Node::diagonal(far, to_side, ahead));
                }
                if open(far, back) {
                    let near = beside::<N>(far, back);
                    visit(Slalom::F180, side, Node::straight(near, back));
                    if open(near, to_side) {
                        visit(Slalom::F135, side, Node::diagonal(near, back, to_side));
                    }
                }
            }
        }
        Facing::Diagonal(into, out) => {
            if !open(node.cell, out) {
                return;
            }
            let side = if out == left(into) {
                Side::Left
            } else {
                Side::Right
            };
            let next = beside::<N>(node.cell, out);
            visit(Slalom::F45, side, Node::straight(next, out));
            let back = opposite(into);
            if open(next, back) {
                let far = beside::<N>(next, back);
                visit(Slalom::F135, side, Node::straight(far, back));
                if open(far, out) {
                    visit(Slalom::Fv90, side, Node::diagonal(far, back, out));
                }
            }
        }
    }
}

/// Returns every cell count `n` and end of the straights that lead on from `node`, nearest first.
#[inline(always)]
pub(super) fn straights<const N: usize>(
    sides: &[u8],
    node: Node,
) -> impl Iterator<Item = (usize, Node)> {
    let mut cell = node.cell;
    // Along a diagonal the two directions take turns.
    let (mut into, mut out) = match node.facing() {
        Facing::Straight(ahead) => (ahead, ahead),
        Facing::Diagonal(into, out) => (into, out),
    };
    let is_straight = into == out;
    (1..).map_while(move |n| {
        if !is_open(sides, cell, out) {
            return None;
        }
        cell = beside::<N>(cell, out);
        (into, out) = (out, into);
        if is_straight {
            return Some((n, Node::straight(cell, out)));
        }
        // The edge reached has to lead on.
        is_open(sides, cell, out).then(|| (n, Node::diagonal(cell, into, out)))
    })
}
