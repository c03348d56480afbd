//! Checks a mouse's proof that no second run takes fewer steps.

use tolman_maze::{Cell, Direction, Grid, Knowledge, Maze};
use tolman_systems::micromouse::Certificate;

/// Reason why a certificate is invalid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CertificateError {
    /// The certificate is about another maze.
    #[error(
        "the certificate is for a maze with another size, start or goals; check it with the maze it was made for"
    )]
    OtherMaze,
    /// The certificate states something false about a wall.
    #[error(
        "the certificate says that the {direction} side of {cell} is {known:?}, but it is not; explore the maze again"
    )]
    FalseWall {
        /// Cell of the wall.
        cell: Cell,
        /// Side of the cell.
        direction: Direction,
        /// State that the certificate claims.
        known: Knowledge,
    },
    /// The certificate lacks a number for some cell, or names a wall that the maze does not have.
    #[error("the certificate has {found} numbers for {cells} cells; give one per cell")]
    Size {
        /// Number of numbers in the certificate.
        found: usize,
        /// Number of cells.
        cells: usize,
    },
    /// The run does not lead from the start to a goal.
    #[error("the run has to begin at the start and end at a goal")]
    Ends,
    /// A step of the run is not known to be possible.
    #[error("step {index} of the run, from {from} to {to}, is not known to be possible")]
    Impossible {
        /// Number of the step, from 1.
        index: usize,
        /// Cell where the step begins.
        from: Cell,
        /// Cell where the step ends.
        to: Cell,
    },
    /// The costs do not agree with the run, or with each other.
    #[error(
        "the costs disagree: the run takes {run} steps, the certificate claims {closed}, and its lower bound is {open}"
    )]
    Costs {
        /// Number of steps of the run.
        run: usize,
        /// Length claimed for the run.
        closed: u32,
        /// Lower bound claimed for any run.
        open: u32,
    },
    /// A step breaks the lower bound.
    #[error(
        "the bound does not hold: a step from {from}, at least {at_least} from the goal, leads to {to}"
    )]
    Bound {
        /// Cell where the step begins.
        from: Cell,
        /// The number there.
        at_least: u32,
        /// Cell where the step ends.
        to: Cell,
    },
}

/// Maximum number of cells of a step, defined here again: the checker uses nothing of the planners.
const MOST_CELLS: u32 = 3;

/// Checks that `certificate` holds in `maze`. Its statements about walls must be true, its run
/// possible, and no run shorter in any maze that agrees with it. Uses only the maze types.
/// O(cells).
///
/// # Errors
/// [`CertificateError`] names the first fault.
pub fn check(certificate: &Certificate, maze: &Maze) -> Result<(), CertificateError> {
    let Certificate { grid, start, .. } = *certificate;
    let mut goals = certificate.goals.clone();
    goals.sort_unstable();
    if grid != maze.grid()
        || maze.start().map(|start| start.0) != Some(start)
        || goals != maze.goals()
    {
        return Err(CertificateError::OtherMaze);
    }
    let mut known = vec![Knowledge::Unknown; grid.wall_count()];
    for (cell, side) in grid.border() {
        known[grid.wall(cell, side).0 as usize] = Knowledge::Wall;
    }
    for &(wall, told) in &certificate.walls {
        let Some((cell, direction)) = grid.side(wall) else {
            return Err(CertificateError::OtherMaze);
        };
        if told != Knowledge::of_standing(maze.stands(wall)) {
            return Err(CertificateError::FalseWall {
                cell,
                direction,
                known: told,
            });
        }
        known[wall.0 as usize] = told;
    }
    let known = |cell, side| known[grid.wall(cell, side).0 as usize];
    check_run(certificate, &known)?;
    check_bound(certificate, &known)
}

fn check_run(
    certificate: &Certificate,
    known: &impl Fn(Cell, Direction) -> Knowledge,
) -> Result<(), CertificateError> {
    let Certificate { grid, run, .. } = certificate;
    let ends_right = run
        .last()
        .is_some_and(|end| certificate.goals.contains(end));
    if run.first() != Some(&certificate.start) || !ends_right {
        return Err(CertificateError::Ends);
    }
    for (index, step) in (1..).zip(run.windows(2)) {
        let (from, to) = (step[0], step[1]);
        let possible = Direction::ALL.into_iter().any(|direction| {
            reach(*grid, from, direction, |cell, side| {
                known(cell, side) == Knowledge::Open
            })
            .contains(&to)
        });
        if !possible {
            return Err(CertificateError::Impossible { index, from, to });
        }
    }
    let closed_cost = certificate.closed_cost;
    if run.len() != closed_cost as usize + 1 || closed_cost != certificate.open_cost {
        return Err(costs(certificate, certificate.open_cost));
    }
    Ok(())
}

fn check_bound(
    certificate: &Certificate,
    known: &impl Fn(Cell, Direction) -> Knowledge,
) -> Result<(), CertificateError> {
    let Certificate { grid, at_least, .. } = certificate;
    if at_least.len() != grid.cell_count() {
        return Err(CertificateError::Size {
            found: at_least.len(),
            cells: grid.cell_count(),
        });
    }
    let number = |cell: Cell| at_least[grid.index(cell)];
    if let Some(goal) = certificate.goals.iter().find(|goal| number(**goal) != 0) {
        return Err(CertificateError::Bound {
            from: *goal,
            at_least: number(*goal),
            to: *goal,
        });
    }
    let from_start = number(certificate.start);
    if from_start != certificate.open_cost {
        return Err(costs(certificate, from_start));
    }
    for from in grid.cells() {
        for direction in Direction::ALL {
            let ends = reach(*grid, from, direction, |cell, side| {
                known(cell, side) != Knowledge::Wall
            });
            if let Some(to) = ends.into_iter().find(|to| number(*to) + 1 < number(from)) {
                return Err(CertificateError::Bound {
                    from,
                    at_least: number(from),
                    to,
                });
            }
        }
    }
    Ok(())
}

/// Returns the error that the costs disagree, if `open` can be hoped for.
const fn costs(certificate: &Certificate, open: u32) -> CertificateError {
    CertificateError::Costs {
        run: certificate.run.len().saturating_sub(1),
        closed: certificate.closed_cost,
        open,
    }
}

/// Returns the cells in which one step in a direction may end, the nearest first.
fn reach(
    grid: Grid,
    from: Cell,
    direction: Direction,
    passable: impl Fn(Cell, Direction) -> bool,
) -> Vec<Cell> {
    let mut ends = Vec::new();
    let mut at = from;
    for _ in 0..MOST_CELLS {
        match grid.neighbour(at, direction) {
            Some(next) if passable(at, direction) => at = next,
            _ => break,
        }
        ends.push(at);
    }
    ends
}
