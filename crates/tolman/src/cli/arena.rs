//! `tolman arena`: sends systems into worlds of every kind and compares their maps with the truth.

mod errands;
mod league;
mod programs;
mod verdicts;

use core::time::Duration;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::Instant;

use anyhow::{Error, anyhow};
use rayon::prelude::*;
use serde::Serialize;
use tolman_arena::Outing;
use tolman_arena::contest::{
    Claim, Condition, Contest, ContestError, ContestRecord, LearnRecord, LocateOutcome, Moment,
};
use tolman_arena::registry::{Registry, RobotEntry, Schooling, SystemEntry, slug};
use tolman_papers::arena::{ArenaWorld, DrawnWorld, filmed};

use self::programs::Programs;
use super::called;
use super::failure::{note, told};
use super::outputs::{self, Output};
use super::replay_file::{self, Overwrite};
use super::{App, Failure, OrBadInput, Result, Unboxed, unknown};

/// A system or baseline of the arena.
type Contestant = &'static dyn SystemEntry;

/// Sends systems into worlds of every kind; judges their maps, and whether they reach the goal
#[derive(clap::Args)]
#[command(after_help = "\
`tolman systems` lists the systems, the baselines, which only drive to the goal, and the robots.
`tolman maze generate --list` names the families. `tolman experiment arena` fills whole tables.

Conditions: as-made, wheels-1, wheels-2, wheels-5 (each wheel is off by a constant of up to this many percent), compass-offset,
constant-odometry, fresh-odometry, doors, kidnapping, drop-outs, real-sensors. docs/arena.md explains them.

Examples:
  tolman arena --system cpm-better --family office
  tolman arena --system cpm-better --family ladder --condition wheels-5
  tolman arena mazes/forks.maze --system all
  tolman arena --system mslst --cost
  tolman arena --system micromouse --own-verdict --worlds 3
  tolman arena --system diktiometry-better --robot laser-pioneer --worlds 1
  tolman arena --system cpm --family star --json > cpm.jsonl
  tolman arena --league .")]
pub(super) struct Arguments {
    /// Files of mazes in any format and of worlds of free walls (.json, or the .yaml of a ROS map),
    /// or folders of them, each to use once, instead of the families or beside those of --family
    #[arg(value_name = "MAZE")]
    mazes: Vec<PathBuf>,
    /// The same as MAZE
    #[arg(long = "maze", value_name = "FILE|DIR")]
    maze_files: Vec<PathBuf>,
    /// System to send, or `all`; by default all, unless a program is given. May be given several
    /// times
    #[arg(long, value_name = "NAME")]
    system: Vec<String>,
    #[command(flatten)]
    programs: Programs,
    /// Robot that carries the systems, or `own` for the one that each is made for
    #[arg(long, value_name = "NAME", default_value = "own")]
    robot: String,
    /// Change in the robots and worlds; the conditions are listed below
    #[arg(long, value_name = "NAME", default_value = "as-made")]
    condition: String,
    /// What the systems do: learn, find out where they are and come home, or run errands from
    /// landmark to landmark with an empty map
    #[arg(long, value_enum, default_value_t)]
    task: ArenaTask,
    /// Family of worlds, or `all`; by default all, unless a MAZE is given. May be given several
    /// times
    #[arg(long, value_name = "NAME")]
    family: Vec<String>,
    /// Number of worlds of each family, small and middle sizes in turn; with --own-verdict the
    /// maximum, by default 40 [default: 2]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    worlds: Option<u32>,
    /// Number of times that a robot is put down in each world to localize, and again to drive to
    /// the goal
    #[arg(long, value_name = "N", default_value_t = 1)]
    starts: u32,
    /// Seed of all random numbers: the same seed gives the same result
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Write a line of JSON for each world instead of the table
    #[arg(long)]
    json: bool,
    /// Measure the system's own computing time per time step of learning; plays one world at a time
    #[arg(long)]
    cost: bool,
    /// Write a replay of the world with the worst map: one HTML file that plays in any browser.
    /// It needs a single contestant
    #[arg(long, value_name = "FILE", value_parser = outputs::file(outputs::REPLAYS))]
    replay: Option<Output>,
    /// Overwrite the replay's file even if it is not a replay
    #[arg(long, requires = "replay")]
    force: bool,
    /// Judge what systems say about their own maps, on 100 right and 100 wrong maps; worlds become
    /// harder while most maps are right
    #[arg(long, conflicts_with_all = ["mazes", "maze_files", "json", "cost", "condition", "starts", "replay"])]
    own_verdict: bool,
    /// Merge the files `*.jsonl` of this folder, which `--json` wrote for any number of entrants,
    /// into one page
    #[arg(long, value_name = "DIR", conflicts_with_all = ["mazes", "maze_files", "system", "mapper", "brain", "json", "cost", "replay", "own_verdict"])]
    league: Option<PathBuf>,
    /// File of the league's page, instead of `league.html` in its folder
    #[arg(long, value_name = "FILE", requires = "league", value_parser = outputs::file(&["html", "htm"]))]
    out: Option<Output>,
}

