//! The paper's outlook (section 6): the same search, without rollouts, with thick walls, slipping
//! wheels and noisy sensors.

use tolman_maze::{Braided, Maze};

use super::check_score;
use crate::rows::row_of;
use tolman_arena::micromouse::ScoreSheet;
use tolman_arena::micromouse::noisy::{self, MouseSize, NoisyConfig};
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{BoxError, Fields, Job, Options, Record, Row, Run, Table, record, require};
use tolman_systems::micromouse::noisy::PoseSource;
use tolman_systems::stream;

/// Name of the table.
pub(super) const NOISE: &str = "noise";

/// Noise levels, as multiples of ordinary noise.
const LEVELS: [f64; 7] = [0.0, 0.25, 1.0, 2.0, 4.0, 5.0, 6.0];

const LOCALIZATIONS: [(PoseSource, &str); 2] = [
    (PoseSource::ParticleFilter, "12x12"),
    (PoseSource::DeadReckoning, "12x12, dead reckoning"),
];

/// Noise levels at which larger mazes are tried, with the particle filter.
const LARGER: [u32; 4] = [1, 2, 4, 6];

/// Noise levels at which a half-size mouse is tried, with the particle filter.
const HALF_SIZE: [u32; 3] = [2, 4, 6];

/// Default number of mazes of each row, the same for all rows of a size.
const MAZES: u32 = 200;

/// Number of mazes for a first look.
const QUICK: u32 = 20;

/// Number of half-size mazes for a first look: each takes seconds.
const QUICK_HALF_SIZE: u32 = 1;

/// Stream of a run's seed from which its maze is drawn.
const MAZE_STREAM: u64 = 41;

record! {
    /// A mouse's runs in a maze with thick walls.
    #[check(NoiseRun::relations)]
    struct NoiseRun {
        /// Number of time steps in which the mouse touched a wall.
        bumps: u32 => lower("bumps"),
        /// Whether the mouse arrived in both runs.
        arrived: bool => higher("arrived"),
        /// Number of steps of the first run, if it arrived.
        run_1: Option<u32> => lower("first run").unit("steps"),
        /// Number of steps of the second run, if it arrived.
        run_2: Option<u32> => lower("second run").unit("steps"),
        /// A thirtieth of the first run's steps plus those of the second run.
        score: Option<f64> => lower("score"),
        /// Mean distance between the believed and the true position at stops.
        error_mm: f64 => lower("error at stops").unit("mm").at_least(0),
    }
}

impl NoiseRun {
    fn relations(&self) -> Result<(), String> {
        let together = [
            self.run_1.is_some(),
            self.run_2.is_some(),
            self.score.is_some(),
        ];
        let arrived = "a run that arrived has a score, another has none";
        require(together == [self.arrived; 3], arrived)?;
        check_score(self.run_1, self.run_2, self.score)
    }
}

pub(super) fn table(options: &Options) -> Table {
    let quick = |mouse: &Mouse| match mouse.config.size {
        MouseSize::Classic => QUICK,
        MouseSize::Half => QUICK_HALF_SIZE,
    };
    let runs = |mouse: &Mouse| options.runs_else(MAZES, quick(mouse));
    Table::of::<NoiseRun>(NOISE, "The mouse among thick walls, with noise")
        .metrics_from(NoiseRun::arrived)
        .rows(mice().map(|mouse| Row::new(mouse.row.clone()).runs(runs(&mouse))))
        .note(
            "One run per maze, half-braided, drawn by the run's seed, on the continuous simulator. A \
             row's name has the maze's cells and the multiple of ordinary noise; half-size mazes have \
             32 × 32 cells of 9 cm, and a mouse of half the size. Unless it says \
             otherwise the mouse has a particle filter. Noise 1: wheels slip by up to 10 % and drift \
             by 0.2 rad/m; three range sensors are off by 3 mm and 2 %. Steps and score are of the \
             runs that arrived. The error is the distance between believed and true position.",
        )
}

fn row(name: &str, level: f64) -> String {
    format!("{name} · {level}")
}

/// A mouse, and the mazes that it is sent into.
struct Mouse {
    row: String,
    /// Number of cells along a side.
    side: u16,
    config: NoisyConfig,
}

fn mice() -> impl Iterator<Item = Mouse> {
    let small = LOCALIZATIONS.into_iter().flat_map(|(localization, name)| {
        LEVELS.map(|level| Mouse {
            row: row(name, level),
            side: 12,
            config: NoisyConfig::ordinary(localization, level),
        })
    });
    let larger = LARGER.map(|level| Mouse {
        row: row("16x16", level.into()),
        side: 16,
        config: NoisyConfig::ordinary(PoseSource::ParticleFilter, level.into()),
    });
    let half_size = HALF_SIZE.map(|level| {
        let mut config = NoisyConfig::ordinary(PoseSource::ParticleFilter, level.into());
        config.size = MouseSize::Half;
        Mouse {
            row: row("half-size", level.into()),
            side: 32,
            config,
        }
    });
    small.chain(larger).chain(half_size)
}

/// Returns the maze of a run, whose seed is the same in all rows.
fn maze(seed: u64, side: u16) -> Result<Maze, BoxError> {
    let braided = Braided {
        width: side,
        height: side,
        share: 0.5,
    };
    let mut maze = braided.generate(&mut stream(seed, MAZE_STREAM))?;
    maze.set_goals(maze.grid().middle().collect());
    Ok(maze)
}

/// Plays a run in one maze.
pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let mouse = row_of(job, mice(), |mouse| mouse.row == job.row)?;
    let trial = noisy::send(&maze(job.seed, mouse.side)?, &mouse.config, job.seed)?;
    let ScoreSheet { run_1, run_2 } = trial.verdict;
    let run = NoiseRun {
        arrived: run_2.is_some(),
        run_1: run_1.filter(|_| run_2.is_some()),
        run_2,
        score: trial.verdict.score(),
        bumps: trial.bumps,
        error_mm: 1000.0 * trial.mean_error,
    };
    Ok(run.fields()?)
}

/// Returns the figure of how often the mouse arrives, by noise.
pub(super) fn figure(runs: &[Run]) -> Figure {
    let mut chart = Chart::new(
        Axis::linear("noise").from_zero(),
        Axis::linear("arrives, %").between(0.0, 100.0),
    );
    for (series, (_, name)) in (0..).zip(LOCALIZATIONS) {
        let points = LEVELS.into_iter().filter_map(|level| {
            let of_row = NoiseRun::of_row(runs, NOISE, &row(name, level)).ok()?;
            let arrived = of_row.iter().filter(|run| run.arrived).count();
            (!of_row.is_empty()).then(|| {
                let percent = 100.0 * arrived as f64 / of_row.len() as f64;
                LinePoint::new(level, percent)
            })
        });
        chart.line(Line::new(name, Series(series), points.collect()));
    }
    let drawing = chart.drawing("How often the mouse arrives, by noise, with each localization.");
    Figure::new("arrives-by-noise", "The mouse and noise", drawing)
        .caption("Noise as a multiple of the ordinary, in mazes of 12 × 12 cells.")
        .table(NOISE)
}
