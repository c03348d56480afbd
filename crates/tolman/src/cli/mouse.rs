//! `tolman mouse`: a micromouse explores mazes, proves its run and makes it, under the paper's rules or those of mms.

mod drawing;
mod mms;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_arena::micromouse::{self, Judgement, MouseTrial};
use tolman_maze::Maze;
use tolman_systems::micromouse::Searcher;
use tolman_systems::micromouse::mms::Until;

use super::maze::Collection;
use super::words::words;
use super::{Failure, OrBadInput, file, maze};

/// Sends a micromouse through mazes: it explores, proves its run, and makes it
#[derive(clap::Args)]
#[command(after_help = "\
The rules are those of \"Plot and Navigate a Virtual Maze\": at most 1000 steps for both runs, each a quarter turn or none
and then up to three cells; the score is a thirtieth of the steps of the first run and those of the second. The
floor is the score of a mouse that knows the maze. With --mms the rules are those of the simulator mms, which hosts the
mouse: it speaks with it on stdin and stdout, and logs to stderr.

Examples:
  tolman mouse mazes/grid/braided-2.txt
  tolman mouse mazes/grid --worst 3
  tolman mouse mazes/grid/perfect-1.txt --steps steps.jsonl
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid")]
pub(super) struct Arguments {
    /// A maze file of any format, or a folder of them
    #[arg(value_name = "FILE|DIR", required_unless_present = "mms")]
    maze: Option<PathBuf>,
    /// Speak the protocol of the simulator mms on stdin and stdout
    #[arg(long, conflicts_with_all = ["maze", "search", "seed", "steps", "worst", "jobs", "json"])]
    mms: bool,
    /// When the mouse of --mms has explored enough
    #[arg(long, default_value = "proof", value_parser = words(UNTIL), requires = "mms")]
    until: Until,
    /// How to explore: certify (until the run is proven), certify-plain (the same, without rollouts), or as the paper does: target, counter-50, counter-75, random
    #[arg(long, value_name = "SEARCH", default_value_t = Searcher::Certify)]
    search: Searcher,
    /// What the chance of the searches that have any follows from
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Write every step as JSON lines: {"rotation": -90|0|90|"Reset", "movement": -3…3|"Reset"}; one maze only
    #[arg(long, value_name = "FILE")]
    steps: Option<PathBuf>,
    /// Draw so many of the mazes with the worst score above the floor
    #[arg(long, value_name = "N", default_value_t = 1)]
    worst: usize,
    /// Mazes at a time, instead of one a core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Write one JSON object a maze and line
    #[arg(long)]
    json: bool,
}

/// When a mouse has explored enough.
const UNTIL: [(&str, &str, Until); 2] = [
    ("goal", "It has been at the goal", Until::Goal),
    (
        "proof",
        "No run can score less than the best one it knows",
        Until::Proof,
    ),
];

/// One maze and what became of the mouse in it.
struct Tried<'a> {
    file: &'a Path,
    maze: &'a Maze,
    trial: MouseTrial,
    judgement: Judgement,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    // clap asks for one of the two.
    let Some(path) = arguments.maze.as_ref().filter(|_| !arguments.mms) else {
        return mms::carry_out(arguments.until, out);
    };
    let Collection { mazes, unsound } = Collection::read(path)?;
    let files = mazes.len() + unsound.len();
    if arguments.steps.is_some() && files > 1 {
        return Err(Failure::BadInput(anyhow!(
            "--steps is of one maze, and {} holds {files}: name a file",
            path.display()
        )));
    }
    let tried = maze::each(&mazes, arguments.jobs, |file, maze| {
        let tried = micromouse::try_on(maze, arguments.search, arguments.seed);
        let (trial, judgement) = tried.with_context(|| maze::name(file)).or_bad_input()?;
        Ok(Tried {
            file,
            maze,
            trial,
            judgement,
        })
    })?;
    for tried in &tried {
        arguments.tell(tried, out)?;
    }
    if !arguments.json {
        let drawn = if tried.len() > 1 { arguments.worst } else { 1 };
        draw_worst(&tried, drawn, out)?;
        if tried.len() > 1 {
            writeln!(out, "{}", summary(&tried))?;
        }
    }
    if let (Some(path), Some(tried)) = (&arguments.steps, tried.first()) {
        file::write(path, steps(&tried.trial)?)?;
    }
    out.flush()?;
    unsound.complain(tried.len())?;
    let solved = tried.iter().map(|tried| tried.judgement.score.is_some());
    maze::all_solved(&mazes, solved)
}

impl Arguments {
    fn tell(&self, tried: &Tried<'_>, out: &mut dyn Write) -> Result<(), Failure> {
        let name = maze::name(tried.file);
        let judgement = &tried.judgement;
        if self.json {
            let mut line = serde_json::to_value(judgement)?;
            line["maze"] = json!(name);
            line["search"] = json!(self.search.name());
            line["above_floor"] = json!(judgement.above_floor());
            line["gave_up"] = json!(tried.trial.gave_up.map(|error| error.to_string()));
            return Ok(writeln!(out, "{line}")?);
        }
        match (judgement.run_1, judgement.run_2, judgement.score) {
            (Some(run_1), Some(run_2), Some(score)) => writeln!(
                out,
                "{name}: {score:.3} = {run_1} / 30 + {run_2}, {:.3} above the floor{}",
                score - judgement.floor,
                if judgement.certified { ", proven" } else { "" }
            )?,
            _ => match tried.trial.gave_up {
                Some(error) => writeln!(out, "{name}: {error}")?,
                None => writeln!(
                    out,
                    "{name}: not done after {} steps",
                    tried.trial.steps.len()
                )?,
            },
        }
        Ok(())
    }
}

/// Those that did not finish first, then by how far they are above the floor.
fn draw_worst(tried: &[Tried<'_>], count: usize, out: &mut dyn Write) -> Result<(), Failure> {
    let mut order: Vec<&Tried<'_>> = tried.iter().collect();
    order.sort_by(|a, b| {
        let above = |tried: &Tried<'_>| tried.judgement.above_floor().unwrap_or(f64::INFINITY);
        above(b).total_cmp(&above(a))
    });
    for tried in order.into_iter().take(count) {
        let name = maze::name(tried.file);
        let drawing = drawing::of(tried.maze, &tried.trial);
        writeln!(
            out,
            "\n{name}, with the stops of the first run (.) and of the second (*):\n{drawing}"
        )?;
    }
    Ok(())
}

fn summary(tried: &[Tried<'_>]) -> String {
    let count = tried.len();
    let done: Vec<&Judgement> = tried
        .iter()
        .map(|tried| &tried.judgement)
        .filter(|judgement| judgement.score.is_some())
        .collect();
    let mean = |value: fn(&Judgement) -> Option<f64>| {
        done.iter()
            .filter_map(|judgement| value(judgement))
            .sum::<f64>()
            / done.len().max(1) as f64
    };
    let certified = done.iter().filter(|judgement| judgement.certified).count();
    format!(
        "{count} mazes: {} finished, {certified} proven; mean score {:.3}, {:.3} above the floor",
        done.len(),
        mean(|judgement| judgement.score),
        mean(Judgement::above_floor),
    )
}

/// The orders, a line each.
fn steps(trial: &MouseTrial) -> Result<String, Failure> {
    let mut text = String::new();
    for step in &trial.steps {
        text += &serde_json::to_string(&step.order)?;
        text.push('\n');
    }
    Ok(text)
}
