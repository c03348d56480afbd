//! Recognizes places in a corridor where they look alike: tells which matches between an image and
//! older ones are true.

use alloc::collections::BTreeMap;

use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_formats::{LogVelocity, PlaceMatch, TucDrive};
use tolman_geom::Pose;
use tolman_maps::audit::{AuditConfig, audit};
use tolman_maps::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};
use tolman_robot::Trajectory;

use super::landmarks::information;
use super::relations::{file, missing_of};
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "tuc";

const DRIVE: &str = "logs/tuc-slam/Corridor_Input.txt.gz";
const TRUTH: &str = "logs/tuc-slam/Corridor_GT.txt.gz";

/// Rows with the minimum similarity of the matches that are examined.
const ROWS: [(&str, f64); 5] = [
    ("alike by 0.1", 0.1),
    ("alike by 0.2", 0.2),
    ("alike by 0.3", 0.3),
    ("alike by 0.5", 0.5),
    ("alike by 0.7", 0.7),
];

/// Maximum distance between the robot's two positions of a true match, m.
const TRUE_M: f64 = 2.0;
/// Standard deviations of a camera's recognition of a place, m and rad.
const SEEN: [f64; 3] = [0.5, 0.5, 0.1];
/// Standard deviations of dead reckoning in each stretch, m and rad, and as a share of the way.
const STRETCH: [f64; 2] = [0.02, 0.005];
const WAY_ERROR: f64 = 0.05;
/// Maximum distance of poses near by, m. Places that look alike are farther apart.
const NEAR: f64 = 30.0;

record! {
    /// Matches that were accepted.
    struct TucRun {
        /// Number of matches that are examined.
        matches: usize => neither("matches").decimals(0),
        /// Share of them that are true.
        true_percent: f64 => neither("true").unit("%").decimals(1),
        /// Number of matches that other matches support.
        accepted: usize => neither("accepted").decimals(0),
        /// Share of the accepted matches that are true, 0 … 1.
        precision: f64 => higher("precision").decimals(4),
        /// Share of all true matches of the data set that are accepted, 0 … 1.
        recall: f64 => higher("recall").decimals(3),
    }
}

/// Returns the message for the missing drive.
pub(super) fn missing() -> Option<String> {
    missing_of([DRIVE, TRUTH], "the corridor of Chemnitz")
}

pub(super) fn table() -> Table {
    let row = |(name, _): (&str, f64)| match missing() {
        Some(missing) => Row::new(name).missing(missing),
        None => Row::new(name).run_each(1),
    };
    Table::of::<TucRun>(NAME, "A corridor of places that look alike")
        .metrics_from(TucRun::matches)
        .rows(ROWS.map(row))
        .note(
            "864 m to and fro. A match says that two places look alike, and how much. It is true if \
             the places are within 2 m. Accepted are the matches that the audit of closures \
             supports: they agree with each other by dead reckoning. Recall is over all true matches \
             of the data set.",
        )
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let (_, least) = row_of(job, ROWS, |(name, _)| *name == job.row)?;
    let read = |name| file(name).ok_or("the corridor of Chemnitz is gone");
    let drive = TucDrive::read(&read(DRIVE)?)?;
    let truth = TucDrive::read_truth(&read(TRUTH)?)?;
    let is_true = |one: &PlaceMatch| is_true(one, &truth);
    let all_true = drive.matches.iter().filter(|one| is_true(one)).count();
    let looked_at = drive.matches.iter().filter(|one| one.similarity >= least);
    let matches: Vec<PlaceMatch> = looked_at.copied().collect();
    let accepted = accepted(&drive.odometry, &matches)?;
    let right = accepted.iter().filter(|one| is_true(one)).count();
    let share = |part: usize, whole: usize| part as f64 / whole.max(1) as f64;
    let run = TucRun {
        matches: matches.len(),
        true_percent: 100.0
            * share(
                matches.iter().filter(|one| is_true(one)).count(),
                matches.len(),
            ),
        accepted: accepted.len(),
        precision: share(right, accepted.len()),
        recall: share(right, all_true),
    };
    Ok(run.fields()?)
}

fn is_true(one: &PlaceMatch, truth: &Trajectory) -> bool {
    let at = |time: f64| truth.at(time).map(|pose| pose.position);
    let pair = at(one.time).zip(at(one.earlier));
    pair.is_some_and(|(now, then)| (now - then).norm() < TRUE_M)
}

/// Returns the matches that others support.
fn accepted(odometry: &[LogVelocity], matches: &[PlaceMatch]) -> Result<Vec<PlaceMatch>, BoxError> {
    let reckoned = LogVelocity::dead_reckoning(odometry);
    let times = matches.iter().flat_map(|one| [one.earlier, one.time]);
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let end = reckoned.poses().last().map(|timed| timed.pose);
    let mut graph = PoseGraph::new();
    let mut ids: BTreeMap<u64, u32> = BTreeMap::new();
    let mut before: Option<(u32, Pose)> = None;
    for time in times {
        // The last image is a moment later than the last odometry.
        let pose = reckoned.at(time).or(end).ok_or("the drive is empty")?;
        let id = graph.add_pose(pose);
        ids.insert(time.to_bits(), id);
        if let Some((from, last)) = before {
            let measured = last.between(pose);
            let [least, turn] = STRETCH;
            let error = least + WAY_ERROR * measured.position.coords.norm();
            graph.add_edge(edge(
                from,
                id,
                measured,
                [error, error, turn],
                PoseEdgeKind::Odometry,
            ))?;
        }
        before = Some((id, pose));
    }
    let mut edges: BTreeMap<u32, PlaceMatch> = BTreeMap::new();
    for one in matches {
        let [from, to] = [one.earlier, one.time].map(|time| ids[&time.to_bits()]);
        let [then, now] = [from, to].map(|id| graph.poses()[id as usize]);
        // An omnidirectional camera does not show its heading; the gyroscope gives it.
        let turned = Pose::new(Pose::IDENTITY.position, then.between(now).heading);
        edges.insert(graph.edges().len() as u32, *one);
        graph.add_edge(edge(from, to, turned, SEEN, PoseEdgeKind::Closure))?;
    }
    let mut config = AuditConfig::standard();
    config.near = NEAR;
    let audit = audit(&graph, &config)?;
    let supported = audit
        .closures
        .iter()
        .filter(|one| one.verdict.is_supported());
    Ok(supported
        .filter_map(|one| edges.get(&one.edge).copied())
        .collect())
}

fn edge(from: u32, to: u32, measured: Pose, errors: [f64; 3], kind: PoseEdgeKind) -> PoseEdge {
    PoseEdge {
        from,
        to,
        measured,
        information: information(errors),
        kind,
    }
}
