//! The explorer of steps on the wall map: it ends with a run that no completion of the unknown
//! walls undercuts.

use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Braided, Cell, Direction, Knowledge, Maze, Rooms, Walls};
use tolman_planners::moves::{
    Leap, MouseStep, MoveDecision, MoveExplorer, MoveExplorerConfig, MoveMap, RolloutConfig,
    Rollouts,
};
use tolman_planners::{Passages, Unknown};

fn mazes() -> impl Strategy<Value = Maze> {
    (3..=11_u16, 3..=11_u16, 0..=10_u8, any::<u64>()).prop_map(|(width, height, share, seed)| {
        braided(width, height, f64::from(share) / 10.0, seed)
    })
}

fn braided(width: u16, height: u16, share: f64, seed: u64) -> Maze {
    let shape = Braided {
        width,
        height,
        share,
    };
    shape
        .generate(&mut ChaCha8Rng::seed_from_u64(seed))
        .unwrap()
}

/// Returns the fewest steps to each cell, computed as plainly as possible. A step crosses up to
/// three cells in a row without a wall between.
fn fewest_steps(maze: &Maze, start: Cell) -> Vec<Option<u16>> {
    let grid = maze.grid();
    let mut steps = vec![None; grid.cell_count()];
    steps[grid.index(start)] = Some(0);
    for depth in 0.. {
        let mut any = false;
        for cell in grid
            .cells()
            .filter(|cell| steps[grid.index(*cell)] == Some(depth))
            .collect::<Vec<_>>()
        {
            for direction in Direction::ALL {
                let mut at = cell;
                for _ in 0..3 {
                    if !maze.is_open(at, direction) {
                        break;
                    }
                    at = grid.neighbour(at, direction).unwrap();
                    let slot = &mut steps[grid.index(at)];
                    if slot.is_none() {
                        *slot = Some(depth + 1);
                        any = true;
                    }
                }
            }
        }
        if !any {
            break;
        }
    }
    steps
}

fn look(map: &mut WallMap<16>, maze: &Maze, at: Cell, heading: Direction) {
    let rays = [heading.left(), heading, heading.right()].map(|direction| {
        let (mut cell, mut open) = (at, 0);
        while maze.is_open(cell, direction) {
            cell = maze.grid().neighbour(cell, direction).unwrap();
            open += 1;
        }
        CellRay::to_wall(direction, open)
    });
    map.observe(at, &rays).unwrap();
}

/// Explores `maze`; what is known in the end, the steps it took, the steps of the run that is
/// proven.
fn explore(maze: &Maze) -> (WallMap<16>, u32, u16) {
    let mut explorer = explorer(maze);
    explore_by(maze, |map, at| {
        explorer.decide(map, maze.goals(), at).unwrap()
    })
}

/// Returns the same, every stop of the proof chosen by rollouts.
fn explore_by_rollouts(maze: &Maze) -> (WallMap<16>, u32, u16) {
    let mut rollouts = Rollouts::new(explorer(maze), RolloutConfig::tuned()).unwrap();
    explore_by(maze, |map, at| {
        rollouts.decide(map, maze.goals(), at).unwrap()
    })
}

fn explorer(maze: &Maze) -> MoveExplorer<16> {
    MoveExplorer::new(MoveExplorerConfig::tuned(), maze.start().unwrap().0).unwrap()
}

fn explore_by(
    maze: &Maze,
    mut decide: impl FnMut(&WallMap<16>, Cell) -> MoveDecision,
) -> (WallMap<16>, u32, u16) {
    let (start, mut heading) = maze.start().unwrap();
    let mut map = WallMap::new(maze.grid(), ClosedCells::Possible).unwrap();
    let (mut at, mut visited) = (start, maze.goals().contains(&start));
    for steps in 0..5000 {
        look(&mut map, maze, at, heading);
        match decide(&map, at) {
            MoveDecision::Drive(leap) => {
                let _ = MouseStep::of_leap(&mut heading, leap);
                let known = Passages::<16>::new(&map, Unknown::Closed).unwrap();
                assert!(
                    Leap::all(&known, at).any(|known| known == leap),
                    "drives through no unknown wall"
                );
                at = leap.end;
                visited |= maze.goals().contains(&at);
            }
            MoveDecision::Turn => heading = heading.right(),
            MoveDecision::Finished { moves } => {
                assert!(visited, "was at the goal");
                return (map, steps, moves);
            }
            MoveDecision::Enough { .. } => panic!("it was to prove its run"),
            MoveDecision::Stuck => panic!("stuck at {at} in\n{map}"),
        }
    }
    panic!("never ends in\n{maze}");
}

