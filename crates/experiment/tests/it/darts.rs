//! Players of different skill throw darts until one hits or ten have missed.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicU64, Ordering};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_draw::{Figure, FloorPlan, Series, ZoneStyle};
use tolman_experiment::{
    Better, BoxError, Correction, Easel, Entry, Experiment, Fields, Job, Metric, Procedure, Record,
    Row, Run, Table, Tolerance, record,
};
use tolman_geom::{Heading, Point, Pose};
use tolman_replay::{Replay, RobotTrack, Scenery};
use tolman_robot::Body;

/// Tolerance of shares of hits.
pub(crate) const HITS: Tolerance = Tolerance::absolute(15.0, "darts scatter");
/// Tolerance of numbers of throws.
pub(crate) const LENGTH: Tolerance = Tolerance::relative(0.35, "arms tire");

/// Maximum number of darts in a run.
const DARTS: u32 = 10;

record! {
    /// What a run measures.
    pub(crate) struct Throws {
        /// Whether a dart hit.
        success: bool => higher("success").tolerance(HITS),
        /// Number of darts thrown.
        throws: u64 =>
            lower("throws").at_least(1).at_most(DARTS).tolerance(LENGTH),
        /// How the run ended.
        outcome: Option<String> => neither("outcome"),
        /// Distance of the last dart from the middle.
        miss: Option<f64> => lower("last miss").unit("m").at_least(0),
    }
}

/// The experiment. Its fields are what tests change.
#[derive(Clone, Debug)]
pub(crate) struct Darts {
    pub(crate) tables: Vec<Table>,
    /// Half the side of the board.
    pub(crate) reach: f64,
    /// Number of times that a replay repeats the darts.
    pub(crate) replay_length: usize,
    /// Number of figures and replays that were made so far.
    pub(crate) made: Arc<AtomicU64>,
}

impl Darts {
    pub(crate) fn new() -> Self {
        let table = |name: &str, title: &str| {
            Table::of::<Throws>(name, title)
                .metric(Metric::percent("success_percent", Throws::success))
                .metric(Metric::mean(Throws::throws))
                .metric(Metric::mean(Throws::miss))
                .metric(
                    Metric::ratio("miss_per_throw", Throws::miss, Throws::throws)
                        .titled("miss a throw")
                        .better(Better::Lower),
                )
                .paper_runs(25)
                .compared_with("Adept", Correction::Holm)
        };
        let near = table("1 (near)", "From two metres, at most 10 darts")
            .note("Runs without a hit count as 10 throws.")
            .row(
                Row::new("Novice")
                    .paper("success_percent", 60.0)
                    .paper_mean("throws", 6.4, 2.9),
            )
            .row(
                Row::new("Adept")
                    .paper("success_percent", 96.0)
                    .paper_mean("throws", 2.6, 2.1)
                    .paper_mean("miss", 0.05, 0.02),
            )
            .row(
                Row::new("Master")
                    .paper("success_percent", 100.0)
                    .paper_mean("throws", 1.3, 0.6),
            );
        let far = table("2 (far)", "From four metres, at most 10 darts")
            .row(Row::new("Novice").paper("success_percent", 40.0))
            .row(Row::new("Adept"))
            .row(Row::new("Master").paper_mean("throws", 1.9, 1.2));
        Self {
            tables: vec![near, far],
            reach: 1.0,
            replay_length: 1,
            made: Arc::default(),
        }
    }

    fn throws(&self, job: &Job<'_>) -> Vec<Point> {
        let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
        let skill = match job.row {
            "Novice" => 1.0,
            "Adept" => 0.5,
            _ => 0.3,
        };
        let spread = self.reach
            * if job.table == "1 (near)" {
                skill
            } else {
                1.4 * skill
            };
        let mut throws = Vec::new();
        for _ in 0..DARTS {
            let mut along = || rng.random_range(-spread..spread);
            throws.push(Point::new(along(), along()));
            if hits(throws.last().copied()) {
                break;
            }
        }
        throws
    }
}

fn hits(throw: Option<Point>) -> bool {
    throw.is_some_and(|throw| throw.coords.norm() < 0.3)
}

pub(crate) const DARTS_ENTRY: Entry = Entry {
    name: "darts",
    title: "Throws until a hit, <by> skill & distance",
    source: "After nobody's paper: values made up for tests",
    runs: 400,
    quick_runs: 10,
    main: &[],
    tour: &[],
    open: |_| Ok((&Darts::new()).into()),
};

impl From<&Darts> for Experiment {
    fn from(darts: &Darts) -> Self {
        let reach = [("reach".to_owned(), toml::Value::Float(darts.reach))];
        let config = toml::toml! { darts = 10 }.into_iter().chain(reach);
        let config = config.collect();
        Self::new(DARTS_ENTRY, darts.tables.clone(), config, darts.clone())
    }
}

impl Procedure for Darts {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let throws = self.throws(job);
        let last = throws.last().copied();
        let hit = hits(last);
        let measured = Throws {
            success: hit,
            throws: throws.len() as u64,
            outcome: Some(if hit { "Hit" } else { "OutOfDarts" }.to_owned()),
            miss: Some(last.map_or(0.0, |throw| throw.coords.norm())),
        };
        Ok(measured.fields()?)
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let near = easel.draw("near", "1 (near)", || {
            self.board(runs, "1 (near)", "first-run")
        })?;
        let far = easel.draw("far", "2 (far)", || {
            self.board(runs, "2 (far)", "first-far-run")
        })?;
        Ok([near, far].concat())
    }

    /// Returns the darts of the near board, as if a robot went from one to the next.
    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if job.table != "1 (near)" {
            return Ok(None);
        }
        self.made.fetch_add(1, Ordering::SeqCst);
        let poses = self.throws(job).into_iter();
        let poses: Vec<Pose> = poses.map(|at| Pose::new(at, Heading::EAST)).collect();
        let long = poses.iter().cycle().take(poses.len() * self.replay_length);
        let body = Body::Circle { radius: 0.05 };
        let track = RobotTrack::new(job.row, body, long.copied().collect());
        let title = format!("Run {} <of {}>", job.run, job.row);
        Ok(Some(Replay::new(
            title,
            0.1,
            Scenery::default(),
            vec![track],
        )))
    }
}

impl Darts {
    fn board(&self, runs: &[Run], table: &str, name: &str) -> Result<[Figure; 1], BoxError> {
        self.made.fetch_add(1, Ordering::SeqCst);
        let corners = [(-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)];
        let corners = corners.map(|(x, y)| Point::new(x, y));
        let walls: Vec<_> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
        let mut plan = FloorPlan::of_walls(&walls, 420.0);
        plan.zone(&corners.map(|corner| corner * 0.15), ZoneStyle::Destination);
        for (i, row) in (0..).zip(&self.tables[0].rows) {
            let run = runs
                .iter()
                .find(|run| run.is_of(table, &row.name))
                .ok_or("no run to draw")?;
            plan.trajectory(&self.throws(&run.job()), Series(i));
        }
        let figure = Figure::new(name, "The first run of each player", {
            plan.drawing("The board with the darts of three players, joined by lines.")
        });
        Ok([figure.caption("Ring: first dart. Dot: last dart.")])
    }
}
