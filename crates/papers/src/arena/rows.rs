use alloc::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::cast::Agent;
use tolman_arena::contest::{Condition, Contest, ContestRecord};
use tolman_arena::registry::{Registry, RobotEntry, SystemEntry};
use tolman_experiment::{BoxError, Fields, Options, Record, Row, run_seed};
use tolman_maze::Braided;

use super::records::{ConditionRun, SizeRun};
use super::worlds::{ArenaWorld, DrawnWorld};
use super::{Arena, ArenaTask, ENTRY, SIZE_TABLE, of_all};
use crate::kept::Kept;

/// World in the names of rows that combine all worlds.
pub(super) const ALL: &str = "all";

/// Default number of worlds of each kind for a system that takes seconds in each.
const SLOW_RUNS: u32 = 1;

/// Default for rows that are left out because they take long.
const NO_RUNS: u32 = 0;

/// Separator of system and world in a row's name.
pub(super) const BETWEEN: &str = " · ";

/// The parts of a row's name.
pub(super) struct RowName<'a> {
    pub(super) contestant: &'static dyn SystemEntry,
    pub(super) world: &'a str,
}

impl<'a> RowName<'a> {
    pub(super) fn read(row: &'a str) -> Option<Self> {
        let (system, world) = row.split_once(BETWEEN)?;
        let contestant = Registry::current().system(system)?;
        Some(Self { contestant, world })
    }
}

pub(super) fn row_name(contestant: &dyn SystemEntry, world: &str) -> String {
    format!("{}{BETWEEN}{world}", contestant.title())
}

/// Returns the contestants that have rows in a table. Baselines learn no map, and only one of them
/// localizes.
pub(super) fn contestants(task: ArenaTask) -> impl Iterator<Item = &'static dyn SystemEntry> {
    let all = Registry::current().contestants();
    all.filter(move |contestant| match contestant.baseline() {
        Some(Agent::UnlocalizedOracle) => task != ArenaTask::Learn,
        Some(_) => task == ArenaTask::Home,
        None => true,
    })
}

/// Returns the rows of a table: each contestant in each world, and in all worlds.
pub(super) fn of(
    task: ArenaTask,
    robot: Option<RobotEntry>,
    worlds: &[ArenaWorld],
    options: &Options,
) -> Vec<Row> {
    let slow = match robot {
        None => SLOW_RUNS,
        Some(_) => NO_RUNS,
    };
    let mut rows = Vec::new();
    for contestant in contestants(task) {
        let runs = runs_of(contestant, options, slow);
        let each = worlds.iter();
        rows.extend(each.map(|world| Row::new(row_name(contestant, world.name())).runs(runs)));
        let all = runs.saturating_mul(worlds.len() as u32);
        rows.push(Row::new(row_name(contestant, ALL)).runs(all));
    }
    rows
}

/// Contests that were already held.
pub(super) type Held = Kept<HeldKey, ContestRecord>;

/// Key of a contest: robot, contestant, world and drawing.
pub(super) type HeldKey = (&'static str, &'static str, usize, u32);

impl Arena {
    /// Returns the contest of a row's run.
    pub(super) fn contest_of(
        &self,
        row: &RowName<'_>,
        robot: Option<RobotEntry>,
        run: u32,
    ) -> Result<HeldKey, BoxError> {
        let (world, number) = self.place(row, run)?;
        // The baselines drive the laser Pioneer in all tables.
        let robot = match (row.contestant.baseline(), robot) {
            (None, None) => row.contestant.facts().own_robot,
            (None, Some(robot)) => robot.name,
            (Some(_), _) => RobotEntry::LASER_PIONEER.name,
        };
        Ok((robot, row.contestant.title(), world, number))
    }

    /// Returns the record of a row's contest. Each contest is held only once.
    pub(super) fn held(
        &self,
        row: &RowName<'_>,
        robot: Option<RobotEntry>,
        run: u32,
    ) -> Result<Arc<ContestRecord>, BoxError> {
        let key = self.contest_of(row, robot, run)?;
        let (_, _, world, number) = key;
        self.held.get(key, || {
            let drawn = self.worlds[world].draw(self.seed, number)?;
            let contest = drawn.contest(row.contestant, robot);
            Ok(contest.play(&self.schooling, |_, _| {})?)
        })
    }

