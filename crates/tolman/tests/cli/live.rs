//! Runs that are looked at: on a terminal of 100 × 40 characters, which `script` of util-linux
//! makes.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use super::{CORRIDOR, folder, tolman_in};

/// Word that stands beside the picture of a run.
const SHOWN: &[u8] = b"heading";

/// Returns the exit code of the command, and what it drew on a terminal until a key stopped it.
/// `None`, with a note, where there is no `script`.
#[expect(clippy::print_stderr, reason = "a test that is left out says so")]
fn drawn(folder: &Path, arguments: &str) -> Option<(Option<i32>, String)> {
    let tolman = env!("CARGO_BIN_EXE_tolman");
    // Only what runs in the foreground may change its terminal, and `timeout` would leave it.
    let limit = "timeout --foreground --kill-after 5 60";
    let line = format!("stty cols 100 rows 40; {limit} {tolman} {arguments}");
    let spawned = Command::new("script")
        .current_dir(folder)
        .env("TERM", "xterm")
        .env("SHELL", "/bin/sh")
        .args(["-qec", &line, "/dev/null"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let Ok(mut child) = spawned else {
        eprintln!("skipped: there is no `script` to make a terminal");
        return None;
    };
    let (mut keys, mut screen) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
    let (mut seen, mut part) = (Vec::new(), [0; 4096]);
    let mut is_open = true;
    while let Ok(read @ 1..) = screen.read(&mut part) {
        seen.extend_from_slice(&part[..read]);
        // Seen enough.
        if is_open && seen.windows(SHOWN.len()).any(|window| window == SHOWN) {
            keys.write_all(b"q").unwrap();
            is_open = false;
        }
    }
    let code = child.wait().unwrap().code();
    let ended = (code, String::from_utf8_lossy(&seen).into_owned());
    Some(ended)
}

#[test]
fn every_verb_that_drives_draws_on_a_terminal() {
    let folder = folder("live");
    std::fs::write(folder.join("a.maze"), CORRIDOR).unwrap();
    let grid = "maze generate perfect --size 4x4 --seed 1 --out grid.maze";
    tolman_in(&folder, &grid.split(' ').collect::<Vec<_>>()).done();
    for command in [
        "mouse grid.maze --live",
        "mms-host --mouse 'TOLMAN mouse --mms' --maze grid.maze --live",
        "run wall-follow --maze a.maze --live",
        "learn --system mslst --preset j --maze a.maze --live --out map.json",
        "drive --map map.json --maze a.maze --live",
        "race grid.maze --live",
        "demo --live --out demo.html",
    ] {
        let command = command.replace("TOLMAN", env!("CARGO_BIN_EXE_tolman"));
        let Some((code, screen)) = drawn(&folder, &command) else {
            return;
        };
        assert_eq!(code, Some(0), "{command}: {screen}");
        assert!(screen.contains("heading"), "{command} drew {screen:?}");
    }
}
