//! The command `tolman`, which also writes replays for Rerun: `--replay FILE.rrd`.

use std::process::ExitCode;

use tolman::{Build, Catalogue, ReplayFormat};

fn main() -> ExitCode {
    let catalogue = Catalogue::tolman()
        .program("tolman-rerun")
        .replay_format(ReplayFormat {
            extension: "rrd",
            magic: b"RRF2",
            write: |replay| Ok(tolman_rerun::rrd(replay)?),
        });
    tolman::run(&catalogue, &Build::current("unknown", "unknown"))
}
