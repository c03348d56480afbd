//! Tests the findings of an audit, and that its certificates can be checked again.

use proptest::prelude::*;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::audit::{
    Audit, AuditConfig, AuditCycle, ClosureVerdict, CycleStep, RefutedBy, SigmaScale,
    UndecidedBecause, audit, errors_of_witnesses, supported_graph, verify,
};
use tolman_maps::geom::nalgebra::{Matrix3, Vector3};
use tolman_maps::geom::{Heading, Point, Pose};
use tolman_maps::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};

use crate::pinned::pinned;

const SIGMA: f64 = 0.02;

/// Poses round a square of 8 m, a metre apart, lap after lap, with measurements that err by
/// `errors` standard deviations.
struct Laps {
    truth: Vec<Pose>,
    graph: PoseGraph,
}

fn pose(x: f64, y: f64, heading: f64) -> Pose {
    Pose::new(Point::new(x, y), Heading::from_radians(heading))
}

fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let sum: f64 = (0..12)
        .map(|_| f64::from(rng.random::<u32>()) / f64::from(u32::MAX))
        .sum();
    sum - 6.0
}

fn edge(from: u32, to: u32, measured: Pose, kind: PoseEdgeKind) -> PoseEdge {
    let weight = (SIGMA * SIGMA).recip();
    let information = Matrix3::from_diagonal(&Vector3::new(weight, weight, weight));
    PoseEdge {
        from,
        to,
        measured,
        information,
        kind,
    }
}

impl Laps {
    /// Returns a graph in which every fifth pose after the first lap has a closure to its place of
    /// the lap before. Each closure is a run of its own.
    fn new(laps: u32, errors: f64, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut erring = |measured: Pose| {
            let off = [(); 3].map(|()| SIGMA * errors * normal(&mut rng));
            measured.compose(pose(off[0], off[1], off[2]))
        };
        let step = |pose: u32| match pose % 8 {
            7 => self::pose(1.0, 0.0, core::f64::consts::FRAC_PI_2),
            _ => self::pose(1.0, 0.0, 0.0),
        };
        let (mut truth, mut graph) = (vec![Pose::IDENTITY], PoseGraph::new());
        graph.add_pose(Pose::IDENTITY);
        for to in 1..32 * laps {
            let moved = step(to - 1);
            truth.push(truth[to as usize - 1].compose(moved));
            graph.add_pose(Pose::IDENTITY);
            let edge = edge(to - 1, to, erring(moved), PoseEdgeKind::Odometry);
            graph.add_edge(edge).unwrap();
        }
        for to in (32..32 * laps).step_by(5) {
            let measured = truth[to as usize - 32].between(truth[to as usize]);
            let (from, kind) = (to - 32, PoseEdgeKind::Closure);
            // Either way round.
            let closure = match to % 2 {
                0 => edge(from, to, erring(measured), kind),
                _ => edge(to, from, erring(measured.inverse()), kind),
            };
            graph.add_edge(closure).unwrap();
        }
        Self { truth, graph }
    }

    /// Returns a graph with `count` false closures between poses that are far apart, and the number
    /// of its right edges.
    fn spoiled(laps: u32, count: u32, seed: u64) -> (Self, u32) {
        let mut made = Self::new(laps, 1.0, seed);
        let right = made.graph.edges().len() as u32;
        let mut rng = ChaCha8Rng::seed_from_u64(seed + 1000);
        let mut left = count;
        while left > 0 {
            let [a, b] = [(); 2].map(|()| rng.random_range(0..32 * laps));
            let far = (made.truth[a as usize].position - made.truth[b as usize].position).norm();
            if a.abs_diff(b) > 1 && far > 2.0 {
                let lie = pose(0.1 * normal(&mut rng), 0.1 * normal(&mut rng), 0.0);
                made.graph
                    .add_edge(edge(a, b, lie, PoseEdgeKind::Closure))
                    .unwrap();
                left -= 1;
            }
        }
        (made, right)
    }
}

