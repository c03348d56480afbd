//! `tolman maze convert`: the same maze in another format.

use std::io::Write;
use std::path::PathBuf;

use super::output::MazeOutput;
use super::{Result, input};

/// Writes a maze in another format
#[derive(clap::Args)]
#[command(after_help = "\
Formats: numbers (of the micromouse test program), mazefiles (drawings), num (of the simulator
mms), tolman (docs/maze-format.md). The format of the input is recognized by its text.

Example:
  tolman maze convert mazes/grid/braided-2.txt --to num --out braided-2.num")]
pub(crate) struct Arguments {
    /// Maze file; - reads standard input
    file: PathBuf,
    #[command(flatten)]
    output: MazeOutput,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    arguments.output.write(&input::parse(&arguments.file)?, out)
}
