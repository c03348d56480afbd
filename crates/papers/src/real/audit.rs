//! Audits of pose graphs with added false closures, compared with graduated non-convexity.

use std::io::Read;
use std::path::Path;
use std::time::Instant;

use flate2::read::GzDecoder;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_experiment::{
    BoxError, Fields, Job, Metric, Options, Record, Row, Table, record, require,
};
use tolman_formats::{G2o, G2oEdge};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::audit::{Audit, AuditConfig, ClosureVerdict, audit, errors_of_witnesses, verify};
use tolman_maps::pose_graph::{PoseEdgeKind, PoseGraph};

use super::GraphFile;
use super::false_closures::{Kind, Spoiler};
use super::gnc::Gnc;
use crate::data;
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "audit";

/// Number of false closures added to external graphs.
const MANY: usize = 1000;

/// Number of false closures added to the project's own small graph.
const FEW: usize = 40;

/// The project's own graph and its true poses.
const ROOMS: &str = include_str!("../../mazes/graphs/rooms.g2o");
const ROOMS_TRUTH: &str = include_str!("../../mazes/graphs/rooms-truth.g2o");

/// A graph with its true poses.
#[derive(Debug)]
struct Known {
    name: &'static str,
    /// Factor for the stated standard deviations.
    scale: f64,
    false_closures: usize,
    /// The right part of the file, and its true poses; `None` if the file is missing.
    graph: Option<(GraphFile, Vec<Pose>)>,
}

/// The graphs that are here.
#[derive(Debug)]
pub(super) struct Graphs {
    known: Vec<Known>,
    gnc: Option<Gnc>,
}

record! {
    /// An audit of a graph with added false closures.
    #[check(AuditRun::relations)]
    struct AuditRun {
        /// Number of false closures that are called supported.
        false_supported: u32 => lower("false supported"),
        /// Number of right closures that are called refuted.
        true_refuted: u32 => lower("right refuted"),
        /// Number of certificates whose bound is broken by others than the closure in question.
        /// Their cycle exceeds its bound even if all other closures are replaced by the truth.
        /// These are refuted right closures, and witnesses with errors beyond their bounds.
        bounds_broken: u32 => lower("bounds broken"),
        /// Share of false closures that are refuted.
        false_refuted_percent: f64 => higher("false refuted").percent().decimals(1),
        /// Share of right closures that are supported; no value if there are none.
        true_supported_percent: Option<f64> => higher("right supported").percent().decimals(1),
        /// Time of the audit over that of GTSAM's graduated non-convexity, on the same graph with
        /// the same standard deviations. GTSAM is stopped after ten minutes, or after a minute plus
        /// 40 times as long as the audit. The ratio is then an upper bound.
        seconds_over_gtsam: Option<f64> => lower("time over GTSAM's").at_least(0).decimals(3),
        /// Number of false closures that GTSAM keeps; no value if it was stopped.
        gtsam_false_kept: Option<u32> => lower("GTSAM keeps false"),
        /// Number of right closures that GTSAM drops; no value if it was stopped.
        gtsam_true_dropped: Option<u32> => lower("GTSAM drops right"),
        /// Number of false closures that were added; fewer if the graph has no room for them.
        added: u32 => neither("added").decimals(0),
    }
}

impl AuditRun {
    fn relations(&self) -> Result<(), String> {
        require(
            self.bounds_broken >= self.true_refuted,
            "right closures are refuted, but fewer bounds are said to be broken",
        )
    }
}

pub(super) fn table(graphs: &Graphs, options: &Options) -> Table {
    let runs = options.runs_else(3, 1);
    let rows = graphs.known.iter().flat_map(|known| {
        Kind::ALL.map(|(_, kind)| {
            let row = Row::new(format!("{} · {}", known.name, kind)).runs(runs);
            match known.graph {
                Some(_) => row,
                None => row.missing(MISSING),
            }
        })
    });
    let gtsam = match graphs.gnc {
        Some(_) => "",
        None => {
            " GTSAM is not here, so nothing is compared with it: pip install gtsam, or name a Python that has it in TOLMAN_PYTHON."
        }
    };
    Table::of::<AuditRun>(NAME, "Pose graphs with false closures, audited")
        .metrics_from(AuditRun::false_supported)
        .metric(Metric::greatest("worst_false_supported", AuditRun::false_supported).titled("false supported, worst run"))
        .rows(rows)
        .note(format!(
            "{MANY} false closures of each kind are added to a graph, {FEW} to the project's own \
             `rooms`. A closure is false if it is off by more than 1 m or 20°. Those of the kind \
             near are off by less, but beyond five standard deviations. Groups are 10 to 20 \
             consecutive pairs that agree with each other. Stated standard deviations are multiplied \
             by {MANHATTAN_SCALE} for manhattan, whose file understates its information, and by 1 \
             for the others.{gtsam}"
        ))
}

