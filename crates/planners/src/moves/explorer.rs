use tolman_maze::{Cell, Walls};

use super::hopes::Hopes;
use super::outlook::Outlook;
use super::{Leap, MoveExplorerConfig, MoveExplorerConfigError, MoveMap};
use crate::{Passages, Unknown};

/// Explores a maze until the best run is known for certain.
///
/// The paper's *open path* takes all unknown walls for open, its *close path* for walls (section 3.3.2); when both
/// are equally long nothing better can turn up. Here both are counted in steps of the run that will be made, so
/// that the proof holds for that run; in the paper they are counted in cells.
///
/// Which wall to look at next is our own:
///
/// - Walls matter that lie on a run better than the best known one. The mouse looks first at those that the best
///   runs of all depend on (they have to be looked at whatever else turns up), and at near ones before far ones.
/// - While no way to the goal is known, it does so only where it is as good as on its way; else it makes for the
///   goal by the way that takes fewest steps if all unknown walls are open. Where it could stop and look on the way,
///   unknown sides that it would see are worth a detour.
/// - As soon as a way is known the mouse drives to the goal, where it has to be once anyway; only then it looks at the rest.
///
/// It always ends: each stop it makes for shows a wall nobody has looked at, and on the way there that stop only gets more
/// attractive.
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
    ///
    /// # Errors
    /// If a weight is out of its range.
    pub fn new(config: MoveExplorerConfig, start: Cell) -> Result<Self, MoveExplorerConfigError> {
        config.check()?;
        Ok(Self {
            config,
            start,
            goal: Goal::Ahead,
        })
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
            // Sooner or later it has to be there, and it is seldom nearer than now.
            (Some(_), Goal::Ahead) => nearest(goals, &here),
            (Some(closed), Goal::Visited) => {
                let proof = self.best_proof(&hopes, &here, open, closed);
                proof.map(|(_, cell)| cell)
            }
            (None, _) => {
                // Nobody knows yet which runs matter besides the best ones.
                let proof = self.best_proof(&hopes, &here, open, open + 1);
                proof
                    .filter(|(worth, _)| *worth > self.config.early_proof)
                    .map(|(_, cell)| cell)
                    .or_else(|| self.best_approach(&hopes, &here))
            }
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
    fn best_approach<W: Walls>(&self, hopes: &Hopes<'_, N, W>, here: &MoveMap<N>) -> Option<Cell> {
        let config = &self.config;
        let outlook = Outlook::new(hopes);
        let approach = best(hopes, here, |cell, moves| {
            let onward = f32::from(hopes.to_goal.moves(cell)?)
                + config.unknown_wall * f32::from(outlook.unknown_walls(cell));
            let seen = hopes.unknown_sides(cell).count() as f32;
            Some(config.sight * seen - config.known_step * f32::from(moves) - onward)
        });
        approach.map(|(_, cell)| cell)
    }

    /// What to look at for the proof, and what it is worth, when runs of `closed` steps and more do not matter
    /// and the best that can be hoped for takes `open`.
    fn best_proof<W: Walls>(
        &self,
        hopes: &Hopes<'_, N, W>,
        here: &MoveMap<N>,
        open: u16,
        closed: u16,
    ) -> Option<(f32, Cell)> {
        let config = &self.config;
        best(hopes, here, |cell, moves| {
            let mut told = 0.0;
            for side in hopes.unknown_sides(cell) {
                if let Some(run) = hopes.run_through(cell, side)
                    && run < closed
                {
                    told += config.base + power(config.patience, run - open);
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

/// The highest score, and the cell that has it, those the mouse can drive to and see something new from. `score` is given a
/// cell and the steps to it. Of equals the first by [`tolman_maze::Grid::index`].
fn best<const N: usize, W: Walls>(
    hopes: &Hopes<'_, N, W>,
    here: &MoveMap<N>,
    score: impl Fn(Cell, u16) -> Option<f32>,
) -> Option<(f32, Cell)> {
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
    best
}

/// A whole power.
fn power(base: f32, exponent: u16) -> f32 {
    (0..exponent).fold(1.0, |power, _| power * base)
}