fn kind(verdict: &ClosureVerdict) -> &'static str {
    match verdict {
        ClosureVerdict::Supported { .. } => "supported",
        ClosureVerdict::Refuted { .. } => "refuted",
        ClosureVerdict::Undecided(_) => "undecided",
    }
}

/// Closures 5 m apart are runs of their own here, and the wheels err at random over any way.
const CONFIG: AuditConfig = {
    let mut config = AuditConfig::standard();
    config.run_way = 4.0;
    config.white_way = f64::INFINITY;
    config
};

#[test]
fn one_drive_is_one_witness_however_seldom_it_closes() {
    for spacing in [3, 4, 5, 7, 12] {
        // Two corridors at right angles that look alike: the second is taken for the first.
        let mut graph = PoseGraph::new();
        graph.add_pose(Pose::IDENTITY);
        for to in 1..240 {
            let turn = if to % 60 == 0 {
                core::f64::consts::FRAC_PI_2
            } else {
                0.0
            };
            graph.add_pose(Pose::IDENTITY);
            let moved = edge(to - 1, to, pose(1.0, 0.0, turn), PoseEdgeKind::Odometry);
            graph
                .add_edge(PoseEdge {
                    information: moved.information * 0.002,
                    ..moved
                })
                .unwrap();
        }
        for at in (0..50_u32).step_by(spacing) {
            let same = edge(at + 5, at + 185, Pose::IDENTITY, PoseEdgeKind::Closure);
            graph.add_edge(same).unwrap();
        }
        let found = audit(&graph, &AuditConfig::standard()).unwrap();
        assert_eq!(
            (found.runs, found.count(ClosureVerdict::is_supported)),
            (1, 0),
            "{spacing}"
        );
    }
}

#[test]
fn long_odometry_by_itself_does_not_refute_what_lies_a_hair_beyond_it() {
    let mut graph = PoseGraph::new();
    graph.add_pose(Pose::IDENTITY);
    for to in 1..2000 {
        graph.add_pose(Pose::IDENTITY);
        let moved = edge(to - 1, to, pose(1.0, 0.0, 0.0), PoseEdgeKind::Odometry);
        graph.add_edge(moved).unwrap();
    }
    // Along the way the standard deviation is 0.02 m times the root of the steps.
    let off = |deviations: f64| 1989.0 + deviations * SIGMA * 1989_f64.sqrt();
    for at in 0..10 {
        let closure = edge(
            at,
            at + 1989,
            pose(off(5.3), 0.0, 0.0),
            PoseEdgeKind::Closure,
        );
        graph.add_edge(closure).unwrap();
    }
    let found = audit(&graph, &AuditConfig::standard()).unwrap();
    assert_eq!(found.count(ClosureVerdict::is_refuted), 0);
    assert_eq!(found.count(ClosureVerdict::is_supported), 0);
    let far = edge(3, 1992, pose(off(20.0), 0.0, 0.0), PoseEdgeKind::Closure);
    graph.add_edge(far).unwrap();
    let found = audit(&graph, &AuditConfig::standard()).unwrap();
    assert_eq!(found.count(ClosureVerdict::is_refuted), 1);
}

#[test]
fn right_closures_are_never_refuted_and_mostly_supported() {
    for seed in 0..12 {
        let laps = Laps::new(5, 1.0, seed);
        let found = audit(&laps.graph, &CONFIG).unwrap();
        assert_eq!(found.count(ClosureVerdict::is_refuted), 0, "seed {seed}");
        let supported = found.count(ClosureVerdict::is_supported);
        assert!(10 * supported > 9 * found.closures.len(), "{supported}");
    }
}

