//! Tests the readings of a laser robot, and the inputs that a simulation refuses.

use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction, Grid, Maze};
use tolman_robot::{Robot, TurnTranslate};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{
    CorridorSize, Door, DoorState, Material, PlaceError, Simulation, Solo, StepError, WallSegment,
    World, WorldError,
};

fn robot() -> LaserPioneer {
    LaserPioneer::new(LaserPioneerConfig::noiseless()).unwrap()
}

fn at(x: f64, y: f64, degrees: f64) -> Pose {
    Pose::new(Point::new(x, y), Heading::from_degrees(degrees))
}

/// Returns one wall across, at x = 3.
fn wall() -> World {
    World::from_segments(vec![WallSegment::between(
        Point::new(3.0, -2.0),
        Point::new(3.0, 2.0),
    )])
    .unwrap()
}

fn ranges(solo: &Solo<LaserPioneer>) -> Vec<f64> {
    solo.sensing().scan.clone().unwrap().ranges
}

#[test]
fn a_robot_senses_before_its_first_step() {
    let solo = Solo::new(wall(), robot(), at(2.5, 0.0, 90.0), 1).unwrap();
    let sensing = solo.sensing();
    // East is to the right of north: beam 54.
    assert!((ranges(&solo)[54] - 0.5).abs() < 1e-12);
    assert!((ranges(&solo)[0] - 1.25).abs() < 1e-12);
    assert!(sensing.compass.unwrap().turn_to(Heading::NORTH).abs() < 1e-12);
    assert_eq!((sensing.time_us, sensing.bump), (0, Some(false)));
}

#[test]
fn odometry_follows_the_motion_and_a_bump_cuts_it() {
    let mut solo = Solo::new(wall(), robot(), at(1.6, 0.0, 0.0), 1).unwrap();
    let command = TurnTranslate {
        turn: 0.1,
        translate: 1.0,
    };
    let mut reckoned = at(1.6, 0.0, 0.0);
    for _ in 0..3 {
        solo.step(&command).unwrap();
        reckoned = solo.sensing().odometry.unwrap().applied_to(reckoned);
        if !solo.truth().bump {
            assert!((reckoned.position - solo.truth().pose.position).norm() < 1e-12);
        }
    }
    assert_eq!(solo.sensing().bump, Some(true), "the wall is 1.15 m ahead");
    assert!(solo.sensing().odometry.unwrap().distance < 0.5);
    assert_eq!(solo.sensing().time_us, 300_000);
    // Beyond full rate counts as full rate.
    solo.place(at(0.0, 0.0, 180.0)).unwrap();
    solo.step(&TurnTranslate {
        turn: 0.0,
        translate: 7.0,
    })
    .unwrap();
    assert!((solo.sensing().odometry.unwrap().distance - 0.5).abs() < 1e-12);
}

#[test]
fn robots_see_each_other_and_doors() {
    let door = Door {
        name: "south".to_owned(),
        start: Point::new(-1.0, -0.75),
        end: Point::new(1.0, -0.75),
        material: Material::default(),
        state: DoorState::Shut,
        schedule: Vec::new(),
    };
    let mut sim = Simulation::new(wall().with_door(door).unwrap(), 1);
    let first = sim.add(robot(), at(0.0, 0.0, 0.0)).unwrap();
    let second = sim.add(robot(), at(1.0, 0.0, 180.0)).unwrap();
    sim.step(&[TurnTranslate::STOP; 2]).unwrap();
    for robot in [first, second] {
        let scan = sim.sensing(robot).scan.clone().unwrap();
        assert!(
            (scan.ranges[0] - 0.75).abs() < 1e-12,
            "the other one's skin"
        );
    }
    let south =
        |sim: &Simulation<LaserPioneer>| sim.sensing(first).scan.clone().unwrap().ranges[54];
    assert!((south(&sim) - 0.75).abs() < 1e-12);
    sim.set_door("south", DoorState::Open).unwrap();
    sim.step(&[TurnTranslate::STOP; 2]).unwrap();
    assert!((south(&sim) - 1.25).abs() < 1e-12);
}

