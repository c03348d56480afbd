//! A program in C makes the same decisions as Rust, on this computer and on an emulated chip.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a failed unwrap is a failed test"
)]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use tolman_firmware::{Command as Next, Mouse, Sides};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{RunMove, Side, Slalom, SpeedRunConfig, SpeedRunTimes};

/// Returns the classic mazes of the project.
fn mazes() -> Vec<Maze> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mazes/grid");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    let mazes = files.iter().map(|file| {
        let text = fs::read_to_string(file).unwrap();
        tolman_maze::read(&text).unwrap().maze
    });
    mazes
        .filter(|maze| (maze.grid().width(), maze.grid().height()) == (16, 16))
        .collect()
}

/// Returns the mazes as a header: bits of the open sides of each cell.
fn header(mazes: &[Maze]) -> String {
    let mut text = format!("static const uint8_t MAZES[{}][256] = {{\n", mazes.len());
    for maze in mazes {
        text.push('{');
        for cell in maze.grid().cells() {
            let open = Direction::ALL
                .into_iter()
                .filter(|side| maze.is_open(cell, *side));
            let bits: u8 = open.map(|side| 1 << side.index()).sum();
            write!(text, "{bits},").unwrap();
        }
        text.push_str("},\n");
    }
    text + "};\n"
}

/// Explores a maze as `main.c` does, and returns what it prints. The reset chip begins at the start
/// with what it knew.
fn explored(maze: &Maze, reset_after: Option<usize>) -> String {
    let times = SpeedRunTimes::<16>::new(&SpeedRunConfig::classic()).unwrap();
    let goals: Vec<Cell> = maze.grid().middle().collect();
    let mut mouse = Mouse::new(&times, &goals);
    let (mut at, mut heading) = (Cell::new(0, 0), Direction::North);
    let mut text = String::new();
    for cells in 0.. {
        let seen = Sides::read(|side| maze.is_open(at, heading.turned(side)));
        match mouse.arrive(seen).unwrap() {
            Next::Drive(side) => {
                write!(text, "{}", side.index()).unwrap();
                heading = heading.turned(side);
                at = maze.beside(at, heading).unwrap();
            }
            Next::Ready { .. } => break,
            other => panic!("{other:?} in\n{maze}"),
        }
        if reset_after == Some(cells) {
            let before = mouse.clone();
            mouse = Mouse::new(&times, &goals);
            mouse
                .restore(|cell, side| tolman_maze::Walls::knowledge(before.walls(), cell, side))
                .unwrap();
            (at, heading) = (Cell::new(0, 0), Direction::North);
        }
    }
    text.push_str("4\n");
    mouse
        .run(|step| {
            let (kind, amount) = match step.run_move {
                RunMove::Straight { half_cells } => (0, half_cells),
                RunMove::Diagonal { cells } => (1, cells),
                RunMove::Turn { slalom, side } => {
                    let kind = Slalom::ALL.iter().position(|turn| *turn == slalom).unwrap();
                    // F45 is the second kind, and so on.
                    (kind + 2, u16::from(side == Side::Right))
                }
            };
            let time_ms = times.of(step.run_move).unwrap();
            writeln!(text, "{kind} {amount} {time_ms}").unwrap();
        })
        .unwrap();
    text
}

/// Returns what the program in C has to print.
fn expected(mazes: &[Maze]) -> String {
    let both = |maze| explored(maze, None) + &explored(maze, Some(60));
    mazes.iter().map(both).collect()
}

/// Builds the static library for a target, and returns it.
fn library(target: Option<&str>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("library");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([
        "build",
        "--release",
        "--quiet",
        "--locked",
        "--offline",
        "--lib",
    ]);
    cargo.arg("--target-dir").arg(&folder);
    if let Some(target) = target {
        cargo.args(["--target", target]);
    }
    let built = cargo
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status()
        .unwrap();
    assert!(built.success());
    folder
        .join(target.unwrap_or_default())
        .join("release/libtolman_mouse.a")
}

/// Compiles `main.c` with a compiler and its options, and returns the program.
fn program(
    compiler: &str,
    name: &str,
    options: &[&str],
    library: &Path,
    mazes: &[Maze],
) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("mazes.h"), header(mazes)).unwrap();
    let program = out.join("main");
    let mut compile = Command::new(compiler);
    compile
        .args(["-O2", "-Wall", "-Wextra", "-Werror", "-I"])
        .arg(&out);
    compile
        .arg("-I")
        .arg(here.join("include"))
        .arg(here.join("tests/main.c"));
    // Libraries follow what needs them.
    let (libraries, options): (Vec<&str>, Vec<&str>) =
        options.iter().partition(|option| option.starts_with("-l"));
    compile
        .args(options)
        .arg(library)
        .args(libraries)
        .arg("-o")
        .arg(&program);
    let compiled = compile.current_dir(here.join("tests")).status().unwrap();
    assert!(compiled.success());
    program
}

/// Returns whether a program is there, and says so if it is not.
fn is_there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok();
    if !found {
        eprintln!("SKIPPED: {program} is not there");
    }
    found
}

fn printed(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    text
}

#[test]
fn c_decides_as_rust_does() {
    let mazes = mazes();
    assert_eq!(mazes.len(), 9);
    if !is_there("cc") {
        return;
    }
    let program = program(
        "cc",
        "host",
        &["-lm", "-lpthread", "-ldl"],
        &library(None),
        &mazes,
    );
    assert_eq!(printed(&mut Command::new(program)), expected(&mazes));
}

#[test]
fn a_chip_decides_as_rust_does() {
    let target = "thumbv7em-none-eabihf";
    if !is_there("arm-none-eabi-gcc") || !is_there("qemu-system-arm") {
        return;
    }
    let mazes = mazes();
    let options = [
        "-mcpu=cortex-m4",
        "-mthumb",
        "-mfpu=fpv4-sp-d16",
        "-mfloat-abi=hard",
        "--specs=rdimon.specs",
        "-Wl,--section-start=.vectors=0x0",
        "-Wl,-Ttext-segment=0x1000",
        "-Wl,-Tdata=0x20000000",
        "-Wl,--gc-sections",
        "-Wl,--undefined=VECTORS",
        "chip.c",
    ];
    let program = program(
        "arm-none-eabi-gcc",
        "chip",
        &options,
        &library(Some(target)),
        &mazes,
    );
    let mut qemu = Command::new("timeout");
    qemu.args([
        "200",
        "qemu-system-arm",
        "-machine",
        "mps2-an386",
        "-nographic",
        "-semihosting",
    ]);
    qemu.arg("-kernel").arg(program);
    assert_eq!(printed(&mut qemu).replace('\r', ""), expected(&mazes));
}
