//! `tolman maze convert`: the same maze in another format.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use clap::builder::TypedValueParser;

use super::marks::Marks;
use super::output::MazeOutput;
use super::{OrBadInput, Result, input};
use crate::cli::words::words;

/// Writes a maze in another format
#[derive(clap::Args)]
#[command(after_help = "\
Formats: numbers (of the micromouse test program), mazefiles (drawings), num (of the simulator
mms), tolman (docs/maze-format.md), blocks (grids of #), underscores (drawings of _ and |), hex (a
digit a cell), maz (binary, a byte a cell). The format of the input is recognized by its text.

Examples:
  tolman maze convert mazes/grid/braided-2.txt --to num --out braided-2.num
  tolman maze convert mazes/grid/braided-2.txt --to tolman --rotate 90 --mirror")]
pub(crate) struct Arguments {
    /// Maze file; - reads standard input
    file: PathBuf,
    #[command(flatten)]
    marks: Marks,
    /// Mirror the maze, west to east, before it is rotated
    #[arg(long)]
    mirror: bool,
    /// Rotate the maze by this angle, degrees clockwise
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = quarters())]
    rotate: u8,
    #[command(flatten)]
    output: MazeOutput,
}

fn quarters() -> impl TypedValueParser<Value = u8> {
    words([
        ("0", "As it is", 0),
        ("90", "North becomes east", 1),
        ("180", "North becomes south", 2),
        ("270", "North becomes west", 3),
    ])
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let mut file = input::parse(&arguments.file)?;
    arguments.marks.put(&mut file)?;
    if (arguments.mirror || arguments.rotate > 0) && !file.unknown.is_empty() {
        return Err(anyhow!(
            "{}: a maze with unknown walls cannot be turned; leave --rotate and --mirror out",
            input::name(&arguments.file)
        ))
        .or_bad_input();
    }
    if arguments.mirror {
        file.maze = file.maze.mirrored();
    }
    for _ in 0..arguments.rotate {
        file.maze = file.maze.rotated();
    }
    arguments.output.write(&file, out)
}
