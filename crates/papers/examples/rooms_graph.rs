//! Drives the laser Pioneer three times round the corridors of `mazes/worlds/rooms.json`. Writes
//! the pose graph of the drive, with false closures, and the true poses: `cargo run -p
//! tolman-papers --example rooms_graph -- mazes/graphs`.

use core::error::Error;
use std::path::Path;
use std::{env, fs};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_formats::{G2o, G2oEdge, G2oPose};
use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Robot, TurnTranslate};
use tolman_sim::noise::Gaussian;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{Solo, World};

/// The way, from corner to corner: all round, then by the passages between, and all round again.
const WAY: &[(f64, f64)] = &[
    (8.5, 0.5),
    (8.5, 3.1),
    (0.5, 3.1),
    (0.5, 0.5),
    (2.7, 0.5),
    (2.7, 3.1),
    (5.5, 3.1),
    (5.5, 0.5),
    (8.5, 0.5),
    (8.5, 3.1),
    (5.5, 3.1),
    (2.7, 3.1),
    (2.7, 0.5),
    (0.5, 0.5),
    (0.5, 3.1),
    (8.5, 3.1),
    (8.5, 0.5),
    (0.5, 0.5),
];

/// Distance between poses, in metres and radians.
const APART: (f64, f64) = (0.3, 0.6);

/// Error of a scan matcher, m and rad. Places nearer than `SEEN` m and rad that were left at least
/// `AGO` poses ago are seen again.
const MATCHED: (f64, f64) = (0.01, 0.005);
const SEEN: (f64, f64) = (0.25, 0.8);
const AGO: usize = 12;

/// Pairs of the places that look alike, each the middle of a corridor like the other.
const ALIKE: [((f64, f64), (f64, f64)); 4] = [
    ((1.6, 0.5), (4.1, 0.5)),
    ((2.7, 1.8), (5.5, 1.8)),
    ((1.6, 3.1), (4.1, 3.1)),
    ((0.5, 1.8), (8.5, 1.8)),
];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1).ok_or("name the folder to write to")?;
    let (truth, steps) = drive()?;
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut edges = steps;
    edges.extend(closures(&truth, &mut rng));
    edges.extend(false_closures(&truth, &mut rng));
    let mut reckoned = vec![truth[0]];
    for step in &edges[..truth.len() - 1] {
        reckoned.push(reckoned[step.from as usize].compose(step.measured));
    }
    let graph = |poses: &[Pose], edges: Vec<G2oEdge>| G2o {
        poses: (0..)
            .zip(poses)
            .map(|(id, pose)| G2oPose {
                id,
                pose: rounded(*pose),
            })
            .collect(),
        edges,
        fixed: vec![0],
        left_out: Vec::new(),
    };
    let steps = edges[..truth.len() - 1].to_vec();
    let folder = Path::new(&folder);
    fs::write(folder.join("rooms.g2o"), graph(&reckoned, edges).text())?;
    fs::write(folder.join("rooms-truth.g2o"), graph(&truth, steps).text())?;
    Ok(())
}

