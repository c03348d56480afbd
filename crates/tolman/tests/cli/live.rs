//! Runs that are looked at: on a terminal of 100 × 40 characters, which `script` of util-linux makes.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use super::{CORRIDOR, Ended, folder, tolman_in};

/// What the command draws on a terminal until a key has made it stop; `None`, told, where there is no `script`.
#[expect(clippy::print_stderr, reason = "a test that is left out says so")]
fn drawn(folder: &Path, arguments: &str) -> Option<Ended> {
    let tolman = env!("CARGO_BIN_EXE_tolman");
    let line = format!("stty cols 100 rows 40; timeout 60 {tolman} {arguments}");
    let spawned = Command::new("script")
        .current_dir(folder)
        .env("TERM", "xterm")
        .args(["-qec", &line, "/dev/null"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut child) = spawned else {
        eprintln!("skipped: there is no `script` to make a terminal");
        return None;
    };
    // Seen enough, whenever it asks.
    let mut keys = child.stdin.take().unwrap();
    keys.write_all(b"q").unwrap();
    let ended = child.wait_with_output().unwrap().into();
    drop(keys);
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
    ] {
        let command = command.replace("TOLMAN", env!("CARGO_BIN_EXE_tolman"));
        let Some(ended) = drawn(&folder, &command) else {
            return;
        };
        assert_eq!(ended.code, Some(0), "{command}: {}", ended.out);
        assert!(
            ended.out.contains("heading") && ended.out.contains("q quit"),
            "{command} drew {:?}",
            ended.out
        );
    }
}
