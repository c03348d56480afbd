//! Step maps, speed runs and the decisions of their exploration, on the mazes of competitions where they are at hand
//! and else on generated ones.
//!
//! Criterion measures one maze of each size; the table at the end is over all mazes. Its figures are the least of
//! several repetitions of the very same work, so that a busy machine does not blur them; *worst* is the
//! largest of these over all mazes and moments.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

use core::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use criterion::Criterion;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_planners::speed_run::{
    Decision, Extent, RunState, SpeedRunConfig, SpeedRunExplorer, SpeedRunMap, SpeedRunTimes,
    best_possible_ms,
};
use tolman_planners::{Passages, StepMap, Unknown};

/// How often the same work is timed.
const REPETITIONS: usize = 15;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    println!("| mazes | what | mean µs | worst µs | baseline µs | ratio |");
    println!("| --- | --- | ---: | ---: | ---: | ---: |");
    measure::<16>(&mut criterion, "classic", &SpeedRunConfig::classic());
    measure::<32>(&mut criterion, "halfsize", &SpeedRunConfig::half_size());
}

fn measure<const N: usize>(criterion: &mut Criterion, folder: &str, config: &SpeedRunConfig) {
    let (source, mazes) = mazes(folder, N as u16);
    let group = format!("{} {source}, {N}²", mazes.len());
    let times = SpeedRunTimes::<N>::new(config).unwrap();
    let mut map = SpeedRunMap::<N>::new();
    let passages: Vec<Passages<N>> = mazes
        .iter()
        .map(|maze| Passages::new(maze, Unknown::Closed).unwrap())
        .collect();
    let numbers = 0..mazes.len();

    let step_map = |number: usize| {
        let goals = mazes[number].goals().iter().copied();
        black_box(StepMap::new(&passages[number], goals));
    };
    let plain_steps = |number: usize| {
        black_box(mazes[number].steps_to_goal());
    };
    row(
        &group,
        "step map",
        numbers.clone().map(|number| least(|| step_map(number))),
        Some(mean(
            numbers.clone().map(|number| least(|| plain_steps(number))),
        )),
    );

    let mut plan = |number: usize| {
        let maze = &mazes[number];
        let start = start(maze);
        let state = RunState::Straight {
            cell: start.0,
            heading: start.1,
        };
        map.search(
            &passages[number],
            &times,
            maze.goals(),
            Extent::Until(state),
        );
        black_box(map.run(&passages[number], &times, state).count());
    };
    // The checker's, graph and all: slow, so every tenth maze has to do.
    let plain_plan = |number: usize| {
        let maze = &mazes[number];
        black_box(best_possible_ms(maze, config, start(maze), maze.goals()));
    };
    let slow = mean(
        numbers
            .clone()
            .step_by(10)
            .map(|number| least(|| plain_plan(number))),
    );
    row(
        &group,
        "fastest run",
        numbers.clone().map(|number| least(|| plan(number))),
        Some(slow),
    );

    let decisions = mazes.iter().flat_map(|maze| {
        let mut least: Vec<f64> = Vec::new();
        for _ in 0..REPETITIONS {
            for (number, time) in explore(maze, &times).into_iter().enumerate() {
                match least.get_mut(number) {
                    Some(least) => *least = time.min(*least),
                    None => least.push(time),
                }
            }
        }
        least
    });
    row(&group, "decision", decisions, None);

    let mut group = criterion.benchmark_group("speed_run");
    group.bench_function(format!("step map, {N}²"), |bencher| {
        bencher.iter(|| step_map(0));
    });
    group.bench_function(format!("fastest run, {N}²"), |bencher| {
        bencher.iter(|| plan(0));
    });
    group.sample_size(10);
    group.bench_function(format!("exploration, {N}²"), |bencher| {
        bencher.iter(|| explore(&mazes[0], &times));
    });
    group.finish();
}

fn row(group: &str, what: &str, figures: impl Iterator<Item = f64>, baseline: Option<f64>) {
    let figures: Vec<f64> = figures.collect();
    let worst = figures.iter().copied().fold(0.0, f64::max);
    let mean = mean(figures.into_iter());
    let baseline = baseline.map_or_else(
        || "| |".to_owned(),
        |baseline| format!("{baseline:.2} | {:.1} |", baseline / mean),
    );
    println!("| {group} | {what} | {mean:.2} | {worst:.2} | {baseline}");
}

fn mean(figures: impl Iterator<Item = f64>) -> f64 {
    let figures: Vec<f64> = figures.collect();
    figures.iter().sum::<f64>() / figures.len() as f64
}

/// Microseconds.
fn least(mut work: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..REPETITIONS {
        let begin = Instant::now();
        work();
        least = least.min(1e6 * begin.elapsed().as_secs_f64());
    }
    least
}

/// Explores until the mouse is back; microseconds of every decision.
fn explore<const N: usize>(maze: &Maze, times: &SpeedRunTimes<N>) -> Vec<f64> {
    let (home, heading) = start(maze);
    let mut walls = WallMap::<N>::new(maze.grid(), ClosedCells::Possible).unwrap();
    let mut explorer = SpeedRunExplorer::new(times, home, heading, maze.goals());
    let (mut at, mut looks) = (home, heading);
    let mut decisions = Vec::new();
    loop {
        let rays = Direction::ALL.map(|side| {
            if maze.is_open(at, side) {
                CellRay::out_of_range(side, 1)
            } else {
                CellRay::to_wall(side, 0)
            }
        });
        walls.observe(at, &rays).unwrap();
        let begin = Instant::now();
        let decision = explorer.decide(&walls, at, looks).unwrap();
        decisions.push(1e6 * begin.elapsed().as_secs_f64());
        let Decision::Drive(direction) = decision else {
            return decisions;
        };
        at = maze.grid().neighbour(at, direction).unwrap();
        looks = direction;
    }
}

fn start(maze: &Maze) -> (Cell, Direction) {
    maze.start().unwrap_or((Cell::new(0, 0), Direction::North))
}

/// Where they come from, and the mazes.
fn mazes(folder: &str, side: u16) -> (&'static str, Vec<Maze>) {
    let data = std::env::var_os("TOLMAN_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let Ok(entries) = std::fs::read_dir(data.join("mazes").join(folder)) else {
        let generated = (0..20).map(|seed| {
            let braided = Braided {
                width: side,
                height: side,
                share: 0.5,
            };
            let mut maze = braided
                .generate(&mut ChaCha8Rng::seed_from_u64(seed))
                .unwrap();
            maze.set_goals(maze.grid().middle().collect());
            maze
        });
        return ("generated", generated.collect());
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let texts = paths
        .iter()
        .map(|path| std::fs::read_to_string(path).unwrap());
    let mazes = texts.filter_map(|text| tolman_maze::read(&text).ok());
    ("of competitions", mazes.map(|file| file.maze).collect())
}
