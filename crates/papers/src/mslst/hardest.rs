//! Four worlds that look alike: the hardest for the better system among those searched.

use alloc::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;
use tolman_geom::Point;

use super::driven::{DrivenRun, Driver, shared_out};
use super::entrant::{Entrant, LearnerConfig};
use super::figures::WIDTH;
use crate::arena::drawn;
use crate::rows::row_of;
use crate::venue::{Venue, World};
use tolman_arena::episode::Episode;
use tolman_arena::family::FamilySize;
use tolman_arena::mslst::learn_better;
use tolman_arena::pioneer;
use tolman_draw::{Figure, Series};
use tolman_experiment::{BoxError, Easel, Fields, Job, Record, Row, Run, Table};

/// Name of the table.
pub(super) const HARDEST: &str = "hardest";

/// The worlds, as family and seed; all have middle size.
const WORLDS: [(&str, u64); 4] = [
    ("wings", 501),
    ("wings", 503),
    ("blocks", 504),
    ("ladder", 501),
];

/// Maximum number of maps of each world.
const MOST_MAPS: u32 = 50;

/// Multiple of the Unlocalized oracle's time from which an episode is drawn as a detour.
const DETOUR: u32 = 2;

/// The worlds, and the numbers of maps and starts in each.
#[derive(Debug)]
pub(super) struct Hardest {
    maps: u32,
    starts: u32,
    worlds: Vec<Venue>,
}

/// Configuration of the runs.
#[derive(Serialize)]
pub(super) struct HardestConfig<'a> {
    starts: u32,
    better: Option<LearnerConfig>,
    worlds: BTreeMap<&'a str, World>,
}

impl Hardest {
    /// Returns the experiment with `runs` starts per world.
    pub(super) fn new(runs: u32, limit: Option<u32>) -> Result<Self, BoxError> {
        let (maps, starts) = shared_out(runs, MOST_MAPS);
        let worlds = WORLDS.iter().map(|(family, seed)| {
            let venue = world(family, *seed)?;
            Ok(venue.limited(limit))
        });
        Ok(Self {
            maps,
            starts,
            worlds: worlds.collect::<Result<_, BoxError>>()?,
        })
    }

    pub(super) fn config(&self) -> HardestConfig<'_> {
        let worlds = self.worlds.iter();
        HardestConfig {
            starts: self.starts,
            better: Entrant::Better.config(pioneer::CORRIDOR_WIDTH),
            worlds: worlds
                .map(|world| (&*world.course.name, world.world()))
                .collect(),
        }
    }

    pub(super) fn table(&self) -> Table {
        let rows = self
            .worlds
            .iter()
            .map(|world| Row::new(&world.course.name).runs(self.maps));
        DrivenRun::table(HARDEST, "The worlds that are hardest for the better system")
            .rows(rows)
            .note(format!(
                "A run is a map with {} starts. In wings everything off the spine exists twice. If \
                 the robot takes one wing for the other, it leaves the goal's wing, and goes to and \
                 fro until the spine tells the wings apart. Blocks has many equal crossings, and the \
                 loops of ladder are the same from both ends.",
                self.starts
            ))
    }

    /// Plays a run: learns a world and drives in it.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let world = row_of(job, &self.worlds, |world| world.course.name == job.row)?;
        Ok(self.drive(world, job.seed, |_, _| {})?.fields()?)
    }

    fn drive(
        &self,
        venue: &Venue,
        seed: u64,
        watch: impl FnMut(&Episode, &Episode),
    ) -> Result<DrivenRun, BoxError> {
        let robot = Entrant::Better.robot(venue);
        let learned = learn_better(&venue.course, &robot, 1, seed)?;
        let driver = Driver {
            venue,
            robot: &robot,
            map: &learned.map,
            starts: self.starts,
            seed,
        };
        driver.drive(|_| None, watch)
    }

    /// Returns the ways by the first map of each world that was played.
    pub(super) fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let first = |world: &&Venue| {
            let mut own = runs
                .iter()
                .filter(|run| run.is_of(HARDEST, &world.course.name));
            own.next()
        };
        let played = self
            .worlds
            .iter()
            .filter_map(|world| Some((world, first(&world)?)));
        let drawn = played.map(|(world, run)| {
            easel.draw(&world.course.name, HARDEST, || Ok([self.ways(world, run)?]))
        });
        Ok(drawn.collect::<Result<Vec<_>, _>>()?.concat())
    }

    fn ways(&self, venue: &Venue, run: &Run) -> Result<Figure, BoxError> {
        let mut plan = tolman_arena::drawing::plan_of_course(&venue.course, WIDTH);
        let (mut detours, mut longest) = (0_u32, 0.0_f64);
        self.drive(venue, run.seed, |episode, by_oracle| {
            let times = f64::from(episode.steps) / f64::from(by_oracle.steps.max(1));
            let detour = episode.steps > DETOUR * by_oracle.steps;
            detours += u32::from(detour);
            longest = longest.max(times);
            let way: Vec<Point> = episode.path.iter().map(|pose| pose.position).collect();
            plan.faint_trajectory(&way, Series(u32::from(detour)));
        })?;
        let name = &venue.course.name;
        let starts = self.starts;
        let figure = Figure::new(
            format!("hardest-{}", name.replace(' ', "-")),
            format!("Better in {name}: its ways by map 0"),
            plan.drawing(format!("Plan of {name}: the ways from {starts} starts.")),
        );
        Ok(figure.table(HARDEST).caption(format!(
            "From {detours} of {starts} starts it takes more than twice the Unlocalized oracle's steps: these ways are drawn in the \
             second colour. The worst takes {longest:.1} times as many."
        )))
    }
}

fn world(family: &str, seed: u64) -> Result<Venue, BoxError> {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let maze = drawn(family, FamilySize::Middle, rng)?;
    let name = format!("{family} {seed}");
    Venue::of_maze(HARDEST, &name, maze)
}