/// What systems do in the arena.
#[derive(Clone, Copy, Debug, Default, PartialEq, clap::ValueEnum)]
enum ArenaTask {
    /// Learn, be put down, find out where that is, and come to the goal
    #[default]
    Learn,
    /// Deliver from landmark to landmark, with an empty map in the beginning
    Errands,
}

/// Name for all systems, and for all families.
const ALL: &str = "all";
/// Default number of worlds of each family; the second is the maximum with `--own-verdict`.
const WORLDS: u32 = 2;
const MOST_WORLDS: u32 = 40;

/// Returns the time since the first call.
fn stopwatch() -> Duration {
    static BEGAN: OnceLock<Instant> = OnceLock::new();
    BEGAN.get_or_init(Instant::now).elapsed()
}

/// Result of a contest, for `--json`.
#[derive(Serialize)]
struct Line<'a> {
    system: &'a str,
    robot: &'a str,
    world: &'a str,
    seed: u64,
    abstained: Option<&'a str>,
    /// Why the contestant did not do all that was asked of it, in its own words.
    why: Option<&'a str>,
    right: Option<bool>,
    right_of_visited: Option<bool>,
    /// Verdict of the system on its own map.
    says: Option<&'static str>,
    purity: Option<f64>,
    link_recall: Option<f64>,
    metres_over_corridors: Option<f64>,
    bytes_per_place: Option<f64>,
    /// Computing time per time step, µs. Written only with `--cost`, because it differs in every
    /// run.
    #[serde(skip_serializing_if = "Option::is_none")]
    us_per_step: Option<f64>,
    found: Vec<&'static str>,
    home_over_shortest: Vec<Option<f64>>,
    #[serde(flatten)]
    made: &'a Made,
}

/// How a line of JSON was made: what a league needs to tell entrants apart, and to play them again.
#[derive(Serialize)]
struct Made {
    condition: String,
    version: String,
    command: String,
}

impl Made {
    fn by(app: &App, condition: Condition) -> Self {
        Self {
            condition: slug(&condition.name()),
            version: app.build.commit.clone(),
            command: called::command(),
        }
    }
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    if let Some(folder) = &arguments.league {
        return league::merge(folder, arguments.out.as_deref(), out);
    }
    let robot = match arguments.robot.as_str() {
        "own" => None,
        name => Some(app.robot(name)?),
    };
    let contestants = arguments.contestants(app)?;
    arguments.check_replay(&contestants)?;
    if arguments.own_verdict {
        return verdicts::judge(arguments, &contestants, robot, &arguments.kinds(app)?, out);
    }
    let condition = condition(app, &arguments.condition, arguments.task)?;
    let worlds = arguments.worlds(app)?;
    if arguments.task == ArenaTask::Errands {
        let made = Made::by(app, condition);
        return errands::run(
            arguments,
            &contestants,
            robot,
            (condition, &made),
            &worlds,
            out,
        );
    }
    let jobs: Vec<Job<'_>> = contestants
        .iter()
        .flat_map(|contestant| worlds.iter().map(|world| (*contestant, world)))
        .collect();
    let schooling = Schooling::default();
    let hold = |(contestant, world): Job<'_>, watch: &mut dyn FnMut(&dyn Outing, Moment)| {
        let contest = Contest {
            condition,
            stopwatch: arguments.cost.then_some(stopwatch),
            ..world.contest(contestant, robot)
        };
        world.hold(&contest, &schooling, watch)
    };
    let play = |job: &Job<'_>| hold(*job, &mut |_, _| {});
    let held: Result<Vec<ContestRecord>, ContestError> = match arguments.cost {
        true => jobs.iter().map(play).collect(),
        false => jobs.par_iter().map(play).collect(),
    };
    let held = held?;
    if let Some(path) = &arguments.replay {
        let worst = worst(&held).and_then(|worst| jobs.get(worst));
        let worst = worst.ok_or_else(|| Failure::Failed(anyhow!("there is no map to replay")))?;
        let title = format!("{} in {}", worst.0.title(), worst.1.name);
        let replay = filmed(&title, |watch| hold(*worst, watch))?;
        if let Some(replay) = replay {
            let replay = replay.fact("seed", worst.1.seed.to_string());
            replay_file::write(path, replay, Overwrite::if_forced(arguments.force))?;
        }
    }
    if arguments.json {
        let made = Made::by(app, condition);
        for ((contestant, world), record) in jobs.iter().zip(&held) {
            let line = line(*contestant, robot, world, record, &made);
            writeln!(out, "{}", serde_json::to_string(&line)?)?;
        }
        return Ok(());
    }
    let tell = |out: &mut dyn Write| match &arguments.replay {
        Some(path) => replay_file::tell(path, out),
        None => Ok(()),
    };
    let of_each = held.chunks(worlds.len().max(1));
    let rows: Vec<TableRow<'_>> = contestants.iter().copied().zip(of_each).collect();
    if arguments.cost {
        costs(&rows, out)?;
        return tell(out);
    }
    table(&rows, robot, out)?;
    why_not(&rows, &worlds, out)?;
    tell(out)
}

