//! `tolman maze check`: whether files can be read, and whether their mazes can be solved.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use tolman_maze::Maze;

use super::collection::Unsound;
use super::{Failure, Result, input, rules, summary::Summary};
use crate::cli::words::counted;

/// Reads mazes and checks that a way leads to the goal; exits 2 if one is invalid
#[derive(clap::Args)]
#[command(after_help = "\
With --rules, mazes are also checked against the rules of micromouse contests: the start has three walls, the goal is
the middle without walls in it, a wall ends at each post, and no maze is another one, turned or mirrored. Exits 1 if a
maze breaks a rule.

Examples:
  tolman maze check mazes/*.maze mazes/grid/*.txt
  tolman maze check mazes/grid/*.txt --rules  # exits 1")]
pub(crate) struct Arguments {
    /// Maze files of any format; - reads standard input
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Write one JSON object per valid maze, one per line
    #[arg(long)]
    json: bool,
    /// Check the rules of micromouse contests too
    #[arg(long, conflicts_with = "json")]
    rules: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let mut unsound = Unsound::default();
    let mut sound = 0;
    let (mut earlier, mut broken) = (Vec::<(String, Maze)>::new(), 0);
    for file in &arguments.files {
        match input::read(file) {
            Ok(read) => {
                sound += 1;
                let summary = Summary::of(input::name(file), &read);
                if arguments.json {
                    writeln!(out, "{}", serde_json::to_string(&summary)?)?;
                } else {
                    writeln!(out, "{summary}")?;
                }
                if arguments.rules {
                    let mut against = rules::broken(&read.maze);
                    let mut twins = earlier
                        .iter()
                        .filter(|(_, maze)| rules::are_alike(maze, &read.maze));
                    against.extend(
                        twins
                            .next()
                            .map(|(twin, _)| format!("the maze is the same as {twin}")),
                    );
                    broken += against.len();
                    for rule in against {
                        writeln!(out, "{}: {rule}", input::name(file))?;
                    }
                    earlier.push((input::name(file), read.maze));
                }
                out.flush()?;
            }
            Err(failure) => unsound.push(failure),
        }
    }
    unsound.complain(sound)?;
    match broken {
        0 => Ok(()),
        _ => Err(Failure::Failed(anyhow!(
            "{} broken",
            counted(broken, "rule")
        ))),
    }
}
