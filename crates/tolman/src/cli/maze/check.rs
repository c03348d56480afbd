//! `tolman maze check`: whether files can be read, and whether their mazes can be solved.

use std::io::Write;
use std::path::PathBuf;

use super::collection::Unsound;
use super::{Result, input, summary::Summary};

/// Reads mazes and checks that a way leads to the goal; exits 2 if one is invalid
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman maze check mazes/*.maze mazes/grid/*.txt")]
pub(crate) struct Arguments {
    /// Maze files of any format; - reads standard input
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Write one JSON object per valid maze, one per line
    #[arg(long)]
    json: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let mut unsound = Unsound::default();
    let mut sound = 0;
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
                out.flush()?;
            }
            Err(failure) => unsound.push(failure),
        }
    }
    unsound.complain(sound)
}
