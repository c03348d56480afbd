//! The system that corrects its pose while it learns, as sections 5 and 6 of the paper ask for.

use alloc::sync::Arc;

use tolman_arena::gngslam::{Pitch, PointScore};
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{
    BoxError, Fields, Job, Metric, Options, Record, Row, Run, Table, record, run_seed,
};
use tolman_geom::Point;
use tolman_robot::pioneer_2dx::TRACK;
use tolman_systems::gngslam::{OnlineSlam, OnlineSlamConfig};

use super::looks::{LookedFrom, OnlineRun};
use super::{ASKED, RANDOM, guesses};
use crate::kept::Kept;

/// Names of the tables.
const ONLINE: &str = "online";
const OTHERS: &str = "other arenas";
const BY_SEED: &str = "random arenas";
const WHEELS: &str = "wheels wrong by up to 10 %";

const TAKEN_FOR_GOOD: &str = "taken for 3 %";
const KNOWN_TO_BE_BAD: &str = "known to be 10 %";

/// Seed of the first arena of that table.
const FIRST_BAD: u64 = 101;
const BAD_RUNS: u32 = 5;
/// Maximum calibration error of the wheels in these arenas, as a share.
const BADLY: f64 = 0.1;

const BETTER: &str = "better";
const RAW: &str = "raw odometry";
const CORRECTED: &str = "corrected";

/// Arenas other than the paper's pitch.
const OTHER_ARENAS: [&str; 2] = ["hall", "l-room"];

/// Default number of runs of a row, and that for a first look.
const RUNS: u32 = 20;
const QUICK_RUNS: u32 = 2;

/// Number of looks of a run that learns: the paper's number of records.
const LEARNED: u32 = 1006;

/// Factor of the long runs' length.
const LONGER: u32 = 10;

/// Number of looks of a run that localizes on a map learned by another run.
const TRIED: u32 = 500;

/// Maximum calibration error of the wheels, as a share; each wheel has its own.
const CALIBRATION: f64 = 0.03;

record! {
    /// A run in an arena.
    struct OnlineFields {
        /// Mean of 0.5 / (0.5 + distance to the true cell), in cells of 8 × 8. It is over the looks
        /// of a run from which the map was not learned.
        score: Option<f64> => higher("score to the border").share().decimals(3),
        /// Root-mean-square distance between that run's believed and true positions.
        tried_error_m: Option<f64> => lower("error on a run not learned from").unit("m").decimals(3),
        /// Number of that run's looks until it knew its place; no value if it never did.
        looks_to_localize: Option<u32> => lower("looks until localized"),
        /// Error over the second tenth of the way, m.
        second_tenth_error_m: Option<f64> => lower("error, second tenth").unit("m").decimals(3),
        /// Root-mean-square error of the position over the last tenth of a run.
        position_error_m: Option<f64> => lower("error, last tenth").unit("m").decimals(3),
        /// Error over each tenth of the way, m.
        errors_m: Vec<f64> => neither("errors").unit("m"),
        /// Distance rolled at the end of each tenth, m.
        rolled_m: Vec<f64> => neither("way").unit("m"),
        /// Number of places of the map.
        places: Option<usize> => neither("places"),
        /// Number of time steps in which the robot touched something.
        bumps: Option<u32> => lower("bumps"),
    }
}

/// The long runs, which two rows share.
#[derive(Debug, Default)]
pub(super) struct LongRuns(Kept<u32, OnlineRun>);