#[test]
fn false_closures_are_refuted_and_never_supported() {
    for seed in 0..12 {
        let (laps, right) = Laps::spoiled(5, 60, seed);
        let found = audit(&laps.graph, &CONFIG).unwrap();
        for closure in &found.closures {
            let is_right = closure.edge < right;
            let verdict = kind(&closure.verdict);
            assert!(
                verdict != if is_right { "refuted" } else { "supported" },
                "seed {seed}: {closure:?}"
            );
        }
        let refuted = found.count(ClosureVerdict::is_refuted);
        assert!(refuted >= 54, "{refuted} of 60");
        for (_, chi2) in errors_of_witnesses(&laps.graph, &CONFIG, &found, &laps.truth).unwrap() {
            assert!(chi2 <= 25.0, "{chi2}");
        }
        verify(&laps.graph, &CONFIG, &found).unwrap();
    }
}

#[test]
fn a_single_run_is_no_witness_of_itself() {
    // Twenty false closures in a row that agree with each other, after a way too long for odometry
    // to tell.
    let mut laps = Laps::new(12, 1.0, 4);
    let all: Vec<PoseEdge> = laps.graph.edges().to_vec();
    laps.graph = PoseGraph::new();
    for _ in &laps.truth {
        laps.graph.add_pose(Pose::IDENTITY);
    }
    for edge in all
        .iter()
        .filter(|edge| edge.kind == PoseEdgeKind::Odometry)
    {
        laps.graph.add_edge(*edge).unwrap();
    }
    // Half a square on, turned by half a turn: it looks the same.
    for from in 0..20 {
        let closure = edge(from, from + 336, Pose::IDENTITY, PoseEdgeKind::Closure);
        laps.graph.add_edge(closure).unwrap();
    }
    let found = audit(&laps.graph, &CONFIG).unwrap();
    assert_eq!(found.runs, 1);
    for closure in &found.closures {
        let reason = &closure.verdict;
        let is_alone = matches!(
            reason,
            ClosureVerdict::Refuted {
                by: RefutedBy::Odometry,
                ..
            } | ClosureVerdict::Undecided(UndecidedBecause::SingleRun { closures: 20 })
        );
        assert!(is_alone, "{reason:?}");
    }
}

#[test]
fn the_order_of_the_edges_does_not_matter() {
    let (laps, _) = Laps::spoiled(4, 30, 5);
    let found = audit(&laps.graph, &CONFIG).unwrap();
    let mut edges: Vec<PoseEdge> = laps.graph.edges().to_vec();
    edges.shuffle(&mut ChaCha8Rng::seed_from_u64(1));
    let mut shuffled = PoseGraph::new();
    for _ in &laps.truth {
        shuffled.add_pose(Pose::IDENTITY);
    }
    for edge in &edges {
        shuffled.add_edge(*edge).unwrap();
    }
    let again = audit(&shuffled, &CONFIG).unwrap();
    for closure in &again.closures {
        let was = edges[closure.edge as usize];
        let before = found
            .closures
            .iter()
            .find(|before| laps.graph.edges()[before.edge as usize] == was);
        assert_eq!(kind(&before.unwrap().verdict), kind(&closure.verdict));
    }
}

#[test]
fn the_scale_of_the_standard_deviations_is_estimated() {
    let laps = Laps::new(30, 0.2, 9);
    let scale = SigmaScale::estimate(&laps.graph).unwrap().unwrap();
    assert!(
        (0.15..0.25).contains(&scale.estimate) && !scale.is_heavy(),
        "{scale:?}"
    );
    assert!((scale.scale() - scale.estimate).abs() < 1e-12);
    // The scale bears false closures.
    let mut graph = laps.graph;
    for to in (64..900).step_by(60) {
        let closure = edge(to - 32, to, pose(5.0, 0.0, 0.0), PoseEdgeKind::Closure);
        graph.add_edge(closure).unwrap();
    }
    let borne = SigmaScale::estimate(&graph).unwrap().unwrap();
    let share = borne.scale() / scale.scale();
    assert!((0.8..1.5).contains(&share), "{borne:?}");
    // A heavy tail raises it.
    let heavy = SigmaScale {
        tail: 48.0,
        ..scale
    };
    assert!(heavy.is_heavy() && heavy.scale() > 3.0 * scale.estimate);
    assert_eq!(
        SigmaScale::estimate(&Laps::new(1, 1.0, 0).graph).unwrap(),
        None
    );
}

