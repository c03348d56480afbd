//! Maze files named on the command line.

use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_experiment::files::files_in;
use tolman_formats::input::{self, SourceError};
use tolman_maze::MazeFile;

use super::{Failure, OrBadInput, Result};
use crate::cli::kind::Kind;

/// Reads a valid maze from a file in any format, or from stdin if the path is `-`.
///
/// # Errors
/// Bad input with the file's name, and with line and column if the text is at fault.
pub(in crate::cli) fn read(path: &Path) -> Result<MazeFile> {
    read_by(path, tolman_maze::read)
}

/// Reads a maze like [`read`], but also accepts one without a way to the goal.
///
/// # Errors
/// As [`read`].
pub(super) fn parse(path: &Path) -> Result<MazeFile> {
    read_by(path, tolman_maze::parse)
}

fn read_by<E: Into<anyhow::Error>>(
    path: &Path,
    read: impl FnOnce(&str) -> Result<MazeFile, E>,
) -> Result<MazeFile> {
    let text = text(path)?;
    read(&text)
        .map_err(|error| Kind::Maze.explain(&text, &name(path), error))
        .or_bad_input()
}

/// Returns the maze files that a path names: the file itself, or the files of the folder, sorted by
/// name, without hidden ones.
///
/// # Errors
/// If the folder cannot be read or holds no file.
pub(super) fn files(path: &Path) -> Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let is_hidden = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        name.as_encoded_bytes().starts_with(b".")
    };
    let mut files = files_in(path)
        .with_context(|| format!("cannot list {}", path.display()))
        .or_bad_input()?;
    files.retain(|file| !is_hidden(file));
    if files.is_empty() {
        return Err(Failure::BadInput(anyhow!(
            "{} holds no file: name a folder of mazes",
            path.display()
        )));
    }
    Ok(files)
}

/// Returns the name of a file in messages.
pub(in crate::cli) fn name(path: &Path) -> String {
    if is_stdin(path) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

/// Returns the name that a maze file gives its maze, or else the name of the file in messages.
pub(in crate::cli) fn world_name(path: &Path, file: &MazeFile) -> String {
    file.name.clone().unwrap_or_else(|| name(path))
}

/// Returns the text of a file, or of stdin if the path is `-`.
///
/// # Errors
/// Bad input with the file's name.
pub(in crate::cli) fn text(path: &Path) -> Result<String> {
    let text = source(path);
    text.map_err(|error| match error {
        SourceError::System(error) => anyhow::Error::from(error).context(format!(
            "cannot read {}; give the path of a file",
            name(path)
        )),
        SourceError::Packed => anyhow!(
            "{} is packed by gzip; unpack a maze or world with `gunzip`, and give a robot's log to \
             `tolman map --log`",
            name(path)
        ),
        error => anyhow!(
            "{}: {error}: expected a maze or a world in text form",
            name(path)
        ),
    })
    .or_bad_input()
}

/// Returns the text of a file, or of stdin if the path is `-`.
pub(in crate::cli) fn source(path: &Path) -> Result<String, SourceError> {
    let bytes = match is_stdin(path) {
        true => input::bytes_of(io::stdin().lock()),
        false => input::bytes(path),
    }?;
    // Binary mazes are no text.
    match tolman_maze::maz_text(&bytes) {
        Some(text) => Ok(text),
        None => input::text_of(&*bytes),
    }
}

/// Returns whether a path stands for stdin.
pub(in crate::cli) fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}
