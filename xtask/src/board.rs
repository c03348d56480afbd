//! `cargo xtask board`: runs the mouse on an emulated chip, and tells the memory and the time that
//! it needs. The package is no member of the workspace.

use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::ci::{Outcome, bare_metal, with};
use crate::workspace::{cargo, output, root, succeed, target_folder};

/// Folder of the package. Its settings of cargo name the chip and the emulator.
const FOLDER: &str = "crates/firmware/board";

/// The program, in the folder that cargo builds into.
const PROGRAM: &str = "thumbv7em-none-eabihf/release/tolman-board";

/// The most that the mouse may need.
const LIMITS: Needs = Needs {
    memory: 26 << 10,
    flash: 56 << 10,
    located: 1_200_000,
    lost: 1_200_000,
};

/// What the mouse needs.
struct Needs {
    /// Stack and variables, bytes.
    memory: u64,
    /// Code and constants, bytes.
    flash: u64,
    /// Longest decision of a mouse that knows its place, instructions.
    located: u64,
    /// Longest decision of a lost mouse, instructions.
    lost: u64,
}

/// Checks the package's form, lints it, runs it, and compares what the mouse needs with what it may
/// need.
///
/// # Errors
/// If it does not build, fails, or needs more.
pub(crate) fn check() -> Result<Outcome> {
    with("qemu-system-arm", "apt-get install qemu-system-arm", || {
        bare_metal::with_target(run)
    })
}

fn run() -> Result<Outcome> {
    succeed(here("fmt")?.args(["--", "--check"]))?;
    let mut lints = here("clippy --locked --quiet --release --bins --examples")?;
    succeed(lints.args(["--", "--deny", "warnings"]))?;
    let needs = measured()?;
    eprintln!(
        "the mouse runs in {} bytes of memory and {} of flash; its longest decision takes {} \
         instructions, {} when it is lost",
        needs.memory, needs.flash, needs.located, needs.lost
    );
    ensure!(
        needs.memory <= LIMITS.memory
            && needs.flash <= LIMITS.flash
            && needs.located <= LIMITS.located
            && needs.lost <= LIMITS.lost,
        "at most {} bytes of memory and {} of flash, {} and {} instructions are allowed",
        LIMITS.memory,
        LIMITS.flash,
        LIMITS.located,
        LIMITS.lost
    );
    Ok(Outcome::Passed)
}

/// Runs the mouse.
fn measured() -> Result<Needs> {
    let lines = output(&mut here("run --locked --quiet --release")?)?;
    let lines = lines
        .lines()
        .map(|line| serde_json::from_str(line).with_context(|| format!("not JSON: {line}")))
        .collect::<Result<Vec<Value>>>()?;
    let most = |name: &str| -> Result<u64> {
        let numbers = lines.iter().filter_map(|line| line[name].as_u64());
        numbers
            .max()
            .with_context(|| format!("no line names {name}"))
    };
    Ok(Needs {
        memory: most("memory")?,
        flash: flash()?,
        located: most("located")?,
        lost: most("lost")?,
    })
}

/// Returns the size of code and constants, bytes.
fn flash() -> Result<u64> {
    let table = output(Command::new("size").arg(target_folder()?.join(PROGRAM)))?;
    let numbers = table.lines().nth(1).context("`size` printed no numbers")?;
    let numbers = numbers.split_whitespace().take(2).map(str::parse::<u64>);
    let [text, data]: [u64; 2] = numbers
        .collect::<Result<Vec<_>, _>>()?
        .try_into()
        .ok()
        .context("`size` printed too few numbers")?;
    Ok(text + data)
}

/// Returns a call of cargo in the package's folder. What is compiled incrementally is other code,
/// which needs more.
fn here(arguments: &str) -> Result<Command> {
    let mut command = cargo(arguments);
    command
        .current_dir(root().join(FOLDER))
        .env("CARGO_INCREMENTAL", "0")
        .env("CARGO_TARGET_DIR", target_folder()?);
    Ok(command)
}