#[test]
fn a_graph_in_two_pieces_is_joined_by_its_closures() {
    // Without the odometry from lap to lap, as two robots have it.
    let laps = Laps::new(3, 1.0, 2);
    let mut graph = PoseGraph::new();
    for _ in &laps.truth {
        graph.add_pose(Pose::IDENTITY);
    }
    for edge in laps
        .graph
        .edges()
        .iter()
        .filter(|edge| edge.to != 32 || edge.from != 31)
    {
        graph.add_edge(*edge).unwrap();
    }
    let found = audit(&graph, &CONFIG).unwrap();
    assert_eq!(found.count(ClosureVerdict::is_refuted), 0);
    assert!(found.count(ClosureVerdict::is_supported) > 5);
    verify(&graph, &CONFIG, &found).unwrap();
}

fn scaled(scale: f64) -> AuditConfig {
    let mut config = CONFIG;
    config.sigma_scale = scale;
    config
}

#[test]
fn what_cannot_be_audited_says_why() {
    let laps = Laps::new(2, 0.0, 0);
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = audit(&laps.graph, &scaled(scale)).unwrap_err();
        assert!(error.to_string().contains("sigma scale"), "{error}");
    }
    let mut graph = laps.graph;
    graph
        .add_edge(edge(3, 9, Pose::IDENTITY, PoseEdgeKind::Odometry))
        .unwrap();
    let error = audit(&graph, &CONFIG).unwrap_err();
    assert!(error.to_string().contains("from pose 3 to 9"), "{error}");
    let empty = audit(&PoseGraph::new(), &CONFIG).unwrap();
    assert!(empty.closures.is_empty());
}

#[test]
fn the_supported_graph_lies_as_the_truth_does() {
    let (laps, _) = Laps::spoiled(4, 40, 3);
    let found = audit(&laps.graph, &CONFIG).unwrap();
    let laid_out = supported_graph(&laps.graph, &CONFIG, &found);
    for (pose, truth) in laid_out.poses().iter().zip(&laps.truth) {
        assert!(
            (pose.position - truth.position).norm() < 2.0,
            "{pose:?} {truth:?}"
        );
    }
}

/// One change of a certificate.
#[derive(Clone, Copy, Debug)]
enum Change {
    Edge,
    Run,
    Residual(usize),
    Covariance(usize),
    Chi2,
    From(usize),
    To(usize),
    Over(usize),
    FewerSteps,
    Swapped,
    By,
    Twice,
}

const CHANGES: [Change; 18] = [
    Change::Edge,
    Change::Run,
    Change::Residual(0),
    Change::Residual(1),
    Change::Residual(2),
    Change::Covariance(0),
    Change::Covariance(1),
    Change::Covariance(5),
    Change::Chi2,
    Change::From(0),
    Change::From(1),
    Change::To(0),
    Change::To(1),
    Change::Over(0),
    Change::FewerSteps,
    Change::Swapped,
    Change::By,
    Change::Twice,
];

fn step(cycle: &mut AuditCycle, which: usize) -> &mut CycleStep {
    let which = which % cycle.steps.len();
    &mut cycle.steps[which]
}

