//! The common part of `tolman run` and `tolman solve`: one robot, one maze, one seed.

use core::ops::ControlFlow;
use core::sync::atomic::Ordering;
use std::io::Write;

use anyhow::{Context, anyhow};
use serde_json::json;
use tolman_arena::Mind;
use tolman_arena::course::Course;
use tolman_arena::episode::{self, Episode, EpisodeError, Trial};
use tolman_arena::pioneer::{body, calibrated};
use tolman_film::Recorder;
use tolman_geom::Point;
use tolman_replay::Fact;
use tolman_sim::robots::LaserPioneerConfig;

use super::trace;
use crate::cli::bar::Doing;
use crate::cli::ground::{Ground, required};
use crate::cli::interrupt;
use crate::cli::live::{self, Live, Scene};
use crate::cli::looks::Looks;
use crate::cli::picture;
use crate::cli::replay_file;
use crate::cli::unfinished::{Done, GoingOn};
use crate::cli::{Failure, OrBadInput, file, of_registry};
use tolman_arena::registry::Start;

/// Settings of a robot's run, and the files that are written.
#[derive(clap::Args)]
#[command(group(required()))]
pub(in crate::cli) struct Outing {
    #[command(flatten)]
    ground: Ground,
    /// Seed of all random numbers of the run: the same seed gives the same run
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Where the robot starts: random, marked (the maze's start), X,Y or X,Y,DEG. X and Y are in
    /// metres from the south-west corner of a maze, or in a world's own frame; DEG in degrees,
    /// counter-clockwise from east
    #[arg(
        long,
        value_name = "WHERE",
        default_value = "random",
        allow_hyphen_values = true
    )]
    start: Start,
    /// Give up after this many time steps [default: in proportion to the corridors' length, at the
    /// rate of the Large maze's 500]
    #[arg(long, value_name = "LIMIT", value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
    #[command(flatten)]
    going_on: GoingOn,
    #[command(flatten)]
    looks: Looks,
}

/// Names of a brain.
#[derive(Clone, Copy)]
pub(in crate::cli) struct Name<'a> {
    /// Name on the command line and in sentences.
    pub(in crate::cli) word: &'static str,
    /// Name in tables and titles.
    pub(in crate::cli) title: &'static str,
    /// Positions of the nodes of the system's map, by id; empty without a map.
    pub(in crate::cli) nodes: &'a [Point],
}

/// Returns the maze or world, made ready for the calibrated robot.
///
/// # Errors
/// Bad input if it cannot be read, or the robot does not fit.
fn course(ground: &Ground) -> Result<Course, Failure> {
    let (name, terrain) = ground.read()?;
    let course = terrain.course(&name, &body()).with_context(|| name);
    course.or_bad_input()
}

/// Sends the mind that `mind` makes on the run, and writes the outcome.
///
/// # Errors
/// Bad input if maze, start or files do not fit together; the error of `mind`; a failure if the
/// robot did not arrive.
pub(in crate::cli) fn carry_out(
    arguments: &Outing,
    name: Name<'_>,
    mind: impl FnOnce(&Course, &LaserPioneerConfig) -> Result<Mind, Failure>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let looks = &arguments.looks;
    let overwrite = looks.overwrite()?;
    let robot = calibrated();
    let course = course(&arguments.ground)?;
    let random = || Some(episode::random_start(&course, &body(), arguments.seed));
    let start = arguments.start.on(&course, random);
    let start = start.map_err(of_registry).or_bad_input()?;
    let trial = Trial {
        course: &course,
        robot: robot.clone(),
        start,
        step_limit: arguments.steps.unwrap_or_else(|| course.step_limit()),
        seed: arguments.seed,
    };
    let mut mind = mind(&course, &robot)?;
    let mut live = match looks.live {
        true => Some(Live::open(Scene::of(&trial, name.word))?),
        false => None,
    };
    let call = arguments.ground.call("run", &course);
    let call = call
        .with("the brain", Some(name.word))
        .with("--seed", Some(arguments.seed))
        .with("--start", Some(arguments.start))
        .with("--steps", arguments.steps);
    let mut keeper = arguments.going_on.keeper(call)?;
    let stop = interrupt::flag()?;
    let mut doing = Doing::new(looks.live);
    let mut done = Done::default();
    let mut broken_off = None;
    let mut commands = Vec::new();
    let mut recorder = Recorder::new(&trial).knowing(name.nodes);
    let episode = episode::run_while(&trial, &mut mind, None, |step| {
        commands.push(step.command);
        recorder.see(step);
        done.steps += 1;
        done.actions += u32::from(step.ends.is_some());
        let state = || Ok(format!("{} {}", step.action, step.words()));
        let went = keeper.went(done, step.robot.path(), step.robot.bumped(), state);
        // The repeated steps were shown in the former run.
        if let (Some(live), None) = (&mut live, keeper.again()) {
            live::see(step, |now| live.watch(now));
        }
        doing.show(|| format!("{}: {} steps; {}", name.word, done.steps, step.words()));
        if broken_off.is_none() {
            broken_off = match went {
                Ok(()) if !stop.load(Ordering::Relaxed) => return ControlFlow::Continue(()),
                Ok(()) => Some(match keeper.save(&state) {
                    Ok(()) => Failure::Interrupted(anyhow!(keeper.told())),
                    Err(failure) => failure,
                }),
                Err(failure) => Some(failure),
            };
        }
        ControlFlow::Break(())
    })
    .map_err(classify)?;
    doing.clear();
    let told = told(name.word, &episode);
    if let Some(live) = live {
        live.close(&told).context("the terminal has gone")?;
    }
    match broken_off {
        // The interrupted action may have led to the goal all the same.
        Some(Failure::Interrupted(_)) if episode.reached => keeper.finish()?,
        Some(failure) => return Err(failure),
        None => keeper.finish()?,
    }
    if let Some(path) = &looks.trace {
        file::write(path, trace::of(&trial, &commands)?)?;
    }
    if let Some(path) = &looks.svg {
        file::write(path, picture::of(&course, &episode.path, &told))?;
    }
    if let Some(path) = &looks.replay {
        let title = format!("{} in {}", name.title, course.name);
        let mut replay = recorder.finish(title, &episode);
        let brain = Fact::new("brain", name.title);
        replay.facts.insert(1, brain);
        replay_file::write(path, replay, overwrite)?;
    }
    if looks.json {
        let json = json!({
            "brain": name.word,
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
        });
        writeln!(out, "{json:#}")?;
    } else {
        if episode.reached {
            writeln!(out, "{told}")?;
        }
        if let Some(path) = &looks.replay {
            writeln!(out, "replay: {}", replay_file::address(path))?;
        }
    }
    if episode.reached {
        return Ok(());
    }
    Err(Failure::Failed(anyhow!(
        "{told}; give it more --steps, or another --seed"
    )))
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
pub(super) fn classify(error: EpisodeError) -> Failure {
    match error {
        EpisodeError::Start(_)
        | EpisodeError::Course(_)
        | EpisodeError::Layers(_)
        | EpisodeError::Policy { .. } => Failure::BadInput(error.into()),
        _ => Failure::Failed(error.into()),
    }
}
