//! Replays as files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Context, anyhow};
use tolman_replay::{Replay, is_replay, page};

use super::{Failure, OrBadInput, called, file};

/// Whether a file that is no replay may be overwritten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Overwrite {
    /// Only replays are.
    Replays,
    /// Anything is.
    Anything,
}

impl Overwrite {
    /// Returns what `--force` says.
    pub(super) const fn if_forced(force: bool) -> Self {
        if force { Self::Anything } else { Self::Replays }
    }
}

/// Writes a replay to the file at `path`, whole or not at all.
///
/// # Errors
/// Bad input if the file exists and is not a replay; a failure if it cannot be written.
pub(super) fn write(path: &Path, replay: Replay, overwrite: Overwrite) -> Result<(), Failure> {
    check(path, overwrite)?;
    let replay = replay.fact("made by", called::command());
    let page = page(&replay).context("cannot write the replay")?;
    file::write(path, &page)
}

/// Checks before the work is done that the file at `path` does not exist yet, or is a replay.
///
/// # Errors
/// Bad input if it is anything else.
pub(super) fn check(path: &Path, overwrite: Overwrite) -> Result<(), Failure> {
    if overwrite == Overwrite::Anything || !path.is_file() {
        return Ok(());
    }
    let mut beginning = Vec::new();
    File::open(path)
        .and_then(|file| file.take(1000).read_to_end(&mut beginning))
        .with_context(|| format!("cannot read {}", path.display()))
        .or_bad_input()?;
    if beginning.is_empty() || is_replay(&beginning) {
        return Ok(());
    }
    Err(Failure::BadInput(anyhow!(
        "{} exists and is not a replay; give another name, or --force to overwrite it",
        path.display()
    )))
}

/// Returns the address at which a browser opens the file.
pub(super) fn address(path: &Path) -> String {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-_.~:".contains(&byte);
    let mut address = "file://".to_owned();
    for byte in path.to_string_lossy().bytes() {
        if plain(byte) {
            address.push(char::from(byte));
        } else {
            address.push_str(&format!("%{byte:02X}"));
        }
    }
    address
}
