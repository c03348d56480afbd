//! MSLST and its baselines drive a robot that no simulator made: a few lines of kinematics in a few
//! corridors.

use core::convert::Infallible;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::Stack;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::{
    Goal, Landmark, LaserSensing, Mapper, Ring, Robot, Scan, SensesLandmarks, Standing, System,
    Task, TurnTranslate,
};
use tolman_systems::mslst::{
    GrowthRecord, Learned, MapFile, Mslst, MslstConfig, MslstMap, ROBOT_UNIT, States,
};
use tolman_systems::{Actor, Brain, Doing, OfStep, Origin, TimeStep, baselines};

const REACH: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

/// `#` is rock, `G` the goal. Two arms, two dead ends, one way to the goal.
const PLAN: [&str; 7] = [
    "#########",
    "#...#...#",
    "#.#.#.#.#",
    "#.#...#.#",
    "#.#.#.#.#",
    "###.#.#G#",
    "#########",
];

/// Width of a corridor and side of a block, m.
const WIDTH: f64 = 1.9 * ROBOT_UNIT;
const RADIUS: f64 = 0.5 * ROBOT_UNIT;

/// A robot among blocks of rock.
struct Digger {
    /// The centres of the blocks, m.
    rock: Vec<Point>,
    goal: Point,
    pose: Pose,
    sensing: LaserSensing,
    rng: ChaCha8Rng,
    steps: u32,
}

fn cells(kind: char) -> Vec<Point> {
    let mut centres = Vec::new();
    for (row, line) in (0_u32..).zip(PLAN.iter().rev()) {
        for (column, cell) in (0_u32..).zip(line.chars()) {
            if cell == kind {
                centres.push(Point::new(f64::from(column), f64::from(row)) * WIDTH);
            }
        }
    }
    centres
}

/// Metres along a ray until it enters the block round `centre`; infinity if it does not.
fn range(from: Point, along: Vector, centre: Point) -> f64 {
    let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
    for axis in 0..2 {
        let sides =
            [-0.5, 0.5].map(|side| (centre[axis] + side * WIDTH - from[axis]) / along[axis]);
        enters = enters.max(sides[0].min(sides[1]));
        leaves = leaves.min(sides[0].max(sides[1]));
    }
    if enters < leaves {
        enters
    } else {
        f64::INFINITY
    }
}

impl Digger {
    fn new(cell: Point, seed: u64) -> Self {
        let mut robot = Self {
            rock: cells('#'),
            goal: cells('G')[0],
            pose: Pose::new(cell, Heading::EAST),
            sensing: LaserSensing::silent(Ring::full(72, 2.5 * ROBOT_UNIT)),
            rng: ChaCha8Rng::seed_from_u64(seed),
            steps: 0,
        };
        robot.sense();
        robot
    }

    fn put_down(&mut self, cell: Point) {
        self.pose = Pose::new(cell, Heading::EAST);
        self.steps = 0;
        self.sense();
    }

    fn sense(&mut self) {
        let Pose { position, heading } = self.pose;
        let ring = Ring::full(72, 2.5 * ROBOT_UNIT);
        let is_near = |rock: &&Point| (position - **rock).norm() < ring.max_range + WIDTH;
        let near: Vec<&Point> = self.rock.iter().filter(is_near).collect();
        let ranges = (0..ring.beams).map(|beam| {
            let along = heading.turned(ring.bearing(beam)).unit();
            let ranges = near.iter().map(|rock| range(position, along, **rock));
            ranges.fold(ring.max_range, f64::min)
        });
        self.sensing.scan = Some(Scan {
            ring,
            ranges: ranges.collect(),
        });
        self.sensing.compass = Some(heading);
    }

    /// Returns whether the digger's body would overlap a block.
    fn collides(&self, position: Point) -> bool {
        self.rock.iter().any(|rock| {
            let apart = (position - rock).map(|along| (along.abs() - 0.5 * WIDTH).max(0.0));
            apart.norm() < RADIUS
        })
    }
}