/// Drives through the rooms. Returns the true poses and the odometry edges between them.
fn drive() -> Result<(Vec<Pose>, Vec<G2oEdge>), Box<dyn Error>> {
    let world = World::from_json(include_str!("../mazes/worlds/rooms.json"))?;
    let mut config = LaserPioneerConfig::noiseless();
    config.turn_per_step = 0.1;
    config.translate_per_step = 0.05;
    config.odometry_distance_noise = Gaussian {
        absolute_sd: 0.002,
        ..Gaussian::NONE
    };
    config.odometry_turn_noise = Gaussian {
        absolute_sd: 0.003,
        ..Gaussian::NONE
    };
    let start = Pose::new(Point::new(0.5, 0.5), Heading::EAST);
    let mut solo = Solo::new(world, LaserPioneer::new(config)?, start, 7)?;
    let (mut truth, mut edges) = (vec![start], Vec::new());
    let (mut rolled, mut steps) = (Pose::IDENTITY, 0_u32);
    for corner in WAY.iter().map(|(x, y)| Point::new(*x, *y)) {
        while (corner - solo.truth().pose.position).norm() > 0.08 {
            let pose = solo.truth().pose;
            let way = corner - pose.position;
            let turn = pose.heading.turn_to(Heading::of(way));
            let ahead = if turn.abs() < 0.3 {
                (way.norm() / 0.05).min(1.0)
            } else {
                0.0
            };
            solo.step(&TurnTranslate {
                turn: (turn / 0.1).clamp(-1.0, 1.0),
                translate: ahead,
            })?;
            rolled = solo
                .sensing()
                .odometry
                .map_or(rolled, |odometry| odometry.applied_to(rolled));
            steps += 1;
            let moved = truth[truth.len() - 1].between(solo.truth().pose);
            if moved.position.coords.norm() > APART.0 || moved.heading.radians().abs() > APART.1 {
                // Error of the odometry over the steps, and a little more in a bend.
                let many = f64::from(steps);
                let (along, turn) = (0.003 * many.sqrt(), 0.003 * many.sqrt());
                edges.push(edge(truth.len() - 1, truth.len(), rolled, along, turn));
                truth.push(solo.truth().pose);
                (rolled, steps) = (Pose::IDENTITY, 0);
            }
        }
    }
    Ok((truth, edges))
}

/// Returns closures at places seen again, matched nearly right.
fn closures(truth: &[Pose], rng: &mut ChaCha8Rng) -> Vec<G2oEdge> {
    let mut closures = Vec::new();
    for to in AGO..truth.len() {
        let seen = |from: &usize| {
            let off = truth[*from].between(truth[to]);
            off.position.coords.norm() < SEEN.0 && off.heading.radians().abs() < SEEN.1
        };
        if let Some(from) = (0..=to - AGO).find(seen) {
            let measured = truth[from].between(truth[to]).compose(error(MATCHED, rng));
            closures.push(edge(from, to, measured, MATCHED.0, MATCHED.1));
        }
    }
    closures
}

/// Returns false closures between places that look alike: one pair alone, the others in runs of
/// three.
fn false_closures(truth: &[Pose], rng: &mut ChaCha8Rng) -> Vec<G2oEdge> {
    let nearest = |(x, y): (f64, f64)| {
        let off = |pose: &Pose| (pose.position - Point::new(x, y)).norm();
        let all = 1..truth.len() - 3;
        all.min_by(|a, b| off(&truth[*a]).total_cmp(&off(&truth[*b])))
    };
    let mut closures = Vec::new();
    for (index, (one, other)) in ALIKE.into_iter().enumerate() {
        let (Some(one), Some(other)) = (nearest(one), nearest(other)) else {
            continue;
        };
        for step in 0..if index == 0 { 1 } else { 3 } {
            let (from, to) = (one.min(other) + step, one.max(other) + step);
            closures.push(edge(
                from,
                to,
                error((0.1, 0.05), rng),
                MATCHED.0,
                MATCHED.1,
            ));
        }
    }
    closures
}

fn edge(from: usize, to: usize, measured: Pose, metres: f64, radians: f64) -> G2oEdge {
    let (place, turn) = (
        (metres * metres).recip().round(),
        (radians * radians).recip().round(),
    );
    G2oEdge {
        from: from as u64,
        to: to as u64,
        measured: rounded(measured),
        information: Matrix3::from_diagonal(&Vector3::new(place, place, turn)),
        line: 0,
    }
}

/// Returns a pose to a hundredth of a millimetre, so that the file stays small.
fn rounded(pose: Pose) -> Pose {
    let round = |number: f64| (number * 1e5).round() / 1e5;
    let position = Point::new(round(pose.position.x), round(pose.position.y));
    Pose::new(
        position,
        Heading::from_radians(round(pose.heading.radians())),
    )
}

/// Returns a small random motion (twelve uniform numbers add up to nearly a normal one).
fn error((metres, radians): (f64, f64), rng: &mut ChaCha8Rng) -> Pose {
    let mut normal = || {
        let sum: f64 = (0..12)
            .map(|_| f64::from(rng.random::<u32>()) / f64::from(u32::MAX))
            .sum();
        sum - 6.0
    };
    let place = Point::new(metres * normal(), metres * normal());
    Pose::new(place, Heading::from_radians(radians * normal()))
}
