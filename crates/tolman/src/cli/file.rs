//! The files that the command line asks for.

use std::path::Path;

use anyhow::Context;
use tolman_experiment::files;

use super::Failure;

/// Writes `contents` to the file at `path`, whole or not at all.
///
/// # Errors
/// A failure that names the file and a repair.
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
