//! The `tolman` command as its users meet it: what it writes where, and how it exits.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot start its command has failed"
)]

extern crate alloc;

mod arena;
mod audit;
#[cfg(target_os = "linux")]
mod bad_mice;
#[cfg(unix)]
mod brain;
mod cpm;
mod demo;
mod experiment;
mod gngslam;
mod help;
mod helpful;
#[cfg(unix)]
mod host;
#[cfg(unix)]
mod hostile;
#[cfg(unix)]
mod interrupted;
mod learn;
#[cfg(unix)]
#[cfg(feature = "live")]
mod live;
mod log;
mod maze;
#[cfg(unix)]
mod mms_host;
mod mouse;
mod mslst_better;
mod outputs;
mod race;
mod replay;
mod run;
mod starts;
mod survey;
mod world;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Exit code and output of a command that has ended.
#[derive(Debug)]
struct Ended {
    code: Option<i32>,
    out: String,
    err: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Ended {
    /// Asks for success and nothing on stderr; returns what was written.
    #[track_caller]
    fn done(self) -> String {
        assert_eq!(
            (self.code, self.err.as_str()),
            (Some(0), ""),
            "{}",
            self.out
        );
        self.out
    }

    /// Asks for this exit code and a message with all these parts, and nothing on stdout.
    #[track_caller]
    fn refused(self, code: i32, parts: &[&str]) {
        assert_eq!(self.failed(code, parts), "");
    }

    /// Asks for this exit code and a message with all these parts; returns what was written.
    #[track_caller]
    fn failed(self, code: i32, parts: &[&str]) -> String {
        assert_eq!(self.code, Some(code), "{}", self.err);
        for part in parts {
            assert!(self.err.contains(part), "no `{part}` in: {}", self.err);
        }
        self.out
    }
}

/// Returns the command `tolman` with these arguments, started in `folder`.
fn command_in(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tolman"));
    command
        .current_dir(folder)
        .args(arguments)
        // Cargo, which runs this test, is not who calls the command.
        .env_remove("CARGO")
        .stdin(Stdio::null());
    command
}

fn tolman_in(folder: &Path, arguments: &[&str]) -> Ended {
    command_in(folder, arguments).output().unwrap().into()
}

fn tolman(arguments: &[&str]) -> Ended {
    tolman_in(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments)
}

/// Runs `tolman` with `text` on its stdin.
fn tolman_fed(text: &str, arguments: &[&str]) -> Ended {
    let mut child = command_in(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that refuses its arguments ends without reading.
    let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
    child.wait_with_output().unwrap().into()
}

/// Returns an empty folder of this name, by itself for each test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A corridor of three cells, 0.95 m wide, with the goal in the east.
const CORRIDOR: &str = "\
name = Corridor
corridor_width = 0.95

o---o---o---o
| S       G |
o---o---o---o
";