impl Robot for Digger {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = Infallible;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
        let mut slip = || self.rng.random_range(0.9..1.1);
        let turn = command.turn.clamp(-1.0, 1.0) * 91_f64.to_radians() * slip();
        let way = command.translate * 2.0 * ROBOT_UNIT * slip();
        self.pose.heading = self.pose.heading.turned(turn);
        let way = self.pose.heading.unit() * way / 10.0;
        for _ in 0..10 {
            // It slides along what it meets.
            for part in [Vector::new(way.x, 0.0), Vector::new(0.0, way.y)] {
                let position = self.pose.position + part;
                if !self.collides(position) {
                    self.pose.position = position;
                }
            }
        }
        self.steps += 1;
        self.sense();
        Ok(())
    }
}

impl SensesLandmarks for Digger {
    fn landmark(&self) -> Option<Landmark> {
        let apart = (self.pose.position - self.goal).abs().max();
        (apart < 0.5 * WIDTH).then_some(Landmark::Goal)
    }
}

fn layers() -> Stack {
    Stack::paper(Ring::full(72, 2.5 * ROBOT_UNIT), ROBOT_UNIT, WIDTH).unwrap()
}

/// Returns a short apprenticeship.
fn config() -> MslstConfig {
    let mut config = MslstConfig::j();
    config.scan_steps = 2000;
    config.graph_actions = 800;
    config
}

const MOST_ACTIONS: u32 = 5000;

/// Lets `system` pursue `task` while it is under way, and returns how it stands then.
fn pursue<S: System<Digger>>(system: &mut S, robot: &mut Digger, task: Task) -> Standing
where
    S::Failure: core::fmt::Debug,
{
    for _ in 0..MOST_ACTIONS {
        let standing = system.act(robot, task).unwrap();
        if standing != Standing::UnderWay {
            return standing;
        }
    }
    Standing::UnderWay
}

/// Returns one that has learned the corridors, and its robot.
fn apprentice() -> (Actor<Mslst>, Digger) {
    let mut mslst = Actor::seeded(Mslst::new(config()), layers(), 5);
    let mut robot = Digger::new(cells('.')[0], 5);
    let standing = pursue(&mut mslst, &mut robot, Task::Explore);
    assert_eq!(standing, Standing::Done);
    (mslst, robot)
}

/// Returns the sum of the steps to the goal from every other cell.
fn steps_from_everywhere<B: Brain>(system: &mut Actor<B>, robot: &mut Digger) -> u32
where
    B::Observation: OfStep<Digger>,
    B::Error: core::fmt::Debug,
{
    let starts = cells('.').into_iter();
    let runs = starts.map(|cell| {
        robot.put_down(cell);
        system.put_down();
        assert_eq!(pursue(system, robot, REACH), Standing::Done, "from {cell}");
        assert_eq!(robot.landmark(), Some(Landmark::Goal), "from {cell}");
        robot.steps
    });
    runs.sum()
}

#[test]
fn mslst_explores_and_then_knows_the_way_to_the_goal() {
    let (mut mslst, mut robot) = apprentice();
    let map = mslst.map();
    assert!(map.places.len() > 20, "{} places", map.places.len());
    let is_goal = |landmark: Option<Landmark>| landmark == Some(Landmark::Goal);
    assert!(map.places.iter().any(|place| is_goal(place.landmark)));
    let learned = steps_from_everywhere(&mut mslst, &mut robot);
    let mut avoid = Actor::seeded(baselines::AvoidBrain::default(), layers(), 5);
    let wandered = steps_from_everywhere(&mut avoid, &mut robot);
    assert!(
        2 * learned < wandered,
        "with its map {learned} steps, wandering {wandered}"
    );
}

