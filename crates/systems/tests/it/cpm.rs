//! CPM on a robot without the simulator: proximity by ray casting in a few lines, wheels by plane
//! geometry.

use core::convert::Infallible;
use core::ops::ControlFlow;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_control::epuck::RangeCurve;
use tolman_geom::{Heading, Point, Pose, Twist, Vector};
use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::epuck::{
    EpuckSensing, MOST_WHEEL_SPEED, PROXIMITY_SENSORS, TRACK, WHEEL_RADIUS, WheelSpeeds,
    WheelTurns, proximity_mounts,
};
use tolman_robot::{
    Goal, Landmark, MapView, Mapper, Position, Robot, SensesLandmarks, Standing, System, Task,
};
use tolman_systems::cpm::{
    Aim, CommonPatterns, Cpm, CpmConfig, CpmObservation, CpmObserveError, Layer3, Lesson, Walker,
    WalkerConfig, soinn, wander,
};

/// From wall to wall, m.
const WIDTH: f64 = 0.25;

/// Length of a time step, µs.
const STEP_US: u64 = 13_000;

/// A loop with two forks, from each of which a way leads to a dead end; the goal is in one of them.
const MAZE: &str = include_str!("../../mazes/forks.maze");

/// An e-puck in a maze of thin walls, without noise.
#[derive(Clone)]
struct ScriptedEpuck {
    maze: Maze,
    walls: Vec<(Point, Point)>,
    curve: RangeCurve,
    pose: Pose,
    path: Vec<Pose>,
    sensing: EpuckSensing,
}

fn config() -> WalkerConfig {
    WalkerConfig::paper(RangeCurve::cpm(), STEP_US, WIDTH)
}

fn centre(cell: Cell) -> Point {
    Point::new(f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5) * WIDTH
}

/// Returns the wall on one side of a cell.
fn wall(cell: Cell, side: Direction) -> (Point, Point) {
    let (out, along) = match side {
        Direction::East => (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)),
        Direction::North => (Vector::new(0.0, 1.0), Vector::new(1.0, 0.0)),
        Direction::West => (Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0)),
        Direction::South => (Vector::new(0.0, -1.0), Vector::new(1.0, 0.0)),
    };
    let middle = centre(cell) + out * (WIDTH / 2.0);
    let half = along * (WIDTH / 2.0);
    (middle - half, middle + half)
}

/// Returns the distance along a ray to the first wall; infinity if it meets none.
fn range(walls: &[(Point, Point)], from: Point, way: Vector) -> f64 {
    let hits = walls.iter().filter_map(|(a, b)| {
        let (edge, gap) = (b - a, a - from);
        let across = way.x * edge.y - way.y * edge.x;
        let ahead = (gap.x * edge.y - gap.y * edge.x) / across;
        let beside = (gap.x * way.y - gap.y * way.x) / across;
        (ahead > 0.0 && (0.0..=1.0).contains(&beside)).then_some(ahead)
    });
    hits.fold(f64::INFINITY, f64::min)
}

impl ScriptedEpuck {
    fn in_maze(text: &str) -> Self {
        let maze = tolman_maze::read(text).unwrap().maze;
        let (start, direction) = maze.start().unwrap();
        let heading = match direction {
            Direction::East => 0.0,
            Direction::North => 90.0,
            Direction::West => 180.0,
            Direction::South => 270.0,
        };
        let sides = maze
            .grid()
            .cells()
            .flat_map(|cell| Direction::ALL.map(|side| (cell, side)));
        let walls = sides
            .filter(|(cell, side)| !maze.is_open(*cell, *side))
            .map(|(cell, side)| wall(cell, side))
            .collect();
        let pose = Pose::new(centre(start), Heading::from_degrees(heading));
        let mut robot = Self {
            maze,
            walls,
            curve: RangeCurve::cpm(),
            pose,
            path: vec![pose],
            sensing: EpuckSensing::default(),
        };
        robot.look();
        robot
    }

    fn look(&mut self) {
        let values: [f64; PROXIMITY_SENSORS] = proximity_mounts().map(|mount| {
            let from = self.pose.transform(mount.position);
            let way = self.pose.heading.turned(mount.heading.radians()).unit();
            self.curve.value(range(&self.walls, from, way))
        });
        self.sensing.proximity = Some(values);
    }

    fn cell(&self) -> Cell {
        let index = |metres: f64| (metres / WIDTH).floor() as u16;
        Cell::new(index(self.pose.position.x), index(self.pose.position.y))
    }
}

impl Robot for ScriptedEpuck {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = Infallible;

    fn sensing(&self) -> &EpuckSensing {
        &self.sensing
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), Infallible> {
        let turned =
            |speed: f64| speed.clamp(-MOST_WHEEL_SPEED, MOST_WHEEL_SPEED) * STEP_US as f64 * 1e-6;
        let (left, right) = (turned(command.left), turned(command.right));
        let rolled = Twist::of_wheels(left * WHEEL_RADIUS, right * WHEEL_RADIUS, TRACK);
        self.pose = self.pose.displaced(rolled.linear, rolled.angular);
        self.path.push(self.pose);
        self.sensing.encoders = Some(WheelTurns { left, right });
        self.sensing.time_us += STEP_US;
        self.look();
        Ok(())
    }
}

impl SensesLandmarks for ScriptedEpuck {
    fn landmark(&self) -> Option<Landmark> {
        let here = self.cell();
        if self.maze.start().is_some_and(|(start, _)| start == here) {
            return Some(Landmark::Start);
        }
        self.maze.goals().contains(&here).then_some(Landmark::Goal)
    }
}

