//! `tolman maze`: looks at mazes, checks, converts and makes them.

mod check;
mod collection;
mod convert;
mod diff;
mod distinct;
mod generate;
mod input;
mod marks;
mod output;
mod rules;
mod show;
mod summary;

use std::io::Write;

use clap::Subcommand;

use super::{App, Failure, OrBadInput, Result, file};
pub(super) use collection::{Collection, each};
pub(super) use input::{is_stdin, name, read, source, text, world_name};
pub(super) use marks::{Marks, place};

/// Shows, checks, compares, converts and generates mazes
#[derive(Subcommand)]
pub(super) enum Verb {
    Show(show::Arguments),
    Check(check::Arguments),
    Convert(convert::Arguments),
    Diff(diff::Arguments),
    Generate(generate::Arguments),
    Distinct(distinct::Arguments),
}

impl Verb {
    pub(super) fn carry_out(self, app: &App, out: &mut dyn Write) -> Result {
        match self {
            Self::Show(arguments) => show::carry_out(&arguments, out),
            Self::Check(arguments) => check::carry_out(&arguments, out),
            Self::Convert(arguments) => convert::carry_out(&arguments, out),
            Self::Diff(arguments) => diff::carry_out(&arguments, out),
            Self::Generate(arguments) => generate::carry_out(app, &arguments, out),
            Self::Distinct(arguments) => distinct::carry_out(&arguments, out),
        }
    }
}
