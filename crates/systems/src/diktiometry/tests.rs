//! The system on a robot of a few lines, without the simulator.

use core::convert::Infallible;

use tolman_geom::{Heading, Point, Vector};
use tolman_maps::diktiometry::{Config, Identity, Observer, PlaceId};
use tolman_maze::{Direction, Maze};
use tolman_robot::{
    Goal, Landmark, Landmarked, LaserSensing, MapView, Mapper, Odometry, Position, Ring, Robot,
    SensesLandmarks, Standing, System, Task, TurnTranslate,
};

use super::*;

/// A ring of corridors with a branch: five places, ten ways.
const RING: &str = "\
o---o---o---o---o---o---o
|               |   |   |
o   o---o---o   o---o---o
|   |   |   |   |   |   |
o   o---o---o   o---o---o
|   |   |   |   |   |   |
o   o---o---o   o---o---o
|                     G |
o---o---o---o---o---o---o
";

/// The places of the ring, m.
const PLACES: [[f64; 2]; 5] = [[0.5, 0.5], [0.5, 3.5], [3.5, 3.5], [3.5, 0.5], [5.5, 0.5]];
/// The end of the branch.
const END: [f64; 2] = PLACES[4];

/// A point in a maze with corridors one metre wide.
#[derive(Clone)]
struct Scripted {
    maze: Maze,
    at: Point,
    heading: f64,
    ring: Ring,
    /// Factor by which the rover's wheels overrate each way.
    scale: f64,
    sensing: LaserSensing,
}

impl Scripted {
    fn new(at: [f64; 2], scale: f64) -> Self {
        let ring = Ring::full(72, 3.0);
        let mut robot = Self {
            maze: tolman_maze::parse(RING).unwrap().maze,
            at: Point::from(at),
            heading: 1.0,
            ring,
            scale,
            sensing: LaserSensing::silent(ring),
        };
        robot.sense(0.0, 0.0);
        robot
    }

    /// Returns the range along a heading: from cell to cell until a wall stands.
    fn range(&self, heading: f64) -> f64 {
        let (sin, cos) = heading.sin_cos();
        let ahead = [
            if cos > 0.0 {
                Direction::East
            } else {
                Direction::West
            },
            if sin > 0.0 {
                Direction::North
            } else {
                Direction::South
            },
        ];
        let mut cell = tolman_maze::Cell::new(self.at.x as u16, self.at.y as u16);
        loop {
            let edge = |at: f64, index: u16, speed: f64| {
                let edge = f64::from(index) + if speed > 0.0 { 1.0 } else { 0.0 };
                let range = (edge - at) / speed;
                if range.is_finite() {
                    range
                } else {
                    f64::INFINITY
                }
            };
            let [x, y] = [edge(self.at.x, cell.x, cos), edge(self.at.y, cell.y, sin)];
            let (range, side) = if x < y { (x, ahead[0]) } else { (y, ahead[1]) };
            if range > self.ring.max_range || !self.maze.is_open(cell, side) {
                return range.min(self.ring.max_range);
            }
            cell = self.maze.beside(cell, side).unwrap();
        }
    }

    fn sense(&mut self, distance: f64, turn: f64) {
        let bearings = (0..self.ring.beams).map(|beam| self.ring.bearing(beam));
        let ranges = bearings.map(|bearing| self.range(self.heading + bearing));
        let ranges = ranges.collect();
        self.sensing.scan = Some(tolman_robot::Scan {
            ring: self.ring,
            ranges,
        });
        self.sensing.compass = Some(Heading::from_radians(self.heading));
        let distance = distance * self.scale;
        self.sensing.odometry = Some(Odometry { distance, turn });
    }
}

impl Robot for Scripted {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = Infallible;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
        let (turn, distance) = (command.turn * TURN, command.translate * STRIDE);
        self.heading += turn;
        self.at += Vector::new(self.heading.cos(), self.heading.sin()) * distance;
        self.sense(distance, turn);
        Ok(())
    }
}

/// Full rates of the robot.
const TURN: f64 = 1.0;
const STRIDE: f64 = 0.2;

fn near(a: Point, b: Point) -> bool {
    (a - b).norm() < 0.3
}

fn at_the_end(robot: &Scripted) -> Option<Landmark> {
    near(robot.at, Point::from(END)).then_some(Landmark::Goal)
}

