//! Every system in every kind of world, compared with the same truth.
//!
//! The tables show what each system learns, and whether its own verdict on that is right. They also
//! show whether it localizes after it was put down, and whether it reaches the goal.

mod errands;
mod figures;
mod others;
mod records;
mod rows;
mod verdicts;
mod worlds;

use tolman_arena::Outing;
use tolman_arena::contest::{Condition, Contest, ContestError, Moment};
use tolman_arena::registry::{RobotEntry, Schooling};
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Easel, Entry, Experiment, Fields, Job, Options, Procedure, Record, Run, Table,
};
use tolman_replay::Replay;

use self::others::Others;
pub(crate) use self::records::LearnRun;
use self::records::{ConditionRun, HomeRun, LocateRun};
use self::rows::{ALL, Held, RowName};
pub(crate) use self::worlds::{drawn, drawn_sized};
use crate::rows::row_of;
use tolman_film::Film;

pub use verdicts::{PoolJudgement, PoolRound, RungJudgement, VerdictPool};
pub use worlds::{ArenaWorld, DrawnWorld, OthersWorlds, world_of_map};

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "arena",
    title: "Arena: every system in every kind of world",
    source: "",
    runs: 3,
    quick_runs: 1,
    main: &[],
    tour: &[],
    open,
};

/// Task of a contestant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ArenaTask {
    Learn,
    Home,
    Locate,
}

/// The laser Pioneer, on which all that can are compared.
const PIONEER: Option<RobotEntry> = Some(RobotEntry::LASER_PIONEER);

/// The tables: name, task, and the robot if it is not the system's own.
const TABLES: [(&str, ArenaTask, Option<RobotEntry>); 6] = [
    ("learn", ArenaTask::Learn, None),
    ("home", ArenaTask::Home, None),
    ("locate", ArenaTask::Locate, None),
    ("learn, Pioneer", ArenaTask::Learn, PIONEER),
    ("home, Pioneer", ArenaTask::Home, PIONEER),
    ("locate, Pioneer", ArenaTask::Locate, PIONEER),
];

/// Name of the table of cost by size.
const SIZE_TABLE: &str = "size";

/// Name of the table of conditions.
const CONDITIONS_TABLE: &str = "conditions";

/// The prepared experiment.
#[derive(Debug)]
struct Arena {
    seed: u64,
    worlds: Vec<ArenaWorld>,
    others: Others,
    schooling: Schooling,
    /// Contests that were already held; several rows use each.
    held: Held,
}

/// Returns the experiment with its tables.
///
/// # Errors
/// If a maze cannot be read.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let worlds = match options.mazes.is_empty() {
        true => ArenaWorld::families(),
        false => ArenaWorld::of_files(&options.mazes)?,
    };
    let mut tables: Vec<Table> = TABLES
        .into_iter()
        .map(|(name, task, robot)| {
            let table = match task {
                ArenaTask::Learn => records::learn(name),
                ArenaTask::Home => records::home(name),
                ArenaTask::Locate => records::locate(name),
            };
            let table = table.rows(rows::of(task, robot, &worlds, options));
            table.note(records::note(task, robot))
        })
        .collect();
    tables.push(records::sizes(SIZE_TABLE).rows(rows::of_sizes(options)));
    tables.push(records::conditions(CONDITIONS_TABLE).rows(rows::of_conditions(options)));
    tables.push(errands::table(&worlds, options));
    let others = Others::found(options)?;
    tables.push(others::table(&others, options));
    let mut config = toml::Table::new();
    let named = worlds.iter().map(ArenaWorld::config);
    config.insert("worlds".to_owned(), named.collect::<Vec<_>>().into());
    let arena = Arena {
        seed: options.seed,
        worlds,
        others,
        schooling: Schooling::default(),
        held: Held::default(),
    };
    Ok(Experiment::new(ENTRY, tables, config, arena))
}

