//! Times how the observer of a diktiometry takes in moves, on open worlds of places that all look
//! alike. It times moves while the world is being learned, and moves once it is known. Another
//! world has places with many looks.
//!
//! The first table is of a map that grows to ten thousand places, with its memory.
//!
//! Criterion measures moves on known maps. The table is of single moves, because percentiles say
//! more on a busy machine.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/it/diktiometry/abstract_world.rs"]
mod abstract_world;
#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/it/diktiometry/walk.rs"]
mod walk;

extern crate alloc;

use core::time::Duration;
use std::fs;
use std::time::Instant;

use criterion::Criterion;
use tolman_maps::diktiometry::{Config, StepReport, Use};
use tolman_maze::Direction;
use tolman_robot::Mapper;
use walk::{ODOMETRY, Scripted, Walk, open, painted};

/// Moves through each of the worlds of many looks, and how many of the first and of the last of
/// them make a row.
const LOOKED_AT: usize = 8000;
const ROW: usize = 1000;

/// Number of times that these moves are made. The least time of each counts.
const AGAIN: usize = 3;

/// Numbers of places at which the growing map is measured, and the side of its world.
const SIZES: [usize; 6] = [500, 1000, 2000, 4000, 7000, 10_000];
const LARGE: u16 = 100;

/// Number of moves after which the places of the growing map are counted again.
const COUNTED: usize = 50;

/// Size of a page of memory, bytes, as Linux counts them.
const PAGE: usize = 4096;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    // The growing map first, while the process has taken no other memory.
    println!(
        "| places | moves | mean µs | 90 % µs | map, bytes a place | resident bytes a place |"
    );
    println!("| ---: | ---: | ---: | ---: | ---: | ---: |");
    growing();
    println!("| places | moves | map | median µs | 90 % µs | mean µs |");
    println!("| ---: | ---: | --- | ---: | ---: | ---: |");
    by_looks();
    in_the_open(&mut criterion);
    criterion.final_summary();
}

/// Times moves in open worlds, while these are being learned and afterwards.
fn in_the_open(criterion: &mut Criterion) {
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
}

/// Lets a map grow to the last of [`SIZES`], and times the moves from each size to the next. Of
/// equal walks, the least time of each move counts.
fn growing() {
    let walks = [(); AGAIN].map(|()| grown());
    for (
        number,
        Grown {
            size,
            bytes,
            resident,
            ..
        },
    ) in walks[0].iter().enumerate()
    {
        let each = walks.iter().map(|walk| walk[number].times.clone());
        let least = |a: Vec<Duration>, b: Vec<Duration>| {
            a.into_iter().zip(b).map(|(a, b)| a.min(b)).collect()
        };
        grown_row(
            *size,
            each.reduce(least).unwrap_or_default(),
            *bytes,
            *resident,
        );
    }
}

/// A part of a walk, at the end of which the map has a given number of places.
struct Grown {
    size: usize,
    times: Vec<Duration>,
    /// Memory of the map, bytes.
    bytes: usize,
    /// Memory that the process has taken since the walk began, bytes; `None` where it is unknown.
    resident: Option<usize>,
}

fn grown() -> Vec<Grown> {
    let before = resident();
    let config = Config::new(Config::compass_actions(), 1.0);
    let mut walk = Walk::new(open(LARGE), ODOMETRY, config, 1);
    let mut planner = Scripted::new(1.0, 1);
    let grow = |size| {
        let mut times = Vec::new();
        while walk.observer.map().paths.places().count() < size {
            for _ in 0..COUNTED {
                let direction = planner.choose(&walk);
                times.push(timed(&mut walk, direction).0);
            }
        }
        Grown {
            size,
            times,
            bytes: walk.observer.map_bytes().unwrap(),
            resident: resident()
                .zip(before)
                .map(|(now, before)| now.saturating_sub(before)),
        }
    };
    SIZES.map(grow).into()
}

/// Returns the resident memory of the process, bytes; `None` if the system does not say.
fn resident() -> Option<usize> {
    let pages = fs::read_to_string("/proc/self/statm").ok()?;
    let pages: usize = pages.split_whitespace().nth(1)?.parse().ok()?;
    Some(PAGE * pages)
}

fn grown_row(places: usize, mut times: Vec<Duration>, bytes: usize, resident: Option<usize>) {
    times.sort_unstable();
    let micros = |time: Duration| time.as_secs_f64() * 1e6;
    let mean = micros(times.iter().sum()) / times.len() as f64;
    let most = micros(times[(times.len() - 1) * 90 / 100]);
    let bytes = bytes / places;
    let resident = resident.map_or("–".to_owned(), |all| (all / places).to_string());
    println!(
        "| {places} | {} | {mean:.1} | {most:.1} | {bytes} | {resident} |",
        times.len()
    );
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
