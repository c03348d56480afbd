//! Writes mazes in the format and to the file that the command line names.

use std::io::Write;

use anyhow::Context;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tolman_maze::{Format, MazeFile, write};

use super::{OrBadInput, Result, file};
use crate::cli::failure::note;
use crate::cli::outputs::{self, Output};

/// Destination and format of a maze that is written.
#[derive(clap::Args)]
pub(super) struct MazeOutput {
    /// Format to write
    #[arg(long, value_name = "FORMAT", default_value = "tolman", value_parser = formats())]
    to: Format,
    /// File to write, instead of standard output
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["maze", "txt", "num", "map", "maz", "hex"]))]
    out: Option<Output>,
}

impl MazeOutput {
    pub(super) fn write(&self, maze: &MazeFile, out: &mut dyn Write) -> Result {
        let text = write(maze, self.to)
            .context("cannot write the maze")
            .or_bad_input()?;
        if let Some(lost) = self.lost(maze) {
            note(&format!(
                "the format `{}` has no room for {lost}; `tolman` has",
                self.to.name()
            ));
        }
        file::write_or_show(self.out.as_deref(), &text, out)
    }

    /// Returns, in words, the contents of the maze file that the format cannot hold; `None` if
    /// nothing is lost.
    fn lost(&self, maze: &MazeFile) -> Option<&'static str> {
        if self.to == Format::Tolman {
            return None;
        }
        match (&maze.name, maze.corridor_width) {
            (Some(_), Some(_)) => Some("the maze's name and the corridors' width"),
            (Some(_), None) => Some("the maze's name"),
            (None, Some(_)) => Some("the corridors' width"),
            (None, None) => None,
        }
    }
}

fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name))
        .try_map(|name: String| name.parse::<Format>())
}
