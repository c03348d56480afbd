//! Carries out any outing: shows it meanwhile and writes it down.

use core::sync::atomic::Ordering;
use std::io::Write;

use anyhow::{Context, anyhow};
use tolman_arena::run::{self, Ended, TaskEnd};
use tolman_arena::{BoxError, Outing};
use tolman_geom::Point;
use tolman_robot::{Standing, Task};

use super::bar::Doing;
use super::looks::Looks;
use super::unfinished::{Done, Keeper};
use super::watched::Watched;
use super::{Failure, file, interrupt, picture, replay_file};
use tolman_arena::registry::{MapText, Setup, slug};
use tolman_film::Film;

/// Outcome of an outing.
pub(super) struct Pursued {
    pub(super) ended: Ended,
    /// Outcome in words.
    pub(super) told: String,
}

/// Lets a system pursue a task to its end, shows it, and writes the requested files. `keeper` saves
/// the run if it is interrupted. `see` is shown the outing after each action, and where the robot
/// was before.
///
/// # Errors
/// If robot or system fail, the run is interrupted, or a file cannot be written.
pub(super) fn send(
    outing: &mut dyn Outing,
    task: Task,
    setup: &Setup<'_>,
    word: &str,
    looks: &Looks,
    mut keeper: Keeper,
    mut see: impl FnMut(&dyn Outing, Point),
) -> Result<Pursued, Failure> {
    let overwrite = looks.overwrite()?;
    let stop = interrupt::flag()?;
    let mut live = match looks.live {
        true => Some(Watched::open(outing, word, setup.seed, setup.steps)?),
        false => None,
    };
    let mut doing = Doing::new(looks.live);
    let filmed = looks.live || looks.replay.is_some();
    let mut film = filmed.then(|| Film::new(outing));
    let mut done = Done::default();
    let mut broken_off = None;
    let ended = run::until_done(outing, |outing| {
        let before = outing
            .path()
            .last()
            .map_or_else(Point::origin, |pose| pose.position);
        let standing = outing.act(task)?;
        see(outing, before);
        if let Some(film) = &mut film {
            film.see(outing);
        }
        done.actions += 1;
        done.steps = outing.steps();
        let went = keeper.went(done, outing.path(), outing.bumped(), || state(outing));
        if let Err(failure) = went {
            broken_off = Some(failure);
            return Ok(Standing::gave_up("it is another run"));
        }
        if let (Some(live), Some(film)) = (&mut live, &film) {
            match keeper.again() {
                // The repeated actions were shown in the former run.
                Some(_) => live.skip(outing),
                None => live.see(outing, film),
            }
        }
        doing.show(|| doing_words(word, done, keeper.again(), outing));
        if standing == Standing::UnderWay && stop.load(Ordering::Relaxed) {
            let saved = keeper.save(&|| state(outing));
            broken_off = Some(match saved {
                Ok(()) => Failure::Interrupted(anyhow!(keeper.told())),
                Err(failure) => failure,
            });
            return Ok(Standing::gave_up("interrupted"));
        }
        Ok::<_, BoxError>(standing)
    });
    doing.clear();
    let ended = ended
        .map_err(anyhow::Error::from_boxed)
        .with_context(|| format!("{word} broke off after {} steps", outing.steps()))?;
    let told = told(&ended, outing, word);
    if let Some(live) = live {
        live.close(&told)?;
    }
    match broken_off {
        Some(failure) => return Err(failure),
        None => keeper.finish()?,
    }
    if let Some(path) = &looks.trace {
        let lines = outing.trace().map_err(anyhow::Error::from_boxed)?;
        file::write(path, lines)?;
    }
    if let Some(path) = &looks.svg {
        file::write(path, picture::of(outing.course(), outing.path(), &told))?;
    }
    if let (Some(path), Some(film)) = (&looks.replay, film) {
        let title = format!("{word} in {}", setup.world);
        let replay = film.replay(outing, title);
        let replay = replay.fact("seed", setup.seed.to_string());
        let replay = replay.fact("outcome", told.clone());
        replay_file::write(path, replay, overwrite)?;
    }
    Ok(Pursued { ended, told })
}

/// Returns the state of a run so far as a text, without the robot's way.
fn state(outing: &dyn Outing) -> Result<String, BoxError> {
    let map = outing.map_file()?.unwrap_or_default();
    Ok(format!("{}\n{map}", outing.words()))
}

fn doing_words(word: &str, done: Done, again: Option<Done>, outing: &dyn Outing) -> String {
    let Done { actions, steps } = done;
    match again {
        Some(again) => format!("{word}: makes {actions} of {} actions again", again.actions),
        None => format!(
            "{word}: {actions} actions, {steps} steps; {}",
            outing.words()
        ),
    }
}

/// Returns the outcome in words.
fn told(ended: &Ended, outing: &dyn Outing, word: &str) -> String {
    let end = match &ended.end {
        TaskEnd::Done => "is done",
        TaskEnd::OutOfTime => "is out of time",
        TaskEnd::GaveUp { why } => &format!("gave up: {why}"),
    };
    let seconds = f64::from(ended.steps) * outing.robot().step_us as f64 * 1e-6;
    format!(
        "{word} {end}, after {} steps, {seconds:.0} s, {} actions and {} bumps",
        ended.steps,
        ended.actions,
        outing.bumped().len()
    )
}

/// Writes the path of the replay, if there is one.
pub(super) fn tell_replay(looks: &Looks, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(path) = &looks.replay {
        writeln!(out, "replay: {}", replay_file::address(path))?;
    }
    Ok(())
}

/// Refuses a map that was learned in another world or on another robot.
///
/// # Errors
/// Bad input that says what differs.
pub(super) fn check_origin(map: &MapText, outing: &dyn Outing) -> Result<(), Failure> {
    let (course, robot) = (outing.course(), outing.robot().name);
    let origin = &map.origin;
    let world = match &origin.drawing {
        Some(drawing) => *drawing == course.drawing(),
        None => origin.world == course.name,
    };
    let error = if !world && origin.world == course.name {
        anyhow!(
            "{} has been drawn again since the map in {} was learned; learn it again, or add --anyway",
            course.name,
            map.name
        )
    } else if !world {
        anyhow!(
            "the map in {} was learned in {}, and this is {}; name the maze it was learned in, or add --anyway",
            map.name,
            origin.world,
            course.name
        )
    } else if origin.robot != robot {
        anyhow!(
            "the map in {} was learned by the {}, and this is the {robot}; take --robot {}, or add --anyway",
            map.name,
            origin.robot,
            slug(&origin.robot)
        )
    } else {
        return Ok(());
    };
    Err(Failure::BadInput(error))
}
