//! Writes replays to files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Context, Error, anyhow};
use tolman_replay::{Replay, is_replay, page};

use super::{Failure, OrBadInput, called, file};

/// Rule for the existing files that may be overwritten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Overwrite {
    /// Only replays.
    Replays,
    /// Any file.
    Anything,
}

impl Overwrite {
    /// Returns what `--force` asks for.
    pub(super) const fn if_forced(force: bool) -> Self {
        if force { Self::Anything } else { Self::Replays }
    }
}

/// Writes a replay to the file at `path`, completely or not at all. It is a web page, or a file for
/// Foxglove if the name ends in `.mcap`.
///
/// # Errors
/// Bad input if the file exists and is not a replay; a failure if it cannot be written.
pub(super) fn write(path: &Path, replay: Replay, overwrite: Overwrite) -> Result<(), Failure> {
    check(path, overwrite)?;
    let replay = replay.fact("made by", called::command());
    let context = "cannot write the replay";
    if is_mcap(path) {
        return file::write(path, mcap(&replay).context(context)?);
    }
    file::write(path, &page(&replay).context(context)?)
}

fn is_mcap(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension == "mcap")
}

#[cfg(feature = "mcap")]
fn mcap(replay: &Replay) -> Result<Vec<u8>, Error> {
    Ok(tolman_replay::mcap(replay)?)
}

/// Returns an error. It is never called, because [`check`] has refused the file before.
#[cfg(not(feature = "mcap"))]
fn mcap(_: &Replay) -> Result<Vec<u8>, Error> {
    Err(anyhow!(NO_MCAP))
}

const NO_MCAP: &str =
    "this tolman writes no MCAP: build it with --features mcap, or name a file that ends in .html";

/// First bytes of an MCAP file.
const MCAP: &[u8] = b"\x89MCAP0\r\n";

/// Checks that the file at `path` does not exist, or is a replay. It is called before the work
/// begins.
///
/// # Errors
/// Bad input if it is another file, or an MCAP file that this build cannot write.
pub(super) fn check(path: &Path, overwrite: Overwrite) -> Result<(), Failure> {
    if is_mcap(path) && !cfg!(feature = "mcap") {
        return Err(Failure::BadInput(anyhow!("{}: {NO_MCAP}", path.display())));
    }
    if overwrite == Overwrite::Anything || !path.is_file() {
        return Ok(());
    }
    let mut beginning = Vec::new();
    File::open(path)
        .and_then(|file| file.take(1000).read_to_end(&mut beginning))
        .with_context(|| format!("cannot read {}", path.display()))
        .or_bad_input()?;
    if beginning.is_empty() || is_replay(&beginning) || beginning.starts_with(MCAP) {
        return Ok(());
    }
    Err(Failure::BadInput(anyhow!(
        "{} exists and is not a replay; give another name, or --force to overwrite it",
        path.display()
    )))
}

/// Returns the address with which a browser opens the file.
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
