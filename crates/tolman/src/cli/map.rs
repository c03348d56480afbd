//! `tolman map`: looks at learned maps.

mod plan;
mod show;
mod show_cpm;
mod show_mslst;
mod show_survey;

use core::error::Error;
use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::Context;
use clap::Subcommand;
use tolman_maps::diktiometry::Action;
use tolman_maze::Direction;

use super::{Failure, OrBadInput};

/// Looks at learned maps
#[derive(Subcommand)]
pub(super) enum Verb {
    Show(show::Arguments),
    Plan(plan::Arguments),
}

impl Verb {
    pub(super) fn carry_out(self, out: &mut dyn Write) -> Result<(), Failure> {
        match self {
            Self::Show(arguments) => show::carry_out(&arguments, out),
            Self::Plan(arguments) => plan::carry_out(&arguments, out),
        }
    }
}

/// Reads a learned map with `from_json`, the reader of its system.
///
/// # Errors
/// Bad input with the file's name.
pub(super) fn read<T, E: Error + Send + Sync + 'static>(
    path: &Path,
    from_json: fn(&str) -> Result<T, E>,
) -> Result<T, Failure> {
    parse(path, &text(path)?, from_json)
}

fn parse<T, E: Error + Send + Sync + 'static>(
    path: &Path,
    text: &str,
    from_json: fn(&str) -> Result<T, E>,
) -> Result<T, Failure> {
    from_json(text)
        .with_context(|| path.display().to_string())
        .or_bad_input()
}

/// The name of the way an action of a survey goes.
fn way(action: Action) -> String {
    let direction = Direction::ALL.get(action.0 as usize);
    direction.map_or_else(String::new, ToString::to_string)
}

/// Returns the text of a file with a learned map of whichever system.
fn text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path)
        .with_context(|| {
            let path = path.display();
            format!(
                "cannot read {path}; give a file that `tolman learn`, `tolman cpm learn` or `tolman survey` wrote"
            )
        })
        .or_bad_input()
}
