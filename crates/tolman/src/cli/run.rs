//! `tolman run`: one robot, one maze or world, one seed.

use core::ops::ControlFlow;
use core::sync::atomic::Ordering;
use std::io::Write;

use anyhow::{Context, anyhow};
use clap::ArgGroup;
use serde_json::json;
use tolman_arena::cast::Cast;
use tolman_arena::episode::{self, Episode, EpisodeError, Trial};
use tolman_arena::pioneer::{body, calibrated};
use tolman_arena::registry::Start;
use tolman_arena::trace_of;
use tolman_film::Recorder;
use tolman_replay::Fact;
use tolman_sim::robots::LaserPioneer;

use super::bar::Doing;
use super::ground::{Ground, required};
use super::live::{Live, Scene, see};
use super::looks::Looks;
use super::sent_out::StartOption;
use super::unfinished::{Done, GoingOn};
use super::{App, Failure, OrBadInput, Result, Unboxed, interrupt, picture};

/// Sends one robot through a maze or a world and reports the result
#[derive(clap::Args)]
#[command(
    group(required()),
    group(ArgGroup::new("who").args(["brain", "system"]).required(true)),
    after_help = "\
The same brain, maze, start and seed make the same run, on any machine. To repeat the run of a line in runs.jsonl,
give its --seed, --start random, and as --steps the step_limit of its world in config.toml.

Examples:
  tolman run wall-follow --maze mazes/j.maze --seed 7 --svg run.svg
  tolman run wall-follow --maze mazes/large.maze --live
  tolman run wall-follow --maze mazes/large.maze --replay run.html
  tolman run avoid --maze mazes/grid/braided-2.txt --steps 20000
  tolman run wall-follow --world mazes/worlds/rooms.json --seed 3
  tolman run wall-follow --world mazes/worlds/hall.yaml --goal 2,0 --seed 2"
)]
pub(super) struct Arguments {
    /// Brain that chooses the actions: a baseline of `tolman systems`
    #[arg(value_name = "BRAIN")]
    brain: Option<String>,
    /// The same as BRAIN
    #[arg(long, value_name = "NAME")]
    system: Option<String>,
    #[command(flatten)]
    ground: Ground,
    /// Seed of all random numbers of the run: the same seed gives the same run
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    start: StartOption,
    /// Give up after this many time steps [default: in proportion to the corridors' length, at the
    /// rate of the Large maze's 500]
    #[arg(long, value_name = "LIMIT", value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
    #[command(flatten)]
    going_on: GoingOn,
    #[command(flatten)]
    looks: Looks,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let brain = arguments.brain.as_ref().or(arguments.system.as_ref());
    let brain = app.system(brain.context("a brain")?, |system| {
        system.baseline().is_some()
    })?;
    let (word, title) = (brain.name(), brain.title());
    let looks = &arguments.looks;
    looks.check()?;
    let robot = calibrated();
    let (name, terrain) = arguments.ground.read()?;
    let course = terrain.course(&name, &body()).with_context(|| name);
    let course = course.or_bad_input()?;
    let random = || Some(episode::random_start(&course, &body(), arguments.seed));
    let wanted = arguments.start.start;
    let wanted = wanted.unwrap_or_else(|| Start::usual(&course));
    let start = wanted.on(&course, random);
    let start = start.unboxed().or_bad_input()?;
    let trial = Trial {
        course: &course,
        robot: robot.clone(),
        start,
        step_limit: arguments.steps.unwrap_or_else(|| course.step_limit()),
        seed: arguments.seed,
    };
    let agent = brain.baseline().context("a baseline")?;
    let mind = Cast::default().mind(agent, &course, &robot);
    let mut mind = mind.map_err(classify)?;
    let mut live = Live::open(looks.live, || Scene::of(&trial, word))?;
    let call = arguments.ground.call("run", &course);
    let call = call
        .with("the brain", Some(word))
        .with("--seed", Some(arguments.seed))
        .with("--start", Some(wanted))
        .with("--steps", arguments.steps);
    let mut keeper = arguments.going_on.keeper(call)?;
    let stop = interrupt::flag()?;
    let mut doing = Doing::new(looks.live);
    let mut done = Done::default();
    let mut broken_off = None;
    let mut commands = Vec::new();
    let mut recorder = Recorder::new(&trial);
    let episode = episode::run_while(&trial, &mut mind, None, |step| {
        commands.push(step.command);
        recorder.see(step);
        done.steps += 1;
        done.actions += u32::from(step.ends.is_some());
        let state = || Ok(format!("{} {}", step.action, step.words()));
        let went = keeper.went(done, step.robot.path(), step.robot.bumped(), state);
        // The repeated steps were shown in the former run.
        if keeper.again().is_none() {
            see(step, |now| live.watch(now));
        }
        doing.show(|| format!("{word}: {} steps; {}", done.steps, step.words()));
        if broken_off.is_none() {
            broken_off = match went {
                Ok(()) if !stop.load(Ordering::Relaxed) => return ControlFlow::Continue(()),
                Ok(()) => Some(keeper.interrupted(state)),
                Err(failure) => Some(failure),
            };
        }
        ControlFlow::Break(())
    })
    .map_err(classify)?;
    doing.clear();
    let told = told(word, &episode);
    live.close(&told)?;
    let saved = match broken_off {
        // The interrupted action may have led to the goal all the same.
        Some(Failure::Interrupted(_)) if episode.reached => keeper.finish()?,
        Some(failure) => return Err(failure),
        None => keeper.finish()?,
    };
    looks.write(
        || {
            let (world, robot) = (course.world.clone(), LaserPioneer::new(robot)?);
            trace_of(world, robot, start, arguments.seed, &commands).unboxed()
        },
        || picture::of(&course, &episode.path, &told),
        || {
            let mut replay = recorder.finish(format!("{title} in {}", course.name), &episode);
            replay.facts.insert(1, Fact::new("brain", title));
            replay
        },
    )?;
    saved.remove();
    let json = || {
        json!({
            "brain": word,
            "maze": course.name,
            "seed": arguments.seed,
            "start": {
                "x": start.position.x,
                "y": start.position.y,
                "heading_deg": start.heading.degrees(),
            },
            "reached": episode.reached,
            "actions": episode.actions,
            "failed_actions": episode.failed_actions,
            "steps": episode.steps,
            "step_limit": trial.step_limit,
            "bumps": episode.bumps,
        })
    };
    looks.tell(out, json, |out| match episode.reached {
        true => writeln!(out, "{told}"),
        false => Ok(()),
    })?;
    match episode.reached {
        true => Ok(()),
        false => Err(Failure::Failed(anyhow!(told))),
    }
}

/// Returns the outcome in words.
fn told(word: &str, episode: &Episode) -> String {
    let Episode {
        actions,
        failed_actions,
        steps,
        bumps,
        ..
    } = episode;
    let came = if episode.reached {
        "reached the destination"
    } else {
        "did not arrive"
    };
    format!(
        "{word} {came}: {steps} steps, {actions} actions of which {failed_actions} failed, {bumps} bumps"
    )
}

/// Returns the failure for an error: bad input if start or maze are at fault.
fn classify(error: EpisodeError) -> Failure {
    match error {
        EpisodeError::Start(_)
        | EpisodeError::Course(_)
        | EpisodeError::Layers(_)
        | EpisodeError::Policy { .. } => Failure::BadInput(error.into()),
        _ => Failure::Failed(error.into()),
    }
}
