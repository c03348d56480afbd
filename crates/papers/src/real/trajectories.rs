//! Other buildings: positions compared with those of the corrected log.

use core::f64::consts::TAU;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::log_score::AlignedScore;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_geom::{Heading, Point, Pose};

use super::relations::{file, missing_of};
use super::{LogMapper, RobotLog};
use crate::data;
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "trajectories";

/// Rows with their logs, and whether the odometry is raw.
pub(super) const ROWS: [(&str, &str, bool); 5] = [
    ("csail", "logs/csail-raw/csail_raw_odom.clf.gz", true),
    (
        "freiburg-079",
        "logs/radish/freiburg-079-corrected.log.gz",
        false,
    ),
    (
        "belgioioso",
        "logs/radish/belgioioso-corrected.log.gz",
        false,
    ),
    ("orebro", "logs/radish/orebro-corrected.log.gz", false),
    ("edmonton", "logs/radish/edmonton-corrected.log.gz", false),
];

/// Errors that are added to a log's odometry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wear {
    /// Constant turn per metre, degrees; its side is drawn for each run.
    turn_a_metre_deg: f64,
    /// Random turn per step, degrees (standard deviation).
    turn_a_step_deg: f64,
    /// Magnitude of the constant relative error of all distances; its sign is drawn for each run.
    length: f64,
}

impl Wear {
    /// Errors for a corrected log.
    const OF_CORRECTED: Self = Self {
        turn_a_metre_deg: 2.0,
        turn_a_step_deg: 1.3,
        length: 0.0,
    };
    /// Errors for raw odometry, which has errors already.
    pub(super) const OF_RAW: Self = Self {
        turn_a_metre_deg: 2.0,
        turn_a_step_deg: 0.0,
        length: 0.05,
    };
}

record! {
    /// A way through a building.
    struct TrajectoryRun {
        /// Root-mean-square distance between the scans' positions and those of the corrected log,
        /// after the best rotation and shift.
        rms_m: f64 => lower("error, root mean square").unit("m").at_least(0).decimals(3),
        /// Largest of these distances.
        largest_m: f64 => lower("largest error").unit("m").at_least(0).decimals(3),
        /// Root-mean-square distance with scans matched only to earlier ones.
        matching_rms_m: f64 => lower("without closures").unit("m").at_least(0).decimals(3),
        /// Root-mean-square distance by the wheels alone.
        odometry_rms_m: f64 => neither("by the wheels alone").unit("m").at_least(0),
        /// Number of places that were recognized again.
        closures: usize => neither("closures").decimals(0),
    }
}

/// Returns the message for a missing log.
pub(super) fn missing() -> Option<String> {
    missing_of(ROWS.map(|(_, name, _)| name), "logs of buildings")
}

pub(super) fn table() -> Table {
    let row = |(name, path, is_raw): (&str, &str, bool)| match file(path) {
        None => Row::new(name).missing(data::missing(&format!("the log of {name}"))),
        Some(_) if is_raw => Row::new(name).run_each(1),
        Some(_) => Row::new(name),
    };
    Table::of::<TrajectoryRun>(NAME, "Other buildings, compared with their corrected logs")
        .metrics_from(TrajectoryRun::rms_m)
        .rows(ROWS.map(row))
        .note(
            "By scan matching with closures, with the configuration of the Intel lab. CSAIL has raw \
             odometry. Of the others only the corrected log is public, so errors are added to its \
             wheels: 2° a metre to one side, and 1.3° (standard deviation) each step.",
        )
}

/// Returns odometry with added errors.
pub(super) fn worse(odometry: &[Pose], wear: Wear, seed: u64) -> Vec<Pose> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut side = || if rng.random::<bool>() { 1.0 } else { -1.0 };
    let Wear {
        turn_a_metre_deg,
        turn_a_step_deg,
        length,
    } = wear;
    let turn = turn_a_metre_deg * side();
    let stretched = match length > 0.0 {
        true => 1.0 + length * side(),
        false => 1.0,
    };
    let mut at = odometry.first().copied().unwrap_or(Pose::IDENTITY);
    let mut worse = vec![at];
    for pair in odometry.windows(2) {
        let step = pair[0].between(pair[1]);
        let random = turn_a_step_deg * gaussian(&mut rng);
        let off = turn * step.position.coords.norm() + random;
        let turned = Pose::new(
            step.position * stretched,
            step.heading.turned(off.to_radians()),
        );
        at = at.compose(turned);
        worse.push(at);
    }
    worse
}

/// Returns a number of the standard normal distribution (Box and Muller).
fn gaussian(rng: &mut ChaCha8Rng) -> f64 {
    let unit = |rng: &mut ChaCha8Rng| (f64::from(rng.random::<u32>()) + 0.5) / 4_294_967_296.0;
    let (radius, turn) = (unit(rng), unit(rng));
    libm::sqrt(-2.0 * libm::log(radius)) * Heading::from_radians(TAU * turn).unit().x
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let (_, name, is_raw) = row_of(job, ROWS, |(name, ..)| *name == job.row)?;
    let path = file(name).ok_or_else(|| format!("the log of {} is gone", job.row))?;
    let log = RobotLog::read(&path)?;
    let truth: Vec<Pose> = log.scans.iter().map(|scan| scan.noted).collect();
    let odometry = match is_raw {
        true => log.odometry(),
        false => worse(&log.odometry(), Wear::OF_CORRECTED, job.seed),
    };
    let matching = log.map(LogMapper::Matching, &odometry, |_| {})?;
    let dense = log.map(LogMapper::ScanMatching, &odometry, |_| {})?;
    let score = aligned(&dense.poses, &truth)?;
    let run = TrajectoryRun {
        rms_m: score.rms,
        largest_m: score.largest,
        matching_rms_m: aligned(&matching.poses, &truth)?.rms,
        odometry_rms_m: aligned(&odometry, &truth)?.rms,
        closures: dense.closures,
    };
    Ok(run.fields()?)
}

/// Returns the errors of poses against the true ones.
pub(super) fn aligned(found: &[Pose], truth: &[Pose]) -> Result<AlignedScore, BoxError> {
    let pairs = found.iter().zip(truth);
    let pairs: Vec<(Point, Point)> = pairs.map(|(a, b)| (a.position, b.position)).collect();
    Ok(AlignedScore::of(&pairs).ok_or("the log has no scan")?)
}