/// Checks that no completion of the unknown walls has a better run.
fn check_proof(
    maze: &Maze,
    (map, _, moves): (WallMap<16>, u32, u16),
    seed: u64,
) -> Result<(), TestCaseError> {
    let start = maze.grid().index(maze.start().unwrap().0);
    let best = |maze: &Maze| {
        maze.goals()
            .iter()
            .filter_map(|goal| fewest_steps(maze, *goal)[start])
            .min()
    };
    prop_assert_eq!(best(maze), Some(moves));
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for open_in_ten in [0, 3, 5, 8, 10_u32] {
        let mut completed = maze.clone();
        for cell in maze.grid().cells() {
            for side in [Direction::North, Direction::East] {
                if map.knowledge(cell, side) == Knowledge::Unknown {
                    completed.set_wall(cell, side, rng.random_range(0..10_u32) >= open_in_ten);
                }
            }
        }
        prop_assert_eq!(
            best(&completed),
            Some(moves),
            "in\n{}\nknown\n{}",
            completed,
            map
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn the_map_of_moves_counts_fewest_steps(maze in mazes(), target in any::<usize>()) {
        let target = maze.grid().cells().nth(target % maze.grid().cell_count()).unwrap();
        let passages = Passages::<16>::new(&maze, Unknown::Closed).unwrap();
        let map = MoveMap::new(&passages, [target]);
        // A leap can be driven back, so the steps there are those from there.
        let expect = fewest_steps(&maze, target);
        for cell in maze.grid().cells() {
            prop_assert_eq!(map.moves(cell), expect[maze.grid().index(cell)]);
            let way: Vec<Leap> = map.way(&passages, cell).collect();
            prop_assert_eq!(Some(way.len() as u16), map.moves(cell));
            prop_assert_eq!(way.last().map_or(cell, |leap| leap.end), target);
        }
    }

    #[test]
    fn what_is_proven_holds_however_the_unknown_walls_turn_out(maze in mazes(), seed in any::<u64>()) {
        check_proof(&maze, explore(&maze), seed)?;
    }

    #[test]
    fn it_explores_from_any_start_in_any_direction(maze in mazes(), start in any::<usize>(), side in 0..4_usize) {
        let mut maze = maze;
        let start = maze.grid().cells().nth(start % maze.grid().cell_count()).unwrap();
        maze.set_start(Some((start, Direction::ALL[side])));
        prop_assert_eq!(Some(explore(&maze).2), {
            let steps = maze.goals().iter().filter_map(|goal| fewest_steps(&maze, *goal)[maze.grid().index(start)]);
            steps.min()
        });
    }

    #[test]
    fn the_same_maze_is_explored_in_the_same_steps(seed in any::<u64>()) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let rooms = Rooms { width: 12, height: 12, attempts: 20, smallest: 2, largest: 4, extra_doors: 3 };
        let maze = rooms.generate(&mut rng).unwrap();
        prop_assert_eq!(explore(&maze).1, explore(&maze).1);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn what_rollouts_prove_holds_as_well(maze in mazes(), seed in any::<u64>()) {
        let explored = explore_by_rollouts(&maze);
        prop_assert_eq!(explored.1, explore_by_rollouts(&maze).1, "the same maze, the same steps");
        check_proof(&maze, explored, seed)?;
    }
}

/// Compares the steps of proofs with and without rollouts: rollouts need fewer.
#[test]
fn rollouts_save_steps() {
    let (mut plain, mut with_rollouts) = (0, 0);
    for seed in 0..10 {
        let maze = braided(16, 16, 0.7, seed);
        plain += explore(&maze).1;
        with_rollouts += explore_by_rollouts(&maze).1;
    }
    assert!(
        with_rollouts < plain,
        "{with_rollouts} steps, {plain} without"
    );
}

/// The last looks are forgotten now and then, also on the way to a stop. The rollout goes on with
/// what it knows.
#[test]
fn rollouts_go_on_where_walls_are_forgotten() {
    let maze = braided(9, 9, 0.5, 1);
    let (start, mut heading) = maze.start().unwrap();
    let mut rollouts = Rollouts::new(explorer(&maze), RolloutConfig::tuned()).unwrap();
    let mut map = WallMap::<16>::new(maze.grid(), ClosedCells::Possible).unwrap();
    let (mut at, mut forgotten) = (start, 0);
    for steps in 0..1000 {
        look(&mut map, &maze, at, heading);
        if steps % 5 == 4 && forgotten < 20 {
            forgotten += map.undo(3);
            // It stands in a cell that it has driven to, and sees where it stands.
            look(&mut map, &maze, at, heading);
        }
        match rollouts.decide(&map, maze.goals(), at).unwrap() {
            MoveDecision::Drive(leap) => {
                let _ = MouseStep::of_leap(&mut heading, leap);
                at = leap.end;
            }
            MoveDecision::Turn => heading = heading.right(),
            MoveDecision::Finished { .. } => {
                assert!(forgotten >= 20, "{forgotten}");
                return;
            }
            MoveDecision::Enough { .. } => panic!("it was to prove its run"),
            MoveDecision::Stuck => panic!("stuck at {at} in\n{map}"),
        }
    }
    panic!("never ends in\n{maze}");
}
