//! `tolman man`: the manual pages.

use std::fs;
use std::io::Write;

use anyhow::Context;
use clap::CommandFactory;

use super::Result;
use super::outputs::{self, Output};

/// Writes the manual page, or the pages of all verbs into a folder
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  tolman man | man -l -
  tolman man --out ~/.local/share/man/man1")]
pub(super) struct Arguments {
    /// Folder to write tolman.1, tolman-run.1, … to
    #[arg(long, value_name = "DIR", value_parser = outputs::folder(&[]))]
    out: Option<Output>,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let command = super::Arguments::command();
    match &arguments.out {
        Some(folder) => Ok(fs::create_dir_all(&**folder)
            .and_then(|()| clap_mangen::generate_to(command, &**folder))
            .with_context(|| format!("cannot write the pages into {}", folder.display()))?),
        None => Ok(clap_mangen::Man::new(command).render(out)?),
    }
}
