//! `tolman demo`: a first run to watch, without any file or argument.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_arena::contest::{Condition, Contest, LocateOutcome, Moment, ShowRecord};
use tolman_arena::registry::{DemoWorld, DrivesBy, Schooling, SystemEntry};
use tolman_film::Film;
use tolman_maze::{Maze, MazeFile};
use tolman_replay::{Chapter, Mark, Marks, Replay, moving_picture};

use super::live::{Live, Scene};
use super::looks::LIVE;
use super::mice::MazePath;
use super::outputs::{self, Output};
use super::replay_file::{self, Overwrite};
use super::words::counted;
use super::{App, Failure, OrBadInput, Result, file, maze};

/// Lets a robot explore a maze, moves it elsewhere, lets it localize and drive to the goal; writes
/// a replay for the browser
#[derive(clap::Args)]
#[command(after_help = "\
`tolman systems` lists the systems that learn. Exit code 1: the robot did not
find out where it is, or did not reach the goal, though its system can drive.

The file is tolman-demo.html in the current folder, or tolman-demo-2.html … if that
exists.

Examples:
  tolman demo
  tolman demo --live
  tolman demo --system cpm-better
  tolman demo --system micromouse --out mouse.html
  tolman demo --maze mazes/forks.maze --seed 3 --svg forks.svg")]
#[command(
    mut_arg("maze", |arg| arg
        .value_name("MAZE")
        .help("Maze file with a goal [default: a maze that comes with the program]")),
    mut_arg("maze_file", |arg| arg.value_name("FILE"))
)]
pub(super) struct Arguments {
    /// System that drives
    #[arg(long, value_name = "NAME", default_value = USUAL)]
    system: String,
    #[command(flatten)]
    maze: MazePath,
    /// Seed of all noise, and of the place where the robot is put down [default: one that shows the
    /// system well]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Replay file to write
    #[arg(long, value_name = "FILE", value_parser = outputs::file(outputs::REPLAYS))]
    out: Option<Output>,
    /// Overwrite the file even if it is not a replay
    #[arg(long, requires = "out")]
    force: bool,
    /// Also write an animated SVG
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["svg"]))]
    svg: Option<Output>,
    #[arg(long, help = LIVE)]
    live: bool,
}

/// System of the demo.
const USUAL: &str = "mslst-better";
/// Maze of the demo. It is part of the program, so that the demo runs in any folder.
pub(super) const MAZE: &str = include_str!("../../mazes/demo.maze");
/// Maze for systems that map a large maze slowly or do not localize in it.
const SMALL: &str = include_str!("../../mazes/star.maze");

/// Plays the usual demo, writes its replay to `demo.html` in a folder, and returns its moving
/// picture.
pub(super) fn in_folder(app: &App, folder: &Path, out: &mut dyn Write) -> Result<String> {
    let path = folder.join("demo.html");
    replay_file::check(&path, Overwrite::Replays)?;
    let contestant = app.system(USUAL, |system| system.learns())?;
    let (name, maze) = named(tolman_maze::read(MAZE).context("the maze of this program")?);
    let contest = contest(contestant, &maze, &name, None);
    let (_, picture) = play(&contest, false, &path, Overwrite::Replays, out)?;
    Ok(picture)
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let overwrite = Overwrite::if_forced(arguments.force);
    let path = match &arguments.out {
        Some(path) => path.to_path_buf(),
        None => free_name()?,
    };
    replay_file::check(&path, overwrite)?;
    let contestant = app.system(&arguments.system, |system| system.learns())?;
    let usual = match contestant.facts().demo.0 {
        DemoWorld::Small => SMALL,
        DemoWorld::Large => MAZE,
    };
    let (name, maze) = match arguments.maze.path() {
        Some(path) => {
            let file = maze::read(path)?;
            (maze::world_name(path, &file), file.maze)
        }
        None => named(tolman_maze::read(usual).context("the maze of this program")?),
    };
    let contest = contest(contestant, &maze, &name, arguments.seed);
    let (record, picture) = play(&contest, arguments.live, &path, overwrite, out)?;
    if let Some(path) = &arguments.svg {
        file::write(path, picture)?;
    }
    match failure(&record).filter(|_| can_drive(&contest)) {
        None => Ok(()),
        Some(why) => Err(Failure::Failed(anyhow!(why))),
    }
}

/// Returns the demo's contest, with the seed that shows the system well if none is given.
fn contest<'a>(
    contestant: &'static dyn SystemEntry,
    maze: &'a Maze,
    name: &'a str,
    seed: Option<u64>,
) -> Contest<'a> {
    Contest {
        contestant,
        robot: None,
        maze,
        name,
        condition: Condition::AsMade,
        starts: 1,
        seed: seed.unwrap_or(contestant.facts().demo.1),
        stopwatch: None,
    }
}

/// Plays the demo, writes its replay, and returns its record and its moving picture.
fn play(
    contest: &Contest<'_>,
    is_live: bool,
    path: &Path,
    overwrite: Overwrite,
    out: &mut dyn Write,
) -> Result<(ShowRecord, String)> {
    let (record, replay) = shown(contest, is_live)?;
    let picture = moving_picture(&replay);
    replay_file::write(path, replay.thinned(replay_file::MOST_STEPS), overwrite)?;
    tell(contest, &record, out)?;
    replay_file::tell(path, out)?;
    Ok((record, picture))
}