/// Returns the tables.
pub(super) fn tables(options: &Options) -> Vec<Table> {
    let runs = options.runs_else(RUNS, QUICK_RUNS);
    let row = |name: &str| Row::new(name).runs(runs);
    let badly = options.runs_else(BAD_RUNS, QUICK_RUNS);
    let long = format!(
        "Learned from {LEARNED} looks on the paper's pitch. Another robot, put down anywhere, tries \
         the map for {TRIED} looks. Wheels are off by up to {CALIBRATION} each. The last two rows \
         are runs with {LONGER} times as many looks. The map is laid over the world by the best fit \
         of the first tenth; the odometry begins at the true pose."
    );
    vec![
        learned(ONLINE, "A pose corrected while the map is learned")
            .rows([row(BETTER), row(RANDOM)])
            .rows([row(RAW), row(CORRECTED)])
            .note(long),
        learned(OTHERS, "The same in other arenas").rows(OTHER_ARENAS.map(row)),
        learned(BY_SEED, "The same in arenas drawn at random")
            .metric(Metric::median("score_median", OnlineFields::score))
            .metric(Metric::least("score_least", OnlineFields::score))
            .rows([row(BETTER), row(RANDOM)])
            .note("Each run is in an arena of its own: 3 to 6.5 m a side, goals of any colours anywhere, windows, furniture, light."),
        learned(WHEELS, "The same on a robot that is badly calibrated")
            .metric(Metric::least("score_least", OnlineFields::score))
            .rows([TAKEN_FOR_GOOD, KNOWN_TO_BE_BAD].map(|name| row(name).runs(badly)))
            .note("Run n is in the random arena 101 + n. The system expects wheels that are wrong by 3 %, as in the other tables, or by 10 %."),
    ]
}

/// Returns a table without rows.
fn learned(name: &str, title: &str) -> Table {
    Table::of::<OnlineFields>(name, title).metrics_from(OnlineFields::score)
}

/// Returns whether a table belongs here.
pub(super) fn has(table: &str) -> bool {
    [ONLINE, OTHERS, BY_SEED, WHEELS].contains(&table)
}

/// Returns the name of the long run that a job uses; `None` if it uses none.
pub(super) fn long_run_of(job: &Job<'_>) -> Option<String> {
    let looks = job.table == ONLINE && [RAW, CORRECTED].contains(&job.row);
    looks.then(|| format!("long run {}", job.run))
}

pub(super) fn run(long: &LongRuns, job: &Job<'_>) -> Result<Fields, BoxError> {
    let fields = match (job.table, job.row) {
        (_, RANDOM) => guessed(job.seed),
        (ONLINE, RAW) => trajectory(&*long.run(job)?, |look| look.reckoned.position),
        (ONLINE, CORRECTED) => trajectory(&*long.run(job)?, |look| look.corrected.position),
        (table, row) => {
            let pitch = match table {
                ONLINE => Pitch::named("pitch")?,
                BY_SEED => Pitch::random(job.seed)?,
                WHEELS => Pitch::random(FIRST_BAD + u64::from(job.run))?,
                _ => Pitch::named(row)?,
            };
            let calibration = if table == WHEELS { BADLY } else { CALIBRATION };
            let mut config = OnlineSlamConfig::pioneer_2dx();
            if row == KNOWN_TO_BE_BAD {
                config.map = config.map.for_wheels(BADLY, TRACK);
            }
            tried(&pitch, config, calibration, job.seed)?
        }
    };
    Ok(fields.fields()?)
}

/// Returns the record of as many guesses as the paper's map is asked for records.
fn guessed(seed: u64) -> OnlineFields {
    let scores = guesses::guesses(seed, ASKED).map(|score| score.by_border);
    OnlineFields {
        score: Some(scores.sum::<f64>() / ASKED as f64),
        ..OnlineFields::default()
    }
}

/// Learns an arena, and tries the map with another robot. The wheels of both are off by up to
/// `calibration`.
fn tried(
    pitch: &Pitch,
    config: OnlineSlamConfig,
    calibration: f64,
    seed: u64,
) -> Result<OnlineFields, BoxError> {
    let learned = learn(pitch, config, calibration, seed, LEARNED)?;
    let other = run_seed(seed, "tried", 0);
    let system = OnlineSlam::on(learned.map.clone().put_down(false), config, other);
    let origin = Some(learned.world_from_map);
    let tried = OnlineRun::of(pitch, system, origin, calibration, other, TRIED)?;
    let scores = tried.looks.iter().map(|look| score(pitch, look));
    let localized = (0..).zip(&tried.looks).find(|(_, look)| look.is_localized);
    Ok(OnlineFields {
        score: Some(scores.sum::<f64>() / f64::from(TRIED)),
        tried_error_m: Some(error(&tried.looks, |look| look.corrected.position)),
        looks_to_localize: localized.map(|(look, _)| look + 1),
        ..trajectory(&learned, |look| look.corrected.position)
    })
}

