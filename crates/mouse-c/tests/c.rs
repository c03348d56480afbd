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
use tolman_maze::{Cell, Direction, Grid, Maze, Walls};
use tolman_planners::speed_run::{
    RunMove, Side, Slalom, SpeedRunConfig, SpeedRunMap, SpeedRunTimes,
};
use tolman_planners::{Passages, StepMap, Unknown};

/// Returns the project's mazes of this size.
fn mazes(side: u16) -> Vec<Maze> {
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
        .filter(|maze| (maze.grid().width(), maze.grid().height()) == (side, side))
        .collect()
}

/// Returns mazes in which a search has much to look at, of this size: without inner walls, with one
/// way to and fro or round and round, with a slow way out of the start and all else open, and with
/// walls by chance.
fn worst_mazes(side: u16) -> Vec<Maze> {
    let walled = |is_wall: &mut dyn FnMut(Cell, Direction) -> bool| {
        let mut maze = Maze::open(Grid::new(side, side));
        for cell in maze.grid().cells() {
            for side in [Direction::North, Direction::East] {
                if maze.grid().neighbour(cell, side).is_some() && is_wall(cell, side) {
                    maze.set_wall(cell, side, true);
                }
            }
        }
        maze
    };
    let last = side - 1;
    // Columns that are open in the north and in the south by turns.
    let comb = move |cell: Cell, side| {
        side == Direction::East && cell.y != if cell.x.is_multiple_of(2) { last } else { 0 }
    };
    // Rings around the middle, each with one opening to the next.
    let ring = move |cell: Cell| {
        let inwards = |at: u16| at.min(last - at);
        inwards(cell.x).min(inwards(cell.y))
    };
    let spiral = move |cell: Cell, side| {
        let next = cell.beyond(side).map_or(0, ring);
        let gate = if ring(cell).min(next) % 2 == 0 {
            last / 2
        } else {
            last / 2 + 1
        };
        next != ring(cell) && !(side == Direction::North && cell.x == gate)
    };
    let mut mazes = vec![
        walled(&mut |_, _| false),
        walled(&mut { comb }),
        walled(&mut { spiral }),
        walled(&mut |cell, side| cell.x < 4 && comb(cell, side)),
    ];
    let goals: Vec<Cell> = mazes[0].grid().middle().collect();
    for seed in 1_u64.. {
        let mut state = seed << 32 | 0x9E37_79B9;
        let mut by_chance = |_, _| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state % 16 < 2 + seed % 4
        };
        let maze = walled(&mut by_chance);
        let open = Passages::<32>::new(&maze, Unknown::Closed).unwrap();
        if StepMap::new(&open, goals.iter().copied())
            .steps(Cell::new(0, 0))
            .is_some()
        {
            mazes.push(maze);
        }
        if mazes.len() == 8 {
            break;
        }
    }
    // Found by changing walls by chance and keeping what made a search longer, some 100,000 times.
    let hard = match side {
        16 => include_str!("hard-16.txt"),
        _ => include_str!("hard-32.txt"),
    };
    mazes.push(tolman_maze::read(hard).unwrap().maze);
    mazes
}

/// Returns the mazes as a header: the goals, and bits of the open sides of each cell.
fn header(mazes: &[Maze]) -> String {
    let grid = mazes[0].grid();
    let mut text = "#define GOALS ".to_owned();
    for goal in grid.middle() {
        write!(text, "{{{}, {}}},", goal.x, goal.y).unwrap();
    }
    let (count, cells) = (mazes.len(), grid.cells().count());
    writeln!(text, "\nstatic const uint8_t MAZES[{count}][{cells}] = {{").unwrap();
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

/// What happens after 60 cells.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Event {
    Nothing,
    /// The chip is reset, and the mouse begins at the start with what it knew.
    Reset,
    /// The mouse is put down elsewhere.
    Carried,
}

