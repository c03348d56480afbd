//! `tolman maze convert`: the same maze in another format.

use std::io::Write;
use std::path::PathBuf;

use clap::builder::TypedValueParser;

use super::marks::Marks;
use super::output::MazeOutput;
use super::{Result, input};
use crate::cli::words::words;

/// Writes a maze in another format
#[derive(clap::Args)]
#[command(after_help = "\
Formats: numbers (of the micromouse test program), mazefiles (drawings), boxes (the same in box
characters), num (of the simulator mms), tolman (docs/maze-format.md), blocks (grids of #),
underscores (drawings of _ and |), hex (a digit a cell), maz (binary, a byte a cell). The format of
the input is recognized by its text. --start and --goal are cells of the maze that is written:
most formats have the start in the south-west corner.

Examples:
  tolman maze convert mazes/grid/braided-2.txt --to num --out braided-2.num
  tolman maze convert mazes/grid/braided-2.txt --to tolman --rotate 90 --mirror
  tolman maze convert mazes/grid/braided-2.txt --to num --rotate 180 --start 0,0")]
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
    if arguments.mirror {
        file = file.mirrored();
    }
    for _ in 0..arguments.rotate {
        file = file.rotated();
    }
    // As the written maze has them: a format may hold one start alone.
    arguments.marks.put(&mut file)?;
    arguments.output.write(&file, out)
}
