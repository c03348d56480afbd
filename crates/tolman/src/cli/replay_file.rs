//! Writes replays to files.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;
use std::sync::OnceLock;

use anyhow::{Context, Error, anyhow};
use tolman_replay::{Replay, is_replay, page};

use super::{Failure, OrBadInput, Result, called, file};
use crate::ReplayFormat;

/// Rule for the existing files that may be overwritten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Overwrite {
    /// Only replays may be overwritten.
    Replays,
    /// Any file may be overwritten.
    Anything,
}

impl Overwrite {
    /// Returns [`Anything`](Self::Anything) with `--force`, else [`Replays`](Self::Replays).
    pub(super) const fn if_forced(force: bool) -> Self {
        if force { Self::Anything } else { Self::Replays }
    }
}

static FORMATS: OnceLock<Vec<ReplayFormat>> = OnceLock::new();

/// Sets the formats in which this program writes replays, beside HTML.
pub(super) fn set_formats(formats: &[ReplayFormat]) {
    // A second call in one process has the same formats.
    let _ = FORMATS.set(formats.to_vec());
}

/// Returns whether this program writes replays into files with this ending, beside HTML.
pub(super) fn has_format(ending: &str) -> bool {
    formats().iter().any(|format| format.extension == ending)
}

fn formats() -> &'static [ReplayFormat] {
    FORMATS.get().map_or(&[], Vec::as_slice)
}

/// Endings of file names that ask for a format, each with advice for a program that lacks the
/// format.
const ELSEWHERE: [(&str, &str); 2] = [
    ("mcap", "build it with --features mcap"),
    (
        "rrd",
        "call tolman-rerun, which `cargo install --path crates/rerun` builds",
    ),
];

/// Maximum number of steps of the replay of a system. Some learn for hours, in steps of
/// milliseconds.
pub(super) const MOST_STEPS: usize = 4000;

/// Writes a replay to the file at `path`, completely or not at all. The ending of the name decides
/// the format; it is a web page if no other format has that ending.
///
/// # Errors
/// Bad input if the file exists and is not a replay; a failure if it cannot be written.
pub(super) fn write(path: &Path, replay: Replay, overwrite: Overwrite) -> Result {
    check(path, overwrite)?;
    let replay = replay.fact("made by", called::command());
    let format = formats()
        .iter()
        .find(|format| ends_in(path, format.extension));
    let contents = match format {
        Some(format) => (format.write)(&replay),
        None => page(&replay).map(String::into_bytes).map_err(Error::from),
    };
    file::write(path, contents.context("cannot write the replay")?)
}

fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|ending| ending == extension)
}

/// Checks that the file at `path` does not exist, or is a replay. It is called before the work
/// begins.
///
/// # Errors
/// Bad input if it is another file, or of a format that this program cannot write.
pub(super) fn check(path: &Path, overwrite: Overwrite) -> Result {
    refuse_unknown(path)?;
    if overwrite == Overwrite::Anything || !path.is_file() {
        return Ok(());
    }
    let mut beginning = Vec::new();
    File::open(path)
        .and_then(|file| file.take(1000).read_to_end(&mut beginning))
        .with_context(|| format!("cannot read {}", path.display()))
        .or_bad_input()?;
    if beginning.is_empty() || is_replay(&beginning) || begins_as_format(&beginning) {
        return Ok(());
    }
    Err(Failure::BadInput(anyhow!(
        "{} exists and is not a replay; give another name, or --force to overwrite it",
        path.display()
    )))
}

/// Refuses a name that asks for a format which this program lacks.
fn refuse_unknown(path: &Path) -> Result {
    let mut elsewhere = ELSEWHERE.iter();
    let asked = elsewhere.find(|(extension, _)| ends_in(path, extension));
    match asked {
        Some((extension, remedy)) if !has_format(extension) => Err(Failure::BadInput(anyhow!(
            "{}: this program writes no .{extension}: {remedy}, or name a file that ends in .html",
            path.display()
        ))),
        _ => Ok(()),
    }
}

fn begins_as_format(beginning: &[u8]) -> bool {
    formats()
        .iter()
        .any(|format| beginning.starts_with(format.magic))
}

/// Writes where the replay at `path` is.
///
/// # Errors
/// If it cannot be written.
pub(super) fn tell(path: &Path, out: &mut dyn Write) -> Result {
    Ok(writeln!(out, "replay: {}", address(path))?)
}

/// Returns the address with which a browser opens the file.
fn address(path: &Path) -> String {
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
