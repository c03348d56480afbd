//! GNG-SLAM: Table 4.1 and its figures. Place maps are learned from six sets of features, their parameters annealed.

mod annealing;
mod drawings;
mod figures;
mod guesses;
mod optimum;
mod places;
mod search_space;
mod sets;

use alloc::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Correction, Entry, Experiment, Fields, Job, Metric, Options, Pairwise, Procedure,
    Record, Row, Run, Table, Tolerance, record, run_seed,
};
use tolman_maps::place_map::PlaceMap;

use annealing::{Annealing, Tried};
use places::Places;
use search_space::{Parameters, TABLE_3_1};
use sets::{RANDOM, RANDOM_SCORE, SETS, Set};

/// The name of the table.
const NAME: &str = "4.1";

/// Guesses of a random map: as many as a map of 1006 records is asked about.
const ASKED: usize = 201;

/// What the catalogue says of it.
pub(super) const ENTRY: Entry = Entry {
    name: "gngslam",
    title: "GNG-SLAM: maps of places from camera, sonar and odometry",
    source: "A. Goldhoorn, H. Stadman, H. Eldering: Implementation of a Simultaneous Localization and Mapping system using \
             Growing Neural Gas, 2006",
    runs: 500,
    quick_runs: 40,
    open,
};

/// The experiment, ready to run.
#[derive(Debug)]
struct GngSlam {
    /// The master seed.
    seed: u64,
    /// How many maps a search makes.
    maps: u32,
    places: Places,
    /// By set. A map follows from those before it, so a search is kept between runs.
    searches: [Mutex<Annealing<Learned>>; SETS.len()],
}

/// What came of a map.
#[derive(Clone, Copy, Debug)]
struct Learned {
    nodes: usize,
    /// `None` of a useless map.
    scores: Option<(f64, f64, bool)>,
}

/// What the runs depend on.
#[derive(Serialize)]
struct Config {
    /// How many maps the window of the search shrinks over.
    maps: u32,
    search_space: BTreeMap<&'static str, (f64, f64)>,
    records: places::Config,
}

/// Sets the tables up. The records are gathered when the first run needs them.
///
/// # Errors
/// If the caller names mazes, which have no place here.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("the tables are of the paper's pitch: leave --maze out".into());
    }
    let maps = options.runs_of(&ENTRY);
    let spaces = TABLE_3_1.map(|parameter| (parameter.name, parameter.space));
    let places = Places::new(run_seed(options.seed, "records", 0));
    let config = toml::Table::try_from(Config {
        maps,
        search_space: spaces.into(),
        records: places.config()?,
    })?;
    let slam = GngSlam {
        seed: options.seed,
        maps,
        places,
        searches: SETS.map(|_| Mutex::new(Annealing::new(maps))),
    };
    let tables = vec![table(), optimum::table(), guesses::table()];
    Ok(Experiment::new(ENTRY, tables, config, slam))
}

record! {
    /// A map, or as many guesses as a map is asked for.
    pub(super) struct MapRun {
        /// Mean over a random fifth of the records of 1 where the nearest node lies in the record's cell, else 0.5 / distance to its
        /// middle, in cells (equation 3.2). None where both goals are nearest to one node: those count as 0 in the search
        /// and are left out here, as in the paper.
        score: Option<f64> => higher("score").share().decimals(3).tolerance(Tolerance::Relative(0.2)),
        /// The same with 0.5 / (0.5 + distance to the cell), which the paper wishes for.
        border_score: Option<f64> => higher("score to the border").share().decimals(3),
        /// Whether both goals are nearest to one node, so that the map cannot be turned and has no score.
        useless: bool => lower("useless maps"),
        /// Whether the map is a mirror image of the pitch: counter-clockwise there is clockwise in it.
        mirrored: Option<bool> => lower("mirrored maps"),
        /// Nodes of the map.
        nodes: Option<usize> => neither("nodes").decimals(1),
        /// a_max, λ, α, d, n_max, ε_b, ε_n, w_image, w_odo, w_sonar; none of guesses.
        parameters: Vec<f64> => neither("parameters"),
    }
}