/// Returns a task's final standing, and the number of actions until then.
fn pursue<R: Robot>(cpm: &mut Cpm, robot: &mut R, task: Task) -> (Standing, u32)
where
    Cpm: System<R>,
    <Cpm as System<R>>::Failure: core::fmt::Debug,
{
    let ends = (1..100).find_map(|action| {
        let standing = cpm.act(robot, task).unwrap();
        (standing != Standing::UnderWay).then_some((standing, action))
    });
    ends.unwrap()
}

fn unlearned(seed: u64) -> Cpm {
    Cpm::unlearned(config(), CpmConfig::robust(), seed).unwrap()
}

const TO_GOAL: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

fn neighbours(map: &MapView, of: u32) -> Vec<u32> {
    let links = map.links.iter().filter(|link| link.from == of);
    let mut found: Vec<u32> = links.map(|link| link.to).collect();
    found.sort_unstable();
    found
}

fn place_of(map: &MapView, landmark: Landmark) -> u32 {
    let mut at = map
        .places
        .iter()
        .filter(|place| place.landmark == Some(landmark));
    let first = at.next().unwrap().id;
    assert!(at.next().is_none(), "{map:?}");
    first
}

#[test]
fn it_learns_the_maze_and_goes_to_the_goal() {
    for seed in 0..3 {
        let (mut robot, mut cpm) = (ScriptedEpuck::in_maze(MAZE), unlearned(seed));
        assert_eq!(cpm.map(), MapView::default());
        let (explored, _) = pursue(&mut cpm, &mut robot, Task::Explore);
        assert_eq!(explored, Standing::Done);
        let steps = robot.path.len();

        // Start and both forks make the loop; from one fork leads a way to the goal.
        let map = cpm.map();
        assert_eq!((map.places.len(), map.links.len()), (5, 10), "{map:?}");
        let (start, goal) = (
            place_of(&map, Landmark::Start),
            place_of(&map, Landmark::Goal),
        );
        let forks = neighbours(&map, start);
        let [near] = neighbours(&map, goal)[..] else {
            panic!("{map:?}");
        };
        assert!(forks.len() == 2 && forks.contains(&near), "{map:?}");
        let far = forks[usize::from(forks[0] == near)];
        assert!(neighbours(&map, near).contains(&far), "{map:?}");
        assert_eq!(neighbours(&map, far).len(), 3);

        // From the start again, without telling where that is.
        robot.pose = robot.path[0];
        cpm.carried();
        let (reached, _) = pursue(&mut cpm, &mut robot, TO_GOAL);
        assert_eq!(reached, Standing::Done);
        assert_eq!(robot.landmark(), Some(Landmark::Goal));
        assert_eq!(cpm.belief()[0].at, Position::Place(goal));
        assert!(4 * (robot.path.len() - steps) < steps);

        let back = Task::Reach(Goal::Place(start));
        assert_eq!(pursue(&mut cpm, &mut robot, back).0, Standing::Done);
        assert_eq!(robot.landmark(), Some(Landmark::Start));
    }
}

/// An e-puck that recognizes nothing.
struct Blind(ScriptedEpuck);

impl Robot for Blind {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = Infallible;

    fn sensing(&self) -> &EpuckSensing {
        self.0.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), Infallible> {
        self.0.step(command)
    }
}

impl SensesLandmarks for Blind {
    fn landmark(&self) -> Option<Landmark> {
        None
    }
}

#[test]
fn a_goal_that_it_does_not_see_is_not_reached() {
    let mut robot = Blind(ScriptedEpuck::in_maze(MAZE));
    let (end, _) = pursue(&mut unlearned(1), &mut robot, TO_GOAL);
    assert!(matches!(end, Standing::GaveUp { .. }), "{end:?}");
    let nowhere = pursue(&mut unlearned(1), &mut robot, Task::Localize);
    assert!(matches!(nowhere, (Standing::GaveUp { .. }, 1)));
}

/// Patterns of the maze itself, from a few hundred observations.
fn patterns() -> CommonPatterns {
    let mut walker = Walker::new(ScriptedEpuck::in_maze(MAZE), config());
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let seen = wander(&mut walker, Lesson::Observations(200), &mut rng).unwrap();
    CommonPatterns::learn(&seen, soinn()).unwrap()
}

/// The walk is the same to the bit whether the robot is owned or lent for a fragment at a time. The
/// map is that of an observer that only watches.
#[test]
fn it_walks_as_with_a_body_of_its_own_and_a_watcher_learns_the_same() {
    let patterns = patterns();
    let mut lent = ScriptedEpuck::in_maze(MAZE);
    let mut cpm = Cpm::new(config(), patterns.clone(), CpmConfig::online(), 7);
    pursue(&mut cpm, &mut lent, Task::Explore);

    let mut walker = Walker::new(ScriptedEpuck::in_maze(MAZE), config());
    let config_3 = CpmConfig::online();
    let mut layer = Layer3::begin(&mut walker, patterns.clone(), None, config_3).unwrap();
    let mut watcher = Cpm::new(config(), patterns.clone(), config_3, 8);
    let began = layer.map().junctions().next().unwrap().1;
    let began = CpmObservation::Began(began.sighting());
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut seen = vec![began];
    while let ControlFlow::Continue(step) =
        layer.advance(&mut walker, Aim::Explore, &mut rng).unwrap()
    {
        seen.push(CpmObservation::Walked(step.walked));
    }
    assert_eq!(walker.body().path, lent.path);

    assert_eq!(watcher.observe(&seen[1]), Err(CpmObserveError::NotBegun));
    for experience in &seen {
        watcher.observe(experience).unwrap();
    }
    assert_eq!(watcher.map(), cpm.map());
    assert!(cpm.map().links.len() >= 10);
}
