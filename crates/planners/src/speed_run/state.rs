use tolman_maze::{Cell, Direction};

/// Place and heading of a speed run between two moves.
///
/// Straights begin and end in the middle of a cell, or, beside turns within a cell, of an edge
/// between two cells. Diagonals do in the middle of an edge. These are the nodes of
/// kerikun11/micromouse-maze-library (`StepMapSlalom::Index`), numbered by the cell ahead, and four
/// more: sixteen for every cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunState {
    /// The mouse is in the middle of `cell`, looking to `heading`.
    Straight {
        /// The cell the mouse is in.
        cell: Cell,
        /// Heading of the mouse.
        heading: Direction,
    },
    /// On the edge through which the mouse enters `cell` in direction `into`, looking at 45°
    /// between `into` and `out`. It crosses the cell and leaves it to `out`, a direction beside
    /// `into`.
    Diagonal {
        /// The cell the mouse is about to cross.
        cell: Cell,
        /// Direction in which the mouse enters the cell.
        into: Direction,
        /// Direction in which the mouse leaves the cell.
        out: Direction,
    },
    /// The mouse is on the edge through which it enters `cell`, looking to `heading`.
    Edge {
        /// The cell the mouse is about to enter.
        cell: Cell,
        /// Heading of the mouse.
        heading: Direction,
    },
}

/// The states of a cell are numbered. 0 … 3 are straight to north, east, south and west. From 4 on
/// they are diagonal: twice the way in, plus one if it leaves to the right. From 12 on they are on
/// an edge, looking to north, east, south and west.
pub(super) const STATES_PER_CELL: usize = 16;

/// A [`RunState`] by number, in a maze whose rows are `N` cells apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    pub(super) cell: usize,
    /// Number within the cell.
    pub(super) state: usize,
}

/// Direction of a state within its cell.
#[derive(Clone, Copy)]
pub(super) enum Facing {
    /// A straight state: the mouse looks in this direction.
    Straight(usize),
    /// A diagonal state: the mouse enters in the first direction and leaves in the second.
    Diagonal(usize, usize),
    /// A state on an edge: the mouse looks in this direction.
    Edge(usize),
}

pub(super) const fn left(direction: usize) -> usize {
    (direction + 3) % 4
}

pub(super) const fn right(direction: usize) -> usize {
    (direction + 1) % 4
}

pub(crate) const fn opposite(direction: usize) -> usize {
    (direction + 2) % 4
}

impl Node {
    /// Returns the state of `cell` with this number within the cell.
    #[inline(always)]
    pub(super) const fn numbered(cell: usize, state: usize) -> Self {
        Self { cell, state }
    }

    pub(super) const fn straight(cell: usize, heading: usize) -> Self {
        Self::numbered(cell, heading)
    }

    /// Returns the diagonal state; `out` lies to the left or right of `into`.
    pub(super) const fn diagonal(cell: usize, into: usize, out: usize) -> Self {
        let turns_right = (out + 4 - into) % 4 == 1;
        Self::numbered(cell, 4 + 2 * into + turns_right as usize)
    }

    pub(super) const fn edge(cell: usize, heading: usize) -> Self {
        Self::numbered(cell, 12 + heading)
    }

    pub(super) const fn facing(self) -> Facing {
        match self.state {
            heading @ 0..4 => Facing::Straight(heading),
            edge @ 12.. => Facing::Edge(edge % 4),
            diagonal => {
                let into = (diagonal - 4) / 2 % 4;
                let out = if diagonal % 2 == 1 {
                    right(into)
                } else {
                    left(into)
                };
                Facing::Diagonal(into, out)
            }
        }
    }

    /// Returns the same place with the opposite heading.
    pub(super) const fn reversed<const N: usize>(self) -> Self {
        match self.facing() {
            Facing::Straight(heading) => Self::straight(self.cell, opposite(heading)),
            Facing::Diagonal(into, out) => Self::diagonal(
                beside::<N>(self.cell, opposite(into)),
                opposite(into),
                opposite(out),
            ),
            Facing::Edge(heading) => {
                Self::edge(beside::<N>(self.cell, opposite(heading)), opposite(heading))
            }
        }
    }

    pub(super) const fn new<const N: usize>(state: RunState) -> Self {
        match state {
            RunState::Straight { cell, heading } => {
                Self::straight(index::<N>(cell), heading.index())
            }
            RunState::Diagonal { cell, into, out } => {
                Self::diagonal(index::<N>(cell), into.index(), out.index())
            }
            RunState::Edge { cell, heading } => Self::edge(index::<N>(cell), heading.index()),
        }
    }

    pub(super) fn cell_of<const N: usize>(self) -> Cell {
        Cell::new((self.cell % N) as u16, (self.cell / N) as u16)
    }

    pub(super) fn run_state<const N: usize>(self) -> RunState {
        let cell = self.cell_of::<N>();
        match self.facing() {
            Facing::Straight(heading) => RunState::Straight {
                cell,
                heading: direction(heading),
            },
            Facing::Diagonal(into, out) => RunState::Diagonal {
                cell,
                into: direction(into),
                out: direction(out),
            },
            Facing::Edge(heading) => RunState::Edge {
                cell,
                heading: direction(heading),
            },
        }
    }
}

/// Returns the cell on the other side of an edge that is open. (Off the maze the number is that of
/// no cell or of a wrong one; no open edge leads there.)
pub(crate) const fn beside<const N: usize>(cell: usize, direction: usize) -> usize {
    let steps = [N, 1, N.wrapping_neg(), 1_usize.wrapping_neg()];
    cell.wrapping_add(steps[direction % 4])
}

pub(super) const fn index<const N: usize>(cell: Cell) -> usize {
    cell.y as usize * N + cell.x as usize
}

pub(super) const fn direction(index: usize) -> Direction {
    Direction::ALL[index % 4]
}
