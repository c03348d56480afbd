//! The command line, one file for each verb.
//!
//! Results go to stdout, everything else to stderr. A verb writes to the `out` it is given and
//! returns a [`Failure`] if it did not do all it was asked for.

mod arena;
mod audit;
mod bar;
mod brain;
mod called;
mod caster;
mod completions;
mod demo;
mod drive;
mod experiment;
mod failure;
mod file;
mod former;
mod ground;
mod half_known;
mod host;
mod interrupt;
mod judge;
mod keep;
mod kind;
mod learn;
mod live;
mod looks;
mod man;
mod map;
mod maze;
mod merge;
mod mice;
mod mms_host;
mod mouse;
mod outputs;
mod picture;
mod pitch;
mod race;
mod replay;
mod replay_file;
mod run;
mod score;
mod send;
mod sent_out;
mod share;
mod stdout;
mod systems;
mod trial;
mod unfinished;
mod words;

use std::io::Write;
use std::process::ExitCode;

use anyhow::anyhow;
use caster::Caster;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use failure::{Failure, OrBadInput, Result, Unboxed, unknown};
use stdout::{Stdout, ink};
use tolman_arena::registry::{MapText, Registry, RobotEntry, SystemEntry};

use crate::{Build, Catalogue, Family};

/// Runs systems and robots in mazes, measures them, and compares them with published papers.
#[derive(Parser)]
#[command(name = "tolman", version, arg_required_else_help = true, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
    #[command(flatten)]
    caster: Caster,
}

const EXAMPLES: &str = "\
Examples:
  tolman demo
  tolman run wall-follow --maze mazes/large.maze --replay run.html
  tolman run wall-follow --maze mazes/j.maze --seed 7 --svg run.svg
  tolman learn --system mslst --preset j --maze mazes/j.maze --out j-map.json
  tolman drive --map j-map.json --maze mazes/j.maze --seed 7
  tolman learn --system cpm-better --maze mazes/cpm-3.maze --out map.json
  tolman learn --system diktiometry-better --maze mazes/j-long.maze --out j-survey.json
  tolman maze show mazes/j.maze
  tolman mouse mazes/grid/braided-1.txt
  tolman race mazes/grid/braided-2.txt --svg race.svg
  tolman arena --system cpm-better --family office
  tolman map --log logs/office.clf.gz --out office
  tolman audit mazes/graphs/rooms.g2o --out audited # exits 1
  tolman experiment baselines --quick

Exit codes: 0 done as asked; 1 failed: a robot did not arrive, a maze was not solved, no way is known, a closure is
refuted, or an error; 2 bad input; 3 a table disagrees with the paper (only with `experiment --check`); 130 interrupted.
Results are written to stdout, progress and errors to stderr.

A verb that sends robots into one maze takes it as --maze FILE; mouse and race also take it without the flag.";

#[derive(Subcommand)]
enum Verb {
    Learn(learn::Arguments),
    Drive(drive::Arguments),
    Map(map::Arguments),
    Score(score::Arguments),
    Systems(systems::Arguments),
    Arena(arena::Arguments),
    Audit(audit::Arguments),
    Run(run::Arguments),
    Replay(replay::Arguments),
    Demo(demo::Arguments),
    #[command(subcommand)]
    Maze(maze::Verb),
    #[command(subcommand)]
    Pitch(pitch::Verb),
    Mouse(mouse::Arguments),
    Race(race::Arguments),
    MmsHost(mms_host::Arguments),
    Host(host::Arguments),
    Brain(brain::Arguments),
    Judge(judge::Arguments),
    Experiment(experiment::Arguments),
    Trial(trial::Arguments),
    Merge(merge::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
    #[command(hide = true)]
    Keep(keep::Arguments),
    #[command(hide = true)]
    Solve(former::Arguments),
    #[command(hide = true)]
    Survey(former::Arguments),
    #[command(hide = true)]
    Cpm(former::Arguments),
}

/// Parameters that every verb gets beside its arguments.
struct App {
    catalogue: Catalogue,
    build: Build,
}

impl App {
    /// Returns the systems, robots and families that the command knows.
    fn registry(&self) -> &Registry {
        &self.catalogue.registry
    }

    /// Returns the system called `name`, if `is_fit` for the verb.
    ///
    /// # Errors
    /// Bad input if there is none, or it was called so before.
    fn system(
        &self,
        name: &str,
        is_fit: impl Fn(&dyn SystemEntry) -> bool,
    ) -> Result<&'static dyn SystemEntry> {
        let named = self.registry().system(name);
        if let Some(system) = named.filter(|system| is_fit(*system)) {
            return Ok(system);
        }
        if let Some(now) = Registry::former_name(name) {
            return Err(Failure::BadInput(anyhow!(
                "{name} is now called {now}: give --system {now}"
            )));
        }
        let fit = self.registry().systems.iter();
        let fit = fit.filter(|system| is_fit(**system));
        let fault = match named {
            Some(_) => format!("{name} does not do this"),
            None => format!("there is no system {name}"),
        };
        Err(unknown(&fault, name, fit.map(|system| system.name())))
    }

