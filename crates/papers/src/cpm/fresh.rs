//! Runs that are each in a new world of their kind. Claims about maps in general need this.

use rand::{Rng, RngExt};
use serde::Serialize;
use tolman_arena::contest::{Claim, Condition, Contest, ContestRecord, Moment};
use tolman_arena::family::FamilySize;
use tolman_arena::registry::{Registry, Schooling};
use tolman_experiment::{BoxError, Fields, Metric, Options, Record, Row, Table, record, require};
use tolman_maze::Maze;
use tolman_robot::Landmark;
use tolman_systems::stream;

use crate::arena::{LearnRun, drawn};

/// Name of the table.
pub(super) const FRESH: &str = "fresh worlds";

/// Default number of worlds of a row.
const WORLDS: u32 = 100;

/// Number of worlds of a row for a first look.
const QUICK: u32 = 2;

/// Stream of a run's seed from which its world is drawn. The contest uses other streams.
const WORLD_STREAM: u64 = 20;

/// Families of the arena that have only corridors.
const CORRIDORS: [&str; 11] = [
    "perfect", "braided", "office", "blocks", "ladder", "eight", "ring", "wings", "comb", "spiral",
    "star",
];

/// Families with openings of 2 × 2 cells.
const OPEN: [&str; 3] = ["rooms", "braided rooms", "pillars"];

/// A row: a kind of world, and a deviation of the robot from its calibration.
#[derive(Clone, Debug, Serialize)]
pub(super) struct FreshRow {
    pub(super) row: String,
    /// Families from which the row's worlds are drawn.
    families: Vec<&'static str>,
    /// Maximum error of each wheel, %.
    wheels: u8,
    /// Name of the system that learns.
    contestant: &'static str,
}

impl FreshRow {
    /// Returns the row of the better system on the robot as it is made.
    fn new(family: &'static str) -> Self {
        Self {
            row: family.to_owned(),
            families: vec![family],
            wheels: 0,
            contestant: "cpm-better",
        }
    }

    /// Returns the row of corridors of any family, with each wheel off by up to `percent`.
    fn wheels(percent: u8) -> Self {
        Self {
            row: format!("wheels {percent} %"),
            families: CORRIDORS.to_vec(),
            wheels: percent,
            ..Self::new("")
        }
    }

    /// Returns the same row with the paper's system.
    fn papers_system(self) -> Self {
        Self {
            row: format!("{} (paper's system)", self.row),
            contestant: "cpm",
            ..self
        }
    }
}

/// Returns all rows.
pub(super) fn rows() -> Vec<FreshRow> {
    let families = CORRIDORS.into_iter().chain(OPEN);
    let papers = ["office", "wings"];
    families
        .map(FreshRow::new)
        .chain([2, 5].map(FreshRow::wheels))
        .chain(papers.map(|family| FreshRow::new(family).papers_system()))
        .collect()
}

record! {
    /// A world drawn for the run and explored completely, and its map.
    #[check(FreshRun::relations)]
    struct FreshRun {
        /// Whether the goal is on the map, and the map is right.
        solved: bool => higher("solved"),
        /// Whether the map matches the truth one to one and has at least 95 % of it. The truth is
        /// junctions, dead ends, start, goal and the ways between them.
        right: bool => higher("map right"),
        /// Whether the goal is on the map.
        goal_found: bool => higher("goal found"),
        /// Whether a place of the map stands for two true places.
        false_merge: Option<bool> => lower("false merges"),
        /// Whether the system's verdict on its own map is right: it is done with a right map, or
        /// gives up with a wrong one.
        verdict_right: Option<bool> => higher("own verdict right"),
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// For a wrong map: whether the system called it right.
        false_right: Option<bool> => lower("wrong maps called right"),
        /// For a right map: whether the system called it wrong.
        false_alarm: Option<bool> => lower("right maps called wrong"),
        /// Share of the visits to its places in which the robot was in the cell that this place
        /// most often was.
        purity: Option<f64> => higher("purity").share().decimals(4),
        /// Number of places on the map over that of true places.
        places_over_true: Option<f64> => lower("places / true places").at_least(0),
        /// Share of the true ways that are on the map; 0 for a system that abstained.
        link_recall: f64 => higher("link recall").share().decimals(3),
        /// Driven distance over the length of all corridors.
        driven: Option<f64> => lower("metres / corridors").at_least(0),
        /// Number of time steps in which it touched something.
        bumps: Option<u32> => lower("steps at a wall"),
        /// End of the run, with the reason.
        why: String => neither("end"),
    }
}

impl FreshRun {
    fn relations(&self) -> Result<(), String> {
        let told = "solved is not whether the goal is on a right map";
        require(self.solved == (self.right && self.goal_found), told)?;
        let told = "who abstained has no map, and no one else has none";
        require(self.abstained == self.verdict_right.is_none(), told)?;
        let told = "a map is either right or wrong";
        let either = self.false_right.is_some() != self.false_alarm.is_some();
        require(self.abstained || either, told)
    }

