//! `tolman mms-host`: hosts a mouse that speaks the protocol of mms, and scores it.

use core::time::Duration;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use serde_json::json;
use tolman_arena::mms::{Hosted, Limits, Log, MouseExit, host};

use super::maze::Collection;
use super::{Failure, OrBadInput, maze};

/// Hosts a mouse that speaks the protocol of the simulator mms, without a window, and scores it
#[derive(clap::Args)]
#[command(after_help = "\
The mouse starts in the south-west cell and looks north; the goal is the middle of the maze. Its score
is the best run's turns and effective distance and a tenth of all turns and effective distance: less is
better, 2000 is a maze unsolved. The code of mms measures in half-steps, its README in cells; both are told.

Examples:
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid/braided-2.txt
  tolman mms-host --mouse 'tolman mouse --mms' --maze mazes/grid --jobs 1 --json")]
pub(super) struct Arguments {
    /// The mouse's command, split into words as a shell does, and run without one
    #[arg(long, value_name = "CMD")]
    mouse: String,
    /// A maze file of any format, or a folder of them
    #[arg(long, value_name = "FILE|DIR")]
    maze: PathBuf,
    /// Stop a mouse after so much time in a maze
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    time_limit: f64,
    /// Stop a mouse after so many moves, turns and crashes in a maze
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    move_limit: u64,
    /// Press the reset button after so many moves and turns
    #[arg(long, value_name = "N")]
    reset_after: Option<u64>,
    /// Mazes at a time, instead of one a core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Show what the mouse writes to stderr
    #[arg(long)]
    log: bool,
    /// Write one JSON object a maze and line
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let words = shlex::split(&arguments.mouse)
        .ok_or_else(|| {
            anyhow!(
                "--mouse {}: a quotation mark is not closed; close it",
                arguments.mouse
            )
        })
        .or_bad_input()?;
    let limits = arguments.limits()?;
    let Collection { mazes, unsound } = Collection::read(&arguments.maze)?;
    let log = if arguments.log {
        Log::Shown
    } else {
        Log::Dropped
    };
    let hosted = maze::each(&mazes, arguments.jobs, |_, maze| {
        host(&words, maze, &limits, log).or_bad_input()
    })?;
    for ((file, _), hosted) in mazes.iter().zip(&hosted) {
        arguments.tell(file, hosted, out)?;
    }
    if hosted.len() > 1 && !arguments.json {
        writeln!(out, "{}", summary(&hosted))?;
    }
    // What was hosted stands before what could not be, wherever the two streams end up.
    out.flush()?;
    unsound.complain(mazes.len())?;
    maze::all_solved(&mazes, hosted.iter().map(|hosted| hosted.solved))
}

impl Arguments {
    fn limits(&self) -> Result<Limits, Failure> {
        let time = Duration::try_from_secs_f64(self.time_limit)
            .ok()
            .filter(|time| (Duration::from_millis(1)..=LONGEST).contains(time))
            .ok_or_else(|| {
                anyhow!(
                    "--time-limit {}: give seconds, from 0.001 to {}",
                    self.time_limit,
                    LONGEST.as_secs()
                )
            })
            .or_bad_input()?;
        Ok(Limits {
            time,
            movements: self.move_limit,
            reset_after: self.reset_after,
        })
    }

    fn tell(&self, file: &Path, hosted: &Hosted, out: &mut dyn Write) -> Result<(), Failure> {
        let name = maze::name(file);
        if self.json {
            let mut line = serde_json::to_value(hosted)?;
            line["maze"] = json!(name);
            return Ok(writeln!(out, "{line}")?);
        }
        let came = if hosted.solved {
            "solved"
        } else {
            "not solved"
        };
        let Hosted {
            score,
            score_in_cells,
            movements,
            crashes,
            ..
        } = hosted;
        Ok(writeln!(
            out,
            "{name}: {came}, score {score:.1} ({score_in_cells:.1} in cells), {movements} movements, \
             {crashes} crashes, {}",
            how(hosted.ended)
        )?)
    }
}

/// No mouse is given more than a day.
const LONGEST: Duration = Duration::from_secs(24 * 60 * 60);

fn how(ended: MouseExit) -> &'static str {
    match ended {
        MouseExit::Done => "done",
        MouseExit::Failed => "ended with a failure",
        MouseExit::OutOfTime => "out of time",
        MouseExit::OutOfMovements => "out of movements",
        MouseExit::LineTooLong => "wrote a line that no command can be",
        _ => "stopped",
    }
}

fn summary(hosted: &[Hosted]) -> String {
    let count = hosted.len() as f32;
    let mean = |score: fn(&Hosted) -> f32| hosted.iter().map(score).sum::<f32>() / count;
    let solved = hosted.iter().filter(|hosted| hosted.solved).count();
    format!(
        "{solved} of {} solved, mean score {:.1} ({:.1} in cells)",
        hosted.len(),
        mean(|hosted| hosted.score),
        mean(|hosted| hosted.score_in_cells)
    )
}