    /// Returns the robot called `name`.
    ///
    /// # Errors
    /// Bad input if there is none.
    fn robot(&self, name: &str) -> Result<RobotEntry> {
        self.registry().robot(name).ok_or_else(|| {
            let names = self.registry().robots.iter().map(|robot| robot.name);
            unknown(&format!("there is no robot {name}"), name, names)
        })
    }

    /// Returns the robot called `name` if it can carry a system.
    ///
    /// # Errors
    /// Bad input that says why not.
    fn robot_for(&self, system: &dyn SystemEntry, name: &str) -> Result<RobotEntry> {
        let robot = self.robot(name)?;
        match system.why_not(&robot) {
            None => Ok(robot),
            Some(why) => {
                let able = self.registry().robots_of(system);
                let able: Vec<&str> = able.iter().map(|robot| robot.name).collect();
                Err(Failure::BadInput(anyhow!(
                    "the {} cannot carry {}: {why}; give --robot {}",
                    robot.title,
                    system.name(),
                    able.join(" or ")
                )))
            }
        }
    }

    /// Returns the family of worlds called `name`.
    ///
    /// # Errors
    /// Bad input if there is none.
    fn family(&self, name: &str) -> Result<&Family> {
        let families = &self.registry().families;
        Family::named(families, name).ok_or_else(|| {
            let names = families.iter().map(|family| family.name);
            unknown(&format!("there is no family {name}"), name, names)
        })
    }

    /// Returns the system that learned a map.
    ///
    /// # Errors
    /// Bad input if this program does not know it.
    fn system_of(&self, map: &MapText) -> Result<&'static dyn SystemEntry> {
        self.registry().system(&map.system).ok_or_else(|| {
            Failure::BadInput(anyhow!(
                "{}: its system, {}, is unknown to this program",
                map.name,
                map.system
            ))
        })
    }
}

/// Runs the command: parses the command line, carries it out with the systems and experiments of
/// `catalogue`, and returns the exit code.
///
/// `build` is named in reports as the program that made them.
#[must_use]
pub fn run(catalogue: &Catalogue, build: &Build) -> ExitCode {
    called::set(catalogue.program);
    replay_file::set_formats(&catalogue.replay_formats);
    // A second call finds the registry of the first, as it does with program and formats.
    let _ = catalogue.registry.clone().install();
    let matches = Arguments::command().get_matches();
    let arguments = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    let mut out = Stdout::lock();
    let app = App {
        catalogue: catalogue.clone(),
        build: build.clone(),
    };
    // The keeper stays until it has ended what it keeps.
    let handled = match arguments.verb {
        Verb::Keep(_) => Ok(()),
        _ => interrupt::ends_the_program(),
    };
    let done = handled.map_err(|error| Failure::Failed(error.into()));
    let done = done.and_then(|()| outputs::check(&matches));
    let done = done.and_then(|()| arguments.caster.install());
    let done = done.and_then(|()| arguments.verb.carry_out(&app, &mut out));
    // Results come before the failure, even if both streams go to one place.
    let written = out.flush();
    let done = done.and_then(|()| Ok(written?));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // The reader has seen enough, as in `tolman maze show … | head -1`.
        Err(failure) if failure.is_closed_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            failure.complain();
            failure.exit_code()
        }
    }
}

impl Verb {
    fn carry_out(self, app: &App, out: &mut dyn Write) -> Result {
        match self {
            Self::Learn(arguments) => learn::carry_out(app, &arguments, out),
            Self::Drive(arguments) => drive::carry_out(app, &arguments, out),
            Self::Map(arguments) => arguments.carry_out(app, out),
            Self::Score(arguments) => score::carry_out(&arguments, out),
            Self::Systems(arguments) => systems::carry_out(app, &arguments, out),
            Self::Arena(arguments) => arena::carry_out(app, &arguments, out),
            Self::Audit(arguments) => audit::carry_out(&arguments, out),
            Self::Run(arguments) => run::carry_out(app, &arguments, out),
            Self::Replay(arguments) => replay::carry_out(&arguments, out),
            Self::Demo(arguments) => demo::carry_out(app, &arguments, out),
            Self::Maze(verb) => verb.carry_out(app, out),
            Self::Pitch(verb) => verb.carry_out(out),
            Self::Mouse(arguments) => mouse::carry_out(&arguments, out),
            Self::Race(arguments) => race::carry_out(&arguments, out),
            Self::Host(arguments) => host::carry_out(app, &arguments, out),
            Self::Brain(arguments) => brain::carry_out(app, &arguments),
            Self::Judge(arguments) => judge::carry_out(app, &arguments, out),
            Self::MmsHost(arguments) => mms_host::carry_out(&arguments, out),
            Self::Experiment(arguments) => experiment::carry_out(app, &arguments, out),
            Self::Trial(arguments) => trial::carry_out(app, &arguments, out),
            Self::Merge(arguments) => merge::carry_out(app, &arguments, out),
            Self::Keep(arguments) => keep::carry_out(&arguments),
            Self::Completions(arguments) => completions::carry_out(&arguments, out),
            Self::Man(arguments) => man::carry_out(&arguments, out),
            Self::Solve(_) => Err(former::refuse("solve", "drive")),
            Self::Survey(_) => Err(former::refuse(
                "survey",
                "learn --system diktiometry-better",
            )),
            Self::Cpm(arguments) => Err(former::refuse_cpm(&arguments)),
        }
    }
}