/// Changes one field of one certificate; returns whether there was something to change.
fn change(found: &mut Audit, which: usize, change: Change) -> bool {
    let closure = &mut found.closures[which];
    let cycle = match &mut closure.verdict {
        ClosureVerdict::Supported { witnesses } => &mut witnesses[0],
        ClosureVerdict::Refuted { cycle, .. } => cycle,
        ClosureVerdict::Undecided(_) => return false,
    };
    match change {
        Change::Edge => closure.edge += 1,
        Change::Run => closure.run += 1,
        Change::Residual(part) => cycle.residual[part] += 0.01,
        Change::Covariance(part) => cycle.covariance[part] *= 1.01,
        Change::Chi2 => cycle.chi2 = cycle.chi2 * 1.001 + 1e-6,
        Change::From(which) => step(cycle, which).from += 1,
        Change::To(which) => step(cycle, which).to += 1,
        Change::Over(which) => step(cycle, which).over = None,
        Change::FewerSteps => {
            cycle.steps.pop();
        }
        Change::Swapped => {
            closure.verdict = match closure.verdict.clone() {
                ClosureVerdict::Supported { mut witnesses } => ClosureVerdict::Refuted {
                    by: RefutedBy::SupportedClosures,
                    cycle: witnesses.remove(0),
                },
                ClosureVerdict::Refuted { cycle, .. } => ClosureVerdict::Supported {
                    witnesses: vec![cycle],
                },
                undecided => undecided,
            }
        }
        Change::By => match &mut closure.verdict {
            ClosureVerdict::Refuted { by, .. } => {
                *by = match by {
                    RefutedBy::Odometry => RefutedBy::SupportedClosures,
                    RefutedBy::SupportedClosures => RefutedBy::Odometry,
                }
            }
            _ => return false,
        },
        Change::Twice => match &mut closure.verdict {
            ClosureVerdict::Supported { witnesses } => {
                let again = witnesses[0].clone();
                witnesses.push(again);
            }
            _ => {
                let again = closure.clone();
                found.closures.push(again);
            }
        },
    }
    true
}

#[test]
fn no_field_of_a_certificate_can_be_changed() {
    let (laps, _) = Laps::spoiled(3, 12, 8);
    let found = audit(&laps.graph, &CONFIG).unwrap();
    verify(&laps.graph, &CONFIG, &found).unwrap();
    let mut changed = 0;
    for which in 0..found.closures.len() {
        for one in CHANGES {
            let mut forged = found.clone();
            // A residual may be near zero; 0.01 is more than any rounding.
            if change(&mut forged, which, one) {
                changed += 1;
                let held = verify(&laps.graph, &CONFIG, &forged);
                assert!(held.is_err(), "{one:?} of {:?}", found.closures[which]);
            }
        }
    }
    assert!(changed > 200, "{changed}");
    let error = verify(&laps.graph, &scaled(1.1), &found);
    assert!(error.is_err(), "another scale is another covariance");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn exact_measurements_refute_nothing(laps in 2_u32..6, turned in -3.0..3.0_f64) {
        let mut exact = Laps::new(laps, 0.0, 0);
        // Wherever the map lies.
        let whole = pose(5.0, -3.0, turned);
        for id in 0..exact.truth.len() as u32 {
            exact.graph.move_pose(id, whole.compose(exact.truth[id as usize]));
        }
        let found = audit(&exact.graph, &CONFIG).unwrap();
        prop_assert_eq!(found.count(ClosureVerdict::is_refuted), 0);
    }

    #[test]
    fn what_is_refuted_is_off_or_its_witnesses_are(seed in 0_u64..1000, errors in 0.5..3.0_f64) {
        // Measurements that err by more than they say: bounds may break, and then it shows.
        let laps = Laps::new(3, errors, seed);
        let found = audit(&laps.graph, &CONFIG).unwrap();
        verify(&laps.graph, &CONFIG, &found).unwrap();
        for closure in &found.closures {
            if let ClosureVerdict::Refuted { cycle, .. } = &closure.verdict {
                prop_assert!(cycle.chi2 > 25.0);
            }
        }
    }
}

/// Every figure of an audit is pinned.
#[test]
fn an_audit_is_what_it_was() {
    let (laps, _) = Laps::spoiled(3, 12, 3);
    let found = audit(&laps.graph, &CONFIG).unwrap();
    let mut figures = vec![format!(
        "{} {:?}",
        found.runs,
        SigmaScale::estimate(&laps.graph)
    )];
    figures.extend(found.closures.iter().map(|closure| format!("{closure:?}")));
    let supported = supported_graph(&laps.graph, &CONFIG, &found);
    figures.push(format!("{}", supported.edges().len()));
    let poses = supported.poses().iter().step_by(8);
    figures.extend(poses.map(|pose| format!("{pose:?}")));
    let errors = errors_of_witnesses(&laps.graph, &CONFIG, &found, &laps.truth).unwrap();
    figures.push(format!("{errors:?}"));
    pinned("audit", &figures);
}

