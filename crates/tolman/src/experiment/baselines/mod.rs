//! The baselines of MSLST: what wandering and wall-following reach without any map.
//!
//! Tables 2 and 3 of "Maze Solving by Learning State Topologies" for its two simple brains, with a random
//! one as the floor and an oracle as the ceiling; competition mazes, or any others, as further tables; and
//! how often the corridor detector takes each kind of place for a corridor.

mod detector;
mod figures;
pub(super) mod worlds;

use tolman_sim::robots::LaserPioneerConfig;

use super::{
    BoxError, Comparison, Correction, Experiment, Field, Fields, Job, Kind, Metric, Options, Row,
    Run, Table, Tolerance,
};
use crate::agents::{Agent, Cast, Mind};
use crate::draw::Figure;
use crate::episode::{self, Episode, EpisodeError, Trial};
use crate::pioneer;
use crate::replay::{Recorder, Replay};

use worlds::Venue;

/// The rows: the paper's brains in its order, then floor and ceiling.
const ROWS: [Agent; 4] = [
    Agent::Avoid,
    Agent::WallFollow,
    Agent::Random,
    Agent::Oracle,
];

/// The experiment, ready to run.
#[derive(Debug)]
struct Baselines {
    robot: LaserPioneerConfig,
    venues: Vec<Venue>,
    /// The agents of each venue.
    casts: Vec<Cast>,
    tables: Vec<Table>,
    /// What is not here.
    skipped: Option<String>,
}

/// Reads the worlds and sets the tables up.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let (venues, skipped) = worlds::venues(&options.mazes)?;
    let mut tables: Vec<Table> = venues.iter().map(table).collect();
    tables.push(detector::table());
    let casts = venues.iter().map(|_| Cast::default()).collect();
    Ok(Box::new(Baselines {
        robot: pioneer::calibrated(),
        venues,
        casts,
        tables,
        skipped,
    }))
}

fn table(venue: &Venue) -> Table {
    let mut table = Table::new(&venue.table, &venue.title)
        .field("reached", Kind::Flag)
        .field("outcome", Kind::Text)
        .field("actions", Kind::Count)
        .field("failed_actions", Kind::Count)
        .field("steps", Kind::Count)
        .field("bumps", Kind::Count)
        .metric(
            Metric::percent("success_percent", "reached")
                .titled("success")
                .tolerance(Tolerance::Absolute(15.0)),
        )
        .metric(Metric::mean("actions"))
        .metric(Metric::mean("steps").tolerance(Tolerance::Relative(0.35)))
        .metric(
            Metric::ratio("steps_per_action", "steps", "actions")
                .titled("steps / action")
                .tolerance(Tolerance::Relative(0.2)),
        );
    for name in ROWS.map(Agent::name) {
        let row = Row::new(name);
        table = table.row(match venue.paper.iter().find(|paper| paper.row == name) {
            Some(paper) => row
                .paper("success_percent", paper.success_percent)
                .paper_mean("actions", paper.actions.0, paper.actions.1)
                .paper_mean("steps", paper.steps.0, paper.steps.1)
                .paper("steps_per_action", paper.steps.0 / paper.actions.0),
            None => row,
        });
    }
    if !venue.paper.is_empty() {
        table = table.paper_runs(25);
    }
    table.comparison = Some(Comparison {
        reference: ROWS[0].name().into(),
        correction: Correction::Bonferroni,
    });
    table.note(format!(
        "A run ends when the robot's centre lies in the destination, or fails after {} time steps, which \
         then count as its steps.",
        venue.step_limit
    ))
}

/// How a run ended, in words.
const fn outcome(reached: bool) -> &'static str {
    if reached { "reached" } else { "timed out" }
}

impl Baselines {
    fn venue(&self, table: &str) -> Option<(usize, &Venue)> {
        self.venues
            .iter()
            .enumerate()
            .find(|(_, venue)| venue.table == table)
    }

    /// What a run is made of; `None` for one of the detector.
    fn cast(&self, job: &Job<'_>) -> Result<Option<(Trial<'_>, Mind)>, EpisodeError> {
        let (Some((index, venue)), Some(agent)) = (self.venue(job.table), Agent::named(job.row))
        else {
            return Ok(None);
        };
        let trial = Trial {
            course: &venue.course,
            robot: self.robot.clone(),
            start: episode::random_start(&venue.course, &pioneer::body(), job.seed),
            step_limit: venue.step_limit,
            seed: job.seed,
        };
        let mind = self.casts[index].mind(agent, &venue.course, &self.robot)?;
        Ok(Some((trial, mind)))
    }

    /// Plays one run; also how figures play it again.
    fn episode(&self, job: &Job<'_>) -> Result<Option<Episode>, EpisodeError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        episode::run(&trial, &mut mind, |_| {}).map(Some)
    }
}

impl Experiment for Baselines {
    fn name(&self) -> &str {
        "baselines"
    }

    fn title(&self) -> &str {
        "Mazes without a map: MSLST's baselines"
    }

    fn source(&self) -> &str {
        "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 2 and 3"
    }

    fn default_runs(&self) -> u32 {
        25
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn skipped(&self) -> Option<&str> {
        self.skipped.as_deref()
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut config = toml::Table::new();
        config.insert("robot".into(), toml::Value::try_from(&self.robot)?);
        let mut worlds = toml::Table::new();
        for venue in &self.venues {
            let mut world = toml::Table::new();
            world.insert("maze".into(), venue.course.maze.to_string().into());
            world.insert("corridor_width".into(), venue.course.corridor_width.into());
            world.insert("step_limit".into(), i64::from(venue.step_limit).into());
            worlds.insert(venue.table.clone(), world.into());
        }
        config.insert("worlds".into(), worlds.into());
        Ok(config)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let Some(episode) = self.episode(job)? else {
            return detector::run(job);
        };
        Ok(Fields::new()
            .flag("reached", episode.reached)
            .text("outcome", outcome(episode.reached))
            .count("actions", u64::from(episode.actions))
            .count("failed_actions", u64::from(episode.failed_actions))
            .count("steps", u64::from(episode.steps))
            .count("bumps", u64::from(episode.bumps)))
    }

    fn check(&self, run: &Run) -> Result<(), BoxError> {
        let Some((_, venue)) = self.venue(&run.table) else {
            return detector::check(run);
        };
        let count = |name: &str| match run.fields.get(name) {
            Some(Field::Count(count)) => *count,
            _ => 0,
        };
        let reached = run.fields.get("reached").and_then(Field::as_flag);
        let (actions, steps) = (count("actions"), count("steps"));
        let told = run.fields.get("outcome").and_then(Field::as_text);
        if told != reached.map(outcome) {
            return Err("outcome and reached contradict each other".into());
        }
        if steps > u64::from(venue.step_limit) {
            return Err(format!("steps is {steps}, the limit {}", venue.step_limit).into());
        }
        if !(1..=steps).contains(&actions) {
            return Err(format!("actions is {actions} in {steps} steps").into());
        }
        if count("failed_actions") > actions || count("bumps") > steps {
            return Err("more failed actions or bumps than actions or steps".into());
        }
        Ok(())
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        let mut recorder = Recorder::new(&trial);
        let episode = episode::run(&trial, &mut mind, |moment| recorder.see(moment))?;
        let title = format!("{} in {}, run {}", job.row, trial.course.name, job.run);
        Ok(Some(recorder.finish(title, &episode)))
    }
}
