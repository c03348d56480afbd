//! Times how the observer of a diktiometry takes in moves, on open worlds of places that all look
//! alike. It times moves while the world is being learned, and moves once it is known. Another
//! world has places with many looks.
//!
//! Criterion measures moves on known maps. The table is of single moves, because percentiles say
//! more on a busy machine.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/it/diktiometry/walk.rs"]
mod walk;

extern crate alloc;

use core::time::Duration;
use std::time::Instant;

use criterion::Criterion;
use tolman_maps::diktiometry::{Config, StepReport, Use};
use tolman_maze::Direction;
use walk::{ODOMETRY, Scripted, Walk, open, painted};

/// Moves through each of the worlds of many looks, and how many of the first and of the last of
/// them make a row.
const LOOKED_AT: usize = 8000;
const ROW: usize = 1000;

/// Number of times that these moves are made. The least time of each counts.
const AGAIN: usize = 3;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    println!("| places | moves | map | median µs | 90 % µs | mean µs |");
    println!("| ---: | ---: | --- | ---: | ---: | ---: |");
    by_looks();
    for (side, moves) in [(10, 1000), (32, 6000), (63, 24_000)] {
        let config = Config::new(Config::compass_actions(), 1.0);
        let mut walk = Walk::new(open(side), ODOMETRY, config, 1);
        let mut learning = Vec::new();
        let mut planner = Scripted::new(1.0, 1);
        for _ in 0..moves {
            let direction = planner.choose(&walk);
            learning.push(timed(&mut walk, direction).0);
        }
        let score = walk.score();
        assert!(
            score.places == usize::from(side) * usize::from(side),
            "{score:?}"
        );
        row(score.places, "being learned", learning);
        let known = (0..4 * moves).map(|_| {
            let direction = walk.robot.wander().unwrap();
            timed(&mut walk, direction).0
        });
        row(score.places, "known", known.collect());
        criterion.bench_function(
            &format!("diktiometry/{} places, a move", score.places),
            |bench| {
                bench.iter_custom(|count| {
                    (0..count)
                        .map(|_| {
                            let direction = walk.robot.wander().unwrap();
                            timed(&mut walk, direction).0
                        })
                        .sum()
                });
            },
        );
    }
    criterion.final_summary();
}

/// Times walks among walls of eight colours, with merges by looks. On a map that is being learned,
/// each move weighs these merges.
fn by_looks() {
    for (name, look_merge) in [("off", Use::Off), ("on", Use::On)] {
        let mut config = painted();
        config.restructuring.look_merge = look_merge;
        let mut times = vec![Duration::MAX; LOOKED_AT];
        // Number of places after each number of moves.
        let mut places = vec![1; LOOKED_AT + 1];
        // The same moves again and again: what else the machine does is not counted.
        for _ in 0..AGAIN {
            let mut walk = Walk::new(open(32).painted(8, 1), ODOMETRY, config.clone(), 1);
            let mut planner = Scripted::new(0.3, 1);
            for (number, time) in times.iter_mut().enumerate() {
                let direction = planner.choose(&walk);
                *time = timed(&mut walk, direction).0.min(*time);
                places[number + 1] = walk.observer.map().paths.places().count();
            }
        }
        for begin in [0, LOOKED_AT - ROW] {
            let end = begin + ROW;
            let map = format!(
                "eight colours, `look_merge` {name}, from {} places on",
                places[begin]
            );
            row(places[end], &map, times[begin..end].to_vec());
        }
    }
}

/// Returns one move, of which only the observer's part is timed.
fn timed(walk: &mut Walk, direction: Direction) -> (Duration, StepReport) {
    let moved = walk.robot.go(direction).unwrap();
    let step = walk.told(&moved);
    let start = Instant::now();
    let report = walk.observer.step(&step).unwrap();
    let time = start.elapsed();
    walk.log.push((moved.to, walk.observer.place()));
    (time, report)
}

fn row(places: usize, map: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let micros = |time: Duration| time.as_secs_f64() * 1e6;
    let at = |share: usize| micros(times[(times.len() - 1) * share / 100]);
    let mean = micros(times.iter().sum()) / times.len() as f64;
    println!(
        "| {places} | {} | {map} | {:.1} | {:.1} | {mean:.1} |",
        times.len(),
        at(50),
        at(90)
    );
}