fn system(seed: u64) -> Diktiometer<LaserEye> {
    let mut routines = RoutineConfig::new(1.0, TURN, STRIDE);
    routines.odometry_share = 0.03;
    routines.compass_bound = 0.01;
    let mut mapper = Config::new(Config::compass_actions(), 2.0);
    mapper.place_radius = 0.05;
    mapper.percepts = aligned_signatures(1, 24);
    Diktiometer::new(
        DiktiometerConfig::paper(routines, mapper),
        LaserEye { columns: 24 },
        seed,
    )
}

/// Acts until the task no longer goes on, and returns how it stands.
fn pursue<R>(system: &mut Diktiometer<LaserEye>, robot: &mut R, task: Task) -> Standing
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error = Infallible>,
{
    for _ in 0..300 {
        match system.act(robot, task).unwrap() {
            Standing::UnderWay => {}
            standing => return standing,
        }
    }
    Standing::UnderWay
}

/// Returns whether the places of a map are those of the ring, as seen from where place 0 truly
/// lies.
fn is_the_ring(map: &MapView, origin: Point) -> bool {
    let drawn = |place: &tolman_robot::MapPlace| place.position.map(|at| origin + at.coords);
    let places: Vec<Point> = map.places.iter().filter_map(drawn).collect();
    let all = PLACES.map(Point::from);
    let found = all
        .into_iter()
        .filter(|truth| places.iter().any(|place| near(*place, *truth)));
    found.count() == PLACES.len() && map.places.len() == PLACES.len() && map.links.len() == 10
}

#[test]
fn a_robot_learns_the_ring_and_goes_where_it_is_sent() {
    for seed in 0..5 {
        let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.02), at_the_end);
        let mut system = system(seed);
        let done = pursue(&mut system, &mut robot, Task::Explore);
        assert_eq!(done, Standing::Done, "seed {seed}");
        let map = system.map();
        let origin = Point::from(PLACES[0]);
        assert!(is_the_ring(&map, origin), "seed {seed}: {map:#?}");
        let landmarks = map.places.iter().filter_map(|place| place.landmark);
        assert_eq!(landmarks.collect::<Vec<_>>(), [Landmark::Goal]);

        for place in &map.places {
            let task = Task::Reach(Goal::Place(place.id));
            assert_eq!(pursue(&mut system, &mut robot, task), Standing::Done);
            let expected = origin + place.position.unwrap().coords;
            let at = robot.robot().at;
            assert!(near(at, expected), "seed {seed}: {at} for {expected}");
            assert_eq!(system.belief()[0].at, Position::Place(place.id));
        }
        let task = Task::Reach(Goal::Place(99));
        let standing = pursue(&mut system, &mut robot, task);
        assert!(matches!(standing, Standing::GaveUp { why } if why.contains("99")));
    }
}

#[test]
fn a_landmark_is_sought_and_then_planned_to() {
    let mut robot = Landmarked::new(Scripted::new([2.3, 3.5], 0.98), at_the_end);
    let mut system = system(1);
    let task = Task::Reach(Goal::Landmark(Landmark::Goal));
    assert_eq!(pursue(&mut system, &mut robot, task), Standing::Done);
    assert_eq!(at_the_end(robot.robot()), Some(Landmark::Goal));
    assert_eq!(
        pursue(&mut system, &mut robot, Task::Explore),
        Standing::Done
    );
    // The corner where it began is place 0, not the spot amid the corridor.
    assert_eq!(system.map().places.len(), PLACES.len());

    let home = Task::Reach(Goal::Place(0));
    assert_eq!(pursue(&mut system, &mut robot, home), Standing::Done);
    assert_eq!(at_the_end(robot.robot()), None);
    let mut moves = 0;
    while moves < 300 && system.act(&mut robot, task).unwrap() == Standing::UnderWay {
        moves += 1;
    }
    assert!(moves < 4, "{moves} moves by plan");
    assert_eq!(at_the_end(robot.robot()), Some(Landmark::Goal));

    let nowhere = Task::Reach(Goal::Landmark(Landmark::Numbered(7)));
    let standing = pursue(&mut system, &mut robot, nowhere);
    assert!(matches!(standing, Standing::GaveUp { .. }), "{standing:?}");
}