/// Returns all verdicts of an audit in short.
fn verdicts(found: &Audit) -> impl Iterator<Item = String> + '_ {
    let cycle = |cycle: &AuditCycle| {
        let spread: f64 = cycle.covariance.iter().sum();
        format!("{} {:.6} {spread:.9}", cycle.steps.len(), cycle.chi2)
    };
    found.closures.iter().map(move |closure| {
        let verdict = match &closure.verdict {
            ClosureVerdict::Supported { witnesses } => {
                format!("{} {}", witnesses.len(), cycle(&witnesses[0]))
            }
            ClosureVerdict::Refuted { by, cycle: against } => {
                format!("{by:?} {}", cycle(against))
            }
            ClosureVerdict::Undecided(UndecidedBecause::Contradictory { against, agreeing }) => {
                format!("{} or {}", cycle(against), cycle(agreeing))
            }
            ClosureVerdict::Undecided(because) => format!("{because:?}"),
        };
        format!("{} {} {verdict}", closure.edge, closure.run)
    })
}

/// Audits of graphs that are hard to tell: measurements that err by more than they say, runs of
/// false closures that agree, odometry in two pieces.
#[test]
fn audits_of_doubtful_graphs_are_what_they_were() {
    let mut figures = Vec::new();
    let mut add = |name: &str, graph: &PoseGraph, config: &AuditConfig| {
        let found = audit(graph, config).unwrap();
        verify(graph, config, &found).unwrap();
        figures.push(format!("{name} {}", found.runs));
        figures.extend(verdicts(&found));
    };
    let mut wide = CONFIG;
    wide.tight_share = 1e-4;
    let mut near = CONFIG;
    (near.pair_gap, near.run_gap, near.most_witnesses) = (20, 6, 2);
    for (seed, config) in [(11, scaled(0.4)), (12, wide), (13, near), (14, scaled(1.7))] {
        let (laps, _) = Laps::spoiled(4, 24, seed);
        add("spoiled", &laps.graph, &config);
    }
    for seed in [15, 16] {
        add("beyond", &Laps::new(4, 2.2, seed).graph, &CONFIG);
    }
    // Twelve closures in a row that agree on a place half a square off, among right ones or alone.
    for (laps, is_alone) in [(4, false), (9, false), (9, true)] {
        let made = Laps::new(laps, 1.0, 17);
        let mut graph = PoseGraph::new();
        for _ in &made.truth {
            graph.add_pose(Pose::IDENTITY);
        }
        for edge in made.graph.edges() {
            if !is_alone || edge.kind == PoseEdgeKind::Odometry {
                graph.add_edge(*edge).unwrap();
            }
        }
        for from in 0..12 {
            let to = from + 32 * laps - 48;
            let closure = edge(from, to, Pose::IDENTITY, PoseEdgeKind::Closure);
            graph.add_edge(closure).unwrap();
        }
        add("run", &graph, &CONFIG);
    }
    // Two robots that meet, and one closure between what nothing joins.
    let made = Laps::new(3, 1.0, 18);
    let mut graph = PoseGraph::new();
    for _ in &made.truth {
        graph.add_pose(Pose::IDENTITY);
    }
    for edge in made.graph.edges() {
        let is_join = edge.kind == PoseEdgeKind::Odometry && [32, 64].contains(&edge.to);
        let leads_on = edge.kind == PoseEdgeKind::Closure && edge.from.max(edge.to) >= 64;
        if !(is_join || leads_on) {
            graph.add_edge(*edge).unwrap();
        }
    }
    let lone = edge(5, 70, Pose::IDENTITY, PoseEdgeKind::Closure);
    graph.add_edge(lone).unwrap();
    add("pieces", &graph, &CONFIG);
    pinned("audit_doubtful", &figures);
}
