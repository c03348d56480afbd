//! Explores whole mazes with a [`CompetitionMouse`], cell by cell.
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
//! let exploration = competition::explore(&maze, &SpeedRunConfig::classic(), |_, _| {})?;
//! assert_eq!(exploration.cells, 12, "six there and six back");
//! assert_eq!(exploration.verdict, Ok(()));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use tolman_maze::{Cell, Direction, Maze, Walls};
use tolman_planners::speed_run::{
    Decision, Extent, RunState, SpeedRunConfig, SpeedRunExplorer, SpeedRunMap, SpeedRunTimes,
};
use tolman_planners::{Passages, Unknown};
use tolman_robot::Standing;
use tolman_systems::micromouse::Brief;
use tolman_systems::micromouse::competition::{
    CompetitionMouse, CompetitionNext, ExploreError, RunLeg, SpeedRunExploration,
};

use crate::run::within;

/// Lets a mouse explore a maze and returns the result. The mouse looks at the walls of its cell and
/// remembers all. It begins at the maze's start, or in the south-western corner, looking north.
/// Calls `see` with every cell that the mouse looks at, and which of its sides are open, in the
/// order of [`Direction::ALL`]. O(cells driven · n) for n cells.
///
/// # Errors
/// If the maze has no way to a goal, or is larger than 32 × 32, or the times of the moves are too
/// far apart.
pub fn explore(
    maze: &Maze,
    config: &SpeedRunConfig,
    see: impl FnMut(Cell, [bool; 4]),
) -> Result<SpeedRunExploration, ExploreError> {
    let grid = maze.grid();
    // What is known takes its time to be looked through.
    if grid.width().max(grid.height()) <= 16 {
        explore_within::<16>(maze, config, see)
    } else {
        explore_within::<32>(maze, config, see)
    }
}

fn explore_within<const N: usize>(
    maze: &Maze,
    config: &SpeedRunConfig,
    mut see: impl FnMut(Cell, [bool; 4]),
) -> Result<SpeedRunExploration, ExploreError> {
    let (start, heading) = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
    let brief = Brief {
        grid: maze.grid(),
        start,
        heading,
        goals: maze.goals().to_vec(),
    };
    let times = SpeedRunTimes::<N>::new(config)?;
    let mut mouse = CompetitionMouse::new(&brief, config, &times)?;
    // It drives to each unseen cell, and home, on a way of at most all cells.
    let cells = maze.grid().cells().count() as u32;
    let (mut at, mut found) = (start, None);
    within(cells * (cells + 1), || {
        let open = Direction::ALL.map(|side| maze.is_open(at, side));
        see(at, open);
        match mouse.next(open)? {
            CompetitionNext::Drive(side) => {
                at = maze.beside(at, side).ok_or(ExploreError::NoWay { at })?;
                Ok::<_, ExploreError>(Standing::UnderWay)
            }
            CompetitionNext::Finished(exploration) => {
                found = Some(exploration);
                Ok(Standing::Done)
            }
        }
    })?;
    found.ok_or(ExploreError::NoWay { at })
}

/// Plan of a mouse in a maze that it knows in part.
#[derive(Clone, Debug)]
pub struct HalfKnown {
    /// Moves of the best run through walls that are known to be open; empty if there is none.
    pub known: Vec<RunLeg>,
    /// Duration of the best run if all unknown walls were open, ms; `None` if no way is left.
    pub possible_ms: Option<u32>,
    /// Decision of a mouse, where it is.
    pub next: Decision,
}

/// Returns the best run from the start through what is known of a maze, and where a mouse that is
/// at `at`, looking to `facing`, would look next.
///
/// # Errors
/// If the maze is larger than 32 × 32 or the mouse's parameters are invalid.
pub fn half_known(
    walls: &impl Walls,
    (start, heading): (Cell, Direction),
    (at, facing): (Cell, Direction),
    goals: &[Cell],
    config: &SpeedRunConfig,
) -> Result<HalfKnown, ExploreError> {
    let times = SpeedRunTimes::<32>::new(config)?;
    let state = RunState::Straight {
        cell: start,
        heading,
    };
    let mut map = SpeedRunMap::<32>::new();
    let hoped = Passages::new(walls, Unknown::Open)?;
    map.search(&hoped, &times, goals, Extent::Until(state));
    let possible_ms = map.time_ms(state);
    let known = Passages::new(walls, Unknown::Closed)?;
    map.search(&known, &times, goals, Extent::Until(state));
    let legs = map.run(&known, &times, state).map(|step| RunLeg {
        step,
        time_ms: times.of(step.run_move).unwrap_or(0),
    });
    let known = legs.collect();
    let mut explorer = SpeedRunExplorer::<32>::new(&times, start, heading, goals);
    let next = explorer.decide(walls, at, facing)?;
    Ok(HalfKnown {
        known,
        possible_ms,
        next,
    })
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
            explore(&maze, &config, |_, _| {}),
            Err(ExploreError::TooLarge(_))
        ));
        let mut maze = Maze::open(Grid::new(4, 1));
        maze.set_start(Some((Cell::new(0, 0), Direction::East)));
        maze.set_goals(vec![Cell::new(3, 0)]);
        maze.set_wall(Cell::new(2, 0), Direction::East, true);
        let at = Cell::new(2, 0);
        assert_eq!(
            explore(&maze, &config, |_, _| {}),
            Err(ExploreError::NoWay { at })
        );
    }

    #[test]
    fn a_mouse_that_faces_a_wall_turns_to_the_side_that_is_open() {
        let mut maze = Maze::open(Grid::new(4, 2));
        for cell in maze.grid().cells().collect::<Vec<_>>() {
            maze.set_wall(cell, Direction::North, true);
        }
        maze.set_goals(vec![Cell::new(3, 0)]);
        for (facing, at, way) in [
            (Direction::North, 0, Direction::East),
            (Direction::South, 0, Direction::East),
            (Direction::West, 0, Direction::East),
            (Direction::East, 0, Direction::East),
        ] {
            maze.set_start(Some((Cell::new(at, 0), facing)));
            let explored = explore(&maze, &SpeedRunConfig::classic(), |_, _| {}).unwrap();
            assert_eq!(explored.verdict, Ok(()));
            assert_eq!(explored.certificate.heading, way);
            assert_eq!((explored.cells, explored.search_cells), (6, 3));
            assert_eq!(explored.proof_cells, 0);
        }
    }
}
