//! Disturbances written outside the simulator: they act, keep runs reproducible, and traces say so.

use rand::Rng;
use rand_distr::{Cauchy, Distribution, Normal, Uniform};
use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Grid, Maze};
use tolman_robot::epuck::{PROXIMITY_SENSORS, WheelSpeeds};
use tolman_robot::{LaserSensing, Robot, Scan, TurnTranslate};
use tolman_sim::noise::{Disturbance, Fault, Faults, Gaussian, Noise};
use tolman_sim::robots::{
    Epuck, EpuckConfig, EpuckDisturbances, LaserPioneer, LaserPioneerConfig,
    LaserPioneerDisturbances, RobotConfigError,
};
use tolman_sim::trace::{Detail, Reader, Recording, ReplayError, replay, replay_with};
use tolman_sim::{Chance, CorridorSize, Draws, Solo, Truth, World};

/// A sensor that ages: it reads less with every reading, and flickers.
#[derive(Clone, Debug)]
struct Ageing {
    readings: u32,
}

impl Disturbance<Scan> for Ageing {
    fn disturb(&mut self, value: &mut Option<Scan>, draws: &mut Draws) {
        self.readings += 1;
        if draws.uniform() < 0.1 {
            *value = None;
        }
        if let Some(scan) = value {
            for range in &mut scan.ranges {
                *range /= 1.0 + 0.01 * f64::from(self.readings);
            }
        }
    }
}

fn ageing() -> LaserPioneerDisturbances {
    let mut outside = LaserPioneerDisturbances::default();
    outside.scan = vec![Box::new(Ageing { readings: 0 })];
    outside.motor_turn = vec![Box::new(Noise::Relative(Normal::new(0.0, 0.2).unwrap()))];
    outside
}

fn config() -> LaserPioneerConfig {
    let mut config = LaserPioneerConfig::noiseless();
    config.scan_noise = Gaussian::absolute(0.01);
    config
}

fn world() -> World {
    let maze = Maze::open(Grid::new(4, 4));
    World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap()
}

fn start(world: &World) -> Pose {
    Pose::new(world.cell_centre(Cell::new(1, 1)), Heading::EAST)
}

const COMMAND: TurnTranslate = TurnTranslate {
    turn: 0.2,
    translate: 0.1,
};

fn drive(
    config: LaserPioneerConfig,
    outside: LaserPioneerDisturbances,
) -> Vec<(Truth, LaserSensing)> {
    let world = world();
    let start = start(&world);
    let robot = LaserPioneer::new(config)
        .unwrap()
        .with_disturbances(outside);
    let mut solo = Solo::new(world, robot, start, 5).unwrap();
    (0..50)
        .map(|_| {
            solo.step(&COMMAND).unwrap();
            (*solo.truth(), solo.sensing().clone())
        })
        .collect()
}

#[test]
fn a_disturbance_acts_after_the_faults_and_repeats_itself() {
    let plain = drive(config(), LaserPioneerDisturbances::default());
    let disturbed = drive(config(), ageing());
    assert_eq!(disturbed, drive(config(), ageing()));
    let missing = disturbed
        .iter()
        .filter(|(_, sensing)| sensing.scan.is_none());
    assert!((1..20).contains(&missing.count()));
    assert_ne!(
        plain[9].0.pose, disturbed[9].0.pose,
        "the motors are disturbed"
    );

    // Without the motors' noise the robot goes the same way and only the scans differ.
    let mut blind = ageing();
    blind.motor_turn = Vec::new();
    let disturbed = drive(config(), blind);
    for (reading, ((truth, sensing), (plain_truth, plain))) in
        (2_u32..).zip(disturbed.iter().zip(&plain))
    {
        assert_eq!(truth, plain_truth);
        assert_eq!(sensing.odometry, plain.odometry);
        if let (Some(scan), Some(plain)) = (&sensing.scan, &plain.scan) {
            let aged = plain.ranges[0] / (1.0 + 0.01 * f64::from(reading));
            assert!((scan.ranges[0] - aged).abs() < 1e-15);
        }
    }
}

#[test]
fn a_further_fault_shifts_no_disturbance() {
    let uniform = || Noise::Absolute(Uniform::new(-1.0, 1.0).unwrap());
    let read = |faults: &[Fault], outside: Vec<Box<dyn Disturbance<f64>>>| {
        let mut each = Faults::new("value", faults.iter().copied());
        each.add(outside);
        let mut value = Some(0.0);
        each.disturb(&mut value, &Chance::of_run(3).at(0, 7));
        value.unwrap()
    };
    let alone = read(&[], vec![Box::new(uniform())]);
    let nothing = Fault::Slip { share: 0.5 };
    assert_eq!(
        alone.to_bits(),
        read(&[nothing], vec![Box::new(uniform())]).to_bits()
    );
    // A second one draws numbers of its own.
    let two = read(&[], vec![Box::new(uniform()), Box::new(uniform())]);
    assert!((two - 2.0 * alone).abs() > 1e-6, "{alone} {two}");
}

