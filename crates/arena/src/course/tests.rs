//! Courses in free worlds.

use tolman_geom::{Point, Pose};
use tolman_maze::MazeFile;
use tolman_robot::Body;
use tolman_sim::{Area, CorridorSize, World, Zone};
use tolman_systems::stream;

use super::{Course, CourseError, FreeWorld, Terrain};

const BODY: Body = Body::Circle { radius: 0.25 };

/// Returns a room of 4 × 2 m off the origin. A wall across it leaves a gap of width `gap`, m, in
/// the north.
fn room(gap: f64) -> World {
    let top = 3.0 - gap;
    let text = format!(
        r#"{{"format": "tolman-world", "version": 1,
            "polylines": [{{"points": [[-1, 1], [3, 1], [3, 3], [-1, 3]], "closed": true}}],
            "walls": [{{"start": [1, 1], "end": [1, {top}]}}],
            "zones": [{{"name": "destination", "areas": [{{"disc": {{"centre": [2.2, 2.0], "radius": 0.4}}}}]}},
                      {{"name": "start", "areas": [{{"disc": {{"centre": [-0.4, 2.1], "radius": 0.2}}}}]}}]}}"#
    );
    World::from_json(&text).unwrap()
}

fn course(world: World) -> Result<Course, CourseError> {
    Course::in_free_world("room", world, 0.95, &BODY)
}

#[test]
fn a_body_passes_gaps_that_are_wider_than_it() {
    let far = Point::new(-0.4, 2.1);
    assert!(course(room(0.63)).unwrap().leads_on(far));
    assert!(!course(room(0.49)).unwrap().leads_on(far));
    assert!(course(room(0.49)).unwrap().leads_on(Point::new(2.0, 1.5)));
    assert!(
        !course(room(1.0)).unwrap().leads_on(Point::new(5.0, 1.5)),
        "outside"
    );
}

#[test]
fn runs_begin_where_the_body_stands_clear_and_can_arrive() {
    let course = course(room(0.8)).unwrap();
    for seed in 0..200 {
        let random = course.random_start(&BODY, &mut stream(seed, 0));
        for pose in [random, course.anywhere(seed).unwrap()] {
            assert!(course.world.clear_for(&BODY, pose), "{pose:?}");
            assert!(course.leads_on(pose.position));
        }
        assert!(!course.is_destination(random.position));
    }
}

#[test]
fn the_marked_start_looks_along_the_longest_way() {
    let course = course(room(1.2)).unwrap();
    let Pose { position, heading } = course.start().unwrap();
    assert_eq!(position, Point::new(-0.4, 2.1));
    assert!((heading.degrees()).abs() < 1e-9, "east, through the gap");
    let shortest = course.shortest_metres().unwrap();
    assert!((2.2..3.5).contains(&shortest), "{shortest}");
}

#[test]
fn a_corridor_counts_as_long_as_it_is() {
    let walls = |length: f64| {
        let text = format!(
            r#"{{"format": "tolman-world", "version": 1,
                "polylines": [{{"points": [[0, 0], [{length}, 0], [{length}, 0.95], [0, 0.95]], "closed": true}}]}}"#
        );
        let goal = Area::Disc {
            centre: Point::new(0.5, 0.5),
            radius: 0.3,
        };
        let world = World::from_json(&text).unwrap();
        world
            .with_zone(Zone::new("destination", vec![goal]))
            .unwrap()
    };
    let long = course(walls(60.0)).unwrap().step_limit();
    let maze = tolman_maze::read("o---o---o\n| S   G |\no---o---o\n").unwrap();
    let per_metre = 500.0 / (63.0 * 0.95);
    assert!(
        (f64::from(long) / (60.0 * per_metre) - 1.0).abs() < 0.15,
        "{long}"
    );
    assert_eq!(
        Course::for_body("corridor", &maze, &BODY)
            .unwrap()
            .step_limit(),
        100
    );
}

#[test]
fn what_no_robot_can_run_in_is_refused() {
    let refused = |world, width| {
        let course = Course::in_free_world("room", world, width, &BODY);
        course.unwrap_err().to_string()
    };
    let bare = World::from_segments(room(1.0).walls().to_vec()).unwrap();
    assert!(refused(bare.clone(), 0.95).contains("no zone `destination`"));
    assert!(refused(room(1.0), 0.4).contains("0.5 m across does not fit corridors 0.4 m"));
    let area = |x, radius| {
        vec![Area::Disc {
            centre: Point::new(x, 2.0),
            radius,
        }]
    };
    let outside = bare
        .clone()
        .with_zone(Zone::new("destination", area(9.0, 0.5)));
    assert!(refused(outside.unwrap(), 0.95).contains("nowhere outside the destination"));
    let all = bare.with_zone(Zone::new("destination", area(1.0, 9.0)));
    assert!(refused(all.unwrap(), 0.95).contains("nowhere outside the destination"));
    let mut walls = room(1.0).walls().to_vec();
    walls[0].end.x = 1e5;
    let vast = World::from_segments(walls).unwrap();
    let vast = vast.with_zone(Zone::new("destination", area(2.2, 0.4)));
    assert!(refused(vast.unwrap(), 0.95).contains("too large"));
}

#[test]
fn a_maze_as_a_free_world_leads_where_the_maze_does() {
    let text = include_str!("../../mazes/large.maze");
    let file = tolman_maze::read(text).unwrap();
    let of_maze = Course::for_body("large", &file, &BODY).unwrap();
    let world = World::from_maze(&file.maze, &CorridorSize::thin(of_maze.corridor_width)).unwrap();
    let terrain = Terrain::Free(FreeWorld {
        world,
        corridor_width: Some(of_maze.corridor_width),
    });
    let free = terrain.course("large", &BODY).unwrap();
    for cell in file.maze.grid().cells() {
        let centre = of_maze.cell_centre(cell);
        assert_eq!(free.leads_on(centre), of_maze.leads_on(centre), "{cell:?}");
    }
    assert_ne!(free.drawing(), of_maze.drawing());
    assert!(free.needs_maze("the oracle").is_err() && of_maze.needs_maze("the oracle").is_ok());
    assert!(
        terrain.maze("the oracle").is_err() && Terrain::from(file as MazeFile).maze("it").is_ok()
    );
}

#[test]
fn the_drawing_tells_worlds_apart() {
    let drawing = |gap| course(room(gap)).unwrap().drawing();
    assert_eq!(drawing(1.0), drawing(1.0));
    assert_ne!(drawing(1.0), drawing(1.1));
}
