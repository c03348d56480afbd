//! `tolman arena --mapper` and `--brain`: contestants that are programs of their own.

use core::time::Duration;
use std::env;
use std::path::Path;

use anyhow::anyhow;
use tolman_arena::foreign::{Budget, ForeignEntry, Log, Role};

use super::super::{OrBadInput, Result, keep};
use super::Contestant;

/// Programs in any language that enter the arena.
#[derive(clap::Args)]
pub(super) struct Programs {
    /// Your mapper: a command that watches a robot and answers with its map. It is split into words
    /// as by a shell, but run without one. May be given several times
    #[arg(long, value_name = "CMD")]
    mapper: Vec<String>,
    /// Your brain: a command that drives the robot too
    #[arg(long, value_name = "CMD")]
    brain: Vec<String>,
    /// Maximum time for which a program may keep the robot waiting in each world
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    time_limit: u64,
    /// Show what the programs write to stderr
    #[arg(long)]
    log: bool,
}

/// Maximum length of a line from a program, bytes. A map of 10,000 places has a third of it.
const LINE_BYTES: u64 = 1 << 20;

impl Programs {
    /// Returns the contestants, mappers first.
    pub(super) fn contestants(&self) -> Result<Vec<Contestant>> {
        let mappers = self.mapper.iter().map(|command| (command, Role::Mapper));
        let brains = self.brain.iter().map(|command| (command, Role::Brain));
        let entries = mappers.chain(brains);
        entries
            .map(|(command, role)| self.entry(command, role).or_bad_input())
            .collect()
    }

    fn entry(&self, command: &str, role: Role) -> anyhow::Result<Contestant> {
        let option = match role {
            Role::Mapper => "--mapper",
            Role::Brain => "--brain",
        };
        let words = shlex::split(command);
        let words = words.ok_or_else(|| {
            anyhow!("{option} {command}: a quotation mark is not closed; close it")
        })?;
        let program = words.first();
        let program = program.ok_or_else(|| anyhow!("{option} is empty: name a program"))?;
        if !is_there(Path::new(program)) {
            return Err(anyhow!(
                "{option} {command}: there is no program {program}; give the path of one that can be run"
            ));
        }
        // A command runs once, and its contestants are there until it ends.
        let entry = Box::leak(Box::new(ForeignEntry {
            name: command.to_owned().leak(),
            words,
            role,
            keeper: keep::keeper(),
            log: match self.log {
                true => Log::Shown,
                false => Log::Dropped,
            },
            budget: Budget {
                time: Duration::from_secs(self.time_limit),
                line_bytes: LINE_BYTES,
                ..Budget::default()
            },
        }));
        Ok(entry)
    }
}

/// Returns whether a program is there, by its path or in the folders of `PATH`.
fn is_there(program: &Path) -> bool {
    if program.components().count() != 1 {
        return program.is_file();
    }
    let folders = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&folders).any(|folder| folder.join(program).is_file())
}