/// Breaks what it is given.
#[derive(Clone, Debug)]
struct Breaks(fn(&mut Scan));

impl Disturbance<Scan> for Breaks {
    fn disturb(&mut self, value: &mut Option<Scan>, _: &mut Draws) {
        if let Some(scan) = value {
            (self.0)(scan);
        }
    }
}

#[test]
fn a_broken_reading_counts_as_missing() {
    let breaks: [fn(&mut Scan); 4] = [
        |scan| scan.ranges[3] = f64::NAN,
        |scan| scan.ranges[3] = 1e9,
        |scan| scan.ranges[3] = -1.0,
        |scan| scan.ranges.truncate(5),
    ];
    for breaks in breaks {
        let mut outside = LaserPioneerDisturbances::default();
        outside.scan = vec![Box::new(Breaks(breaks))];
        let run = drive(config(), outside);
        assert!(run.iter().all(|(_, sensing)| sensing.scan.is_none()));
    }
    // Motors that are told no number stand still; heavy tails end.
    let mut outside = LaserPioneerDisturbances::default();
    outside.motor_distance = vec![Box::new(Noise::Absolute(Constant(f64::NAN)))];
    outside.motor_turn = vec![Box::new(Noise::Absolute(Cauchy::new(0.0, 1e12).unwrap()))];
    outside.compass = vec![Box::new(Noise::Absolute(Constant(f64::INFINITY)))];
    for (truth, sensing) in drive(config(), outside) {
        assert_eq!(truth.pose.position, start(&world()).position);
        assert!(truth.pose.is_finite());
        assert_eq!(sensing.compass, None);
    }
}

/// Always the same sample.
#[derive(Clone, Copy, Debug)]
struct Constant(f64);

impl Distribution<f64> for Constant {
    fn sample<R: Rng + ?Sized>(&self, _: &mut R) -> f64 {
        self.0
    }
}

#[test]
fn each_wheel_of_an_epuck_is_disturbed_by_itself() {
    let mut outside = EpuckDisturbances::default();
    outside.left_wheel = vec![Box::new(Noise::Relative(Constant(-1.0)))];
    outside.proximity = vec![Box::new(Noise::Absolute(Constant(1000.0)))];
    let mut config = EpuckConfig::cpm();
    config.wheels = Vec::new();
    let robot = Epuck::new(config).unwrap().with_disturbances(outside);
    let world = world();
    let start = start(&world);
    let mut solo = Solo::new(world, robot, start, 5).unwrap();
    solo.step(&WheelSpeeds {
        left: 1.0,
        right: 1.0,
    })
    .unwrap();
    assert!(solo.truth().motion.turn > 0.0, "the left wheel stands");
    let proximity = solo.sensing().proximity.unwrap();
    assert_eq!(
        proximity.map(|value| value >= 1000.0),
        [true; PROXIMITY_SENSORS]
    );
}

fn record(outside: LaserPioneerDisturbances) -> String {
    let world = world();
    let start = start(&world);
    let robot = LaserPioneer::new(config())
        .unwrap()
        .with_disturbances(outside);
    let mut file = Vec::new();
    let mut recording =
        Recording::start(world, 11, vec![(robot, start)], &mut file, Detail::Sensing).unwrap();
    for _ in 0..20 {
        recording.step(&[COMMAND]).unwrap();
    }
    recording.finish().unwrap();
    String::from_utf8(file).unwrap()
}

#[test]
fn a_trace_names_what_it_cannot_hold() {
    let plain = record(LaserPioneerDisturbances::default());
    assert!(!plain.contains("disturbances"));

    let trace = record(ageing());
    let reader = Reader::<LaserPioneer, _>::open(trace.as_bytes()).unwrap();
    let named: Vec<_> = reader.disturbances().collect();
    assert_eq!(named.len(), 1);
    assert!(
        named[0][0].starts_with("motor_turn: Relative(Normal"),
        "{named:?}"
    );
    assert_eq!(named[0][1], "scan: Ageing { readings: 0 }");

    let error = replay::<LaserPioneer>(trace.as_bytes()).unwrap_err();
    assert!(matches!(error, ReplayError::Disturbances { robot: 0, .. }));
    assert!(error.to_string().contains("Ageing"), "{error}");

    // With the same robot it replays to the bit; with another it is refused.
    let with = |readings| {
        replay_with(trace.as_bytes(), |_, config| {
            let mut outside = ageing();
            outside.scan = vec![Box::new(Ageing { readings })];
            Ok::<_, RobotConfigError>(LaserPioneer::new(config)?.with_disturbances(outside))
        })
    };
    assert_eq!(with(0).unwrap().tick(), 20);
    assert!(matches!(with(1), Err(ReplayError::Disturbances { .. })));
    // A robot that is disturbed where the recorded one was not is refused as well.
    let disturbed = replay_with(plain.as_bytes(), |_, config| {
        Ok::<_, RobotConfigError>(LaserPioneer::new(config)?.with_disturbances(ageing()))
    });
    assert!(matches!(disturbed, Err(ReplayError::Disturbances { .. })));
}