const MANHATTAN_SCALE: f64 = 0.16;

const MISSING: &str = "it is a pose graph of the Vertigo project (OpenSLAM); put it into `graphs` of the folder that TOLMAN_DATA names";

impl Graphs {
    /// Returns the graphs that are here.
    ///
    /// # Errors
    /// If one that is here cannot be read.
    pub(super) fn find() -> Result<Self, BoxError> {
        let folder = data::folder().map(|folder| folder.join("graphs"));
        let folder = folder.as_deref();
        let manhattan = of_others(folder, "manhattanOlson3500.g2o.gz", |folder, _| {
            let truth = folder.join("manhattanOlson3500_nodes_groundTruth.dat.gz");
            poses_of_lines(&unpacked(&truth)?)
        })?;
        // All its closures are right, and its poses are optimized with them.
        let intel = of_others(folder, "intel.g2o.gz", |_, graph| Ok(graph.poses()))?;
        let ring = of_others(folder, "ring.g2o.gz", |folder, _| {
            Ok(GraphFile::read(&folder.join("ring_groundtruth.g2o.gz"))?.poses())
        })?;
        let known = |name, graph| Known {
            name,
            scale: 1.0,
            false_closures: MANY,
            graph,
        };
        Ok(Self {
            known: vec![
                Known {
                    scale: MANHATTAN_SCALE,
                    ..known("manhattan", manhattan)
                },
                known("intel", intel),
                known("ring", ring),
                Known {
                    false_closures: FEW,
                    ..known("rooms", Some(rooms()?))
                },
            ],
            gnc: Gnc::find(),
        })
    }

    /// Returns the message about missing data; `None` if nothing is missing.
    pub(super) fn missing(&self) -> Option<String> {
        let missing = self.known.iter().any(|known| known.graph.is_none());
        missing.then(|| data::missing("the pose graphs of the Vertigo project"))
    }

    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (name, kind) = job
            .row
            .split_once(" · ")
            .ok_or("a row is a graph · a kind")?;
        let (kind, _) = row_of(job, Kind::ALL, |(_, name)| *name == kind)?;
        let known = row_of(job, &self.known, |known| known.name == name)?;
        let Some((file, truth)) = &known.graph else {
            return Err(format!("the graph {name} is not here").into());
        };
        Ok(self.measure(known, file, truth, kind, job)?.fields()?)
    }

    fn measure(
        &self,
        known: &Known,
        file: &GraphFile,
        truth: &[Pose],
        kind: Kind,
        job: &Job<'_>,
    ) -> Result<AuditRun, BoxError> {
        let mut config = AuditConfig::standard();
        config.sigma_scale = known.scale;
        let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
        let added = Spoiler::new(&file.graph, truth).draw(kind, known.false_closures, &mut rng);
        let mut graph = file.graph.clone();
        for edge in &added {
            graph.add_edge(*edge)?;
        }
        let right = file.graph.edges().len() as u32;
        let start = Instant::now();
        let audited = audit(&graph, &config)?;
        let seconds = start.elapsed().as_secs_f64();
        verify(&graph, &config, &audited)?;
        let errors = errors_of_witnesses(&graph, &config, &audited, truth)?;
        let most = config.bound * config.bound;
        let broken = errors
            .iter()
            .filter(|(edge, chi2)| *edge < right || *chi2 > most);
        let counts = Counts::of(&audited, right);
        let mut run = AuditRun {
            false_supported: counts.false_supported,
            true_refuted: counts.true_refuted,
            bounds_broken: broken.count() as u32,
            false_refuted_percent: percent(counts.false_refuted, added.len() as u32).unwrap_or(0.0),
            true_supported_percent: percent(counts.true_supported, counts.right),
            added: added.len() as u32,
            ..AuditRun::default()
        };
        // The project's own graph is too small to measure times.
        if let Some(gnc) = self.gnc.as_ref().filter(|_| known.false_closures == MANY) {
            let found = gnc.run(&g2o_of(file, &graph), right, known.scale, seconds)?;
            run.seconds_over_gtsam = Some(seconds / found.seconds);
            run.gtsam_false_kept = found.false_kept;
            run.gtsam_true_dropped = found.true_dropped;
        }
        Ok(run)
    }
}

