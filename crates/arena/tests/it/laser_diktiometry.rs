//! The system on the laser Pioneer, through the one loop that runs systems.

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Goal, Landmark, Landmarked, Mapper, Task};
use tolman_sim::Solo;
use tolman_sim::robots::LaserPioneer;
use tolman_systems::diktiometry::{Diktiometer, DiktiometerConfig, LaserEye};

use tolman_arena::diktiometry::{Office, OfficeConfig, SurveyorConfig, TruePlace, mapper};
use tolman_arena::run::{Limited, TaskEnd, run};

/// Returns MSLST's J maze: corridors 0.95 m wide, with walls that are lines.
fn j() -> Office {
    let file = tolman_maze::read(include_str!("../../mazes/j-long.maze")).unwrap();
    let mut furniture = OfficeConfig::bare();
    furniture.corridor_width = file.corridor_width.unwrap();
    furniture.wall_thickness = 0.0;
    Office::new(&file.maze, &furniture).unwrap()
}

#[test]
fn what_leads_to_no_goal_is_no_part_of_it() {
    let office = j();
    // A J has two ends and three bends.
    let places = office.places(&[]);
    assert_eq!(places.len(), 5);
    let degrees = places.values().map(TruePlace::way_count);
    assert_eq!(degrees.sum::<usize>(), 8);
    let apart = office.separation() - office.config().pitch();
    assert!(apart.abs() < 1e-12, "{apart}");
}

#[test]
fn the_laser_pioneer_learns_the_j_and_goes_to_its_goal() {
    let office = j();
    let config = SurveyorConfig::mslst();
    let routines = config.routines(office.config().corridor_width);
    let truth = office.places(&[]);
    assert_eq!(office.doorways(), 0);
    // The goal is the east end of the hook, the start the other end.
    let ends = truth.values().filter(|place| place.way_count() == 1);
    let mut ends: Vec<Point> = ends.map(|place| place.position).collect();
    ends.sort_by(|a, b| a.x.total_cmp(&b.x));
    let [start, goal] = ends[..] else {
        panic!("a J has two ends");
    };
    for seed in 1..4 {
        let pioneer = LaserPioneer::new(config.laser_robot()).unwrap();
        let pose = Pose::new(start, Heading::NORTH);
        let solo = Solo::new(office.course.world.clone(), pioneer, pose, seed).unwrap();
        let is_near =
            |solo: &Solo<LaserPioneer>, at: Point| (solo.truth().pose.position - at).norm() < 0.3;
        let landmarked = Landmarked::new(solo, |solo: &Solo<LaserPioneer>| {
            is_near(solo, goal).then_some(Landmark::Goal)
        });
        let mut robot = Limited::new(landmarked, 20_000);
        let paper = DiktiometerConfig::paper(routines, mapper(&office, &config));
        let mut system = Diktiometer::new(paper, LaserEye { columns: 24 }, seed);

        let ended = run(&mut robot, &mut system, Task::Explore).unwrap();
        assert_eq!(ended.end, TaskEnd::Done, "seed {seed}: {ended:?}");
        let map = system.map();
        assert_eq!((map.places.len(), map.links.len()), (5, 8), "{map:#?}");
        for place in truth.values() {
            let is_there = |drawn: &Point| (start + drawn.coords - place.position).norm() < 0.5;
            let drawn = map.places.iter().filter_map(|place| place.position);
            assert_eq!(drawn.filter(is_there).count(), 1, "{place:?} of {map:#?}");
        }

        let home = map.places[0].id;
        let ended = run(&mut robot, &mut system, Task::Reach(Goal::Place(home))).unwrap();
        assert_eq!(ended.end, TaskEnd::Done);
        assert!(is_near(robot.robot().robot(), start), "seed {seed}");
        let task = Task::Reach(Goal::Landmark(Landmark::Goal));
        let ended = run(&mut robot, &mut system, task).unwrap();
        assert_eq!((ended.end, ended.actions), (TaskEnd::Done, 4), "by the map");
        assert!(is_near(robot.robot().robot(), goal), "seed {seed}");
    }
}

/// A run that is out of time stops in mid-corridor; the next one continues from there.
#[test]
fn a_run_that_broke_off_goes_on() {
    let office = j();
    let config = SurveyorConfig::mslst();
    let routines = config.routines(office.config().corridor_width);
    let start = office
        .places(&[])
        .values()
        .next()
        .map(|place| place.position);
    let pioneer = LaserPioneer::new(config.laser_robot()).unwrap();
    let pose = Pose::new(start.unwrap(), Heading::NORTH);
    let mut solo = Solo::new(office.course.world.clone(), pioneer, pose, 1).unwrap();
    let paper = DiktiometerConfig::paper(routines, mapper(&office, &config));
    let mut system = Diktiometer::new(paper, LaserEye { columns: 24 }, 1);
    for (limit, end) in [(50, TaskEnd::OutOfTime), (20_000, TaskEnd::Done)] {
        let nowhere = Landmarked::new(&mut solo, |_| None);
        let mut robot = Limited::new(nowhere, limit);
        let ended = run(&mut robot, &mut system, Task::Explore).unwrap();
        assert_eq!(ended.end, end, "{ended:?}");
    }
    assert_eq!(system.map().places.len(), 5);
}