    /// Plays a run of the table of conditions, in a small world. The kinds of worlds take turns.
    pub(super) fn under_condition(&self, row: &RowName<'_>, run: u32) -> Result<Fields, BoxError> {
        let drawn = self.world_of_condition(run)?;
        let contest = Contest {
            condition: condition_of(row)?,
            ..drawn.contest(row.contestant, None)
        };
        let record = contest.play(&self.schooling, |_, _| {})?;
        Ok(ConditionRun::of(&record).fields()?)
    }

    /// Returns the world of run `run` of each condition.
    pub(super) fn world_of_condition(&self, run: u32) -> Result<DrawnWorld, BoxError> {
        let (world, number) = of_all(run, self.worlds.len() as u32);
        // Drawings with even numbers are small.
        self.worlds[world as usize].draw(self.seed, 2 * number)
    }

    /// Plays a run of the table of sizes.
    pub(super) fn sized(&self, row: &RowName<'_>, run: u32) -> Result<Fields, BoxError> {
        let drawn = sized_world(self.seed, row, run)?;
        let contest = drawn.contest(row.contestant, None);
        let record = contest.play(&self.schooling, |_, _| {})?;
        Ok(SizeRun::of(&record, &drawn.maze).fields()?)
    }
}

/// Returns the number of worlds of each kind for a contestant: the caller's, or else the
/// experiment's own. It is `slow` for a contestant that takes seconds in each.
pub(super) fn runs_of(contestant: &dyn SystemEntry, options: &Options, slow: u32) -> u32 {
    match contestant.name() {
        "gng-slam-better" => options.runs_else(slow, slow),
        _ => options.runs_of(&ENTRY),
    }
}

/// Returns the rows of the table of conditions: each system under each condition.
pub(super) fn of_conditions(options: &Options) -> Vec<Row> {
    let mut rows = Vec::new();
    for contestant in contestants(ArenaTask::Learn) {
        for condition in Condition::ALL {
            let row = Row::new(row_name(contestant, &condition.name()));
            rows.push(row.runs(runs_of(contestant, options, NO_RUNS)));
        }
    }
    rows
}

/// Systems in the table of sizes, and the sides of its worlds, cells.
const SIZED: [&str; 4] = ["mslst", "cpm-better", "diktiometry-better", "micromouse"];
pub(super) const SIZES: [u16; 6] = [5, 8, 12, 16, 24, 40];

/// Returns the systems in the table of sizes.
pub(super) fn sized() -> impl Iterator<Item = &'static dyn SystemEntry> {
    let names = SIZED.into_iter();
    names.filter_map(|name| Registry::current().system(name))
}

/// Maximum side if the table is not asked for by name. Larger worlds take minutes each.
const QUICK_SIDE: u16 = 16;

/// Returns the rows of the table of sizes.
pub(super) fn of_sizes(options: &Options) -> Vec<Row> {
    let is_named = options.tables.iter().any(|name| name == SIZE_TABLE);
    let mut rows = Vec::new();
    for contestant in sized() {
        for side in SIZES {
            let is_filled = is_named || side <= QUICK_SIDE;
            let runs = if is_filled {
                options.runs_of(&ENTRY)
            } else {
                NO_RUNS
            };
            let row = Row::new(row_name(contestant, &size_name(side)));
            rows.push(row.runs(runs));
        }
    }
    rows
}

/// Returns the condition that a row names.
pub(super) fn condition_of(row: &RowName<'_>) -> Result<Condition, BoxError> {
    Condition::named(row.world).ok_or_else(|| "there is no such condition".into())
}

pub(super) fn size_name(side: u16) -> String {
    format!("{side} × {side}")
}

/// Returns a braided world of the size that a row names.
pub(super) fn sized_world(
    master_seed: u64,
    row: &RowName<'_>,
    run: u32,
) -> Result<DrawnWorld, BoxError> {
    let side = SIZES.into_iter().find(|side| size_name(*side) == row.world);
    let side = side.ok_or("there is no such size")?;
    let seed = run_seed(master_seed, row.world, run);
    let braided = Braided {
        width: side,
        height: side,
        share: 1.0,
    };
    Ok(DrawnWorld {
        name: format!("{} {run}", row.world),
        maze: braided.generate_corridors(&mut ChaCha8Rng::seed_from_u64(seed))?,
        floor: None,
        seed,
        starts: 1,
    })
}
