//! `cargo xtask mazes`: every maze of the project can be read and solved.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};

use crate::workspace;

/// Runs `tolman maze check` over all files in `mazes/`.
///
/// # Errors
/// If there is none, or one of them is refused.
pub(crate) fn run() -> Result<()> {
    let folder = workspace::root().join("mazes");
    let mut files = Vec::<PathBuf>::new();
    for entry in
        fs::read_dir(&folder).with_context(|| format!("cannot read {}", folder.display()))?
    {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension != "md") {
            files.push(path);
        }
    }
    files.sort();
    ensure!(!files.is_empty(), "no maze in {}", folder.display());
    let mut check = workspace::cargo("run --quiet --package tolman -- maze check");
    workspace::succeed(check.args(files))
}
