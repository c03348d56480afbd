//! The better system in worlds whose walls stand anywhere.

use core::slice;

use crate::kept::Kept;
use crate::metrics::UsualMetrics as _;
use tolman_arena::Outing;
use tolman_arena::contest::{Claim, Condition, TrueVisits};
use tolman_arena::course::Terrain;
use tolman_arena::free_family::FreeFamily;
use tolman_arena::registry::{MapText, Registry, Schooling, Settings, Setup, Start, SystemEntry};
use tolman_arena::run::{self, TaskEnd};
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record, run_seed};
use tolman_geom::{Point, path_length};
use tolman_robot::{Goal, Landmark, Task};

record! {
    /// A free world that was learned, and drives in it.
    pub(super) struct FreeRun {
        /// Whether the map is right: its places lie where they truly are, and it covers the floor.
        usable: bool => higher("usable"),
        /// Whether the system says that its map is right.
        claimed_right: bool => neither("claimed right"),
        /// Whether the system says so of a map that is not.
        wrongly_claimed: bool => lower("wrong, claimed right"),
        /// Share of the drives from random places that reached the goal.
        arrived_percent: f64 => higher("arrived").percent().decimals(1),
        /// Mean way of those drives over the shortest; missing without one.
        metres_over_shortest: Option<f64> => lower("way / shortest").at_least(0).decimals(2),
    }
}

/// Name of the table.
pub(super) const FREE_WORLDS: &str = "free worlds";

/// Name of the row of all families.
const ALL: &str = "all";

/// Number of drives in each world.
const DRIVES: u32 = 2;

/// The worlds that were learned.
#[derive(Debug)]
pub(super) struct FreeWorlds {
    seed: u64,
    runs: u32,
    played: Kept<(usize, u32), FreeRun>,
}

impl FreeWorlds {
    /// Returns the experiment with `runs` worlds in all, at least one of each family.
    pub(super) fn new(runs: u32, seed: u64) -> Self {
        let families = FreeFamily::ALL.len() as u32;
        Self {
            seed,
            runs: (runs / families).max(1),
            played: Kept::default(),
        }
    }

    pub(super) fn table(&self) -> Table {
        let families = FreeFamily::ALL.iter().map(|family| family.name);
        let rows = families.map(|name| Row::new(name).runs(self.runs));
        let all = Row::new(ALL).runs(self.runs * FreeFamily::ALL.len() as u32);
        Table::of::<FreeRun>(FREE_WORLDS, "The better system where walls stand anywhere")
            .metrics([FreeRun::usable, FreeRun::claimed_right, FreeRun::wrongly_claimed])
            .metric(Metric::mean(FreeRun::arrived_percent))
            .metric(Metric::mean(FreeRun::metres_over_shortest))
            .rows(rows.chain([all]))
            .note(format!(
                "A map is usable if its places lie at most 0.2 m off (root mean square) and 95 % of \
                 the floor is within 1 m of it. {DRIVES} drives by each map, from random places."
            ))
    }

    /// Plays a run: a world of a family.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let families = FreeFamily::ALL.len();
        let of_row = FreeFamily::ALL.iter().position(|one| one.name == job.row);
        let (family, number) = match of_row {
            Some(family) => (family, job.run),
            None => (job.run as usize % families, job.run / families as u32),
        };
        let played = self.played.get((family, number), || {
            let family = &FreeFamily::ALL[family];
            played(family, run_seed(self.seed, family.name, number))
        })?;
        Ok(played.fields()?)
    }
}

/// Learns a world of a family and drives in it.
fn played(family: &FreeFamily, seed: u64) -> Result<FreeRun, BoxError> {
    let system = Registry::current().system("mslst-better");
    let system = system.ok_or("there is no system mslst-better")?;
    let robot = Registry::current().robot(system.facts().own_robot);
    let terrain = Terrain::Free(family.world(seed)?);
    let schooling = Schooling::default();
    let setup = Setup {
        world: family.name,
        terrain: &terrain,
        seed,
        start: None,
        steps: None,
        robot: robot.ok_or("the robot of mslst-better is missing")?,
        from: None,
        settings: Settings::default(),
        condition: Condition::AsMade,
        doors: &[],
        schooling: &schooling,
    };
    let mut outing = system.learner(&setup)?;
    let mut been = TrueVisits::default();
    let ended = run::until_done(&mut *outing, |outing| {
        let before = here(outing);
        let standing = outing.act(Task::Explore);
        been.note(outing, before);
        standing
    })?;
    let truth = been.evidence(&*outing, 0);
    let complaint = truth.complaint(&outing.map(), outing.course(), system.facts().places);
    let (usable, claimed_right) = (
        complaint.is_none(),
        Claim::complaint(&ended.end, Task::Explore, &*outing).is_none(),
    );
    let ways = match outing.map_file()? {
        Some(text) => drives(
            system,
            &MapText::read(family.name.to_owned(), text)?,
            &setup,
        )?,
        None => Vec::new(),
    };
    let arrived: Vec<f64> = ways.iter().copied().flatten().collect();
    Ok(FreeRun {
        usable,
        claimed_right,
        wrongly_claimed: claimed_right && !usable,
        arrived_percent: 100.0 * arrived.len() as f64 / f64::from(DRIVES),
        metres_over_shortest: (!arrived.is_empty())
            .then(|| arrived.iter().sum::<f64>() / arrived.len() as f64),
    })
}

/// Drives by a map to the goal from random places. Returns the way of each drive over the shortest;
/// `None` if it did not arrive.
fn drives(
    system: &dyn SystemEntry,
    map: &MapText,
    setup: &Setup<'_>,
) -> Result<Vec<Option<f64>>, BoxError> {
    let drive = |number| {
        let setup = Setup {
            start: Some(Start::Random),
            seed: run_seed(setup.seed, "drive", number),
            ..setup.clone()
        };
        let mut outing = system.driver(slice::from_ref(map), &setup)?;
        let radius = outing.robot().inner_radius();
        let shortest = outing.course().shortest_drive(here(&*outing), radius);
        let reach = Task::Reach(Goal::Landmark(Landmark::Goal));
        let ended = run::until_done(&mut *outing, |outing| outing.act(reach))?;
        let has_arrived = ended.end == TaskEnd::Done && outing.landmark() == Some(Landmark::Goal);
        let way = shortest.filter(|metres| *metres > 0.0);
        let over = way.map_or(1.0, |metres| path_length(outing.path()) / metres);
        Ok(has_arrived.then_some(over))
    };
    (0..DRIVES).map(drive).collect()
}

fn here(outing: &dyn Outing) -> Point {
    let last = outing.path().last();
    last.map_or_else(Point::origin, |pose| pose.position)
}
