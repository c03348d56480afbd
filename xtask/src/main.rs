//! The project's chores, one module per verb. `cargo xtask --help` lists them.
//!
//! This crate depends on none of the crates it checks. So it builds in seconds, and runs even when
//! they do not build.
#![expect(clippy::print_stderr, reason = "a chore reports on stderr")]

extern crate alloc;

mod bench;
mod board;
mod ci;
mod dist;
mod docs;
mod experiment;
mod fuzz;
mod golden;
mod layers;
mod mazes;
mod mouse_c;
mod mujoco;
mod mutants;
mod packages;
mod playground;
mod prose;
mod python;
mod release;
mod rerun;
mod ros2;
mod site;
mod workspace;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Result, bail};
use ci::Outcome;
use clap::{Parser, Subcommand};

/// The chores of the tolman workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Runs the experiments in release and writes their report; see `experiment --help`
    #[command(disable_help_flag = true)]
    Experiment {
        /// Arguments for `tolman experiment`
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    /// Runs everything a change must pass: format, lints, tests, pages in a browser, docs, layers,
    /// mazes, bare metal
    Ci(ci::Choice),
    /// Plays a few runs of every experiment and compares them, to the bit, with those in
    /// tests/golden
    Golden {
        /// Experiments to play; all if left out
        names: Vec<String>,
        /// Write the runs to tests/golden instead
        #[arg(long)]
        bless: bool,
    },
    /// Compares the dependencies between the crates with the tables of docs/architecture.md
    Layers,
    /// Reads every maze in mazes/ and checks that it can be solved, and that the fragments of Mazes
    /// 1 to 3 of CPM are distinctive
    Mazes,
    /// Measures the speed: all criterion benches and the long ray fuzz, or one bench
    Bench {
        /// Bench to run; all if left out
        name: Option<String>,
    },
    /// Runs the mouse on an emulated chip, and tells the memory and the time that it needs
    Board,
    /// Compares the header of the mouse for C with its code, and lets programs in C explore mazes
    C,
    /// Checks that comments keep to 100 columns, and that comments, messages and pages use plain
    /// words
    Prose,
    /// Builds the command as one file that runs on every Linux of this processor: target/dist
    Dist,
    /// Makes everything of a release but the uploads: packages in order, each built and tested by
    /// itself, the command as one file, the site, the notes and the tag's message
    Release {
        /// Uploads nothing. There is no other way yet: the last lines name what is left to type
        #[arg(long, required = true)]
        dry_run: bool,
    },
    /// Gives mutated files to every reader, or to those named. Exits with 1 if one panics, takes
    /// longer than 2 s or uses more than 1 GiB
    Fuzz {
        /// Duration of the whole run, seconds
        #[arg(long, default_value_t = 60)]
        seconds: u64,
        /// Seed of the mutations
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// Formats, such as `carmen` or `map_of_cpm`; all if left out
        targets: Vec<String>,
    },
    /// Changes the code in small ways and checks that the tests notice; exits 1 if they miss more
    /// than 8 %; needs cargo-mutants
    Mutants {
        /// Changes to try: K/N for every N-th one from the K-th on
        #[arg(long, default_value = "0/400", value_parser = mutants::Shard::parse)]
        shard: mutants::Shard,
        /// Crates, such as `tolman-geom`; geom, maze, planners, quantizers and maps if left out
        packages: Vec<String>,
    },
    /// Builds the Python module, installs it into target/python and runs its tests
    Python,
    /// Lets a system learn mazes on a robot in MuJoCo, a simulator of others, and go home from
    /// elsewhere. Installs MuJoCo into target/mujoco
    Mujoco(mujoco::Choice),
    /// Lets the ROS 2 node learn mazes on the robot of MuJoCo, over DDS alone, go home, and go to a
    /// goal of nav2
    Ros2(mujoco::Choice),
    /// Tests the package that writes replays for Rerun
    Rerun,
    /// Builds the playground, a page on which robots learn a maze that the reader draws. Needs a
    /// target of rustc and wasm-bindgen; if one is missing, says how to install it
    Playground {
        /// File to write [default: target/playground/tolman-playground.html]
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Builds one folder of pages that open from disk: playground, replays, a report, all pages and
    /// the API documentation. Needs the playground's tools and mdBook; if one is missing, says how
    /// to install it
    Site {
        /// Folder to write; a site that is there is replaced [default: target/site]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Builds the API documentation, makes README's animated picture and checks the links of the
    /// written pages
    Docs,
}

fn main() -> ExitCode {
    let done = match Arguments::parse().verb {
        Verb::Experiment { arguments } => return experiment::run(&arguments),
        Verb::Ci(choice) => ci::run(&choice),
        Verb::Golden { names, bless } => golden::run(&names, bless),
        Verb::Layers => layers::run(),
        Verb::Mazes => mazes::run(),
        Verb::Bench { name } => bench::run(name.as_deref()),
        Verb::Board => alone(board::check()),
        Verb::C => alone(mouse_c::check()),
        Verb::Prose => prose::run(),
        Verb::Dist => dist::run().map(drop),
        Verb::Release { dry_run: _ } => release::run(),
        Verb::Fuzz {
            seconds,
            seed,
            targets,
        } => fuzz::run(seconds, seed, &targets),
        Verb::Mutants { shard, packages } => alone(mutants::check(shard, &packages)),
        Verb::Python => alone(python::check()),
        Verb::Mujoco(choice) => alone(mujoco::run(&choice)),
        Verb::Rerun => alone(rerun::check()),
        Verb::Ros2(choice) => alone(ros2::run(&choice)),
        Verb::Playground { out } => playground::run(out.as_deref()),
        Verb::Site { out } => site::run(out.as_deref()),
        Verb::Docs => docs::run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs a step by itself. Then a missing tool is an error.
fn alone(step: Result<Outcome>) -> Result<()> {
    match step? {
        Outcome::Passed => Ok(()),
        Outcome::Missing(why) => bail!("{why}"),
    }
}