/// Returns the number of the contest with the worst map, the first of several; `None` if nobody
/// learned one.
fn worst(held: &[ContestRecord]) -> Option<usize> {
    let maps = held.iter().map(ContestRecord::goodness).enumerate();
    let maps = maps.filter_map(|(number, goodness)| Some((number, goodness?)));
    let worst = maps.min_by(|a, b| a.1.total_cmp(&b.1));
    worst.map(|(number, _)| number)
}

/// A contestant, and a world for it.
type Job<'a> = (Contestant, &'a DrawnWorld);

/// A contestant, and its records in all worlds.
type TableRow<'a> = (Contestant, &'a [ContestRecord]);

/// Returns a value as a cell of a table has it: a dash if there is none.
fn or_dash(value: Option<impl ToString>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| value.to_string())
}

/// Writes the cost of learning for each system, as means over the worlds in which it drove.
fn costs(rows: &[TableRow<'_>], out: &mut dyn Write) -> io::Result<()> {
    let width = title_width(rows);
    writeln!(
        out,
        "{:width$} {:>6} {:>12} {:>10} {:>13}",
        "system", "worlds", "time steps", "µs a step", "bytes a place"
    )?;
    for (contestant, records) in rows {
        let learned: Vec<&LearnRecord> = records.iter().flat_map(|r| &r.learned).collect();
        let steps: u64 = learned.iter().map(|one| u64::from(one.steps)).sum();
        let thinking: Duration = learned.iter().filter_map(|one| one.thinking).sum();
        let bytes: usize = learned.iter().filter_map(|one| one.map_bytes).sum();
        let places: usize = learned.iter().map(|one| one.places).sum();
        let ratio =
            |part: f64, whole: f64| or_dash((whole > 0.0).then(|| format!("{:.1}", part / whole)));
        writeln!(
            out,
            "{:width$} {:>6} {:>12} {:>10} {:>13}",
            contestant.title(),
            learned.len(),
            steps,
            ratio(1e6 * thinking.as_secs_f64(), steps as f64),
            ratio(bytes as f64, places as f64),
        )?;
    }
    Ok(())
}

fn contestants(app: &App, name: &str) -> Result<Vec<Contestant>> {
    if name == ALL {
        return Ok(app.registry().contestants().collect());
    }
    let competes = |system: &dyn SystemEntry| system.learns() || system.baseline().is_some();
    Ok(vec![app.system(name, competes)?])
}

/// Returns the width of the column of names.
fn title_width(rows: &[TableRow<'_>]) -> usize {
    let widths = rows.iter().map(|(one, _)| one.title().chars().count());
    widths.max().unwrap_or(0).max(18)
}

fn condition(app: &App, name: &str, task: ArenaTask) -> Result<Condition> {
    let mut known = app.registry().conditions.clone();
    if task == ArenaTask::Errands {
        known.push(Condition::MovingDoors);
    }
    let mut conditions = known.iter();
    let named = conditions.find(|condition| slug(&condition.name()) == slug(name));
    named.copied().ok_or_else(|| {
        let names: Vec<String> = known.iter().map(|one| slug(&one.name())).collect();
        let fault = format!("there is no condition {name} in the arena");
        unknown(&fault, name, names.iter().map(String::as_str))
    })
}

impl Arguments {
    /// Returns the programs, then the systems of `--system`.
    fn contestants(&self, app: &App) -> Result<Vec<Contestant>> {
        let mut all = self.programs.contestants()?;
        for name in &self.system {
            all.extend(contestants(app, name)?);
        }
        if all.is_empty() {
            all = contestants(app, ALL)?;
        }
        Ok(all)
    }

    /// Refuses a replay of several contestants, or in place of another file.
    fn check_replay(&self, contestants: &[Contestant]) -> Result {
        match &self.replay {
            Some(path) if contestants.len() == 1 => {
                replay_file::check(path, Overwrite::if_forced(self.force))
            }
            Some(_) => Err(Failure::BadInput(anyhow!(
                "--replay needs a single contestant: give one of --system, --mapper and --brain"
            ))),
            None => Ok(()),
        }
    }

    /// Returns the worlds of files, then those of `--family`.
    fn kinds(&self, app: &App) -> Result<Vec<ArenaWorld>> {
        let paths = [self.mazes.as_slice(), &self.maze_files].concat();
        let mut kinds = match paths.is_empty() {
            true => Vec::new(),
            false => of_others(&paths)?,
        };
        for name in &self.family {
            match name.as_str() {
                ALL => kinds.extend(ArenaWorld::families()),
                name => kinds.push(ArenaWorld::Family(*app.family(name)?)),
            }
        }
        if kinds.is_empty() {
            kinds = ArenaWorld::families();
        }
        Ok(kinds)
    }

    fn worlds(&self, app: &App) -> Result<Vec<DrawnWorld>> {
        let kinds = self.kinds(app)?;
        let is_changed = slug(&self.condition) != slug(&Condition::AsMade.name());
        if is_changed
            && kinds
                .iter()
                .any(|kind| matches!(kind, ArenaWorld::Floor { .. }))
        {
            return Err(Failure::BadInput(anyhow!(
                "--condition {} changes mazes of cells: leave it out for worlds of free walls",
                self.condition
            )));
        }
        let mut worlds = Vec::new();
        for kind in &kinds {
            let count = match kind {
                ArenaWorld::Family(_) => self.worlds.unwrap_or(WORLDS),
                ArenaWorld::File { .. } | ArenaWorld::Floor { .. } => 1,
            };
            for number in 0..count {
                let drawn = match (kind.draw(self.seed, number).unboxed(), kind) {
                    (Ok(drawn), _) => drawn,
                    // The other worlds stand.
                    (Err(error), ArenaWorld::Floor { .. }) if kinds.len() > 1 => {
                        note(&told(&error));
                        continue;
                    }
                    (Err(error), _) => return Err(Failure::BadInput(error)),
                };
                let starts = self.starts;
                worlds.push(DrawnWorld { starts, ..drawn });
            }
        }
        match worlds.is_empty() {
            true => Err(Failure::BadInput(anyhow!(
                "no world is left: give the file of one into which a robot fits"
            ))),
            false => Ok(worlds),
        }
    }
}

/// Returns the worlds of files, and tells which files have no world.
fn of_others(paths: &[PathBuf]) -> Result<Vec<ArenaWorld>> {
    let others = ArenaWorld::of_others(paths).unboxed().or_bad_input()?;
    for refused in others.refused {
        note(&told(&Error::from_boxed(refused)));
    }
    for world in &others.worlds {
        if let ArenaWorld::File {
            name,
            width: Some(width),
            ..
        } = world
        {
            note(&format!(
                "corridor_width = {width} of {name} is ignored: each robot gets corridors of its own width"
            ));
        }
    }
    if others.worlds.is_empty() {
        return Err(Failure::BadInput(anyhow!(
            "there is no maze and no world in what was named: give their files"
        )));
    }
    Ok(others.worlds)
}

/// Returns the robot that carries a contestant. Baselines drive the laser Pioneer.
fn carrier(contestant: Contestant, robot: Option<RobotEntry>) -> RobotEntry {
    let own = || Registry::current().robot(contestant.facts().own_robot);
    let robot = match contestant.baseline() {
        Some(_) => None,
        None => robot.or_else(own),
    };
    robot.unwrap_or(RobotEntry::LASER_PIONEER)
}

fn line<'a>(
    contestant: Contestant,
    robot: Option<RobotEntry>,
    world: &'a DrawnWorld,
    record: &'a ContestRecord,
    made: &'a Made,
) -> Line<'a> {
    let learned = record.learned.as_ref();
    let judged = learned.map(|learned| learned.judgement);
    let found = record.found.iter().map(|found| match found.outcome {
        LocateOutcome::Right => "right",
        LocateOutcome::Wrong => "wrong",
        LocateOutcome::Abstained { .. } => "abstained",
    });
    Line {
        system: contestant.name(),
        robot: carrier(contestant, robot).name,
        world: &world.name,
        seed: world.seed,
        abstained: record.abstained.as_deref(),
        why: record.complaint(),
        right: judged.map(|judged| judged.is_right),
        right_of_visited: judged.map(|judged| judged.is_right_of_visited),
        says: learned.map(|learned| match learned.claim {
            Claim::Right => "right",
            Claim::Wrong => "wrong",
            Claim::Undecided => "undecided",
        }),
        purity: judged.and_then(|judged| judged.purity),
        link_recall: judged.map(|judged| judged.link_recall),
        bytes_per_place: learned.and_then(LearnRecord::bytes_per_place),
        us_per_step: learned.and_then(LearnRecord::us_per_step),
        metres_over_corridors: learned.map(|learned| learned.driven),
        found: found.collect(),
        home_over_shortest: record.homes.iter().map(|home| home.over_shortest).collect(),
        made,
    }
}

