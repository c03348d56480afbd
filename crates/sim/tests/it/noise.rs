//! Noise and faults: what each does, and that none shifts another.

use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Grid, Maze};
use tolman_robot::{LaserSensing, Robot, TurnTranslate};
use tolman_sim::noise::{Fault, Faults, Gaussian};
use tolman_sim::robots::{
    LaserPioneer, LaserPioneerConfig, LaserPioneerFaults, RobotConfigError, StuckBeam,
};
use tolman_sim::{Chance, Channel, CorridorSize, Simulation, Solo, Truth, World};

/// Returns the values 1, 2, 3 … of successive ticks after the fault.
fn series(fault: Fault, count: u32) -> Vec<Option<f64>> {
    fault.check().unwrap();
    let mut faults = Faults::new("series", [fault]);
    (1..=count)
        .map(|tick| {
            let mut value = Some(f64::from(tick));
            faults.disturb(&mut value, &Chance::of_run(3).at(0, u64::from(tick)));
            value
        })
        .collect()
}

#[test]
fn each_fault_does_what_it_says() {
    let biased = series(
        Fault::Bias {
            scale: 2.0,
            offset: 0.5,
        },
        2,
    );
    assert_eq!(biased, [Some(2.5), Some(4.5)]);
    let rounded = series(Fault::Quantization { step: 2.0 }, 4);
    assert_eq!(rounded, [Some(2.0), Some(2.0), Some(4.0), Some(4.0)]);
    let drifting = series(Fault::Drift { rate: 0.25 }, 3);
    let (up, down) = ([1.25, 2.5, 3.75], [0.75, 1.5, 2.25]);
    assert!(
        [up, down].iter().any(|known| drifting == known.map(Some)),
        "{drifting:?}"
    );
    let late = series(Fault::Delay { steps: 2 }, 4);
    assert_eq!(late, [None, None, Some(1.0), Some(2.0)]);
    let stuck = series(
        Fault::Stuck {
            probability: 1.0,
            steps: 2,
        },
        5,
    );
    assert_eq!(
        stuck,
        [Some(1.0), Some(1.0), Some(1.0), Some(4.0), Some(4.0)]
    );

    let held = series(
        Fault::Bounded {
            share: 0.1,
            offset: 0.0,
            steps: 3,
        },
        300,
    );
    let factors: Vec<f64> = (1..)
        .zip(&held)
        .map(|(truth, value)| value.unwrap() / f64::from(truth))
        .collect();
    for factors in factors.chunks(3) {
        assert!(factors.iter().all(|f| (f - factors[0]).abs() < 1e-12));
    }
    let (low, high) = factors.iter().fold((9.0, 0.0), |(low, high), factor| {
        (f64::min(low, *factor), f64::max(high, *factor))
    });
    assert!((0.9..0.92).contains(&low), "{low}");
    assert!((1.08..=1.1).contains(&high), "{high}");

    let count = 4000;
    let missing = series(Fault::DropOut { probability: 0.25 }, count);
    let missing = missing.iter().filter(|value| value.is_none()).count();
    assert!((900..1100).contains(&missing), "{missing}");

    let outliers = Fault::Outliers {
        probability: 0.1,
        low: -2.0,
        high: -1.0,
    };
    let out = series(outliers, count);
    let out = out
        .iter()
        .flatten()
        .filter(|value| (-2.0..-1.0).contains(*value))
        .count();
    assert!((330..470).contains(&out), "{out}");

    let shares = |fault| -> Vec<f64> {
        (1..)
            .zip(series(fault, count))
            .map(|(tick, value)| value.unwrap() / f64::from(tick))
            .collect()
    };
    let slipped = shares(Fault::Slip { share: 0.1 });
    assert!(slipped.iter().all(|share| (0.9..1.1).contains(share)));
    assert!(slipped.iter().any(|share| *share > 1.08) && slipped.iter().any(|share| *share < 0.92));
    let noisy = shares(Fault::Gaussian(Gaussian::relative(0.1)));
    let mean = noisy.iter().sum::<f64>() / f64::from(count);
    let square = noisy
        .iter()
        .map(|share| (share - mean) * (share - mean))
        .sum::<f64>();
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    assert!(
        ((square / f64::from(count)).sqrt() - 0.1).abs() < 0.01,
        "{square}"
    );
}

/// Pins the draws: a change of them would change every result ever computed with a seed.
#[test]
fn the_same_seed_draws_these_numbers() {
    let mut draws = Chance::of_run(42)
        .at(7, 1234)
        .draws(Channel::named("golden"));
    let gaussians: Vec<u64> = (0..4).map(|_| draws.gaussian().to_bits()).collect();
    let uniforms: Vec<u64> = (0..2).map(|_| draws.uniform().to_bits()).collect();
    assert_eq!(gaussians, GAUSSIANS);
    assert_eq!(uniforms, UNIFORMS);
}

/// −1.03799…, 0.03445…, 0.24760…, 0.94234…: also what the same formulas give in Python.
const GAUSSIANS: [u64; 4] = [
    13_830_725_548_079_353_282,
    4_585_125_600_260_556_226,
    4_598_089_088_029_557_140,
    4_606_663_097_303_649_401,
];
/// 0.98151…, 0.74927….
const UNIFORMS: [u64; 2] = [4_607_015_883_119_356_314, 4_604_924_097_590_130_789];

fn world() -> World {
    let maze = Maze::open(Grid::new(4, 4));
    World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap()
}