#[test]
fn another_goes_on_with_the_map_and_knows_where_it_is() {
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), at_the_end);
    let mut first = system(2);
    assert_eq!(
        pursue(&mut first, &mut robot, Task::Explore),
        Standing::Done
    );
    let observer = first.observer().unwrap().clone();
    let known = observer.moves();
    let eye = LaserEye { columns: 24 };
    let mut again = Diktiometer::with_map(first.config().clone(), eye, observer, 3);
    let standing = pursue(&mut again, &mut robot, Task::Localize);
    assert_eq!(standing, Standing::Done);
    let moves = again.observer().unwrap().moves() - known;
    assert_eq!(moves, 10, "confidence rests on this many");
    let Position::Place(id) = again.belief()[0].at else {
        panic!("a place");
    };
    let map = again.map();
    assert!(is_the_ring(&map, Point::from(PLACES[0])), "{map:#?}");
    let place = map.places.iter().find(|place| place.id == id);
    let expected = Point::from(PLACES[0]) + place.unwrap().position.unwrap().coords;
    let at = robot.robot().at;
    assert!(near(at, expected), "{at} for {expected}");
}

/// Carries a robot off after three routines of its exploration, inside a corridor: no place looks
/// like that. Returns its visits until then, and how the exploration ends.
fn carried_off(system: &mut Diktiometer<LaserEye>) -> (Vec<Option<u32>>, Standing) {
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), at_the_end);
    for _ in 0..3 {
        let standing = system.act(&mut robot, Task::Explore).unwrap();
        assert_eq!(standing, Standing::UnderWay);
    }
    let visits = Mapper::visits(system);
    robot.robot_mut().at = Point::new(0.5, 2.0);
    let standing = pursue(system, &mut robot, Task::Explore);
    (visits, standing)
}

#[test]
fn a_robot_that_is_carried_off_while_it_learns_begins_another_map() {
    for seed in 0..5 {
        let mut system = system(seed);
        let (visits, standing) = carried_off(&mut system);
        assert_eq!(standing, Standing::Done, "seed {seed}");
        let all = Mapper::visits(&system);
        let (before, after) = all.split_at(visits.len());
        assert!(before.iter().all(Option::is_none), "of the map it dropped");
        assert!(after.iter().all(Option::is_some));
        assert_eq!(system.map().places.len(), PLACES.len());
    }
}

#[test]
fn a_robot_that_is_carried_off_stops_by_the_papers_rule_of_matching() {
    let mut config = system(0).config().clone();
    config.mapper.matching.identity = Identity::Meets;
    let mut system = Diktiometer::new(config, LaserEye { columns: 24 }, 0);
    let (visits, standing) = carried_off(&mut system);
    assert!(
        matches!(&standing, Standing::GaveUp { why } if why.contains("carried")),
        "{standing:?}"
    );
    assert_eq!(Mapper::visits(&system), visits, "it came to no place");
}

/// Fails once, after a number of time steps.
struct Failing(Scripted, Option<u32>);

impl Robot for Failing {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = core::fmt::Error;

    fn sensing(&self) -> &LaserSensing {
        self.0.sensing()
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), core::fmt::Error> {
        match &mut self.1 {
            Some(0) => {
                self.1 = None;
                return Err(core::fmt::Error);
            }
            Some(left) => *left -= 1,
            None => {}
        }
        self.0.step(command).map_err(|never| match never {})
    }
}

impl SensesLandmarks for Failing {
    fn landmark(&self) -> Option<Landmark> {
        None
    }
}

#[test]
fn a_routine_that_broke_off_amid_a_corridor_is_made_good() {
    let mut amid = 0;
    for after in (20..400).step_by(19) {
        let mut robot = Failing(Scripted::new(PLACES[0], 1.0), Some(after));
        let mut system = system(4);
        while system.act(&mut robot, Task::Explore).is_ok() {}
        let stopped = robot.0.at;
        if PLACES
            .iter()
            .any(|place| (stopped - Point::from(*place)).norm() < 0.7)
        {
            continue;
        }
        amid += 1;
        for _ in 0..300 {
            system.act(&mut robot, Task::Explore).unwrap();
        }
        let map = system.map();
        let origin = Point::from(PLACES[0]);
        assert!(is_the_ring(&map, origin), "{stopped}, {after}: {map:#?}");
    }
    assert!(amid > 5, "{amid}");
}

#[test]
fn what_cannot_be_driven_is_refused_by_name() {
    let mut blind = Scripted::new(PLACES[0], 1.0);
    blind.ring = Ring::fan(72, 3.0, 3.0);
    blind.sense(0.0, 0.0);
    let mut robot = Landmarked::new(blind, at_the_end);
    let failure = system(1).act(&mut robot, Task::Explore).unwrap_err();
    let told = format!("{failure:?}");
    assert!(told.contains("NotRound"), "{told}");
}