/// Writes the table with one row for each system.
fn table(rows: &[TableRow<'_>], robot: Option<RobotEntry>, out: &mut dyn Write) -> io::Result<()> {
    let width = title_width(rows);
    writeln!(
        out,
        "{:width$} {:13} {:>6} {:>9} {:>5} {:>7} {:>6} {:>7} {:>13}",
        "system",
        "robot",
        "worlds",
        "abstained",
        "right",
        "visited",
        "recall",
        "located",
        "came to goal"
    )?;
    for (contestant, records) in rows {
        let judged: Vec<_> = records.iter().flat_map(|r| &r.learned).collect();
        let judged = || judged.iter().map(|learned| learned.judgement);
        let recall: f64 = judged().map(|judged| judged.link_recall).sum();
        let found = || records.iter().flat_map(|r| &r.found);
        let located = found().filter(|found| found.outcome == LocateOutcome::Right);
        let homes = || records.iter().flat_map(|r| &r.homes);
        let came = homes().filter(|home| home.over_shortest.is_some());
        let learns = contestant.learns();
        let has_maps = judged().next().is_some();
        writeln!(
            out,
            "{:width$} {:13} {:>6} {:>9} {:>5} {:>7} {:>6} {:>7} {:>13}",
            contestant.title(),
            carrier(*contestant, robot).title,
            records.len(),
            records.iter().filter(|r| r.abstained.is_some()).count(),
            or_dash(has_maps.then(|| judged().filter(|judged| judged.is_right).count())),
            or_dash(has_maps.then(|| judged().filter(|judged| judged.is_right_of_visited).count())),
            or_dash(has_maps.then(|| format!("{:.2}", recall / records.len() as f64))),
            or_dash((learns || found().next().is_some()).then(|| format!(
                "{}/{}",
                located.count(),
                found().count()
            ))),
            or_dash((homes().count() > 0).then(|| format!("{}/{}", came.count(), homes().count()))),
        )?;
    }
    Ok(())
}

/// Writes why each system abstained, and why it doubts its map or gave up, a line per system and
/// reason.
fn why_not(rows: &[TableRow<'_>], worlds: &[DrawnWorld], out: &mut dyn Write) -> io::Result<()> {
    for (contestant, records) in rows {
        let mut abstained = worlds.iter().zip(*records);
        let first = abstained.find_map(|(world, r)| Some((world, r.abstained.as_ref()?)));
        if let Some((world, why)) = first {
            writeln!(
                out,
                "{} abstained, first in {}: {why}",
                contestant.title(),
                world.name
            )?;
        }
        let mut learned = worlds.iter().zip(*records);
        let first = learned.find_map(|(world, r)| Some((world, r.complaint_of_map()?)));
        if let Some((world, why)) = first {
            writeln!(
                out,
                "{} gave up or doubts its map, first in {}: {why}",
                contestant.title(),
                world.name
            )?;
        }
    }
    Ok(())
}
