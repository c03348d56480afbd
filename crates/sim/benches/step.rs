//! World steps per second: one robot alone, and many that see each other.
//!
//! One iteration is one step of the whole world: commands, contact, scans of 72 beams of 2.5 units
//! for every robot. Robots of 0.5 units diameter drive and turn at random, in mazes of 400 and
//! 40,000 unit walls. The e-pucks have eight infrared rays each and drive in corridors of 0.25 m.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

extern crate alloc;

mod measure;

use alloc::sync::Arc;

use criterion::Criterion;
use measure::Table;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::Braided;
use tolman_robot::epuck::WheelSpeeds;
use tolman_robot::{Ring, TurnTranslate};
use tolman_sim::casters::{Lanes, LatticeWalk, ParryPolyline};
use tolman_sim::noise::Gaussian;
use tolman_sim::robots::{Epuck, EpuckConfig, LaserPioneer, LaserPioneerConfig};
use tolman_sim::sensors::{ResponseCurve, ResponsePoint};
use tolman_sim::{CorridorSize, Model, Simulation, World};

const PARRY: &str = "parry2d polyline";

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut table = Table::new("k steps/s", PARRY);
    for (side, robots) in [(19, 1), (199, 1), (19, 100), (62, 1000)] {
        let mut rng = ChaCha8Rng::seed_from_u64(u64::from(side));
        let maze = Braided {
            width: side,
            height: side,
            share: 0.5,
        }
        .generate(&mut rng)
        .unwrap();
        let world = World::from_maze(&maze, &CorridorSize::thin(1.0)).unwrap();
        let baseline = Arc::new(LatticeWalk::new(&world, Lanes::Baseline).unwrap());
        let parry = Arc::new(ParryPolyline::new(world.walls()));
        let worlds = [
            (PARRY, world.clone().with_caster(parry), quiet()),
            (
                "lattice walk",
                world.clone().with_caster(baseline.clone()),
                quiet(),
            ),
            (
                "lattice walk, noise on everything",
                world.clone().with_caster(baseline),
                noisy(),
            ),
            ("lattice walk, AVX2", world, quiet()),
        ];
        for (name, world, config) in worlds {
            let robot = || LaserPioneer::new(config.clone()).unwrap();
            let mut sim = crowd(world, robot, robots, &mut rng);
            let commands: Vec<Vec<TurnTranslate>> = (0..64)
                .map(|_| (0..robots).map(|_| command(&mut rng)).collect())
                .collect();
            let mut next = commands.iter().cycle();
            let mut step = || sim.step(next.next().unwrap_or(&commands[0]));
            let group = if robots == 1 {
                "1 robot".to_owned()
            } else {
                format!("{robots} robots")
            };
            let column = format!("{}", (side + 1) * (side + 1));
            let label = format!("{group}, {column} walls, {name}");
            let per_second = measure::per_second(&mut criterion, &label, &mut step);
            table.enter(&group, name, &column, per_second.map(|steps| steps / 1e3));
        }
    }
    epucks(&mut criterion, &mut table);
    criterion.final_summary();
    println!("{table}");
}

/// Times a hundred e-pucks that see each other.
fn epucks(criterion: &mut Criterion, table: &mut Table) {
    const COUNT: u32 = 100;
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let maze = Braided {
        width: 19,
        height: 19,
        share: 0.5,
    }
    .generate(&mut rng)
    .unwrap();
    let world = World::from_maze(&maze, &CorridorSize::thin(0.25)).unwrap();
    let parry = world
        .clone()
        .with_caster(Arc::new(ParryPolyline::new(world.walls())));
    let mut perfect = EpuckConfig::webots();
    perfect.response = noiseless(&ResponseCurve::epuck());
    perfect.wheels = Vec::new();
    for (name, world, config) in [
        (PARRY, parry, &perfect),
        ("lattice walk", world.clone(), &perfect),
        ("lattice walk, Webots' noise", world, &EpuckConfig::webots()),
    ] {
        let mut sim = crowd(
            world,
            || Epuck::new(config.clone()).unwrap(),
            COUNT,
            &mut rng,
        );
        let commands: Vec<Vec<WheelSpeeds>> = (0..64)
            .map(|_| {
                let mut speed = || rng.random_range(-2.0..6.0);
                (0..COUNT)
                    .map(|_| WheelSpeeds {
                        left: speed(),
                        right: speed(),
                    })
                    .collect()
            })
            .collect();
        let mut next = commands.iter().cycle();
        let mut step = || sim.step(next.next().unwrap_or(&commands[0]));
        let label = format!("{COUNT} e-pucks, 400 walls, {name}");
        let per_second = measure::per_second(criterion, &label, &mut step);
        let group = format!("{COUNT} e-pucks");
        table.enter(&group, name, "400", per_second.map(|steps| steps / 1e3));
    }
}

/// Returns the same curve without noise.
fn noiseless(curve: &ResponseCurve) -> ResponseCurve {
    let points = (0..=70).map(|millimetre| ResponsePoint {
        relative_sd: 0.0,
        ..curve.at(f64::from(millimetre) * 1e-3)
    });
    ResponseCurve::new(points.collect()).unwrap()
}

fn quiet() -> LaserPioneerConfig {
    let mut config = LaserPioneerConfig::noiseless();
    config.radius = 0.25;
    config.ring = Ring::full(72, 2.5);
    config.turn_per_step = 0.5;
    config.translate_per_step = 0.1;
    config
}

fn noisy() -> LaserPioneerConfig {
    let noise = Gaussian {
        relative_sd: 0.02,
        absolute_sd: 0.01,
    };
    let mut config = quiet();
    config.motor_noise.turn = noise;
    config.motor_noise.translate = noise;
    config.motor_noise.drift_sd = 0.1;
    config.scan_noise = noise;
    config.compass_noise = noise;
    config.odometry_distance_noise = noise;
    config.odometry_turn_noise = noise;
    config
}

fn command(rng: &mut ChaCha8Rng) -> TurnTranslate {
    TurnTranslate {
        turn: rng.random_range(-1.0..1.0),
        translate: rng.random_range(-0.2..1.0),
    }
}

/// Returns robots at random places of the world.
fn crowd<M: Model>(
    world: World,
    robot: impl Fn() -> M,
    robots: u32,
    rng: &mut ChaCha8Rng,
) -> Simulation<M> {
    let bounds = world.bounds();
    let mut sim = Simulation::new(world, 1);
    while sim.robots().len() < robots as usize {
        let x = rng.random_range(bounds.min.x..bounds.max.x);
        let y = rng.random_range(bounds.min.y..bounds.max.y);
        let heading = Heading::from_radians(rng.random_range(-3.0..3.0));
        // Places that are taken are refused; try others.
        let _ = sim.add(robot(), Pose::new(Point::new(x, y), heading));
    }
    sim
}