impl Procedure for Arena {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        if job.table == errands::TABLE {
            return self.errands(job.row, job.run);
        }
        let row = RowName::read(job.row).ok_or_else(|| no_row(job))?;
        match job.table {
            SIZE_TABLE => return self.sized(&row, job.run),
            CONDITIONS_TABLE => return self.under_condition(&row, job.run),
            others::TABLE => {
                let record = self.among_others(&row, job.run)?;
                return Ok(ConditionRun::of(&record).fields()?);
            }
            _ => {}
        }
        let (_, task, robot) = row_of(job, TABLES, |(name, ..)| *name == job.table)?;
        let record = self.held(&row, robot, job.run)?;
        Ok(match task {
            ArenaTask::Learn => LearnRun::of(&record).fields()?,
            ArenaTask::Home => HomeRun::of(&record).fields()?,
            ArenaTask::Locate => LocateRun::of(&record).fields()?,
        })
    }

    fn shares(&self, job: &Job<'_>) -> Option<String> {
        let mut tables = TABLES.into_iter();
        let (_, _, robot) = tables.find(|(name, ..)| *name == job.table)?;
        let row = RowName::read(job.row)?;
        let (robot, contestant, world, number) = self.contest_of(&row, robot, job.run).ok()?;
        Some(format!(
            "{contestant}, {robot}, in drawing {number} of world {world}"
        ))
    }

    fn figures(&self, runs: &[Run], _easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(&self.worlds, runs)
    }

    fn shown(&self, runs: &[Run]) -> Result<Option<Vec<Run>>, BoxError> {
        Ok(Some(records::worst(runs)?))
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if job.table == errands::TABLE {
            return Ok(None);
        }
        let row = RowName::read(job.row).ok_or_else(|| no_row(job))?;
        let robot = TABLES.into_iter().find(|(name, ..)| *name == job.table);
        let robot = robot.and_then(|(_, _, robot)| robot);
        let (world, condition) = match job.table {
            SIZE_TABLE => (
                rows::sized_world(self.seed, &row, job.run)?,
                Condition::AsMade,
            ),
            CONDITIONS_TABLE => (self.world_of_condition(job.run)?, rows::condition_of(&row)?),
            others::TABLE => (self.world_of_others(&row, job.run)?, Condition::AsMade),
            _ => (self.world(&row, job.run)?, Condition::AsMade),
        };
        let title = format!("{}, run {}", job.row, job.run);
        let contest = Contest {
            condition,
            ..world.contest(row.contestant, robot)
        };
        let replay = filmed(&title, |watch| world.hold(&contest, &self.schooling, watch))?;
        Ok(replay.map(|replay| replay.fact("seed", world.seed.to_string())))
    }
}

/// Returns a replay of a contest, which `play` holds before a viewer; `None` if the contestant
/// abstains or is a baseline.
///
/// # Errors
/// That of `play`.
pub fn filmed<T>(
    title: &str,
    play: impl FnOnce(&mut dyn FnMut(&dyn Outing, Moment)) -> Result<T, ContestError>,
) -> Result<Option<Replay>, ContestError> {
    let mut film: Option<Film> = None;
    let mut replay = None;
    play(&mut |outing, moment| match (moment, &mut film) {
        (Moment::Over, film) => {
            let film = film.take();
            replay = film.map(|film| film.replay(outing, title.to_owned()));
        }
        (Moment::PutDown, Some(film)) => film.lifted(outing),
        (_, Some(film)) => film.see(outing),
        (_, none) => *none = Some(Film::new(outing)),
    })?;
    Ok(replay)
}

fn no_row(job: &Job<'_>) -> BoxError {
    format!("there is no row {:?} of {}", job.row, job.table).into()
}

/// Returns kind and number of the world for a run of the row "all", with `worlds` kinds. Run n has
/// kind n modulo their number.
const fn of_all(run: u32, worlds: u32) -> (u32, u32) {
    (run % worlds, run / worlds)
}

impl Arena {
    /// Returns the world of a run.
    fn world(&self, row: &RowName<'_>, run: u32) -> Result<DrawnWorld, BoxError> {
        let (world, number) = self.place(row, run)?;
        self.worlds[world].draw(self.seed, number)
    }

    /// Returns the index of a run's world among the experiment's, and the number of its drawing.
    fn place(&self, row: &RowName<'_>, run: u32) -> Result<(usize, u32), BoxError> {
        if row.world == ALL {
            let (world, number) = of_all(run, self.worlds.len() as u32);
            return Ok((world as usize, number));
        }
        let mut worlds = self.worlds.iter();
        let world = worlds.position(|world| world.name() == row.world);
        Ok((world.ok_or("there is no such world")?, run))
    }
}
