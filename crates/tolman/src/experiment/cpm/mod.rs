//! CPM: figure 9 of "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path Planning" (Kawewong and
//! others), the same with our own reading of loops, and mazes that the paper's robot cannot tell apart.

mod figures;
mod venue;

use tolman_maps::cpm::CpmConfig;

use super::{BoxError, Experiment, Fields, Job, Kind, Metric, Options, Row, Table};
use crate::agents::cpm::{CommonPatterns, Mode, Record, Trial, epuck, learn};
use crate::draw::Figure;
use crate::experiment::Run;
use crate::replay::Replay;

use venue::Venue;

/// The table of figure 9.
const FIGURE_9: &str = "9";

/// The table of mazes with fragments that look alike.
const ALIASED: &str = "aliased";

/// How many aliased mazes there are.
const ALIASED_MAZES: u32 = 200;

/// The experiment, ready to run.
#[derive(Debug)]
struct Cpm {
    venues: Vec<Venue>,
    /// What the robot learned in the learning maze.
    patterns: CommonPatterns,
    tables: Vec<Table>,
}

/// Reads the mazes, and lets the robot learn.
///
/// # Errors
/// If a maze cannot be read, or nothing is learned.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let venues = if options.mazes.is_empty() {
        venue::papers()?
    } else {
        venue::from_files(&options.mazes)?
    };
    let learning = venue::learning()?;
    let patterns = learn(&learning.maze, learning.corridor_width, options.seed)?;
    let mut tables = vec![figure_9(&venues, options.mazes.is_empty())];
    if options.mazes.is_empty() {
        tables.push(aliased());
    }
    Ok(Box::new(Cpm {
        venues,
        patterns,
        tables,
    }))
}

/// `papers`: the mazes are the paper's.
fn figure_9(venues: &[Venue], papers: bool) -> Table {
    let mut table = fields(Table::new(
        FIGURE_9,
        "Time from the first to the second episode",
    ))
    .metric(Metric::percent("solved_percent", "solved"))
    .metric(
        Metric::least("reduction_min_percent", "reduction")
            .titled("least reduction")
            .unit("%"),
    )
    .metric(
        Metric {
            name: "reduction_percent".into(),
            ..Metric::mean("reduction")
        }
        .titled("reduction")
        .unit("%"),
    )
    .metric(Metric::mean("closure_precision").titled("loops closed: precision"))
    .metric(Metric::mean("closure_recall").titled("recall"))
    .metric(Metric::mean("seconds_1").titled("episode 1").unit("s"))
    .metric(Metric::mean("seconds_2").titled("episode 2").unit("s"))
    .paper_runs(10)
    .note(
        "Solved: the goal was found, the shortest way of all that was walked was planned, and driven to the goal. Reductions are of solved \
         runs. A run without a loop has precision and recall 1. The paper's robot needs no more than two episodes either.",
    );
    for venue in venues {
        let mut row = Row::new(&venue.name);
        if papers {
            row = row.paper("solved_percent", 100.0);
        }
        table = table
            .row(row)
            .row(Row::new(format!("{}{BETTER}", venue.name)));
    }
    table
}

/// What follows the name of a maze in a row of our own reading.
const BETTER: &str = " better";

fn aliased() -> Table {
    fields(Table::new(ALIASED, "Mazes with fragments that look alike"))
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(Metric::mean("closure_precision").titled("loops closed: precision"))
        .metric(Metric::mean("closure_recall").titled("recall"))
        .row(Row::new("Better").runs(ALIASED_MAZES))
        .note("One random maze a run, which the paper's robot cannot tell its way in.")
}

/// What every run of this experiment measures.
fn fields(table: Table) -> Table {
    table
        .field("solved", Kind::Flag)
        .optional_field("reduction", Kind::Number)
        .field("closure_precision", Kind::Number)
        .field("closure_recall", Kind::Number)
        .optional_field("seconds_1", Kind::Number)
        .optional_field("seconds_2", Kind::Number)
        .optional_field("observations_1", Kind::Count)
        .optional_field("observations_2", Kind::Count)
        .field("traversals", Kind::Count)
        .field("fragments", Kind::Count)
        .field("true_fragments", Kind::Count)
        .field("contradictions", Kind::Count)
        .field("bumps", Kind::Count)
        .optional_field("trouble", Kind::Text)
}

