//! Files that are either whole or not there.

use std::fs;
use std::path::Path;

use anyhow::Context;

use super::Failure;

/// Writes `text` beside `path` and renames it into place.
///
/// # Errors
/// If one of the two cannot be done; nothing is left behind.
pub(super) fn write_whole(path: &Path, text: &str) -> Result<(), Failure> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let written = fs::write(&beside, text).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // The first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    Ok(written.with_context(|| {
        format!(
            "cannot write {}: give a path in a folder that can be written to",
            path.display()
        )
    })?)
}
