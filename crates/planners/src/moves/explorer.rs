use tolman_maze::{Cell, Walls};

use super::hopes::Hopes;
use super::outlook::Outlook;
use super::{Leap, MoveExplorerConfig, MoveMap};
use crate::{Passages, Unknown};

/// Explores a maze until the best run is known for certain.
///
/// The paper's *open path* takes all unknown walls for open, its *close path* for walls (section 3.3.2); when both
/// are equally long nothing better can turn up. Here both are counted in steps of the run that will be made, so
/// that the proof holds for that run; in the paper they are counted in cells.
///
/// Which wall to look at next is our own:
///
/// - While no way to the goal is known, the mouse makes for it by the way that takes fewest steps if all unknown
///   walls are open. Where it could stop and look on the way there, unknown sides that it would see are worth a
///   detour, those on the best runs from the *start* more so.
/// - Then only walls matter that lie on a run better than the known one. The mouse looks first at those that the
///   best runs of all depend on (they have to be looked at whatever else turns up), and at near ones before far
///   ones.
///
/// The explorer remembers nothing but whether it has been at the goal; it compares everything else with `walls` at each
/// call, so walls may be forgotten again at any time.
#[derive(Clone, Debug)]
pub struct MoveExplorer<const N: usize> {
    config: MoveExplorerConfig,
    start: Cell,
    goal: Goal,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    Ahead,
    Visited,
}

/// What an explorer wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveDecision {
    /// Drive there, and look around.
    Drive(Leap),
    /// Turn right on the spot, to see what lies behind.
    Turn,
    /// The mouse was at a goal, and no run from the start takes fewer steps than the best known one, whatever
    /// the walls nobody has looked at. It takes so many:
    Finished {
        /// Steps.
        moves: u16,
    },
    /// No way leads to a goal.
    Stuck,
}

impl<const N: usize> MoveExplorer<N> {
    /// An explorer for a mouse that makes its runs from `start` and has seen nothing.
    #[must_use]
    pub const fn new(config: MoveExplorerConfig, start: Cell) -> Self {
        Self {
            config,
            start,
            goal: Goal::Ahead,
        }
    }

    /// What to do in the cell `at`, once what is seen from there is in `walls`, to reach one of `goals`. O(N²).
    #[must_use]
    pub fn decide(&mut self, walls: &impl Walls, goals: &[Cell], at: Cell) -> MoveDecision {
        if goals.contains(&at) {
            self.goal = Goal::Visited;
        }
        let certain = Passages::new(walls, Unknown::Closed);
        let hoped = Passages::new(walls, Unknown::Open);
        let from_start = MoveMap::new(&hoped, [self.start]);
        let to_goal = MoveMap::new(&hoped, goals.iter().copied());
        let Some(open) = to_goal.moves(self.start) else {
            return MoveDecision::Stuck;
        };
        let closed = MoveMap::new(&certain, goals.iter().copied()).moves(self.start);
        let hopes = Hopes {
            walls,
            hoped: &hoped,
            from_start: &from_start,
            to_goal: &to_goal,
            goals,
        };
        if hopes.unknown_sides(at).next().is_some() {
            // Only at the start has the mouse not seen what lies behind it: from then on it has seen, before
            // it drives along a row of cells, how far that row goes to both sides.
            return MoveDecision::Turn;
        }
        let here = MoveMap::new(&certain, [at]);
        let target = match (closed, self.goal) {
            (Some(moves), Goal::Visited) if moves == open => {
                return MoveDecision::Finished { moves };
            }
            (Some(moves), Goal::Ahead) if moves == open => nearest(goals, &here),
            (Some(closed), _) => self.best_proof(&hopes, &here, open, closed),
            (None, _) => self.best_approach(&hopes, &here, open),
        };
        let Some(target) = target else {
            return MoveDecision::Stuck;
        };
        let back = MoveMap::new(&certain, [target]);
        let left = back.moves(at).and_then(|moves| moves.checked_sub(1));
        // Of the ways there, the one with most to see on it.
        Leap::all(&certain, at)
            .filter(|leap| left.is_some() && back.moves(leap.end) == left)
            .max_by_key(|leap| hopes.unknown_sides(leap.end).count())
            .map_or(MoveDecision::Stuck, MoveDecision::Drive)
    }

    /// Where to look while no way to the goal is known.
    fn best_approach<W: Walls>(
        &self,
        hopes: &Hopes<'_, N, W>,
        here: &MoveMap<N>,
        open: u16,
    ) -> Option<Cell> {
        let config = &self.config;
        let outlook = Outlook::new(hopes);
        best(hopes, here, |cell, moves| {
            let (mut unknown, mut relevant) = (0.0, 0.0);
            for side in hopes.unknown_sides(cell) {
                unknown += 1.0;
                if hopes.run_through(cell, side) == Some(open) {
                    relevant += 1.0;
                }
            }
            let onward = f32::from(hopes.to_goal.moves(cell)?)
                + config.unknown_wall * f32::from(outlook.unknown_walls(cell));
            let worth = config.sight * unknown + config.relevant_sight * relevant;
            Some(worth - config.known_step * f32::from(moves) - onward)
        })
    }

    /// Where to look once a way of `closed` steps is known, which can be undercut by one of `open` steps.
    fn best_proof<W: Walls>(
        &self,
        hopes: &Hopes<'_, N, W>,
        here: &MoveMap<N>,
        open: u16,
        closed: u16,
    ) -> Option<Cell> {
        let config = &self.config;
        best(hopes, here, |cell, moves| {
            let mut told = 0.0;
            for side in hopes.unknown_sides(cell) {
                if let Some(run) = hopes.run_through(cell, side)
                    && run < closed
                {
                    told += config.base + libm::powf(config.patience, f32::from(run - open));
                }
            }
            (told > 0.0).then(|| told / libm::powf(f32::from(moves), config.nearness))
        })
    }
}

/// The goal that takes fewest steps to drive to.
fn nearest<const N: usize>(goals: &[Cell], here: &MoveMap<N>) -> Option<Cell> {
    let reached = goals.iter().filter(|goal| here.moves(**goal).is_some());
    reached.min_by_key(|goal| here.moves(**goal)).copied()
}

/// The cell that scores highest among those the mouse can drive to and see something new from. `score` is given a
/// cell and the steps to it. Of equals the first by [`tolman_maze::Grid::index`].
fn best<const N: usize, W: Walls>(
    hopes: &Hopes<'_, N, W>,
    here: &MoveMap<N>,
    score: impl Fn(Cell, u16) -> Option<f32>,
) -> Option<Cell> {
    let mut best: Option<(f32, Cell)> = None;
    for cell in hopes.walls.grid().cells() {
        if let Some(moves @ 1..) = here.moves(cell)
            && hopes.unknown_sides(cell).next().is_some()
            && let Some(score) = score(cell, moves)
            && best.is_none_or(|(highest, _)| score > highest)
        {
            best = Some((score, cell));
        }
    }
    best.map(|(_, cell)| cell)
}