    fn of(record: &ContestRecord, goal_found: bool) -> Self {
        let run = LearnRun::of(record);
        let learned = record.learned.as_ref();
        let is_mixed = run.purity.is_some_and(|purity| purity < 1.0);
        Self {
            solved: run.right && goal_found,
            right: run.right,
            goal_found: goal_found && !run.abstained,
            abstained: run.abstained,
            false_merge: learned.map(|_| is_mixed),
            verdict_right: learned.map(|learned| match learned.claim {
                Claim::Right => run.right,
                Claim::Wrong => !run.right,
                Claim::Undecided => false,
            }),
            false_right: run.false_right,
            false_alarm: run.false_alarm,
            purity: run.purity,
            places_over_true: run.places,
            link_recall: run.link_recall,
            driven: run.driven,
            bumps: run.bumps,
            why: run.why,
        }
    }
}

/// Returns the table of the fresh worlds.
pub(super) fn table(rows: &[FreshRow], options: &Options) -> Table {
    let worlds = options.runs_else(WORLDS, QUICK);
    Table::of::<FreshRun>(FRESH, "Fresh worlds: each run another drawing")
        .metric(Metric::percent("solved_percent", FreshRun::solved))
        .metric(Metric::percent("false_merges_percent", FreshRun::false_merge))
        .metric(Metric::percent("own_verdict_right_percent", FreshRun::verdict_right))
        .metrics_from(FreshRun::abstained)
        .rows(rows.iter().map(|row| Row::new(&row.row).runs(worlds)))
        .note(
            "Each run draws its own world from its seed, of the arena's families and of middle size. \
             Rows without a word are of the better system. The robot explores until it says that it \
             is done, or gives up. Solved: the goal is on the map, and the map is right by the \
             arena's rule. It matches the true junctions, dead ends, start and goal and the ways \
             between them one to one, with at least 95 % of all. A system that abstains says so \
             before it drives, and counts as not solved. Own verdict: being done says that the map \
             is right, giving up that it is not. A robot that drives ten times the corridors has \
             said neither, which is not right. Wheels: corridors of any family. Each wheel is off by \
             a constant of up to 2 or 5 %, drawn for the run, in addition to the slip of 10 % that \
             is drawn in each time step.",
        )
}

impl FreshRow {
    fn condition(&self) -> Condition {
        match self.wheels {
            0 => Condition::AsMade,
            percent => Condition::Wheels(percent),
        }
    }

    /// Draws a run's world.
    fn draw(&self, seed: u64) -> Result<Maze, BoxError> {
        let mut rng = stream(seed, WORLD_STREAM);
        let name = match self.families.as_slice() {
            [one] => one,
            several => several
                .get(position(several.len(), &mut rng))
                .ok_or("the row has no family")?,
        };
        drawn(name, FamilySize::Middle, &mut rng)
    }

    /// Lets the robot explore a new world and returns the record.
    pub(super) fn run(&self, schooling: &Schooling, seed: u64) -> Result<Fields, BoxError> {
        let maze = self.draw(seed)?;
        let contestant = Registry::current()
            .system(self.contestant)
            .ok_or("there is no such system")?;
        let contest = Contest {
            contestant,
            robot: None,
            maze: &maze,
            name: &self.row,
            condition: self.condition(),
            starts: 0,
            seed,
            stopwatch: None,
        };
        let mut goal_found = false;
        let record = contest.play(schooling, |outing, moment| {
            if moment == Moment::Over {
                let places = outing.map().places;
                goal_found = places
                    .iter()
                    .any(|place| place.landmark == Some(Landmark::Goal));
            }
        })?;
        Ok(FreshRun::of(&record, goal_found).fields()?)
    }
}

/// Returns a random number below `count`.
fn position(count: usize, rng: &mut impl Rng) -> usize {
    rng.random_range(0..count.max(1) as u32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_run_of_each_row_draws_its_own_world() {
        for row in rows() {
            let drawn = |seed| row.draw(seed).unwrap();
            assert_eq!(drawn(1), drawn(1));
            let others = (2..12).filter(|seed| drawn(*seed) != drawn(1)).count();
            assert!(others > 0, "{}", row.row);
        }
    }

    #[test]
    fn corridors_have_no_openings() {
        let is_open = |family| {
            let maze = FreshRow::new(family).draw(3).unwrap();
            maze.reachable().any(|cell| maze.is_room(cell))
        };
        assert!(!CORRIDORS.into_iter().any(is_open));
        assert!(OPEN.into_iter().all(is_open));
    }

    #[test]
    fn what_no_run_measures_is_refused() {
        let right = FreshRun {
            solved: true,
            right: true,
            goal_found: true,
            verdict_right: Some(true),
            false_alarm: Some(false),
            ..FreshRun::default()
        };
        right.relations().unwrap();
        let abstained = FreshRun::of(&ContestRecord::default(), false);
        abstained.relations().unwrap();
        let unsaid = FreshRun {
            verdict_right: None,
            ..right.clone()
        };
        assert!(unsaid.relations().unwrap_err().contains("no map"));
        let unfound = FreshRun {
            goal_found: false,
            ..right
        };
        assert!(unfound.relations().unwrap_err().contains("the goal"));
    }
}
