//! External mazes and logs, which are not part of this project.
//!
//! They are read from the folder that the variable `TOLMAN_DATA` names, or else from
//! `../shared/data` beside the current folder. If neither exists, experiments that need them are
//! skipped with a message.

use std::env;
use std::path::PathBuf;

const DEFAULT: &str = "../shared/data";

/// Origin of the external mazes: a sentence without its beginning.
pub(crate) const MAZES: &str = "it is one of the mazes that Udacity gives with its project \"Plot and Navigate a Virtual Maze\", or of \
                                the collections of micromouse contests; put it into `mazes` of the folder that TOLMAN_DATA names";

/// Returns the folder, or `None` if it does not exist.
#[must_use]
pub fn folder() -> Option<PathBuf> {
    let named = env::var_os("TOLMAN_DATA").map_or_else(|| PathBuf::from(DEFAULT), PathBuf::from);
    named.is_dir().then_some(named)
}

/// Returns the message for missing data.
#[must_use]
pub fn missing(what: &str) -> String {
    format!("Skipped: {what}, which are not here. Set TOLMAN_DATA to the folder that holds them.")
}
