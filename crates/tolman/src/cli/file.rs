//! Reads and writes files that the command line names.

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::Context;
use tolman_experiment::files;
use tolman_formats::input;

use super::{OrBadInput, Result};

/// Returns the text of the file at `path`.
///
/// # Errors
/// Bad input that names the file and says what to do: `repair`.
pub(super) fn read(path: &Path, repair: &str) -> Result<String> {
    input::text(path)
        .with_context(|| format!("cannot read {}; {repair}", path.display()))
        .or_bad_input()
}

/// Writes `contents` to the file at `path`. A file is written completely or not at all.
///
/// # Errors
/// A failure that names the file and says what to do.
pub(super) fn write(path: &Path, contents: impl AsRef<[u8]>) -> Result {
    Ok(
        files::write_whole(path, contents.as_ref()).with_context(|| {
            format!(
                "cannot write {}: give a path in a folder that can be written to",
                path.display()
            )
        })?,
    )
}

/// Writes `text` to the file at `path`, or to `out` if no file is named.
///
/// # Errors
/// As [`write`].
pub(super) fn write_or_show(path: Option<&Path>, text: &str, out: &mut dyn Write) -> Result {
    match path {
        Some(path) => write(path, text),
        None => Ok(out.write_all(text.as_bytes())?),
    }
}

/// Makes the folder at `path`, if it does not exist.
///
/// # Errors
/// A failure that names the folder and says what to do: `repair`.
pub(super) fn make_folder(path: &Path, repair: &str) -> Result {
    Ok(fs::create_dir_all(path)
        .with_context(|| format!("cannot make {}: {repair}", path.display()))?)
}
