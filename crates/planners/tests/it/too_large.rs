//! A maze that does not fit is refused, by its size, wherever one is handed over.

use tolman_maze::{Cell, Direction, Grid, Maze};
use tolman_planners::moves::{MoveExplorer, MoveExplorerConfig, RolloutConfig, Rollouts};
use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunExplorer, SpeedRunTimes};
use tolman_planners::{Passages, PoseSet, TooLarge, Unknown};

const START: Cell = Cell::new(0, 0);
const GOALS: [Cell; 1] = [Cell::new(1, 1)];

/// Hands a maze of this size to everything that holds 16 × 16 cells.
fn refusals(width: u16, height: u16) -> [Option<TooLarge>; 6] {
    let maze = Maze::open(Grid::new(width, height));
    let times = SpeedRunTimes::<16>::new(&SpeedRunConfig::classic()).unwrap();
    let explorer = MoveExplorer::<16>::new(MoveExplorerConfig::tuned(), START).unwrap();
    let mut rollouts = Rollouts::new(explorer.clone(), RolloutConfig::tuned()).unwrap();
    let mut explorer = explorer;
    let mut competitor = SpeedRunExplorer::<16>::new(&times, START, Direction::East, &GOALS);
    [
        Passages::<16>::new(&maze, Unknown::Closed).err(),
        Passages::<16>::new(&maze, Unknown::Open).err(),
        PoseSet::<16>::anywhere(maze.grid()).err(),
        explorer.decide(&maze, &GOALS, START).err(),
        rollouts.decide(&maze, &GOALS, START).err(),
        competitor.decide(&maze, START, Direction::East).err(),
    ]
}

#[test]
fn a_maze_that_does_not_fit_is_refused_by_its_size() {
    for (width, height) in [(17, 4), (4, 17), (32, 32)] {
        let grid = Grid::new(width, height);
        let expected = TooLarge { grid, side: 16 };
        assert_eq!(refusals(width, height), [Some(expected); 6]);
    }
    let grid = Grid::new(17, 4);
    assert_eq!(
        TooLarge { grid, side: 16 }.to_string(),
        "the maze is 17 × 4 cells and the map holds 16 × 16 at most"
    );
}

#[test]
fn a_maze_that_fits_is_not() {
    for (width, height) in [(16, 16), (2, 2), (16, 2)] {
        assert_eq!(refusals(width, height), [None; 6]);
    }
}
