//! The competition model of the micromouse on whole mazes: explore, prove, run.
//!
//! How the mouse decides is told in [`speed_run`](tolman_planners::speed_run); here is
//! the world that it drives in, cell by cell, and the judge of what it comes home with.
//!
//! ```
//! use tolman_arena::competition;
//! use tolman_planners::speed_run::SpeedRunConfig;
//!
//! let text = "\
//! o---o---o---o
//! |           |
//! o   o---o   o
//! |   | G     |
//! o   o---o   o
//! | S |       |
//! o---o---o---o
//! ";
//! let maze = tolman_maze::read(text)?.maze;
//! let exploration = competition::explore(&maze, &SpeedRunConfig::classic())?;
//! assert_eq!(exploration.cells, 12, "six there and six back");
//! assert_eq!(exploration.verdict, Ok(()));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use thiserror::Error;
use tolman_maps::wall_map::{ClosedCells, ObserveError, Ray, TooLarge, WallMap};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{
    CertificateError, Decision, SpeedRunCertificate, SpeedRunConfig, SpeedRunConfigError,
    SpeedRunExplorer, SpeedRunTimes,
};
use tolman_planners::{Passages, Unknown};

/// What came of an exploration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exploration {
    /// Moves from a cell to the next, from the start to the goal, wherever else, and back to the start.
    pub cells: u32,
    /// The run that the mouse found.
    pub certificate: SpeedRunCertificate,
    /// What the checker says to it: it sees the walls that the mouse knows, and no more.
    pub verdict: Result<(), CertificateError>,
}

/// Why a maze cannot be explored.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ExploreError {
    /// The mouse cannot be driven like that.
    #[error("the mouse cannot be driven as its configuration says")]
    Config(#[from] SpeedRunConfigError),
    /// The maze has more than 32 columns or rows.
    #[error("the maze does not fit into the mouse's map")]
    TooLarge(#[from] TooLarge),
    /// What is seen contradicts the map.
    #[error("the mouse sees what it knows to be different")]
    Observation(#[from] ObserveError),
    /// The mouse knows no way to a goal.
    #[error("the mouse in {at} sees no way to a goal any more")]
    NoWay {
        /// Where it is.
        at: Cell,
    },
}

/// Lets a mouse that looks at the walls of its cell, and remembers all, explore a maze from its start, or from the
/// south-western corner, looking north. O(cells driven · n) for n cells.
///
/// # Errors
/// If the maze has no way to a goal, or is larger than 32 × 32, or the times of the moves are too far apart.
pub fn explore(maze: &Maze, config: &SpeedRunConfig) -> Result<Exploration, ExploreError> {
    let grid = maze.grid();
    // What is known takes its time to be looked through.
    if grid.width().max(grid.height()) <= 16 {
        explore_within::<16>(maze, config)
    } else {
        explore_within::<32>(maze, config)
    }
}

fn explore_within<const N: usize>(
    maze: &Maze,
    config: &SpeedRunConfig,
) -> Result<Exploration, ExploreError> {
    let (home, heading) = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
    let times = SpeedRunTimes::<N>::new(config)?;
    let mut walls = WallMap::<N>::new(maze.grid(), ClosedCells::Possible)?;
    let mut explorer = SpeedRunExplorer::new(&times, home, heading, maze.goals());
    let (mut at, mut looks) = (home, heading);
    let mut cells = 0;
    loop {
        walls.observe(at, &Direction::ALL.map(|side| look(maze, at, side)))?;
        match explorer.decide(&walls, at, looks) {
            Decision::Drive(direction) => {
                let next = maze.grid().neighbour(at, direction);
                at = next.ok_or(ExploreError::NoWay { at })?;
                looks = direction;
                cells += 1;
            }
            Decision::Finished { run_ms } => {
                let known = Passages::new(&walls, Unknown::Closed);
                let run = explorer.planner().run(&known);
                let certificate = SpeedRunCertificate {
                    start: home,
                    heading,
                    moves: run.map(|step| step.run_move).collect(),
                    time_ms: run_ms.into(),
                };
                return Ok(Exploration {
                    cells,
                    verdict: certificate.check(&walls, config, maze.goals()),
                    certificate,
                });
            }
            Decision::Stuck => return Err(ExploreError::NoWay { at }),
        }
    }
}

/// What a sensor sees that looks no farther than the wall of its own cell.
fn look(maze: &Maze, cell: Cell, direction: Direction) -> Ray {
    if maze.is_open(cell, direction) {
        Ray::out_of_range(direction, 1)
    } else {
        Ray::to_wall(direction, 0)
    }
}

#[cfg(test)]
mod tests {
    use tolman_maze::Grid;

    use super::*;

    #[test]
    fn what_cannot_be_explored_is_refused() {
        let config = SpeedRunConfig::classic();
        let mut maze = Maze::open(Grid::new(33, 4));
        maze.set_goals(vec![Cell::new(3, 3)]);
        assert!(matches!(
            explore(&maze, &config),
            Err(ExploreError::TooLarge(_))
        ));
        let mut maze = Maze::open(Grid::new(4, 1));
        maze.set_start(Some((Cell::new(0, 0), Direction::East)));
        maze.set_goals(vec![Cell::new(3, 0)]);
        maze.set_wall(Cell::new(2, 0), Direction::East, true);
        let at = Cell::new(2, 0);
        assert_eq!(explore(&maze, &config), Err(ExploreError::NoWay { at }));
    }
}
