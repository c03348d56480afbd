//! The pages that the command writes, as a browser shows them. `cargo xtask ci` runs these tests
//! where chromium is installed. To run them by hand: `cargo test -p tolman --test browser --
//! --ignored`.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot talk to its browser has failed"
)]

mod client;
mod devtools;
mod lessons;
mod pages;
mod playground;
mod replay;
mod report;
mod site;
mod tab;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tab::Tab;

/// Returns a browser with one empty tab; none, said on stderr, where chromium is not installed.
fn tab() -> Option<Tab> {
    let tab = Tab::open();
    if tab.is_none() {
        tell("left out: chromium is not installed");
    }
    tab
}

/// Writes a line on stderr. Not with a macro: the test harness keeps what those print.
fn tell(line: &str) {
    // If stderr cannot be written, there is no other place to report it.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Returns an empty folder of this name, by itself for each test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("browser")
        .join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Lets `tolman` do what `words` say, in the workspace's folder; asks for success and returns what
/// it wrote.
#[track_caller]
fn tolman(words: &[&str]) -> String {
    ended(words, 0)
}

/// Runs [`tolman`], asking for another exit code.
#[track_caller]
fn ended(words: &[&str], code: i32) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_tolman"))
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .args(words)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        output.status.code(),
        Some(code),
        "tolman {words:?}: {complaint}"
    );
    String::from_utf8(output.stdout).unwrap()
}
