//! Any outing carried out: looked at while it goes, and written down.

use core::sync::atomic::Ordering;
use std::io::Write;

use anyhow::{Context, anyhow};
use tolman_arena::Outing;
use tolman_arena::run::{self, Ended, TaskEnd};
use tolman_robot::{Standing, Task};

use super::live::{Live, Now, Scene};
use super::looks::Looks;
use super::{Failure, file, interrupt, picture, replay_file};
use crate::system::{MapText, Setup, slug};
use tolman_papers::Film;

/// What became of an outing.
pub(super) struct Pursued {
    pub(super) ended: Ended,
    /// The same in words.
    pub(super) told: String,
}

/// Lets a system pursue a task to its end, shows it to who looks, and writes down what was asked
/// for.
///
/// # Errors
/// If robot or system fail, somebody interrupts, or a file cannot be written.
pub(super) fn send(
    outing: &mut dyn Outing,
    task: Task,
    setup: &Setup<'_>,
    word: &str,
    looks: &Looks,
) -> Result<Pursued, Failure> {
    let overwrite = looks.overwrite()?;
    let stop = interrupt::flag()?;
    let mut live = match looks.live {
        true => Some(Live::open(scene(outing, setup, word))?),
        false => None,
    };
    let mut film = looks.replay.as_ref().map(|_| Film::new(outing));
    let mut shown = 1;
    let mut interrupted = false;
    let ended = run::until_done(outing, |outing| {
        let standing = outing.act(task)?;
        if let Some(film) = &mut film {
            film.see(outing);
        }
        if let Some(live) = &mut live {
            let words = outing.words();
            let (path, bumped) = (outing.path(), outing.bumped());
            for (step, pose) in path.iter().enumerate().skip(shown) {
                live.watch(&Now {
                    pose: *pose,
                    bump: bumped.binary_search(&(step as u32)).is_ok(),
                    action: &words,
                    ended: None,
                    scan: outing.scan(),
                });
            }
            shown = path.len();
        }
        interrupted = stop.load(Ordering::Relaxed);
        match interrupted {
            true => Ok(Standing::gave_up("interrupted")),
            false => Ok::<_, tolman_arena::BoxError>(standing),
        }
    });
    let ended = ended
        .map_err(anyhow::Error::from_boxed)
        .with_context(|| format!("{word} broke off after {} steps", outing.steps()))?;
    let told = told(&ended, outing, word);
    if let Some(live) = live {
        live.close(&told).context("the terminal has gone")?;
    }
    if interrupted {
        return Err(Failure::Interrupted(anyhow!("{word} was interrupted")));
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

fn scene(outing: &dyn Outing, setup: &Setup<'_>, word: &str) -> Scene {
    Scene {
        course: outing.course().clone(),
        word: word.to_owned(),
        seed: setup.seed,
        start: outing.path()[0],
        step_us: outing.robot().step_us,
        radius: outing.robot().body.radius(),
        step_limit: setup.steps,
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

/// Tells where the replay lies, if there is one.
pub(super) fn tell_replay(looks: &Looks, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(path) = &looks.replay {
        writeln!(out, "replay: {}", replay_file::address(path))?;
    }
    Ok(())
}

/// Refuses a map that was learned in another world or on another robot.
///
/// # Errors
/// Bad input with what differs.
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
