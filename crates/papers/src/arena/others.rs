//! Table `others`: drawings and floors that others made, from the folder of external data.

use core::slice;
use std::fs;
use std::path::{Path, PathBuf};

use tolman_arena::contest::ContestRecord;
use tolman_experiment::{BoxError, Options, Row, Table, run_seed};

use super::records::ConditionRun;
use super::rows::{RowName, contestants, row_name, runs_of};
use super::worlds::{ArenaWorld, DrawnWorld};
use super::{Arena, ArenaTask};
use crate::data;
use crate::maze_file::in_file;

/// Name of the table.
pub(super) const TABLE: &str = "others";

/// Kinds of worlds: the name in a row, the folder in that of the data, and the endings of files
/// that are no worlds there.
const KINDS: [(&str, &str, &[&str]); 2] = [
    ("drawings", "mazes", &["md"]),
    ("floors", "floors", &["md", "pgm", "png"]),
];

/// Worlds of others.
#[derive(Debug, Default)]
pub(super) struct Others {
    /// Their files by [`KINDS`], in an order that a seed has drawn.
    files: [Vec<PathBuf>; KINDS.len()],
    /// Files in which no contest can be held, with the reason.
    refused: Vec<String>,
}

impl Others {
    /// Returns the worlds that are there, each read once; none if the table is not asked for.
    ///
    /// # Errors
    /// If a folder cannot be read.
    pub(super) fn found(options: &Options) -> Result<Self, BoxError> {
        let mut found = Self::default();
        if let Some(folder) = data::folder().filter(|_| is_named(options)) {
            for (files, (_, kind, others)) in found.files.iter_mut().zip(KINDS) {
                let kind = folder.join(kind);
                if kind.is_dir() {
                    collect(&kind, others, files)?;
                }
                files.retain(|file| match ArenaWorld::of_others(slice::from_ref(file)) {
                    Ok(_) => true,
                    Err(error) => {
                        found.refused.push(error.to_string());
                        false
                    }
                });
                // A run takes the file of its number: so few runs are a fair sample, too. Where the
                // data lie does not change the order.
                files.sort_by_key(|file| {
                    let name = file.strip_prefix(&folder).unwrap_or(file);
                    run_seed(options.seed, &name.to_string_lossy(), 0)
                });
            }
        }
        Ok(found)
    }

    /// Returns the files of a kind.
    fn of(&self, kind: &str) -> &[PathBuf] {
        let named = KINDS.iter().position(|(name, ..)| *name == kind);
        named.map_or(&[], |kind| &self.files[kind])
    }
}

/// Adds the files in `folder` and in all folders below it.
fn collect(folder: &Path, others: &[&str], files: &mut Vec<PathBuf>) -> Result<(), BoxError> {
    let listed = fs::read_dir(folder).map_err(|error| in_file(folder, error))?;
    for entry in listed {
        let path = entry.map_err(|error| in_file(folder, error))?.path();
        let ending = path.extension().unwrap_or_default();
        if path.is_dir() {
            collect(&path, others, files)?;
        } else if others.iter().all(|other| ending != *other) {
            files.push(path);
        }
    }
    Ok(())
}

/// Returns whether the table is asked for by name, and is filled: a run takes up to a minute.
fn is_named(options: &Options) -> bool {
    options.tables.iter().any(|name| name == TABLE)
}

/// Returns the table.
pub(super) fn table(others: &Others, options: &Options) -> Table {
    let mut rows = Vec::new();
    for contestant in contestants(ArenaTask::Learn) {
        for (kind, ..) in KINDS {
            let row = Row::new(row_name(contestant, kind));
            rows.push(match others.of(kind).len() {
                _ if !is_named(options) => row.runs(0),
                0 => row.missing(data::missing(&format!("{kind} of others"))),
                _ => row.runs(runs_of(contestant, options, 1)),
            });
        }
    }
    let refused = match others.refused.is_empty() {
        true => String::new(),
        false => format!(" Left out: {}.", others.refused.join("; ")),
    };
    Table::of::<ConditionRun>(TABLE, "In worlds that others drew")
        .metrics_from(ConditionRun::abstained)
        .rows(rows)
        .note(format!(
            "Each system on its paper's robot. Drawings: files of competitions and generators, of any \
             format, in `mazes`; floors: occupancy grids of ROS in `floors`, both of the folder that \
             TOLMAN_DATA names. Each run has another file, in an order that the seed draws; where \
             there are more runs than files, a file comes again with another seed. Systems that need \
             cells abstain on floors.{refused}",
        ))
}

impl Arena {
    /// Returns the world of a run of the table of others.
    pub(super) fn world_of_others(
        &self,
        row: &RowName<'_>,
        run: u32,
    ) -> Result<DrawnWorld, BoxError> {
        let files = self.others.of(row.world);
        let turn = (run as usize).checked_rem(files.len());
        let file = files[turn.ok_or("there is no such file")?].clone();
        let world = ArenaWorld::of_others(&[file])?.worlds.into_iter().next();
        world
            .ok_or("there is no world in the file")?
            .draw(self.seed, run)
    }

    /// Plays a run of the table of others.
    pub(super) fn among_others(
        &self,
        row: &RowName<'_>,
        run: u32,
    ) -> Result<ContestRecord, BoxError> {
        let world = self.world_of_others(row, run)?;
        let contest = world.contest(row.contestant, None);
        Ok(world.hold(&contest, &self.schooling, |_, _| {})?)
    }
}