/// Returns the chapters of the replay, in order.
fn chapters(record: &ShowRecord, replay: &Replay) -> Vec<Chapter> {
    let chapter = |from, caption: &str, seconds| Chapter {
        from,
        caption: caption.to_owned(),
        seconds,
    };
    let mut chapters = vec![chapter(
        0,
        "It explores an unknown maze, and its map grows",
        9.0,
    )];
    let lifts = replay.tracks.iter().flat_map(|track| &track.lifts);
    chapters.extend(lifts.map(|lift| {
        let caption = "Put down elsewhere, it finds out where it is";
        chapter(*lift, caption, 3.0)
    }));
    let home = record.found.step as u32 + 1;
    let caption = match (&record.found.outcome, record.home) {
        (_, None) => "It does not come to the goal",
        (LocateOutcome::Right, _) => "It knows where it is, and drives to the goal",
        _ => "It drives to the goal",
    };
    let has_more = (home as usize) < replay.steps();
    chapters.extend(has_more.then(|| chapter(home, caption, 4.0)));
    chapters
}

fn named(file: MazeFile) -> (String, Maze) {
    (file.name.unwrap_or_default(), file.maze)
}

/// Plays the demo, and returns its record and its replay.
fn shown(contest: &Contest<'_>, is_live: bool) -> Result<(ShowRecord, Replay)> {
    let mut live = None;
    let mut film: Option<Film> = None;
    let mut replay = None;
    let record = contest.show(&Schooling::default(), |outing, moment| {
        let film = film.get_or_insert_with(|| Film::new(outing));
        match moment {
            Moment::Begun => {
                let name = contest.contestant.title();
                let scene = || Scene::of_outing(outing, name, contest.seed, None);
                live = Some(Live::open(is_live, scene));
            }
            Moment::Acted => {
                film.see(outing);
                if let Some(Ok(live)) = &mut live {
                    live.follow(outing, film);
                }
            }
            Moment::PutDown => film.lifted(outing),
            Moment::Over => {
                let title = format!(
                    "{} in the maze {}",
                    contest.contestant.title(),
                    contest.name
                );
                replay = Some(core::mem::replace(film, Film::new(outing)).replay(outing, title));
            }
        }
    });
    if let Some(live) = live {
        let told = match &record {
            Ok(record) if record.home.is_some() => "it came to the goal",
            _ => "it did not come to the goal",
        };
        live?.close(told)?;
    }
    let record = record.map_err(anyhow::Error::from).or_bad_input()?;
    let mut replay = replay.context("the demo ended before it was over")?;
    let found = &record.found;
    if let (LocateOutcome::Right, Some(track)) = (&found.outcome, replay.tracks.first_mut()) {
        let known = [found.step as u32];
        track
            .marks
            .push(Marks::new(Mark::Event, "found itself", known));
    }
    replay.chapters = chapters(&record, &replay);
    let replay = replay.fact("seed", contest.seed.to_string());
    Ok((record, replay))
}

/// Writes the events of the demo, in lines of at most 80 columns.
fn tell(contest: &Contest<'_>, record: &ShowRecord, out: &mut dyn Write) -> Result {
    let ShowRecord {
        learned,
        explored,
        found,
        home,
        shortest,
        ..
    } = record;
    let name = contest.contestant.title();
    writeln!(
        out,
        "{name} explored the maze {}: {explored:.1} m driven, {} places on its map.",
        contest.name, learned.places
    )?;
    match (&found.outcome, found.was_put_down) {
        (_, false) => writeln!(
            out,
            "It follows its robot, so it is not put down elsewhere."
        )?,
        (LocateOutcome::Right, true) => writeln!(
            out,
            "Put down elsewhere, it found out where it is after {}, {:.1} m.",
            counted(found.actions as usize, "move"),
            found.metres
        )?,
        (LocateOutcome::Wrong, true) => {
            writeln!(out, "Put down elsewhere, it named a place where it is not.")?;
        }
        (LocateOutcome::Abstained { .. }, true) => {
            writeln!(out, "Put down elsewhere, it did not find out where it is.")?;
        }
    }
    match home {
        Some(home) => writeln!(
            out,
            "It drove to the goal in {home:.1} m; the shortest way is {shortest:.1} m."
        )?,
        None if !can_drive(contest) => writeln!(
            out,
            "It does not drive by its map, so it did not go to the goal."
        )?,
        None => writeln!(out, "It did not come to the goal.")?,
    }
    Ok(())
}

/// Returns whether the system of a contest drives by maps at all.
fn can_drive(contest: &Contest<'_>) -> bool {
    contest.contestant.facts().drives != DrivesBy::NoMap
}

/// Returns why the demo did not show all it should, or `None` if it did.
fn failure(record: &ShowRecord) -> Option<String> {
    let found = &record.found;
    match (&found.outcome, record.home) {
        (LocateOutcome::Wrong, _) => Some("it did not find itself".to_owned()),
        (LocateOutcome::Abstained { why }, _) if found.was_put_down => {
            Some(format!("it did not find itself: {why}"))
        }
        (_, None) if record.gave_up.is_empty() => Some("it did not come to the goal".to_owned()),
        (_, None) => Some(format!("it did not come to the goal: {}", record.gave_up)),
        _ => None,
    }
}

/// Returns a file name that is still free.
fn free_name() -> Result<PathBuf> {
    let names = (1..1000).map(|number| match number {
        1 => "tolman-demo.html".to_owned(),
        _ => format!("tolman-demo-{number}.html"),
    });
    let mut free = names.filter(|name| std::fs::symlink_metadata(Path::new(name)).is_err());
    free.next().map(PathBuf::from).ok_or_else(|| {
        Failure::BadInput(anyhow!(
            "a thousand demos are here already; name a file with --out"
        ))
    })
}