/// Returns a map of the ring, and the place on it where the goal is.
fn known_ring() -> (Observer, Option<PlaceId>) {
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), at_the_end);
    let mut learner = system(2);
    let done = pursue(&mut learner, &mut robot, Task::Explore);
    assert_eq!(done, Standing::Done);
    let places = learner.map().places;
    let goal = places.iter().find(|place| place.landmark.is_some());
    let goal = goal.map(|place| PlaceId(place.id));
    (learner.observer().unwrap().clone(), goal)
}

fn wayfinder(known: &(Observer, Option<PlaceId>), seed: u64) -> Diktiometer<LaserEye> {
    put_down(&known.0, known.1.map(LandmarkSpot::Place), seed)
}

/// Returns a system that was put down anywhere on a map.
fn put_down(map: &Observer, goal: Option<LandmarkSpot>, seed: u64) -> Diktiometer<LaserEye> {
    let (config, eye) = (system(0).config().clone(), LaserEye { columns: 24 });
    let mut system = Diktiometer::with_map(config, eye, map.clone(), seed);
    if let Some(goal) = goal {
        system.remember(Landmark::Goal, goal);
    }
    assert_eq!(system.put_down(), Standing::UnderWay);
    system
}

/// Points in mid-corridor and at places of the ring.
const STARTS: [[f64; 2]; 7] = [
    [0.5, 1.7],
    [0.4, 3.1],
    [2.2, 3.6],
    [3.5, 2.4],
    [1.9, 0.5],
    [4.4, 0.55],
    [3.5, 0.5],
];

#[test]
fn a_robot_that_was_put_down_anywhere_finds_its_way() {
    let known = known_ring();
    for (seed, start) in (0..).zip(STARTS) {
        let mut robot = Landmarked::new(Scripted::new(start, 1.02), at_the_end);
        let mut system = wayfinder(&known, seed);
        assert!(system.belief().is_empty());
        let task = Task::Reach(Goal::Landmark(Landmark::Goal));
        let mut moves = 0;
        let standing = loop {
            moves += 1;
            match System::act(&mut system, &mut robot, task).unwrap() {
                Standing::UnderWay => assert!(moves < 40, "{start:?}"),
                standing => break standing,
            }
        };
        assert_eq!(standing, Standing::Done, "{start:?}");
        assert_eq!(at_the_end(robot.robot()), Some(Landmark::Goal));
        let whole: f64 = system.belief().iter().map(|guess| guess.weight).sum();
        assert!((whole - 1.0).abs() < 1e-9);
        // The map is as it was.
        assert_eq!(system.map().places.len(), PLACES.len());
    }
}

#[test]
fn a_robot_that_is_carried_off_on_its_way_finds_out() {
    let known = known_ring();
    let home = Task::Reach(Goal::Place(0));
    for (seed, start) in (0..).zip(STARTS) {
        let mut robot = Landmarked::new(Scripted::new(start, 1.0), |_| None);
        let mut system = wayfinder(&(known.0.clone(), None), seed);
        for _ in 0..40 {
            if System::act(&mut system, &mut robot, Task::Localize).unwrap() == Standing::Done {
                break;
            }
        }
        assert!(system.belief()[0].weight > 0.5, "{start:?}");
        // To another place than it knows it stands at.
        let at = robot.robot().at;
        let elsewhere = PLACES
            .map(Point::from)
            .into_iter()
            .find(|place| !near(*place, at));
        robot.robot_mut().at = elsewhere.unwrap();
        robot.robot_mut().sense(0.0, 0.0);
        let mut moves = 0;
        while System::act(&mut system, &mut robot, home).unwrap() == Standing::UnderWay {
            moves += 1;
            assert!(moves < 80, "{start:?}");
        }
        assert!(near(robot.robot().at, Point::from(PLACES[0])), "{start:?}");
    }
}

#[test]
fn a_goal_that_the_map_does_not_have_is_given_up() {
    let (map, _) = known_ring();
    let mut robot = Landmarked::new(Scripted::new(STARTS[0], 1.0), |_| None);
    let mut system = wayfinder(&(map, None), 1);
    let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
    for (task, why) in [
        (goal, "not on the map"),
        (Task::Reach(Goal::Place(99)), "99"),
        (Task::Explore, "learns none"),
    ] {
        let standing = System::act(&mut system, &mut robot, task).unwrap();
        assert!(
            matches!(&standing, Standing::GaveUp { why: told } if told.contains(why)),
            "{standing:?}"
        );
    }
}

/// Returns the goal in the middle of the northern corridor, where no place is.
fn amid_the_north(robot: &Scripted) -> Option<Landmark> {
    (near(robot.at, Point::new(2.0, 3.5))).then_some(Landmark::Goal)
}