/// Returns a run that learns an arena, aligned with it by the first [`LEARNED`] looks.
fn learn(
    pitch: &Pitch,
    config: OnlineSlamConfig,
    calibration: f64,
    seed: u64,
    looks: u32,
) -> Result<OnlineRun, BoxError> {
    let system = OnlineSlam::new(config, seed);
    let run = OnlineRun::of(pitch, system, None, calibration, seed, looks)?;
    Ok(run.aligned(LEARNED as usize))
}

/// Returns the score of a look, by the distance to the border of the true cell.
fn score(pitch: &Pitch, look: &LookedFrom) -> f64 {
    let (cells, size) = (pitch.cells, pitch.cells.size());
    let off = look.corrected.position - cells.bounds().min;
    let in_cells = Point::new(off.x / size.x, off.y / size.y);
    PointScore::of(cells.cell_of(look.truth.position), in_cells).by_border
}

/// Returns the errors of a run, by tenths.
fn trajectory(run: &OnlineRun, position: impl Fn(&LookedFrom) -> Point) -> OnlineFields {
    let tenth = |number: usize| {
        let looks = run.looks.len();
        &run.looks[looks * number / 10..looks * (number + 1) / 10]
    };
    let errors_m: Vec<f64> = (0..10)
        .map(|number| error(tenth(number), &position))
        .collect();
    let last = |number: usize| tenth(number).last().map_or(0.0, |look| look.rolled);
    OnlineFields {
        position_error_m: errors_m.last().copied(),
        second_tenth_error_m: errors_m.get(1).copied(),
        errors_m,
        rolled_m: (0..10).map(last).collect(),
        places: Some(run.map.places().len()),
        bumps: Some(run.bumps),
        ..OnlineFields::default()
    }
}

/// Returns the root-mean-square error, m.
fn error(looks: &[LookedFrom], position: impl Fn(&LookedFrom) -> Point) -> f64 {
    let off = |look: &LookedFrom| (position(look) - look.truth.position).norm_squared();
    let sum: f64 = looks.iter().map(off).sum();
    libm::sqrt(sum / looks.len().max(1) as f64)
}

impl LongRuns {
    /// Returns the long run with a job's number. Each is made once.
    fn run(&self, job: &Job<'_>) -> Result<Arc<OnlineRun>, BoxError> {
        self.0.get(job.run, || {
            let pitch = Pitch::named("pitch")?;
            let config = OnlineSlamConfig::pioneer_2dx();
            learn(&pitch, config, CALIBRATION, job.seed, LONGER * LEARNED)
        })
    }
}

/// Returns the figure of the error over the driven way.
pub(super) fn figures(runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let error = Axis::log("error, m");
    let mut chart = Chart::new(Axis::linear("way, m").from_zero(), error);
    for (series, row) in [RAW, CORRECTED].into_iter().enumerate() {
        let of_row = OnlineFields::of_row(runs, ONLINE, row)?;
        if of_row.is_empty() {
            return Ok(Vec::new());
        }
        let mean = |tenth: usize, of: &dyn Fn(&OnlineFields) -> &Vec<f64>| {
            let values = of_row.iter().filter_map(|run| of(run).get(tenth));
            values.sum::<f64>() / of_row.len() as f64
        };
        let points = (0..10).map(|tenth| {
            let way = mean(tenth, &|run| &run.rolled_m);
            LinePoint::new(way, mean(tenth, &|run| &run.errors_m))
        });
        chart.line(Line::new(row, Series(series as u32), points.collect()));
    }
    let drawing = chart.drawing("Error of raw odometry and of the corrected pose against the way.");
    Ok(vec![
        Figure::new(
            "drift",
            "Odometry drifts, the corrected pose does not",
            drawing,
        )
        .caption(format!(
            "Root-mean-square error of the position over each tenth of {} looks, mean of all runs.",
            LONGER * LEARNED
        ))
        .table(ONLINE),
    ])
}
