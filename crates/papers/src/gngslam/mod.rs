//! GNG-SLAM: Tables 3.1 and 4.1 with their figures.
//!
//! Place maps are learned from six sets of features with annealed parameters. Further tables are of
//! the system that corrects its pose while it learns.

mod annealing;
mod drawings;
mod driven;
mod figures;
mod guesses;
mod looks;
mod online;
mod optimum;
mod places;
mod search_space;
mod searches;
mod sets;

use alloc::collections::BTreeMap;

use crate::tolerances::MAP_SCORE;
use serde::Serialize;
use tolman_draw::Figure;
use tolman_experiment::{
    Beside, BoxError, Correction, Easel, Entry, Experiment, Fields, Headline, Job, Metric, Options,
    Pairwise, Procedure, Record, Row, Run, Table, record,
};

use search_space::TABLE_3_1;
use searches::{MAPS, Searches};
use sets::{RANDOM, RANDOM_SCORE, SETS, TABLE, VARIANTS, settings};

/// Number of guesses of a random map: as many as a map of 1006 records is asked for.
const ASKED: usize = 201;

/// Maximum number of runs of each variant.
const VARIANT_RUNS: u32 = 200;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "gngslam",
    title: "GNG-SLAM: maps of places from camera, sonar and odometry",
    source: "A. Goldhoorn, H. Stadman, H. Eldering: Implementation of a Simultaneous Localization and Mapping system using \
             Growing Neural Gas, 2006",
    runs: 500,
    quick_runs: 40,
    main: &["4.1"],
    tour: &[
        Headline {
            system: "GNG-SLAM",
            measures: "score of the map",
            table: "4.1",
            row: "40x30 hsv+odometry",
            metric: "score",
            beside: Beside::Paper,
            runs: Some(20),
        },
        Headline {
            system: "GNG-SLAM Better",
            measures: "error of the pose at last, m",
            table: "online",
            row: "corrected",
            metric: "position_error_m",
            beside: Beside::Rival {
                row: "raw odometry",
                called: "wheels alone",
            },
            runs: Some(4),
        },
    ],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct GngSlam {
    /// Master seed of the experiment.
    seed: u64,
    searches: Searches,
    long: online::LongRuns,
}

/// Configuration of the runs.
#[derive(Serialize)]
struct Config {
    /// Number of maps over which the window of a search shrinks.
    maps_of_a_search: u32,
    search_space: BTreeMap<&'static str, (f64, f64)>,
    sources: Vec<places::Config>,
}

/// Returns the experiment with its tables. Records are gathered when the first run needs them.
///
/// # Errors
/// If the caller names mazes, which this experiment does not use.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("the tables are of the paper's pitch: leave --maze out".into());
    }
    let searches = Searches::new(options.seed);
    let spaces = TABLE_3_1.map(|parameter| (parameter.name, parameter.space));
    let config = toml::Table::try_from(Config {
        maps_of_a_search: MAPS,
        search_space: spaces.into(),
        sources: searches.configs()?,
    })?;
    let runs = options.runs_of(&ENTRY);
    let mut tables = vec![
        paper(),
        optimum::table(runs),
        variants(options.runs.unwrap_or(runs.min(VARIANT_RUNS))),
        guesses::table(options),
    ];
    tables.push(driven::table(options));
    tables.extend(online::tables(options));
    let slam = GngSlam {
        seed: options.seed,
        searches,
        long: online::LongRuns::default(),
    };
    Ok(Experiment::new(ENTRY, tables, config, slam))
}

record! {
    /// Scores of one map, or of as many random guesses.
    pub(super) struct MapRun {
        /// Mean score over a random fifth of the records (equation 3.2). A record scores 1 if the
        /// nearest node is in its cell; otherwise 0.5 / distance to the cell's middle, in cells. A
        /// map with one node for both goals has no score. It counts as 0 in the search and is left
        /// out here, as in the paper.
        score: Option<f64> => higher("score").share().decimals(3).tolerance(MAP_SCORE),
        /// Mean of 0.5 / (0.5 + distance to the cell), the score that the paper would prefer.
        border_score: Option<f64> => higher("score to the border").share().decimals(3),
        /// Whether both goals are nearest to one node, so that the map cannot be turned and has no
        /// score.
        useless: bool => lower("useless maps"),
        /// Whether the map is a mirror image of the pitch, with counter-clockwise and clockwise
        /// exchanged.
        mirrored: Option<bool> => lower("mirrored maps"),
        /// Number of nodes of the map.
        nodes: Option<usize> => neither("nodes").decimals(1),
        /// Values of a_max, λ, α, d, n_max, ε_b, ε_n, w_image, w_odo, w_sonar; empty for guesses.
        parameters: Vec<f64> => neither("parameters"),
    }
}