#[test]
fn a_goal_on_the_way_between_two_places_is_found_again() {
    let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), amid_the_north);
    let mut learner = system(2);
    let done = pursue(&mut learner, &mut robot, Task::Explore);
    assert_eq!(done, Standing::Done);
    let spot = learner.spot_of(Landmark::Goal);
    assert!(matches!(spot, Some(LandmarkSpot::Way(..))), "{spot:?}");

    assert_eq!(pursue(&mut learner, &mut robot, goal), Standing::Done);
    assert_eq!(amid_the_north(robot.robot()), Some(Landmark::Goal));
    // It has not forgotten where that was.
    assert_eq!(learner.spot_of(Landmark::Goal), spot);
    let home = Task::Reach(Goal::Place(0));
    assert_eq!(pursue(&mut learner, &mut robot, home), Standing::Done);
    assert!(near(robot.robot().at, Point::from(PLACES[0])));

    let map = learner.observer().unwrap();
    let finder = |seed| put_down(map, spot, seed);
    for (seed, start) in (0..).zip(STARTS) {
        let mut robot = Landmarked::new(Scripted::new(start, 1.02), amid_the_north);
        let mut finder = finder(seed);
        let mut moves = 0;
        while System::act(&mut finder, &mut robot, goal).unwrap() == Standing::UnderWay {
            moves += 1;
            assert!(moves < 40, "{start:?}");
        }
        assert_eq!(
            amid_the_north(robot.robot()),
            Some(Landmark::Goal),
            "{start:?}"
        );
    }
    // Where the goal is gone it gives up.
    let mut robot = Landmarked::new(Scripted::new(STARTS[0], 1.0), |_| None);
    let mut finder = finder(1);
    let standing = loop {
        match System::act(&mut finder, &mut robot, goal).unwrap() {
            Standing::UnderWay => {}
            standing => break standing,
        }
    };
    assert!(matches!(&standing, Standing::GaveUp { why } if why.contains("not where")));
}

#[test]
fn a_robot_that_broke_off_goes_on_or_turns_back_to_the_place_that_is_asked_for() {
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), amid_the_north);
    let mut learner = system(2);
    assert_eq!(
        pursue(&mut learner, &mut robot, Task::Explore),
        Standing::Done
    );
    let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
    for end in [PLACES[1], PLACES[2], PLACES[1]] {
        assert_eq!(pursue(&mut learner, &mut robot, goal), Standing::Done);
        let map = learner.map();
        let origin = Point::from(PLACES[0]);
        let is_end = |place: &&tolman_robot::MapPlace| {
            let at = place.position.map(|at| origin + at.coords);
            at.is_some_and(|at| near(at, Point::from(end)))
        };
        let id = map.places.iter().find(is_end).unwrap().id;
        // One routine leads there, either way, and the map stays as it is.
        let standing = learner.act(&mut robot, Task::Reach(Goal::Place(id)));
        assert_eq!(standing.unwrap(), Standing::Done);
        assert!(near(robot.robot().at, Point::from(end)));
        assert!(is_the_ring(&learner.map(), origin));
    }
}

#[test]
fn a_way_that_was_never_tried_is_hoped_for_and_a_known_world_is_as_planned() {
    let mut robot = Landmarked::new(Scripted::new(PLACES[0], 1.0), at_the_end);
    let mut learner = system(2);
    let mut hopes = 0;
    loop {
        let standing = learner.act(&mut robot, Task::Explore).unwrap();
        let observer = learner.observer().unwrap();
        let places: Vec<PlaceId> = observer.map().paths.places().map(|(id, _)| id).collect();
        for to in places {
            let from = observer.place();
            let Some(plan) = observer.plan(from, to) else {
                continue;
            };
            let way = approach(observer, &[true; 4], from, to).unwrap();
            assert_eq!(way.first.is_none(), plan.is_empty());
            let starts = [from].into_iter().chain(plan.iter().map(|step| step.to));
            let legs = starts.zip(&plan);
            let legs = legs.map(|(start, step)| observer.map().distance(start, step.to));
            let known: f64 = legs.sum();
            assert!(way.metres < known + 0.1, "{way:?}, {known}");
            hopes += u32::from(way.metres < known - 0.1);
            if standing == Standing::Done {
                assert!(way.metres > known - 0.1, "{way:?}, {known}");
            }
        }
        if standing == Standing::Done {
            break;
        }
    }
    assert!(hopes > 0);
}
