//! Carries out any outing: shows it meanwhile and writes it down.

use core::sync::atomic::Ordering;

use anyhow::{Context, anyhow};
use tolman_arena::run::{self, Ended, TaskEnd};
use tolman_arena::{BoxError, Outing};
use tolman_geom::Point;
use tolman_robot::{Goal, Landmark, Standing, Task};

use super::bar::Doing;
use super::live::{Live, Scene};
use super::looks::Looks;
use super::replay_file::MOST_STEPS;
use super::unfinished::{Done, Keeper, Saved};
use super::{Failure, Result, Unboxed, interrupt, picture};
use tolman_arena::registry::{MapText, Setup, slug};
use tolman_film::Film;

/// Task of every robot that drives to the goal.
pub(super) const ARRIVE: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

/// Outcome of an outing.
pub(super) struct Pursued {
    pub(super) ended: Ended,
    /// Outcome in words.
    pub(super) told: String,
    /// Whether the robot is at the goal.
    pub(super) has_arrived: bool,
    /// Files of the run, to be removed once its results are written.
    pub(super) saved: Saved,
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
) -> Result<Pursued> {
    looks.check()?;
    let stop = interrupt::flag()?;
    let scene = || Scene::of_outing(outing, word, setup.seed, setup.steps);
    let mut live = Live::open(looks.live, scene)?;
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
        match (keeper.again(), &film) {
            (None, Some(film)) => live.follow(outing, film),
            // The repeated actions were shown in the former run.
            _ => live.skip(outing),
        }
        doing.show(|| doing_words(word, done, keeper.again(), outing));
        if standing == Standing::UnderWay && stop.load(Ordering::Relaxed) {
            broken_off = Some(keeper.interrupted(|| state(outing)));
            return Ok(Standing::gave_up("interrupted"));
        }
        Ok::<_, BoxError>(standing)
    });
    doing.clear();
    let ended = ended
        .unboxed()
        .with_context(|| format!("{word} broke off after {} steps", outing.steps()))?;
    let told = told(&ended, outing, word);
    live.close(&told)?;
    let saved = match broken_off {
        Some(failure) => return Err(failure),
        None => keeper.finish()?,
    };
    looks.write(
        || outing.trace().unboxed(),
        || picture::of(outing.course(), outing.path(), &told),
        || {
            let film = film.unwrap_or_else(|| Film::new(outing));
            film.replay(outing, format!("{word} in {}", setup.world))
                .fact("seed", setup.seed.to_string())
                .fact("outcome", told.clone())
                .thinned(MOST_STEPS)
        },
    )?;
    let has_arrived = ended.end == TaskEnd::Done && outing.landmark() == Some(Landmark::Goal);
    Ok(Pursued {
        ended,
        told,
        has_arrived,
        saved,
    })
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
        "{word} {end}, after {} steps, {seconds:.0} s of the robot's time, {} actions and {} bumps",
        ended.steps,
        ended.actions,
        outing.bumped().len()
    )
}

/// Refuses a map that was learned in another world or on another robot.
///
/// # Errors
/// Bad input that says what differs.
pub(super) fn check_origin(map: &MapText, outing: &dyn Outing) -> Result {
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