fn table() -> Table {
    let metric = Metric::greatest("best_score", MapRun::score).titled("best map");
    Table::of::<MapRun>(NAME, "Scores of maps by the features they are learned from")
        .metric(Metric::mean(MapRun::score))
        .metric(metric.decimals(3))
        .metric(Metric::mean(MapRun::border_score))
        .metric(Metric::percent("useless_percent", MapRun::useless))
        .metric(Metric::percent("mirrored_percent", MapRun::mirrored))
        .metric(Metric::mean(MapRun::nodes))
        .rows(SETS.iter().map(|set| Row::new(set.row).paper(MapRun::score, set.score)))
        .row(Row::new(RANDOM).paper(MapRun::score, RANDOM_SCORE))
        .compared_with(RANDOM, Correction::Holm)
        .pairwise(Pairwise {
            field: MapRun::score.to_owned(),
            rows: SETS.iter().map(|set| set.row.to_owned()).collect(),
            correction: Correction::Holm,
            paper: vec![(SETS[1].row.to_owned(), SETS[4].row.to_owned(), 0.22)],
        })
        .note(format!(
            "A row is one search by simulated annealing: each map has parameters near those of the better of the two before, \
             so maps of a row depend on each other, and p-values take them for independent, as the paper does. n counts the maps \
             with a score. A random map is {ASKED} guesses. The paper has {} to {} maps a row.",
            SETS[2].samples, SETS[0].samples
        ))
}

impl GngSlam {
    /// Plays a map of a set's search.
    fn map(&self, place: usize, number: u32) -> Result<MapRun, BoxError> {
        let mut search = self.searches[place]
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let seed = |step| run_seed(self.seed, NAME, step);
        let Tried {
            parameters, map, ..
        } = search.map(
            number,
            |step| stream(seed(step), 0),
            |step, parameters| self.scored(&SETS[place], parameters, seed(step)),
        )?;
        Ok(MapRun {
            score: map.scores.map(|(score, ..)| score),
            border_score: map.scores.map(|(_, score, _)| score),
            useless: map.scores.is_none(),
            mirrored: map.scores.map(|(.., mirrored)| mirrored),
            nodes: Some(map.nodes),
            parameters: parameters.0.into(),
        })
    }

    /// Learns a map and scores it.
    fn scored(
        &self,
        set: &Set,
        parameters: &Parameters,
        seed: u64,
    ) -> Result<(Learned, f64), BoxError> {
        let map = self.learn(set, parameters, seed)?;
        let table = self.places.table(set.image())?;
        let scorer = self.places.scorer()?;
        let score = scorer.score(&map, table, &mut stream(seed, 2))?;
        let scores =
            score.map(|score| (score.mean.by_centre, score.mean.by_border, score.mirrored));
        let learned = Learned {
            nodes: map.network().len(),
            scores,
        };
        Ok((learned, scores.map_or(0.0, |(score, ..)| score)))
    }

    /// Learns the map of a run.
    fn learn(&self, set: &Set, parameters: &Parameters, seed: u64) -> Result<PlaceMap, BoxError> {
        let table = self.places.table(set.image())?;
        let records = 0..self.places.count()?;
        let config = parameters.config(set.with_sonar);
        Ok(PlaceMap::learn(
            table,
            records,
            config,
            &mut stream(seed, 1),
        )?)
    }
}

/// One of the streams of random numbers of a run: 0 for parameters, 1 for learning, 2 for the records that are asked about.
fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(number);
    rng
}

/// As many guesses as a map is asked for.
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

impl Procedure for GngSlam {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let place = SETS.iter().position(|set| set.row == job.row);
        let run = match (job.table, job.row, place) {
            (guesses::NAME, ..) => return guesses::run(job),
            (optimum::NAME, ..) => return optimum::run(self, job),
            (NAME, RANDOM, _) => random_map(job.seed),
            (NAME, _, Some(place)) => self.map(place, job.run)?,
            (table, row, _) => return Err(format!("there is no row {row:?} of {table}").into()),
        };
        Ok(run.fields()?)
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let mut figures = figures::of(runs, self.seed)?;
        figures.extend(self.drawings(runs)?);
        Ok(figures)
    }
}
