//! The paper's outlook (section 6): the same search, without rollouts, with thick walls, wheels that slip and noisy sensors.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Braided, Maze};

use super::check_score;
use tolman_arena::micromouse::noisy::{self, NoisyConfig, NoisyEnd};
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};
use tolman_systems::micromouse::noisy::Localization;

/// The name of the table.
pub(super) const NOISE: &str = "noise";

/// Multiples of ordinary noise.
const LEVELS: [f64; 7] = [0.0, 0.25, 1.0, 2.0, 4.0, 5.0, 6.0];

const LOCALIZATIONS: [(Localization, &str); 2] = [
    (Localization::ParticleFilter, "particle filter"),
    (Localization::DeadReckoning, "dead reckoning"),
];

/// Mazes of each row, the same in all.
const MAZES: u32 = 20;

pub(super) fn table() -> Table {
    let mut table = Table::new(NOISE, "The mouse among thick walls, with noise")
        .field("arrived", Kind::Flag)
        .optional_field("run_1", Kind::Count)
        .optional_field("run_2", Kind::Count)
        .optional_field("score", Kind::Number)
        .field("bumps", Kind::Count)
        .field("error_mm", Kind::Number)
        .metric(Metric::percent("arrived_percent", "arrived"))
        .metric(Metric::mean("run_1").titled("first run").unit("steps"))
        .metric(Metric::mean("run_2").titled("second run").unit("steps"))
        .metric(Metric::mean("score"))
        .metric(Metric::mean("error_mm").titled("error at stops").unit("mm"))
        .note(
            "One run a maze of 12 × 12 cells, half-braided, on the continuous simulator. Noise 1: wheels slip by up to \
             10 % and drift by 0.2 rad/m; three range sensors are off by 3 mm and 2 %. Steps and score are of the runs that \
             arrived, the error is where the mouse thinks it is against where it is.",
        );
    for (_, name) in LOCALIZATIONS {
        for level in LEVELS {
            table = table.row(Row::new(row(name, level)).runs(MAZES));
        }
    }
    table
}

fn row(name: &str, level: f64) -> String {
    format!("{name}, noise {level}")
}

/// The mouse of a row.
fn config(wanted: &str) -> Option<NoisyConfig> {
    let rows = LOCALIZATIONS.iter().flat_map(|(localization, name)| {
        LEVELS.map(|level| (row(name, level), *localization, level))
    });
    rows.into_iter()
        .find(|(name, ..)| name == wanted)
        .map(|(_, localization, level)| NoisyConfig::ordinary(localization, level))
}

fn maze(number: u32) -> Result<Maze, BoxError> {
    let braided = Braided {
        width: 12,
        height: 12,
        share: 0.5,
    };
    let mut maze = braided.generate(&mut ChaCha8Rng::seed_from_u64(number.into()))?;
    maze.set_goals(maze.grid().middle().collect());
    Ok(maze)
}

/// One maze.
pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let config = config(job.row).ok_or("there is no such row")?;
    let trial = noisy::send(&maze(job.run)?, &config, job.seed)?;
    let fields = Fields::new()
        .flag("arrived", matches!(trial.end, NoisyEnd::Arrived { .. }))
        .count("bumps", trial.bumps.into())
        .number("error_mm", 1000.0 * trial.mean_error);
    Ok(match trial.end {
        NoisyEnd::Arrived { run_1, run_2 } => fields
            .count("run_1", run_1.into())
            .count("run_2", run_2.into())
            .number("score", f64::from(run_1) / 30.0 + f64::from(run_2)),
        _ => fields,
    })
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let arrived = run.fields.get("arrived").and_then(Field::as_flag) == Some(true);
    match (number("run_1"), number("run_2"), number("score")) {
        (Some(run_1), Some(run_2), Some(score)) if arrived => check_score(run_1, run_2, score),
        (None, None, None) if !arrived => Ok(()),
        _ => Err("a run that arrived has a score, another has none".into()),
    }
}

/// How often the mouse arrives, by noise.
pub(super) fn figure(runs: &[Run]) -> Figure {
    let mut chart = Chart::new(
        Axis::linear("noise").from_zero(),
        Axis::linear("arrives, %").between(0.0, 100.0),
    );
    for (series, (_, name)) in (0..).zip(LOCALIZATIONS) {
        let points = LEVELS.into_iter().filter_map(|level| {
            let wanted = row(name, level);
            let mut of_row = runs
                .iter()
                .filter(|run| run.table == NOISE && run.row == wanted)
                .filter_map(|run| run.fields.get("arrived").and_then(Field::as_flag))
                .peekable();
            of_row.peek()?;
            let (arrived, count) = of_row.fold((0, 0), |(arrived, count), flag| {
                (arrived + u32::from(flag), count + 1)
            });
            let percent = 100.0 * f64::from(arrived) / f64::from(count);
            Some(LinePoint::new(level, percent))
        });
        chart.line(Line::new(name, Series(series), points.collect()));
    }
    let drawing = chart.drawing("How often the mouse arrives, by noise, with each localization.");
    Figure::new("arrives-by-noise", "The mouse and noise", drawing)
        .caption("Noise as a multiple of the ordinary; twenty mazes a point.")
        .table(NOISE)
}
