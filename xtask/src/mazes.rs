//! `cargo xtask mazes`: checks that every maze of the project can be read and solved. Also checks
//! that the fragments of Mazes 1 to 3 of CPM are distinctive.

use std::process::Command;

use anyhow::Result;

use crate::workspace;

/// "Every path-fragment in the environment is distinctive" (CPM, section 4.3).
const DISTINCTIVE: [&str; 3] = ["cpm-1.maze", "cpm-2.maze", "cpm-3.maze"];

/// Builds the command and checks all files in `mazes/` with it.
///
/// # Errors
/// If there is no maze, or one of them is refused.
pub(crate) fn run() -> Result<()> {
    check_with(|| Ok(workspace::cargo("run --quiet --package tolman --")))
}

/// Checks all files in `mazes/` with `tolman`, and lets an e-puck walk the mazes that have to be
/// distinctive.
///
/// # Errors
/// As [`run`].
pub(crate) fn check_with(tolman: impl Fn() -> Result<Command>) -> Result<()> {
    let folder = workspace::root().join("mazes");
    let mut files = workspace::entries(&folder)?;
    for kind in ["grid", "tolman"] {
        files.extend(workspace::entries(&folder.join(kind))?);
    }
    files.retain(|path| path.extension().is_some_and(|extension| extension != "md"));
    workspace::succeed(tolman()?.args(["maze", "check"]).args(files))?;
    let distinctive = DISTINCTIVE.map(|name| folder.join(name));
    workspace::succeed(tolman()?.args(["maze", "distinct"]).args(distinctive))
}