fn noisy() -> LaserPioneerConfig {
    let noise = Gaussian {
        relative_sd: 0.1,
        absolute_sd: 0.02,
    };
    let mut config = LaserPioneerConfig::noiseless();
    config.motor_noise.turn = noise;
    config.motor_noise.translate = noise;
    config.motor_noise.drift_sd = 0.2;
    config.scan_noise = noise;
    config.compass_noise = noise;
    config.odometry_distance_noise = noise;
    config.odometry_turn_noise = noise;
    config
}

fn drive(config: LaserPioneerConfig, run: u64) -> Vec<(Truth, LaserSensing)> {
    let world = world();
    let start = Pose::new(world.cell_centre(Cell::new(1, 1)), Heading::EAST);
    let mut solo = Solo::new(world, LaserPioneer::new(config).unwrap(), start, run).unwrap();
    (0..50)
        .map(|step| {
            let command = TurnTranslate {
                turn: 0.2,
                translate: 0.1 * f64::from(step % 7),
            };
            solo.step(&command).unwrap();
            (*solo.truth(), solo.sensing().clone())
        })
        .collect()
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_others() {
    assert_eq!(drive(noisy(), 5), drive(noisy(), 5));
    assert_ne!(drive(noisy(), 5), drive(noisy(), 6));
}

#[test]
fn a_stuck_beam_says_the_same_whatever_the_others_meet() {
    let stuck_at = |beam, range| {
        let mut config = noisy();
        config.faults.stuck_beams.push(StuckBeam { beam, range });
        config
    };
    for ((_, stuck), (_, plain)) in drive(stuck_at(9, 0.4), 5).iter().zip(&drive(noisy(), 5)) {
        let (Some(stuck), Some(plain)) = (&stuck.scan, &plain.scan) else {
            panic!("a scan is missing");
        };
        let mut expected = plain.clone();
        expected.ranges[9] = 0.4;
        assert_eq!(*stuck, expected);
    }
    for (beam, range) in [(72, 0.4), (9, 1.3), (9, f64::NAN)] {
        let refused = LaserPioneer::new(stuck_at(beam, range)).unwrap_err();
        assert!(refused.to_string().contains("stuck_beams"), "{refused}");
    }
}

#[test]
fn a_further_consumer_shifts_no_other() {
    let plain = drive(noisy(), 5);
    let dropping = Fault::DropOut { probability: 0.5 };
    let mut faults = LaserPioneerFaults::default();
    faults.scan = vec![Fault::Gaussian(Gaussian::absolute(0.1)), dropping];
    let (mut missing, mut changed) = (0, 0);
    let mut robot = noisy();
    robot.faults = faults;
    for ((truth, sensing), (plain_truth, plain)) in drive(robot, 5).into_iter().zip(&plain) {
        assert_eq!(truth, *plain_truth);
        assert_eq!(sensing.compass, plain.compass);
        assert_eq!(sensing.odometry, plain.odometry);
        changed += usize::from(sensing.scan != plain.scan);
        missing += usize::from(sensing.scan.is_none());
    }
    assert!((10..40).contains(&missing), "{missing}");
    assert!(changed > missing, "{changed}");

    // A robot far off in the same world draws from its own stream.
    let mut sim = Simulation::new(world(), 5);
    let pose = |x, y, sim: &Simulation<LaserPioneer>| {
        Pose::new(sim.world().cell_centre(Cell::new(x, y)), Heading::EAST)
    };
    let config = || {
        let mut config = noisy();
        config.ring.max_range = 0.5;
        LaserPioneer::new(config).unwrap()
    };
    let alone = {
        let mut sim = Simulation::new(world(), 5);
        let first = sim.add(config(), pose(1, 1, &sim)).unwrap();
        sim.step(&[TurnTranslate {
            turn: 0.3,
            translate: 0.1,
        }])
        .unwrap();
        sim.sensing(first).clone()
    };
    let first = sim.add(config(), pose(1, 1, &sim)).unwrap();
    let second = sim.add(config(), pose(3, 3, &sim)).unwrap();
    sim.step(
        &[TurnTranslate {
            turn: 0.3,
            translate: 0.1,
        }; 2],
    )
    .unwrap();
    assert_eq!(*sim.sensing(first), alone);
    assert_ne!(sim.sensing(second).odometry, alone.odometry);
}

#[test]
fn numbers_without_sense_are_refused() {
    let with = |change: &dyn Fn(&mut LaserPioneerConfig)| {
        let mut config = noisy();
        change(&mut config);
        LaserPioneer::new(config).map(|_| ())
    };
    let field = |result: Result<(), RobotConfigError>| result.unwrap_err().to_string();
    assert!(with(&|_| {}).is_ok());
    assert!(field(with(&|config| config.radius = f64::NAN)).contains("radius"));
    assert!(field(with(&|config| config.ring.beams = 0)).contains("beams"));
    assert!(field(with(&|config| config.ring.max_range = -1.0)).contains("range"));
    assert!(field(with(&|config| config.turn_per_step = f64::INFINITY)).contains("turn_per_step"));
    assert!(field(with(&|config| config.scan_noise.absolute_sd = -0.1)).contains("scan_noise"));
    assert!(field(with(&|config| config.step_us = 0)).contains("step_us"));
    let dropping = Fault::DropOut { probability: 1.5 };
    let error = field(with(&|config| config.faults.compass.push(dropping)));
    assert!(
        error.contains("faults.compass") && error.contains("probability"),
        "{error}"
    );
}
