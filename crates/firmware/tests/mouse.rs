//! Tests of the mouse on mazes, with and without crashes.
#![expect(clippy::unwrap_used, reason = "a failed unwrap is a failed test")]

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_firmware::{Command, MAZE, Mouse, Sides};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_planners::speed_run::{RunStep, SpeedRunConfig, SpeedRunTimes, best_possible_ms};

fn maze(seed: u64) -> Maze {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (width, height) = (MAZE as u16, MAZE as u16);
    let braided = Braided {
        width,
        height,
        share: 0.5,
    };
    let mut maze = braided.generate(&mut rng).unwrap();
    maze.set_goals(maze.grid().middle().collect());
    maze
}

fn seen_as(heading: Direction, side: Direction) -> Direction {
    Direction::ALL[(heading.index() + side.index()) % 4]
}

/// Drives until the mouse stays. It crashes before the cells that `crashes` counts, and is then put
/// down in a cell where it has been. Returns the duration of its fastest run, ms, or `None` if it
/// gives up or never comes back.
fn drive(maze: &Maze, crashes: &[usize]) -> Option<u16> {
    let config = SpeedRunConfig::classic();
    let times = SpeedRunTimes::new(&config).unwrap();
    let goals = maze.goals();
    let mut mouse = Mouse::new(&times, goals).unwrap();
    let (mut at, mut heading) = (Cell::new(0, 0), Direction::North);
    let mut trail = vec![(at, heading)];
    for cells in 0..5000 {
        let open = |side| maze.is_open(at, seen_as(heading, side));
        let arrived = mouse.arrive(Sides {
            left: open(Direction::West),
            ahead: open(Direction::North),
            right: open(Direction::East),
        });
        let command = arrived.unwrap();
        match command {
            Command::Drive(side) => {
                heading = seen_as(heading, side);
                assert!(maze.is_open(at, heading), "against the wall at {at}");
                at = maze.grid().neighbour(at, heading).unwrap();
                trail.push((at, heading));
            }
            Command::Ready { run_ms } => {
                let mut moves = 0;
                mouse.run(|_: RunStep| moves += 1).unwrap();
                assert!(moves > 0 && at == Cell::new(0, 0));
                return Some(run_ms);
            }
            Command::CarryBack => {
                assert!(!crashes.is_empty(), "lost without a crash");
                (at, heading) = (Cell::new(0, 0), Direction::North);
                mouse.carried_back();
                continue;
            }
            Command::GiveUp => return None,
        }
        if crashes.contains(&cells) {
            mouse.crash().unwrap();
            // The mouse stands as it came in: the side behind it is open.
            (at, heading) = trail[1 + cells * 7 % (trail.len() - 1)];
        }
    }
    None
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_run_found_is_the_best_of_all_with_and_without_crashes(
        seed in any::<u64>(),
        crashes in prop::collection::vec(0_usize..200, 0..3),
    ) {
        let maze = maze(seed);
        let start = (Cell::new(0, 0), Direction::North);
        let best = best_possible_ms(&maze, &SpeedRunConfig::classic(), start, maze.goals());
        prop_assume!(best.is_some());
        prop_assert_eq!(drive(&maze, &crashes).map(u32::from), best);
    }
}

#[test]
fn all_that_a_mouse_holds_fits_into_10_kb() {
    let held = size_of::<Mouse<'_>>() + size_of::<SpeedRunTimes<MAZE>>();
    assert!(held <= 10_000, "{held} bytes");
}