/// Explores a maze as `main.c` does, and returns what it prints.
fn explored<const N: usize>(maze: &Maze, config: &SpeedRunConfig, event: Event) -> String {
    const START: (Cell, Direction) = (Cell::new(0, 0), Direction::North);
    let times = SpeedRunTimes::<N>::new(config).unwrap();
    let goals: Vec<Cell> = maze.grid().middle().collect();
    let begun = || Mouse::<N>::with_map(&times, &goals, SpeedRunMap::new());
    let mut mouse = begun();
    let (mut at, mut heading) = START;
    let mut text = String::new();
    for cells in 0.. {
        let seen = Sides::read(|side| maze.is_open(at, heading.turned(side)));
        match mouse.arrive(seen).unwrap() {
            Next::Drive(side) => {
                write!(text, "{}", side.index()).unwrap();
                match maze.beside(at, heading.turned(side)) {
                    Some(next) => (at, heading) = (next, heading.turned(side)),
                    None => mouse.crash().unwrap(),
                }
            }
            Next::Ready { .. } => break,
            Next::CarryBack => {
                text.push('5');
                mouse.carried_back();
                (at, heading) = START;
            }
            Next::GiveUp => panic!("no way to the goal in\n{maze}"),
        }
        match event {
            Event::Reset if cells == 60 => {
                let before = mouse.clone();
                mouse = begun();
                mouse
                    .restore(|cell, side| before.walls().knowledge(cell, side))
                    .unwrap();
                (at, heading) = START;
            }
            Event::Carried if cells == 60 => {
                at = Cell::new(3, 1);
                let behind_is_open = |heading: &Direction| maze.is_open(at, heading.opposite());
                heading = Direction::ALL.into_iter().find(behind_is_open).unwrap();
            }
            _ => {}
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
fn expected<const N: usize>(mazes: &[Maze], config: &SpeedRunConfig) -> String {
    let events = [Event::Nothing, Event::Reset, Event::Carried];
    let all = |maze| {
        events
            .map(|event| explored::<N>(maze, config, event))
            .concat()
    };
    mazes.iter().map(all).collect()
}

/// The library for mazes of 16 × 16 cells, the smaller one, and that for 32 × 32.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Size {
    Classic,
    Small,
    Half,
}

impl Size {
    /// Returns the feature of the library.
    const fn feature(self) -> &'static str {
        match self {
            Self::Classic => "",
            Self::Small => "small",
            Self::Half => "side-32",
        }
    }

    /// Returns what the header has to know.
    const fn define(self) -> &'static str {
        match self {
            Self::Classic => "-DTOLMAN",
            Self::Small => "-DTOLMAN_SMALL",
            Self::Half => "-DTOLMAN_SIDE_32",
        }
    }

    fn mazes(self) -> Vec<Maze> {
        let mazes = mazes(self.side());
        assert_eq!(mazes.len(), if self == Self::Half { 2 } else { 9 });
        mazes
    }

    /// Returns the number of columns and rows.
    const fn side(self) -> u16 {
        match self {
            Self::Half => 32,
            _ => 16,
        }
    }

    fn expected(self, mazes: &[Maze]) -> String {
        match self {
            Self::Half => expected::<32>(mazes, &SpeedRunConfig::half_size()),
            _ => expected::<16>(mazes, &SpeedRunConfig::classic()),
        }
    }
}

/// Builds the static library for a target, and returns it.
fn library(size: Size, target: Option<&str>) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("library-{}", size.feature()));
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([
        "build",
        "--release",
        "--quiet",
        "--locked",
        "--offline",
        "--lib",
    ]);
    cargo
        .args(["--features", size.feature(), "--target-dir"])
        .arg(&folder);
    if let Some(target) = target {
        cargo.args(["--target", target]);
    }
    let built = cargo
        .env("CARGO_INCREMENTAL", "0")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status()
        .unwrap();
    assert!(built.success());
    folder
        .join(target.unwrap_or_default())
        .join("release/libtolman_mouse.a")
}

/// Compiles files of this folder, and returns the program.
fn program(
    (size, mazes): (Size, &[Maze]),
    compiler: &str,
    name: &str,
    options: &[&str],
    target: Option<&str>,
) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", size.feature()));
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("mazes.h"), header(mazes)).unwrap();
    let program = out.join("main");
    let mut compile = Command::new(compiler);
    compile.args(["-O2", "-Wall", "-Wextra", "-Werror", size.define(), "-I"]);
    compile.arg(&out).arg("-I").arg(here.join("include"));
    // Libraries follow what needs them.
    let (libraries, options): (Vec<&str>, Vec<&str>) =
        options.iter().partition(|option| option.starts_with("-l"));
    compile
        .args(options)
        .arg(library(size, target))
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

/// Returns what a program prints to stdout and to stderr.
fn printed(command: &mut Command) -> (String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap().replace('\r', "");
    let (out, err) = (text(output.stdout), text(output.stderr));
    assert!(output.status.success(), "{out}{err}");
    (out, err)
}

#[test]
fn c_decides_as_rust_does() {
    if !is_there("cc") {
        return;
    }
    for size in [Size::Classic, Size::Half] {
        let options = ["main.c", "-lm", "-lpthread", "-ldl"];
        let mazes = size.mazes();
        let program = program((size, &mazes), "cc", "host", &options, None);
        let (out, _) = printed(&mut Command::new(program));
        assert_eq!(out, size.expected(&mazes));
    }
}

/// A Cortex-M4F.
const CHIP: &str = "thumbv7em-none-eabihf";