/// Counts of closures by verdict and truth.
#[derive(Default)]
struct Counts {
    right: u32,
    false_supported: u32,
    true_refuted: u32,
    false_refuted: u32,
    true_supported: u32,
}

impl Counts {
    /// Returns the counts of an audit whose edges from `right` on are false.
    fn of(audit: &Audit, right: u32) -> Self {
        let mut counts = Self::default();
        for closure in &audit.closures {
            let is_right = closure.edge < right;
            counts.right += u32::from(is_right);
            match (&closure.verdict, is_right) {
                (ClosureVerdict::Supported { .. }, true) => counts.true_supported += 1,
                (ClosureVerdict::Supported { .. }, false) => counts.false_supported += 1,
                (ClosureVerdict::Refuted { .. }, true) => counts.true_refuted += 1,
                (ClosureVerdict::Refuted { .. }, false) => counts.false_refuted += 1,
                (ClosureVerdict::Undecided(_), _) => {}
            }
        }
        counts
    }
}

fn percent(part: u32, whole: u32) -> Option<f64> {
    (whole > 0).then(|| 100.0 * f64::from(part) / f64::from(whole))
}

/// Returns a graph with its false closures as the contents of a file.
fn g2o_of(file: &GraphFile, graph: &PoseGraph) -> G2o {
    let id = |pose: u32| file.file.poses[pose as usize].id;
    let edges = graph.edges().iter().map(|edge| G2oEdge {
        from: id(edge.from),
        to: id(edge.to),
        measured: edge.measured,
        information: edge.information,
        line: 0,
    });
    G2o {
        edges: edges.collect(),
        ..file.file.clone()
    }
}

/// Returns an external graph with its true poses, if both are here.
fn of_others(
    folder: Option<&Path>,
    name: &str,
    truth: impl Fn(&Path, &GraphFile) -> Result<Vec<Pose>, BoxError>,
) -> Result<Option<(GraphFile, Vec<Pose>)>, BoxError> {
    let Some(folder) = folder.filter(|folder| folder.join(name).is_file()) else {
        return Ok(None);
    };
    let graph = GraphFile::read(&folder.join(name))?;
    let truth = truth(folder, &graph)?;
    if truth.len() != graph.file.poses.len() {
        return Err(format!(
            "{name} has {} poses, its truth {}",
            graph.file.poses.len(),
            truth.len()
        )
        .into());
    }
    Ok(Some((graph, truth)))
}

fn unpacked(path: &Path) -> Result<String, BoxError> {
    let mut text = String::new();
    GzDecoder::new(std::fs::File::open(path)?).read_to_string(&mut text)?;
    Ok(text)
}

/// Returns poses from lines of x, y and heading.
fn poses_of_lines(text: &str) -> Result<Vec<Pose>, BoxError> {
    let pose = |line: &str| -> Result<Pose, BoxError> {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(str::parse)
            .collect::<Result<_, _>>()?;
        let [x, y, heading] = numbers[..] else {
            return Err(format!("`{line}` is not x, y and a heading").into());
        };
        Ok(Pose::new(Point::new(x, y), Heading::from_radians(heading)))
    };
    text.lines()
        .filter(|line| !line.trim().is_empty())
        .map(pose)
        .collect()
}

/// Returns the project's own graph without the false closures in its file.
fn rooms() -> Result<(GraphFile, Vec<Pose>), BoxError> {
    let of = |file| {
        GraphFile::of(file).map_err(|(line, error)| BoxError::from(format!("line {line}: {error}")))
    };
    let all = of(G2o::parse(ROOMS)?)?;
    let truth = of(G2o::parse(ROOMS_TRUTH)?)?.poses();
    let mut file = all.file.clone();
    let is_right = all.graph.edges().iter().map(|edge| {
        let [from, to] = [edge.from, edge.to].map(|pose| truth[pose as usize]);
        edge.kind == PoseEdgeKind::Odometry
            || !super::false_closures::is_false(edge.measured, from.between(to))
    });
    let mut is_right = is_right.collect::<Vec<bool>>().into_iter();
    file.edges.retain(|_| is_right.next().unwrap_or(true));
    Ok((of(file)?, truth))
}
