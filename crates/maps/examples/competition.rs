//! Explores all mazes of a folder in the competition model and prints a table.
//!
//! `cargo run --release -p tolman-maps --example competition -- FOLDER [classic|half-size]`
#![expect(clippy::print_stdout, reason = "the table is the purpose")]

use core::error::Error;
use core::time::Duration;
use std::path::Path;
use std::time::Instant;
use std::{env, fs};

use tolman_maps::wall_map::{ClosedCells, Ray, WallMap};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{
    Decision, SpeedRunCertificate, SpeedRunConfig, SpeedRunExplorer, SpeedRunTimes,
    best_possible_ms,
};
use tolman_planners::{Passages, Unknown};

/// The most columns and rows.
const SIDE: usize = 32;

struct Exploration {
    cells: u32,
    run_ms: u16,
    certified: bool,
    /// One a cell.
    decisions: Vec<Duration>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let folder = arguments.next().ok_or("say which folder holds the mazes")?;
    let config = match arguments.next().as_deref() {
        None | Some("classic") => SpeedRunConfig::classic(),
        Some("half-size") => SpeedRunConfig::half_size(),
        Some(other) => return Err(format!("\"{other}\" is neither classic nor half-size").into()),
    };
    let mut paths = fs::read_dir(&folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()?;
    paths.sort();

    println!("{:>6} {:>8} {:>9}  maze", "cells", "run/ms", "certified");
    let mut all = Vec::new();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        match read(&path) {
            Ok(maze) => {
                let done = explore(&maze, &config)?;
                let mark = if done.certified { "yes" } else { "NO" };
                println!("{:6} {:8} {mark:>9}  {name}", done.cells, done.run_ms);
                all.push(done);
            }
            Err(error) => println!("{:>25}  {name}: {error}", "skipped"),
        }
    }

    let count = all.len().max(1) as f64;
    let cells: u32 = all.iter().map(|done| done.cells).sum();
    let certified = all.iter().filter(|done| done.certified).count();
    let mut decisions: Vec<_> = all.iter().flat_map(|done| &done.decisions).collect();
    decisions.sort();
    let total: Duration = decisions.iter().copied().sum();
    println!(
        "{} mazes: {:.2} cells, {:.1} % certified; a decision takes {:.1} µs, 99.9 % of them at most {:.1} µs",
        all.len(),
        f64::from(cells) / count,
        100.0 * certified as f64 / count,
        1e6 * total.as_secs_f64() / decisions.len().max(1) as f64,
        1e6 * decisions
            .get(decisions.len() * 999 / 1000)
            .map_or(0.0, |time| time.as_secs_f64()),
    );
    Ok(())
}

fn read(path: &Path) -> Result<Maze, Box<dyn Error>> {
    Ok(tolman_maze::read(&fs::read_to_string(path)?)?.maze)
}

fn explore(maze: &Maze, config: &SpeedRunConfig) -> Result<Exploration, Box<dyn Error>> {
    let (home, heading) = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
    let goals = maze.goals();
    let times = SpeedRunTimes::<SIDE>::new(config)?;
    let mut map = WallMap::<SIDE>::new(maze.grid(), ClosedCells::Possible)?;
    let mut explorer = SpeedRunExplorer::new(&times, home, heading, goals);
    let (mut at, mut looks) = (home, heading);
    let mut decisions = Vec::new();
    loop {
        map.observe(at, &Direction::ALL.map(|side| look(maze, at, side)))?;
        let begin = Instant::now();
        let decision = explorer.decide(&map, at, looks);
        decisions.push(begin.elapsed());
        match decision {
            Decision::Drive(direction) => {
                at = maze
                    .grid()
                    .neighbour(at, direction)
                    .ok_or("out of the maze")?;
                looks = direction;
            }
            Decision::Finished { run_ms } => {
                let known = Passages::new(&map, Unknown::Closed);
                let run = explorer.planner().run(&known);
                let certificate = SpeedRunCertificate {
                    start: home,
                    heading,
                    moves: run.map(|step| step.run_move).collect(),
                    time_ms: run_ms.into(),
                };
                let best = best_possible_ms(maze, config, (home, heading), goals);
                return Ok(Exploration {
                    cells: decisions.len() as u32 - 1,
                    run_ms,
                    certified: certificate.check(&map, config, goals).is_ok()
                        && best == Some(run_ms.into()),
                    decisions,
                });
            }
            Decision::Stuck => return Err("the goal is out of reach".into()),
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
