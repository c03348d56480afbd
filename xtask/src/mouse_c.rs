//! `cargo xtask c`: compares the header of the mouse for C with its code, lets programs in C
//! explore mazes, and a mouse in C++ play mms. The package is no member of the workspace.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::ci::{Outcome, command, with};
use crate::workspace::{built, cargo, output, root, succeed, target_folder};

/// Folder of the package.
const FOLDER: &str = "crates/mouse-c";

/// The header, in the folder of the package.
const HEADER: &str = "include/tolman_mouse.h";

/// Chips besides the one on which the tests run.
const CHIPS: [&str; 3] = [
    "thumbv6m-none-eabi",
    "thumbv7m-none-eabi",
    "riscv32imc-unknown-none-elf",
];

/// Checks the package's form, lints and tests it, and compares its header with what cbindgen
/// writes.
///
/// # Errors
/// If a check fails.
pub(crate) fn check() -> Result<Outcome> {
    succeed(here("fmt")?.args(["--", "--check"]))?;
    succeed(here("clippy --locked --quiet --all-targets")?.args(["--", "--deny", "warnings"]))?;
    succeed(&mut here("test --locked --quiet")?)?;
    for feature in ["side-32", "small"] {
        succeed(here("check --locked --quiet --features")?.arg(feature))?;
    }
    for target in CHIPS {
        other_chip(target)?;
    }
    with("c++", "apt-get install g++", examples)?;
    with("cbindgen", "apt-get install cbindgen", || {
        let mut cbindgen = Command::new("cbindgen");
        cbindgen.current_dir(root().join(FOLDER)).arg("--quiet");
        let header = output(&mut cbindgen)?;
        let kept = fs::read_to_string(root().join(FOLDER).join(HEADER))?;
        ensure!(
            header == kept,
            "{FOLDER}/{HEADER} is not what the code says: run `cbindgen --output {HEADER}` in {FOLDER}"
        );
        Ok(Outcome::Passed)
    })
}

/// Builds the library for a chip, or says that rustup does not have it.
fn other_chip(target: &str) -> Result<()> {
    let there = output(Command::new("rustup").args(["target", "list", "--installed"]));
    if there.is_ok_and(|all| all.lines().any(|line| line == target)) {
        return succeed(here("build --locked --quiet --release --lib --target")?.arg(target));
    }
    eprintln!("SKIPPED: the library for {target}: `rustup target add {target}`");
    Ok(())
}

/// Compiles the sketch for Arduino, and lets the mouse in C++ play mms in all classic mazes.
fn examples() -> Result<Outcome> {
    let cpp = |out: &[&str]| {
        let mut cpp = Command::new("c++");
        cpp.current_dir(root().join(FOLDER));
        cpp.args("-Wall -Wextra -Werror -O2 -I include".split(' '))
            .args(out);
        cpp
    };
    let sketch = "-fsyntax-only -Iexamples/stub -include Arduino.h -x c++ examples/arduino.ino";
    succeed(&mut cpp(&sketch.split(' ').collect::<Vec<_>>()))?;
    succeed(&mut here("build --locked --quiet --release --lib")?)?;
    let folder = target_folder()?.join("release");
    let (library, mouse) = (folder.join("libtolman_mouse.a"), folder.join("mms"));
    let text = |path: &Path| {
        path.to_str()
            .map(str::to_owned)
            .context("the path is not UTF-8")
    };
    let (library, mouse) = (text(&library)?, text(&mouse)?);
    let system = ["-lpthread", "-ldl", "-lm", "-o", &mouse];
    succeed(&mut cpp(
        &[&["examples/mms.cpp", &library][..], &system].concat()
    ))?;
    command()?;
    // A maze of half size is too large for it.
    let mazes = output(
        Command::new("git")
            .args(["ls-files", "mazes/grid"])
            .current_dir(root()),
    )?;
    for maze in mazes.lines().filter(|maze| !maze.contains("half-size")) {
        let mut host = built("tolman")?;
        let told = output(host.args(["mms-host", "--mouse", &mouse, "--maze", maze]))?;
        ensure!(
            told.contains(": solved, ") && told.contains(" 0 crashes, "),
            "the mouse in C++ fails: {told}"
        );
    }
    Ok(Outcome::Passed)
}

/// Returns a call of cargo in the package's folder.
fn here(arguments: &str) -> Result<Command> {
    let mut command = cargo(arguments);
    command
        .current_dir(root().join(FOLDER))
        .env("CARGO_TARGET_DIR", target_folder()?);
    Ok(command)
}
