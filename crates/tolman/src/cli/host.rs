//! `tolman host`: a program in any language drives a simulated robot and is scored.

use core::time::Duration;
use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, Error, anyhow};
use clap::ArgGroup;
use serde_json::json;
use tolman_arena::cpm::epuck;
use tolman_arena::foreign::{Budget, ForeignBrain, Hello, Launch, Log};
use tolman_arena::{Depicted, Outing, RobotFacts, Sent};
use tolman_geom::path_length;
use tolman_sim::robots::Epuck;

use super::ground::Ground;
use super::looks::Looks;
use super::send::{ARRIVE, Pursued, send};
use super::sent_out::{StartOption, setup_of};
use super::unfinished::{Call, Keeper, Saving};
use super::words::words;
use super::{App, Failure, OrBadInput, Result, Unboxed, interrupt, keep};
use tolman_arena::registry::{RobotEntry, RobotKind, Schooling, Setup, slug};

/// Lets your program, in any language, drive a simulated robot to the goal, and scores it; exits 1
/// if the robot does not arrive
///
/// The program reads lines of JSON from its standard input. The first line describes the robot.
/// Each line after it holds what the robot senses in one time step. The program answers it with one
/// line: a command, or that it is done.
#[derive(clap::Args)]
#[command(
    group(ground_or_template()),
    after_help = "\
What the program reads, and what it answers:
  {\"hello\": {\"protocol\": 1, \"robot\": \"laser-pioneer\", \"radius\": …, \"step_us\": …, \"step_limit\": …, \"corridor_width\": …}}
  {\"step\": 0, \"sensing\": {…}, \"landmark\": null}   ->  {\"turn\": 0.1, \"translate\": 0.5}
  {\"step\": 1, \"sensing\": {…}, \"landmark\": \"Goal\"} ->  {\"done\": true}

It may also answer {\"give_up\": \"why\"}. The command of an e-puck is {\"left\": …, \"right\": …}, rad/s. A program that ends
early, takes longer than --time-limit or answers nonsense has failed, and is ended with all that it started.

Examples:
  tolman host --template > brain.py
  tolman host --maze mazes/j.maze --seed 3 --replay hosted.html -- python3 brain.py"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    ground: Ground,
    /// Seed of all random numbers: the same seed gives the same noise and the same start
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Robot to drive: laser-pioneer or e-puck
    #[arg(long, value_name = "NAME")]
    robot: Option<String>,
    #[command(flatten)]
    start: StartOption,
    /// Stop after this many time steps
    #[arg(long, value_name = "LIMIT", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..))]
    steps: u32,
    /// Stop the program once it has kept the robot waiting this long
    #[arg(long, value_name = "SECONDS", default_value_t = 600, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    time_limit: u64,
    /// Show what the program writes to stderr
    #[arg(long)]
    log: bool,
    /// Write a sample program in Python: `brain` follows the right-hand wall on a laser-pioneer,
    /// `mapper` watches one and learns its map, for `tolman arena --mapper`
    #[arg(long, value_name = "KIND", num_args = 0..=1, default_missing_value = "brain", value_parser = words(TEMPLATES))]
    template: Option<&'static str>,
    #[command(flatten)]
    looks: Looks,
    /// Program and its arguments
    #[arg(
        last = true,
        required_unless_present = "template",
        value_name = "PROGRAM"
    )]
    program: Vec<String>,
}

/// Values of `--template`, with the program that each writes.
const TEMPLATES: [(&str, &str, &str); 2] = [
    ("brain", "Drives", include_str!("host/brain.py")),
    ("mapper", "Watches", include_str!("host/mapper.py")),
];

/// Returns the group that requires a maze, a world or `--template`.
fn ground_or_template() -> ArgGroup {
    let either = ArgGroup::new("either").args(["maze", "maze_file", "world", "template"]);
    either.required(true)
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(template) = arguments.template {
        return Ok(out.write_all(template.as_bytes())?);
    }
    let world = arguments.ground.read()?;
    let robot = match &arguments.robot {
        Some(name) => app.robot(name)?,
        None => RobotEntry::LASER_PIONEER,
    };
    let schooling = Schooling::default();
    let setup = Setup {
        start: arguments.start.start,
        steps: Some(arguments.steps),
        ..setup_of(&world, robot, &schooling, arguments.seed)
    };
    let stop = interrupt::flag()?;
    let keeper = keep::keeper();
    let launch = Launch {
        words: &arguments.program,
        keeper: &keeper,
        log: match arguments.log {
            true => Log::Shown,
            false => Log::Dropped,
        },
        stop: &stop,
    };
    let outing = arguments.outing(&setup, &launch);
    let mut outing = outing
        .with_context(|| format!("cannot host a program in {}", setup.world))
        .or_bad_input()?;
    let word = arguments.program.join(" ");
    let keeper = Keeper::new(PathBuf::new(), Call::new("host"), None)?.saving(Saving::Never);
    let looks = &arguments.looks;
    let pursued = send(
        &mut *outing,
        ARRIVE,
        &setup,
        &word,
        looks,
        keeper,
        |_, _| {},
    )?;
    arguments.tell(&*outing, setup.world, &pursued, out)
}

impl Arguments {
    /// Starts the program and puts its robot on the course.
    fn outing(&self, setup: &Setup<'_>, launch: &Launch<'_>) -> Result<Box<dyn Outing>, Error> {
        let robot = setup.robot;
        match robot.kind() {
            RobotKind::Laser => {
                let model = robot.laser_model(robot.laser_config()).unboxed()?;
                self.outing_of(model, setup, launch)
            }
            RobotKind::Epuck => self.outing_of(Epuck::new(epuck())?, setup, launch),
            RobotKind::Camera | RobotKind::Pioneer2dx => Err(anyhow!(
                "a program cannot be given the {}: give --robot laser-pioneer or e-puck",
                robot.title
            )),
        }
    }

    fn outing_of<M: Depicted + 'static>(
        &self,
        model: M,
        setup: &Setup<'_>,
        launch: &Launch<'_>,
    ) -> Result<Box<dyn Outing>, Error> {
        let course = setup.terrain.course(setup.world, model.body())?;
        let start = setup.start_off_centre(&course, model.body()).unboxed()?;
        let robot = course.robot_at(start, model, setup.seed)?;
        let facts = RobotFacts::of(&robot);
        let hello = Hello {
            robot: slug(facts.name),
            radius: facts.body.radius(),
            step_us: facts.step_us,
            step_limit: Some(self.steps),
            corridor_width: course.corridor_width,
        };
        let brain = ForeignBrain::start(launch, self.budget(), hello)?;
        Ok(Box::new(Sent::new(course, robot, self.steps, brain)))
    }

    fn budget(&self) -> Budget {
        Budget {
            time: Duration::from_secs(self.time_limit),
            lines: u64::from(self.steps) + 1,
            ..Budget::default()
        }
    }

    fn tell(
        &self,
        outing: &dyn Outing,
        world: &str,
        pursued: &Pursued,
        out: &mut dyn Write,
    ) -> Result {
        let Pursued {
            ended,
            told,
            has_arrived,
            ..
        } = pursued;
        let driven = path_length(outing.path());
        let shortest = outing
            .course()
            .shortest_metres_from(outing.path()[0].position);
        let json = || {
            json!({
                "program": self.program,
                "maze": world,
                "robot": outing.robot().name,
                "seed": self.seed,
                "reached": has_arrived,
                "gave_up": ended.end.why(),
                "steps": ended.steps,
                "bumps": outing.bumped().len(),
                "driven": driven,
                "shortest": shortest,
            })
        };
        self.looks.tell(out, json, |out| {
            if !has_arrived {
                return Ok(());
            }
            let way = shortest.map(|shortest| format!(" (the shortest way: {shortest:.1} m)"));
            let way = way.unwrap_or_default();
            writeln!(out, "{told}; it drove {driven:.1} m{way}")
        })?;
        match has_arrived {
            true => Ok(()),
            false => Err(Failure::Failed(anyhow!(
                "{told}: the robot is not at the goal of {world}; --log shows what the program says"
            ))),
        }
    }
}