impl Cpm {
    /// Plays the trial of a job, and says where.
    fn play(&self, job: &Job<'_>) -> Result<(Venue, Record), BoxError> {
        let (venue, mode) = if job.table == ALIASED {
            (venue::aliased(job.seed)?, better())
        } else {
            let (name, mode) = match job.row.strip_suffix(BETTER) {
                Some(name) => (name, better()),
                None => (job.row, Mode::Paper(CpmConfig::online())),
            };
            let venue = self.venues.iter().find(|venue| venue.name == name);
            (venue.ok_or("there is no such row")?.clone(), mode)
        };
        let trial = Trial {
            maze: &venue.maze,
            corridor_width: venue.corridor_width,
            patterns: &self.patterns,
            robot: epuck(),
            mode,
            seed: job.seed,
        };
        let record = trial.play()?;
        Ok((venue, record))
    }
}

/// Our own reading: dead reckoning beside the patterns.
fn better() -> Mode {
    Mode::Reckoned(CpmConfig::robust())
}

/// Part of a whole; all of nothing.
fn share(part: u32, rest: u32) -> f64 {
    if part + rest == 0 {
        1.0
    } else {
        f64::from(part) / f64::from(part + rest)
    }
}

impl Experiment for Cpm {
    fn name(&self) -> &str {
        "cpm"
    }

    fn title(&self) -> &str {
        "CPM: common-pattern maps on an e-puck"
    }

    fn source(&self) -> &str {
        "A. Kawewong, Y. Honda, M. Tsuboyama, O. Hasegawa: Reasoning on the Self-Organizing Incremental Associative Memory for Online \
         Robot Path Planning, figure 9"
    }

    fn default_runs(&self) -> u32 {
        10
    }

    fn quick_runs(&self) -> u32 {
        3
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut config = toml::Table::new();
        config.insert("robot".into(), toml::Value::try_from(epuck())?);
        for (name, mode) in [
            ("paper", Mode::Paper(CpmConfig::online())),
            ("better", better()),
        ] {
            config.insert(name.into(), format!("{mode:?}").into());
        }
        let mut dictionary = toml::Table::new();
        dictionary.insert("units".into(), self.patterns.unit_count().into());
        dictionary.insert("clusters".into(), self.patterns.cluster_count().into());
        config.insert("dictionary".into(), dictionary.into());
        let mut mazes = toml::Table::new();
        for venue in self.venues.iter().chain([&venue::learning()?]) {
            mazes.insert(venue.name.clone(), venue.maze.to_string().into());
        }
        config.insert("mazes".into(), mazes.into());
        Ok(config)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (_, record) = self.play(job)?;
        let closures = record.closures;
        let mut fields = Fields::new()
            .flag("solved", record.is_solved())
            .number("closure_precision", share(closures.right, closures.wrong))
            .number("closure_recall", share(closures.right, closures.missed))
            .count("traversals", record.traversals.into())
            .count("fragments", record.fragments.into())
            .count("true_fragments", record.true_fragments.into())
            .count("contradictions", record.contradictions.into())
            .count("bumps", record.bumps.into());
        if let Some(reduction) = record.reduction_percent() {
            fields = fields.number("reduction", reduction);
        }
        if let Some(first) = record.first {
            fields = fields
                .number("seconds_1", first.seconds)
                .count("observations_1", first.observations.into());
        }
        if let Some(second) = record.second {
            fields = fields
                .number("seconds_2", second.seconds)
                .count("observations_2", second.observations.into());
        }
        if let Some(trouble) = record.trouble {
            fields = fields.text("trouble", trouble);
        }
        Ok(fields)
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let (venue, record) = self.play(job)?;
        Ok(Some(figures::replay(&venue, &record, job)?))
    }
}
