//! The command line, one verb a file.
//!
//! Results go to stdout, everything else to stderr. A verb writes to the `out` it is given and
//! returns a [`Failure`] if there is something to complain about.

mod bar;
mod called;
mod completions;
mod cpm;
mod demo;
mod experiment;
mod failure;
mod file;
mod interrupt;
mod learn;
mod man;
mod map;
mod maze;
mod mms_host;
mod mouse;
mod replay;
mod replay_file;
mod run;
mod share;
mod solve;
mod start;
mod stdout;
mod survey;
mod words;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use failure::{Failure, OrBadInput};
use stdout::{Stdout, ink};

/// Robots with laser rings in mazes: runs them, measures them, and sets them beside the papers.
#[derive(Parser)]
#[command(name = "tolman", version, arg_required_else_help = true, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

const EXAMPLES: &str = "\
Examples:
  tolman demo
  tolman run wall-follow --maze mazes/large.maze --replay run.html
  tolman run wall-follow --maze mazes/j.maze --seed 7 --svg run.svg
  tolman learn --maze mazes/j.maze --out j-map.json
  tolman solve --map j-map.json --maze mazes/j.maze --seed 7
  tolman cpm learn --maze mazes/cpm-3.maze --out map.json
  tolman survey --maze mazes/j.maze --out j-survey.json
  tolman maze show mazes/j.maze
  tolman mouse mazes/grid --worst 3
  tolman experiment baselines --quick

Exit codes: 0 done as asked; 1 failed: a robot did not arrive, a maze was not solved, no way is known, or an
error; 2 bad input; 3 a table disagrees with the paper (only with `experiment --check`); 130 interrupted.
Results are written to stdout, progress and errors to stderr.";

#[derive(Subcommand)]
enum Verb {
    Run(run::Arguments),
    Learn(learn::Arguments),
    Solve(solve::Arguments),
    Survey(survey::Arguments),
    #[command(subcommand)]
    Map(map::Verb),
    Replay(replay::Arguments),
    Demo(demo::Arguments),
    #[command(subcommand)]
    Maze(maze::Verb),
    #[command(subcommand)]
    Cpm(cpm::Verb),
    Mouse(mouse::Arguments),
    MmsHost(mms_host::Arguments),
    Experiment(experiment::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// Parses the command line, does what it says and returns the exit code.
pub(crate) fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut out = Stdout::lock();
    let done = arguments.verb.carry_out(&mut out);
    // What was found stands before what failed, wherever the two streams end up.
    let written = out.flush();
    let done = done.and_then(|()| Ok(written?));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads has seen enough, as in `tolman maze show … | head -1`.
        Err(failure) if failure.is_closed_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            failure.complain();
            failure.exit_code()
        }
    }
}

impl Verb {
    fn carry_out(self, out: &mut dyn Write) -> Result<(), Failure> {
        match self {
            Self::Run(arguments) => run::carry_out(&arguments, out),
            Self::Learn(arguments) => learn::carry_out(&arguments, out),
            Self::Solve(arguments) => solve::carry_out(&arguments, out),
            Self::Survey(arguments) => survey::carry_out(&arguments, out),
            Self::Map(verb) => verb.carry_out(out),
            Self::Replay(arguments) => replay::carry_out(&arguments, out),
            Self::Demo(arguments) => demo::carry_out(&arguments, out),
            Self::Maze(verb) => verb.carry_out(out),
            Self::Cpm(verb) => verb.carry_out(out),
            Self::Mouse(arguments) => mouse::carry_out(&arguments, out),
            Self::MmsHost(arguments) => mms_host::carry_out(&arguments, out),
            Self::Experiment(arguments) => experiment::carry_out(&arguments, out),
            Self::Completions(arguments) => completions::carry_out(&arguments, out),
            Self::Man(arguments) => man::carry_out(&arguments, out),
        }
    }
}