const CORE: [&str; 5] = [
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfpu=fpv4-sp-d16",
    "-mfloat-abi=hard",
    "-Wl,--gc-sections",
];

/// Returns the number behind a name in a line of JSON.
fn number(line: &str, name: &str) -> u32 {
    let (_, value) = line.split_once(&format!("\"{name}\":")).unwrap();
    let end = value.find([',', '}']).unwrap();
    value[..end].parse().unwrap()
}

/// Returns whether a program can be built for the chip, and says so if it cannot.
fn has_chip() -> bool {
    let mut rustc = Command::new("rustc");
    let (folder, _) = printed(rustc.args(["--print", "target-libdir", "--target", CHIP]));
    let found = Path::new(folder.trim()).exists();
    if !found {
        eprintln!("SKIPPED: `rustup target add {CHIP}`");
    }
    found && is_there("arm-none-eabi-gcc")
}

/// Lets `main.c` run on an emulated chip, and compares what the library needs there with what it
/// may need: memory with the stack, bytes, and instructions of the longest decision.
fn a_chip_decides_as_rust_does(
    (size, mazes, name): (Size, &[Maze], &str),
    most_memory: u32,
    most_instructions: u32,
) {
    if !has_chip() || !is_there("qemu-system-arm") {
        return;
    }
    let options = [
        "--specs=rdimon.specs",
        "-Wl,--section-start=.vectors=0x0",
        "-Wl,-Ttext-segment=0x1000",
        "-Wl,-Tdata=0x20000000",
        "-Wl,--undefined=VECTORS",
        "-Wl,--no-warn-execstack",
        "-DCHIP",
        "main.c",
        "chip.c",
    ];
    let options = [&CORE[..], &options].concat();
    let compiler = "arm-none-eabi-gcc";
    let program = program((size, mazes), compiler, name, &options, Some(CHIP));
    let mut qemu = Command::new("timeout");
    qemu.args([
        "500",
        "qemu-system-arm",
        "-machine",
        "mps2-an386",
        "-nographic",
    ]);
    qemu.args(["-semihosting", "-icount", "shift=4", "-kernel"]);
    let (out, needs) = printed(qemu.arg(program));
    assert_eq!(out, size.expected(mazes));
    let memory = number(&needs, "mouse") + number(&needs, "stack");
    eprintln!("{name} {}: {memory} bytes, {needs}", size.define());
    assert!(memory <= most_memory, "{needs}");
    assert!(number(&needs, "arrive") <= most_instructions, "{needs}");
}

#[test]
fn a_chip_decides_as_rust_does_in_classic_mazes() {
    let size = Size::Classic;
    a_chip_decides_as_rust_does((size, &size.mazes(), "chip"), 26 << 10, 1_200_000);
}

#[test]
fn a_chip_decides_as_rust_does_with_little_memory() {
    let size = Size::Small;
    a_chip_decides_as_rust_does((size, &size.mazes(), "chip"), 16 << 10, 1_200_000);
}

#[test]
fn a_chip_decides_as_rust_does_in_half_size_mazes() {
    let size = Size::Half;
    a_chip_decides_as_rust_does((size, &size.mazes(), "chip"), 48 << 10, 5_000_000);
}

/// Nine mazes made to be worse than any of a competition.
#[test]
fn decisions_of_a_chip_are_bounded_in_the_worst_mazes() {
    for (size, most_memory, most_instructions) in [
        (Size::Classic, 26 << 10, 1_200_000),
        (Size::Small, 16 << 10, 1_200_000),
        (Size::Half, 48 << 10, 5_000_000),
    ] {
        let mazes = worst_mazes(size.side());
        a_chip_decides_as_rust_does((size, &mazes, "worst"), most_memory, most_instructions);
    }
}

/// Code and constants of all functions, without those of C.
#[test]
fn the_library_fits_into_60_kb_of_flash() {
    if !has_chip() {
        return;
    }
    let options = [
        "-nostdlib",
        "-Wl,--entry=all",
        "-Wl,--no-warn-execstack",
        "flash.c",
    ];
    let options = [&CORE[..], &options].concat();
    let program = program(
        (Size::Classic, &[Maze::open(Grid::new(16, 16))]),
        "arm-none-eabi-gcc",
        "flash",
        &options,
        Some(CHIP),
    );
    let (table, _) = printed(Command::new("arm-none-eabi-size").arg(program));
    let numbers = table.lines().nth(1).unwrap().split_whitespace().take(2);
    let bytes: u32 = numbers.map(|number| number.parse::<u32>().unwrap()).sum();
    eprintln!("{bytes} bytes of code and constants");
    assert!(bytes <= 60 << 10, "{bytes}");
}
