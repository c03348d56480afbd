//! Explores all mazes of a folder in the competition model and prints a table.
//!
//! `cargo run --release -p tolman --example competition -- FOLDER [classic|half-size]`
#![expect(clippy::print_stdout, reason = "the table is the purpose")]

use core::error::Error;
use std::path::Path;
use std::{env, fs};

use rayon::prelude::*;
use tolman_arena::competition;
use tolman_planners::speed_run::SpeedRunConfig;
use tolman_systems::micromouse::competition::SpeedRunExploration;

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
    let outcomes: Vec<_> = paths
        .par_iter()
        .map(|path| explore(path, &config))
        .collect();

    println!("{:>6} {:>8} {:>9}  maze", "cells", "run/ms", "certified");
    let mut explored = Vec::new();
    for (path, outcome) in paths.iter().zip(outcomes) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        match outcome {
            Ok(done) => {
                let mark = if done.verdict.is_ok() { "yes" } else { "NO" };
                let time = done.certificate.time_ms;
                println!("{:6} {time:8} {mark:>9}  {name}", done.cells);
                explored.push(done);
            }
            Err(error) => println!("{:>25}  {name}: {error}", "skipped"),
        }
    }
    let count = explored.len().max(1) as f64;
    let cells: u32 = explored.iter().map(|done| done.cells).sum();
    let certified = explored.iter().filter(|done| done.verdict.is_ok()).count();
    println!(
        "{} mazes: {:.2} cells, {:.1} % certified",
        explored.len(),
        f64::from(cells) / count,
        100.0 * certified as f64 / count,
    );
    Ok(())
}

/// Explores a maze. Returns an error as text, which can change threads.
fn explore(path: &Path, config: &SpeedRunConfig) -> Result<SpeedRunExploration, String> {
    let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
    let file = tolman_maze::read(&text).map_err(|error| error.to_string())?;
    competition::explore(&file.maze, config, |_, _| {}).map_err(|error| error.to_string())
}
