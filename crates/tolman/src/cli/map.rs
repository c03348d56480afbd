//! `tolman map`: looks at learned maps.

mod plan;
mod show;
mod show_cpm;
mod show_survey;

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::Context;
use clap::Subcommand;
use tolman_arena::diktiometry::SurveyFile;
use tolman_maps::diktiometry::Action;
use tolman_maze::Direction;
use tolman_systems::mslst::MapFile;

use super::Failure;
use super::failure::OrBadInput;

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

/// Reads a map that `tolman learn` wrote.
///
/// # Errors
/// Bad input with the file's name.
pub(super) fn read(path: &Path) -> Result<MapFile, Failure> {
    parse(path, &text(path)?)
}

fn parse(path: &Path, text: &str) -> Result<MapFile, Failure> {
    MapFile::from_json(text)
        .with_context(|| path.display().to_string())
        .or_bad_input()
}

/// The name of the way an action of a survey goes.
fn way(action: Action) -> String {
    let direction = Direction::ALL.get(action.0 as usize);
    direction.map_or_else(String::new, ToString::to_string)
}

/// Reads a survey that `tolman survey` wrote.
///
/// # Errors
/// Bad input with the file's name.
pub(super) fn read_survey(path: &Path) -> Result<SurveyFile, Failure> {
    parse_survey(path, &text(path)?)
}

fn parse_survey(path: &Path, text: &str) -> Result<SurveyFile, Failure> {
    SurveyFile::from_json(text)
        .with_context(|| path.display().to_string())
        .or_bad_input()
}

/// The text of a file with a learned map of whichever kind.
///
/// # Errors
/// Bad input with the file's name.
pub(super) fn text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path)
        .with_context(|| {
            let path = path.display();
            format!(
                "cannot read {path}; give a file that `tolman learn`, `tolman cpm learn` or `tolman survey` wrote"
            )
        })
        .or_bad_input()
}
