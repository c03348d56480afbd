//! Drives the laser Pioneer twice round a simulated office and writes the CARMEN log of it:
//! `cargo run -p tolman-papers --example office_log | gzip -9n > logs/office.clf.gz`.
#![expect(clippy::print_stdout, reason = "the log goes to standard output")]

use core::error::Error;
use core::f64::consts::PI;

use tolman_geom::{Point, Pose, Vector};
use tolman_robot::{LaserSensing, Odometry, Ring, Robot, TurnTranslate};
use tolman_sim::noise::Gaussian;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{Solo, WallSegment, World};

/// The corners of walls, each list joined in order.
const WALLS: &[&[(f64, f64)]] = &[
    &[
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 6.0),
        (20.6, 6.0),
        (20.6, 7.2),
        (20.0, 7.2),
        (20.0, 14.0),
    ],
    &[
        (20.0, 14.0),
        (13.0, 14.0),
        (13.0, 14.5),
        (11.5, 14.5),
        (11.5, 14.0),
        (0.0, 14.0),
        (0.0, 9.0),
    ],
    &[(0.0, 9.0), (0.4, 9.0), (0.4, 8.5), (0.0, 8.5), (0.0, 0.0)],
    &[
        (8.0, 2.5),
        (2.5, 2.5),
        (2.5, 11.5),
        (7.0, 11.5),
        (7.0, 11.1),
        (8.0, 11.1),
        (8.0, 11.5),
    ],
    &[
        (8.0, 11.5),
        (17.5, 11.5),
        (17.5, 8.0),
        (17.0, 8.0),
        (17.0, 7.0),
        (17.5, 7.0),
        (17.5, 2.5),
    ],
    &[(17.5, 2.5), (9.2, 2.5)],
    &[(10.5, 2.5), (10.5, 8.5), (4.0, 8.5)],
    &[(5.0, 4.0), (5.6, 4.0), (5.6, 4.6), (5.0, 4.6), (5.0, 4.0)],
];

/// The way, from corner to corner: round the corridor, into the room, and round again.
const WAY: &[(f64, f64)] = &[
    (18.7, 1.2),
    (18.7, 12.7),
    (1.2, 12.7),
    (1.2, 1.2),
    (8.6, 1.2),
    (8.6, 6.5),
    (4.0, 6.5),
    (8.6, 6.5),
    (8.6, 1.2),
    (18.7, 1.2),
    (18.7, 12.7),
    (1.2, 12.7),
    (1.2, 1.2),
    (6.0, 1.2),
];

/// Minimum distance (m) and turn (rad) between two scans.
const APART: (f64, f64) = (0.4, 0.35);

fn main() -> Result<(), Box<dyn Error>> {
    let corners = WALLS.iter().flat_map(|corners| corners.windows(2));
    let point = |(x, y): (f64, f64)| Point::new(x, y);
    let walls = corners.map(|pair| WallSegment::between(point(pair[0]), point(pair[1])));
    let world = World::from_segments(walls.collect())?;
    let mut config = LaserPioneerConfig::noiseless();
    config.ring = Ring {
        beams: 180,
        first_bearing: -0.5 * PI,
        spacing: 1_f64.to_radians(),
        max_range: 30.0,
    };
    config.turn_per_step = 0.1;
    config.translate_per_step = 0.05;
    config.scan_noise = Gaussian {
        absolute_sd: 0.01,
        ..Gaussian::NONE
    };
    config.odometry_distance_noise = Gaussian {
        relative_sd: 0.05,
        ..Gaussian::NONE
    };
    config.odometry_turn_noise = Gaussian {
        relative_sd: 0.05,
        absolute_sd: 0.004,
    };
    let start = Pose::new(Point::new(1.2, 1.2), tolman_geom::Heading::EAST);
    let mut solo = Solo::new(world, LaserPioneer::new(config)?, start, 7)?;
    println!(
        "# A simulated office, by cargo run -p tolman-papers --example office_log. FLASER: x y theta are true, odom_x … what wheels say."
    );
    println!("PARAM laser_front_laser_resolution 1.0 nohost 0");
    let mut reckoned = Pose::IDENTITY;
    let mut written: Option<Pose> = None;
    for corner in WAY.iter().copied().map(point) {
        loop {
            let pose = solo.truth().pose;
            let way: Vector = corner - pose.position;
            if way.norm() < 0.15 {
                break;
            }
            let turn = pose.heading.turn_to(tolman_geom::Heading::of(way));
            let translate = if turn.abs() < 0.3 {
                (way.norm() / 0.05).min(1.0)
            } else {
                0.0
            };
            let turn = (turn / 0.1).clamp(-1.0, 1.0);
            solo.step(&TurnTranslate { turn, translate })?;
            let sensing: LaserSensing = solo.sensing().clone();
            let Some(odometry) = sensing.odometry else {
                continue;
            };
            // The left wheel is a little small: a degree a metre to the left.
            let turn = odometry.turn + 1_f64.to_radians() * odometry.distance;
            reckoned = Odometry { turn, ..odometry }.applied_to(reckoned);
            let pose = solo.truth().pose;
            let step = written.map(|written| written.between(pose));
            let is_far = step.is_none_or(|step| {
                step.position.coords.norm() >= APART.0 || step.heading.radians().abs() >= APART.1
            });
            if is_far && let Some(scan) = &sensing.scan {
                written = Some(pose);
                let time = sensing.time_us as f64 * 1e-6;
                let ranges: Vec<String> = scan
                    .ranges
                    .iter()
                    .map(|range| format!("{range:.2}"))
                    .collect();
                let at = |pose: Pose| {
                    let Pose { position, heading } = pose;
                    format!(
                        "{:.4} {:.4} {:.5}",
                        position.x,
                        position.y,
                        heading.radians()
                    )
                };
                println!(
                    "FLASER {} {} {} {} {time:.2} sim {time:.2}",
                    ranges.len(),
                    ranges.join(" "),
                    at(pose),
                    at(reckoned)
                );
            }
        }
    }
    Ok(())
}