#[test]
fn the_baselines_find_the_goal_and_can_be_asked_for_nothing_else() {
    fn check<B: Brain<Observation = TimeStep, Error = Infallible>>(brain: B, start: Point) {
        let name = format!("{brain:?}");
        let mut system = Actor::seeded(brain, layers(), 1);
        let mut robot = Digger::new(start, 1);
        assert_eq!(
            pursue(&mut system, &mut robot, REACH),
            Standing::Done,
            "{name}"
        );
        assert!(robot.steps > 0, "{name}");
        assert!(system.map().places.is_empty(), "{name}");
        for task in [Task::Explore, Task::Localize, Task::Reach(Goal::Place(0))] {
            let standing = system.act(&mut robot, task).unwrap();
            assert!(matches!(standing, Standing::GaveUp { .. }), "{name}");
        }
    }
    let open = cells('.');
    let (far, near) = (open[2], open[open.len() - 1]);
    check(baselines::AvoidBrain::default(), far);
    check(baselines::WallFollow::new(WIDTH), far);
    check(baselines::Random, near);
}

#[test]
fn without_a_map_mslst_says_what_it_needs() {
    let mut mslst = Actor::seeded(Mslst::new(config()), layers(), 5);
    let mut robot = Digger::new(cells('.')[0], 5);
    for task in [REACH, Task::Localize] {
        let standing = mslst.act(&mut robot, task).unwrap();
        let Standing::GaveUp { why } = standing else {
            panic!("{standing:?}");
        };
        assert!(why.contains("let it explore first"), "{why}");
    }
    assert_eq!(robot.steps, 0);
}

/// Layers for other beams would leave the robot where it is.
#[test]
fn layers_for_another_ring_are_refused() {
    let layers = Stack::paper(Ring::full(36, 2.5 * ROBOT_UNIT), ROBOT_UNIT, WIDTH).unwrap();
    let mut mslst = Actor::seeded(Mslst::new(config()), layers, 5);
    let mut robot = Digger::new(cells('.')[0], 5);
    let error = mslst.act(&mut robot, Task::Explore).unwrap_err();
    let told = error.to_string();
    assert!(
        told.contains("72 beams") && told.contains("expect 36"),
        "{told}"
    );
}

#[test]
fn a_compass_that_never_tells_is_named() {
    let told = States::learn(&[], 100.0).unwrap_err().to_string();
    assert!(told.contains("check ranges and compass"), "{told}");
}

/// No watcher sees a real robot learn: its map is kept without the survey.
#[test]
fn a_map_that_nobody_watched_survives_its_file() {
    let (mslst, _) = apprentice();
    let map = MslstMap::clone(mslst.brain().learned().unwrap());
    let survey = GrowthRecord::default();
    let file = MapFile {
        origin: Origin {
            world: "corridors".to_owned(),
            drawing: None,
            robot: "digger".to_owned(),
            seed: 5,
        },
        config: config(),
        learned: Learned { map, survey },
    };
    let read = MapFile::from_json(&file.to_json().unwrap()).unwrap();
    assert_eq!(read.learned.map.graph, file.learned.map.graph);
    assert_eq!(read.learned.survey, GrowthRecord::default());
}

/// The paper's history localization ends with one node, or with a memory full of what several nodes
/// fit.
#[test]
fn localization_ends_with_one_place_or_a_reason() {
    let (mut mslst, mut robot) = apprentice();
    let mut found = 0;
    for cell in cells('.') {
        robot.put_down(cell);
        mslst.put_down();
        match pursue(&mut mslst, &mut robot, Task::Localize) {
            Standing::Done => found += 1,
            Standing::GaveUp { why } => assert!(why.contains("nodes fit all 6"), "{why}"),
            Standing::UnderWay => panic!("no end from {cell}"),
        }
    }
    assert!(found > 0);
}

/// A log of what one robot sensed and did teaches another brain the same map.
#[test]
fn mslst_learns_from_a_log() {
    let mut log = Vec::new();
    let mut wanderer = Actor::seeded(Mslst::new(config()), layers(), 5);
    let mut robot = Digger::new(cells('.')[0], 5);
    log.push(TimeStep::of(&robot, Doing::PutDown));
    while wanderer.brain().learned().is_none() {
        wanderer
            .act_seen(&mut robot, Task::Explore, |_, step| {
                log.push(TimeStep::of(step.robot, Doing::of(step)));
            })
            .unwrap();
    }
    let mut reader = Mslst::new(config());
    for seen in &log {
        reader.observe(seen).unwrap();
    }
    assert!(reader.learned().is_some());
    assert_eq!(reader.map(), wanderer.map());
}