/// Returns a table of maps, without rows.
fn of_maps(name: &str, title: &str) -> Table {
    let best = Metric::greatest("best_score", MapRun::score).titled("best map");
    Table::of::<MapRun>(name, title)
        .metric(Metric::mean(MapRun::score))
        .metric(best)
        .metrics_from(MapRun::border_score)
}

fn paper() -> Table {
    let rows = SETS.iter();
    of_maps(TABLE, "Scores of maps by the features they are learned from")
        .rows(rows.map(|set| Row::new(set.row)
            .paper(MapRun::score, set.score)
            .paper_runs(set.samples)))
        .row(Row::new(RANDOM).paper(MapRun::score, RANDOM_SCORE))
        .compared_with(RANDOM, Correction::Holm)
        .pairwise(Pairwise {
            field: MapRun::score.to_owned(),
            rows: SETS.iter().map(|set| set.row.to_owned()).collect(),
            correction: Correction::Holm,
            paper: vec![(SETS[1].row.to_owned(), SETS[4].row.to_owned(), 0.22)],
        })
        .note(format!(
            "Each {MAPS} maps of a row are one search by simulated annealing, in which a map has \
             parameters near those of the better of the two before. So maps depend on each other; \
             p-values treat them as independent, as in the paper. n counts the maps with a score. A \
             random map is {ASKED} guesses. The paper has {} to {} maps a row.",
            SETS[2].samples, SETS[0].samples
        ))
}

fn variants(runs: u32) -> Table {
    let settings = settings().into_iter();
    let rows = settings.filter(|setting| setting.table == VARIANTS);
    of_maps(VARIANTS, "Set 1 with one thing changed")
        .rows(rows.map(|setting| Row::new(setting.row).runs(runs)))
        .note(
            "In Table 4.1 wheels slip but count rightly, features are scaled by groups, and maps stretched over the cells where \
             records were taken. Here each wheel counts wrongly by a constant share. Raw values are metres, and colours of 0 to 1.",
        )
}

/// Returns the record of a random map: as many guesses as a map is asked for records.
fn random_map(seed: u64) -> MapRun {
    let (mut centre, mut border) = (0.0, 0.0);
    for guess in guesses::guesses(seed, ASKED) {
        centre += guess.by_centre;
        border += guess.by_border;
    }
    MapRun {
        score: Some(centre / ASKED as f64),
        border_score: Some(border / ASKED as f64),
        ..MapRun::default()
    }
}

/// Returns the index of a job's row among the settings; `None` if it is not there.
fn place_of(job: &Job<'_>) -> Option<usize> {
    let is_row = |setting: &sets::Setting| (setting.table, setting.row) == (job.table, job.row);
    settings().iter().position(is_row)
}

impl Procedure for GngSlam {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let run = match (job.table, job.row, place_of(job)) {
            (guesses::NAME, ..) => return guesses::run(job),
            (table, ..) if driven::has(table) => return driven::run(job),
            (table, ..) if online::has(table) => return online::run(&self.long, job),
            (optimum::NAME, ..) => return optimum::run(&self.searches, job),
            (TABLE, RANDOM, _) => random_map(job.seed),
            (_, _, Some(row)) => self.searches.map(row, job.run)?,
            (table, row, _) => return Err(format!("there is no row {row:?} of {table}").into()),
        };
        Ok(run.fields()?)
    }

    fn shares(&self, job: &Job<'_>) -> Option<String> {
        let (row, number) = match job.table {
            table if online::has(table) => return online::long_run_of(job),
            optimum::NAME => optimum::search_of(job),
            _ => (place_of(job)?, job.run / searches::MAPS),
        };
        Some(format!("search {number} of setting {row}"))
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let mut figures = easel.draw("scores", sets::TABLE, || figures::of(runs, self.seed))?;
        figures.extend(easel.draw("maps", sets::TABLE, || self.searches.drawings(runs))?);
        figures.extend(easel.draw("driven", driven::DRIVEN, || driven::figures(runs))?);
        figures.extend(online::figures(runs)?);
        Ok(figures)
    }
}
