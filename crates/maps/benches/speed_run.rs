//! Step maps, speed runs and the decisions of their exploration. The mazes are those of
//! competitions if they are available, otherwise generated ones; `SPEED_RUN_MAZES=FOLDER` names
//! others.
//!
//! A mouse never plans the same maze twice, and a processor that has seen a maze before foresees
//! its branches. So the maze changes at every call: all mazes are walked in turn, fifteen times.
//! Each maze has a JSON line with the minimum and the median of its fifteen times, for comparison
//! with another program. The table at the end has the means of both over all mazes, and the *worst*
//! of the minima. It also has the time of the same work when it is repeated at once.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

use core::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_planners::speed_run::{
    Decision, Extent, RunState, SpeedRunConfig, SpeedRunExplorer, SpeedRunMap, SpeedRunTimes,
};
use tolman_planners::{Passages, StepMap, Unknown};

/// Number of turns of each maze.
const ROUNDS: usize = 15;

fn main() {
    let classic = measure::<16>("classic", &SpeedRunConfig::classic());
    let half_size = measure::<32>("halfsize", &SpeedRunConfig::half_size());
    println!("| mazes | what | least µs | median µs | worst µs | repeated µs |");
    println!("| --- | --- | ---: | ---: | ---: | ---: |");
    for row in classic.iter().chain(&half_size) {
        println!("{row}");
    }
}

/// A maze with its name, and where its runs begin.
struct Named {
    name: String,
    maze: Maze,
    start: (Cell, Direction),
}

/// Prints a JSON line for each maze, and returns the rows of the table.
fn measure<const N: usize>(folder: &str, config: &SpeedRunConfig) -> Vec<String> {
    let (source, mazes) = mazes(folder, N as u16);
    let times = SpeedRunTimes::<N>::new(config).unwrap();
    let passages: Vec<Passages<N>> = mazes
        .iter()
        .map(|named| Passages::new(&named.maze, Unknown::Closed).unwrap())
        .collect();
    let mut map = SpeedRunMap::<N>::new();
    let step_map = Timed::of(mazes.len(), |number| {
        let goals = mazes[number].maze.goals().iter().copied();
        let begin = Instant::now();
        black_box(StepMap::new(&passages[number], goals));
        since(begin)
    });
    let plan = Timed::of(mazes.len(), |number| {
        let Named { maze, start, .. } = &mazes[number];
        let (cell, heading) = *start;
        let state = RunState::Straight { cell, heading };
        let begin = Instant::now();
        let extent = Extent::Until(state);
        map.search(&passages[number], &times, maze.goals(), extent);
        black_box(map.run(&passages[number], &times, state).count());
        since(begin)
    });
    let decision = Timed::of(mazes.len(), |number| explore(&mazes[number], &times));
    let all = [
        ("step map", step_map),
        ("plan", plan),
        ("decision", decision),
    ];
    for (number, named) in mazes.iter().enumerate() {
        println!("{}", line(&named.name, N, number, &all));
    }
    let group = format!("{} {source}, {N}²", mazes.len());
    all.iter()
        .map(|(what, timed)| timed.row(&group, what))
        .collect()
}

/// Returns a maze's least and median times, µs, as a line of JSON.
fn line(name: &str, side: usize, number: usize, all: &[(&str, Timed)]) -> String {
    let mut line = serde_json::json!({ "maze": name, "side": side });
    for (what, timed) in all {
        let rounds = &timed.in_turn[number];
        line[format!("{what} least us")] = rounded(least(rounds)).into();
        line[format!("{what} median us")] = rounded(median(rounds)).into();
    }
    line.to_string()
}

/// Microseconds of the same work in all mazes.
struct Timed {
    /// Times of each round, by maze.
    in_turn: Vec<Vec<f64>>,
    /// Least time of as many repetitions at once, by maze.
    repeated: Vec<f64>,
}

