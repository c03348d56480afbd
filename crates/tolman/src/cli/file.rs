//! Writes files that the command line asks for.

use std::path::Path;

use anyhow::Context;
use tolman_experiment::files;

use super::Failure;

/// Writes `contents` to the file at `path`. A file is written completely or not at all.
///
/// # Errors
/// A failure that names the file and says what to do.
pub(super) fn write(path: &Path, contents: impl AsRef<[u8]>) -> Result<(), Failure> {
    Ok(
        files::write_whole(path, contents.as_ref()).with_context(|| {
            format!(
                "cannot write {}: give a path in a folder that can be written to",
                path.display()
            )
        })?,
    )
}