#[test]
fn a_kidnapped_robot_feels_nothing_of_it() {
    let mut solo = Solo::new(wall(), robot(), at(0.0, 0.0, 0.0), 1).unwrap();
    solo.place(at(2.5, 1.0, 0.0)).unwrap();
    solo.step(&TurnTranslate::STOP).unwrap();
    assert_eq!(
        solo.sensing().odometry.unwrap(),
        tolman_robot::Odometry::default()
    );
    assert!((ranges(&solo)[0] - 0.5).abs() < 1e-12);
}

#[test]
fn a_command_that_is_no_number_moves_nothing() {
    let mut sim = Simulation::new(wall(), 1);
    let first = sim.add(robot(), at(0.0, 0.0, 0.0)).unwrap();
    let second = sim.add(robot(), at(1.0, 0.0, 0.0)).unwrap();
    let go = TurnTranslate {
        turn: 0.0,
        translate: -1.0,
    };
    let (before, sensed) = (*sim.truth(first), sim.sensing(first).clone());
    let nan = TurnTranslate {
        turn: f64::NAN,
        translate: 0.0,
    };
    let error = sim.step(&[go, nan]).unwrap_err();
    assert!(matches!(error, StepError::Command { robot, .. } if robot == second));
    assert_eq!(
        error.to_string(),
        "robot 1: the command's turn is NaN; give a finite number"
    );
    let error = sim.step(&[go]).unwrap_err();
    assert_eq!(
        error,
        StepError::Commands {
            commands: 1,
            robots: 2
        }
    );
    assert_eq!((sim.tick(), *sim.truth(first)), (0, before));
    assert_eq!(*sim.sensing(first), sensed);
}

#[test]
fn impossible_places_are_refused() {
    let maze = Maze::open(Grid::new(3, 1));
    let world = World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap();
    let refuse = |pose| {
        Solo::new(world.clone(), robot(), pose, 1)
            .map(|_| ())
            .unwrap_err()
    };
    assert!(matches!(
        refuse(at(f64::NAN, 0.0, 0.0)),
        PlaceError::NotFinite { .. }
    ));
    assert!(matches!(
        refuse(at(0.0, 0.0, f64::INFINITY)),
        PlaceError::NotFinite { .. }
    ));
    assert!(matches!(
        refuse(at(-1.0, 0.5, 0.0)),
        PlaceError::NotOnFloor { .. }
    ));
    let PlaceError::InWall { free, radius, .. } = refuse(at(0.2, 0.475, 0.0)) else {
        panic!("a wall is 0.2 m away");
    };
    assert!((free - 0.2).abs() < 1e-12 && (radius - 0.25).abs() < 1e-12);
    // A robot wider than the corridor fits nowhere.
    let narrow = World::from_maze(&maze, &CorridorSize::thin(0.4)).unwrap();
    let middle = Pose::new(narrow.cell_centre(Cell::new(1, 0)), Heading::EAST);
    let error = Solo::new(narrow, robot(), middle, 1)
        .map(|_| ())
        .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("a smaller robot or a wider corridor"),
        "{error}"
    );
    // Inside a thick wall.
    let mut walled = maze.clone();
    walled.set_wall(Cell::new(0, 0), Direction::East, true);
    let size = CorridorSize {
        corridor_width: 0.8,
        wall_thickness: 0.3,
    };
    let thick = World::from_maze(&walled, &size).unwrap();
    let error = Solo::new(thick, robot(), at(1.1, 0.55, 0.0), 1)
        .map(|_| ())
        .unwrap_err();
    assert!(matches!(error, PlaceError::NotOnFloor { .. }), "{error}");

    let mut sim = Simulation::new(world, 1);
    let first = sim.add(robot(), at(0.475, 0.475, 0.0)).unwrap();
    let error = sim.add(robot(), at(0.9, 0.475, 0.0)).unwrap_err();
    assert!(
        matches!(error, PlaceError::InRobot { other, .. } if other == first),
        "{error}"
    );
    let error = sim.place(first, at(0.1, 0.1, 0.0)).unwrap_err();
    assert!(matches!(error, PlaceError::InWall { .. }), "{error}");
    assert_eq!(sim.truth(first).pose, at(0.475, 0.475, 0.0));
    let mut config = LaserPioneerConfig::noiseless();
    config.step_us = 50_000;
    let error = sim
        .add(LaserPioneer::new(config).unwrap(), at(2.0, 0.475, 0.0))
        .unwrap_err();
    assert!(
        matches!(
            error,
            PlaceError::Step {
                step_us: 50_000,
                expected_us: 100_000
            }
        ),
        "{error}"
    );
}