impl Timed {
    fn of(mazes: usize, mut work: impl FnMut(usize) -> f64) -> Self {
        let mut in_turn = vec![Vec::with_capacity(ROUNDS); mazes];
        for _ in 0..ROUNDS {
            for (number, times) in in_turn.iter_mut().enumerate() {
                times.push(work(number));
            }
        }
        let again = |number| least(&(0..ROUNDS).map(|_| work(number)).collect::<Vec<_>>());
        Self {
            in_turn,
            repeated: (0..mazes).map(again).collect(),
        }
    }

    fn row(&self, group: &str, what: &str) -> String {
        let of = |figure: fn(&[f64]) -> f64| -> Vec<f64> {
            self.in_turn.iter().map(|times| figure(times)).collect()
        };
        let (least, median) = (of(least), of(median));
        let worst = least.iter().copied().fold(0.0, f64::max);
        let [least, median, repeated] =
            [least, median, self.repeated.clone()].map(|all| mean(&all));
        format!("| {group} | {what} | {least:.2} | {median:.2} | {worst:.2} | {repeated:.2} |")
    }
}

fn since(begin: Instant) -> f64 {
    1e6 * begin.elapsed().as_secs_f64()
}

fn mean(times: &[f64]) -> f64 {
    times.iter().sum::<f64>() / times.len() as f64
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

/// Rounds to hundredths, which is finer than the clock.
fn rounded(time: f64) -> f64 {
    (100.0 * time).round() / 100.0
}

/// Explores until the mouse is back; microseconds of a decision, their mean.
fn explore<const N: usize>(named: &Named, times: &SpeedRunTimes<N>) -> f64 {
    let Named { maze, start, .. } = named;
    let (home, heading) = *start;
    let mut walls = WallMap::<N>::new(maze.grid(), ClosedCells::Possible).unwrap();
    let mut explorer = SpeedRunExplorer::<N>::new(times, home, heading, maze.goals());
    let (mut at, mut looks) = (home, heading);
    let mut decisions = Vec::new();
    loop {
        let rays = Direction::ALL.map(|side| match maze.is_open(at, side) {
            true => CellRay::out_of_range(side, 1),
            false => CellRay::to_wall(side, 0),
        });
        walls.observe(at, &rays).unwrap();
        let begin = Instant::now();
        let decision = explorer.decide(&walls, at, looks).unwrap();
        decisions.push(since(begin));
        let Decision::Drive(direction) = decision else {
            return mean(&decisions);
        };
        at = maze.grid().neighbour(at, direction).unwrap();
        looks = direction;
    }
}

/// Returns the origin of the mazes, in words, and the mazes by name.
fn mazes(folder: &str, side: u16) -> (&'static str, Vec<Named>) {
    if let Some(folder) = std::env::var_os("SPEED_RUN_MAZES") {
        let fits = |named: &Named| {
            let larger = named.maze.grid().width().max(named.maze.grid().height());
            (larger > 16) == (side > 16) && larger <= side
        };
        let named = in_folder(Path::new(&folder)).unwrap();
        return ("of yours", named.into_iter().filter(fits).collect());
    }
    let data = std::env::var_os("TOLMAN_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    match in_folder(&data.join("mazes").join(folder)) {
        Some(mazes) => ("of competitions", mazes),
        None => (
            "generated",
            (0..20).map(|seed| generated(seed, side)).collect(),
        ),
    }
}

fn generated(seed: u64, side: u16) -> Named {
    let braided = Braided {
        width: side,
        height: side,
        share: 0.5,
    };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut maze = braided.generate(&mut rng).unwrap();
    maze.set_goals(maze.grid().middle().collect());
    Named::of(format!("seed {seed}"), maze)
}

fn in_folder(folder: &Path) -> Option<Vec<Named>> {
    let entries = std::fs::read_dir(folder).ok()?;
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).ok()?;
        let name = path.file_stem()?.to_string_lossy().into_owned();
        Some(Named::of(name, tolman_maze::read(&text).ok()?.maze))
    };
    Some(paths.iter().filter_map(read).collect())
}

impl Named {
    fn of(name: String, maze: Maze) -> Self {
        let start = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
        Self { name, maze, start }
    }
}