#[test]
fn impossible_worlds_are_refused() {
    let maze = Maze::open(Grid::new(1, 1));
    let error = World::from_maze(&maze, &CorridorSize::thin(f64::NAN)).unwrap_err();
    assert!(matches!(error, WorldError::CorridorWidth { .. }));
    let negative = CorridorSize {
        corridor_width: 1.0,
        wall_thickness: -0.1,
    };
    let error = World::from_maze(&maze, &negative).unwrap_err();
    assert!(matches!(error, WorldError::WallThickness { .. }));
    assert_eq!(
        World::from_segments(Vec::new()).unwrap_err(),
        WorldError::NoWalls
    );
    let point = Point::new(1.0, 1.0);
    let error = World::from_segments(vec![WallSegment::between(point, point)]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("wall 0 from (1, 1) to (1, 1) m has no length"),
        "{error}"
    );
    let nan = WallSegment::between(point, Point::new(f64::NAN, 0.0));
    assert!(matches!(
        World::from_segments(vec![nan]),
        Err(WorldError::Wall { index: 0, .. })
    ));
    let zone = |name: &str, radius| {
        tolman_sim::Zone::new(
            name,
            vec![tolman_sim::Area::Disc {
                centre: point,
                radius,
            }],
        )
    };
    let twice = wall()
        .with_zone(zone("goal", 1.0))
        .unwrap()
        .with_zone(zone("goal", 2.0));
    assert!(matches!(twice, Err(WorldError::ZoneTwice { .. })));
    assert!(matches!(
        wall().with_zone(zone("goal", 0.0)),
        Err(WorldError::Zone { index: 0, .. })
    ));
}

#[test]
fn a_maze_marks_its_zones_and_cells() {
    let mut maze = Maze::open(Grid::new(3, 2));
    maze.set_goals(vec![Cell::new(2, 0), Cell::new(2, 1)]);
    maze.set_start(Some((Cell::new(0, 1), Direction::East)));
    let world = World::from_maze(&maze, &CorridorSize::thin(0.5)).unwrap();
    for cell in maze.grid().cells() {
        let centre = world.cell_centre(cell);
        assert_eq!(world.cell_at(centre), Some(cell));
        assert_eq!(
            world.zone("destination").unwrap().contains(centre),
            cell.x == 2
        );
        assert_eq!(
            world.zone("start").unwrap().contains(centre),
            cell == Cell::new(0, 1)
        );
        assert!((world.nearest_wall_distance(centre) - 0.25).abs() < 1e-12 || cell.x == 1);
    }
    assert_eq!(world.cell_at(Point::new(-0.01, 0.1)), None);
    assert!((world.bounds().width() - 1.5).abs() < 1e-12);
}

/// Steps a crowd a little in a maze of 40,000 walls: bodies stay apart.
#[test]
fn a_crowd_in_a_large_maze() {
    let side = 199;
    let mut maze = Maze::open(Grid::new(side, side));
    for cell in maze.grid().cells().collect::<Vec<_>>() {
        if cell.y + 1 < side && cell.x > 0 {
            maze.set_wall(cell, Direction::North, true);
        }
    }
    let mut sim = Simulation::new(
        World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap(),
        1,
    );
    for cell in maze.grid().cells().step_by(39) {
        let pose = Pose::new(sim.world().cell_centre(cell), Heading::EAST);
        sim.add(robot(), pose).unwrap();
    }
    let count = sim.robots().len();
    assert!(count > 1000);
    let commands = vec![
        TurnTranslate {
            turn: 0.1,
            translate: 1.0
        };
        count
    ];
    for _ in 0..5 {
        sim.step(&commands).unwrap();
    }
    assert!(sim.robots().any(|robot| sim.truth(robot).bump));
}
