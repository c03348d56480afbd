//! The better MSLST's map of the Large maze: its memory, and how it comes back from its file. Also
//! what happens in a robot or a world other than the learned one.

use alloc::sync::Arc;
use std::sync::OnceLock;

use tolman_arena::course::Course;
use tolman_arena::episode::{self, Trial, random_start};
use tolman_arena::mslst::{BetterLearned, better_config, learn_better};
use tolman_arena::pioneer::{ENCODER_SD, body, calibrated, with_sensor_noise};
use tolman_arena::run::TaskEnd;
use tolman_arena::{Mind, pioneer};
use tolman_maze::{Cell, Direction};
use tolman_sim::robots::{LaserPioneerConfig, StuckBeam};
use tolman_systems::Origin;
use tolman_systems::mslst::better::{BetterMap, BetterMapFile, BetterNavigator};

fn robot() -> LaserPioneerConfig {
    with_sensor_noise(&calibrated(), ENCODER_SD)
}

fn course() -> &'static Course {
    static COURSE: OnceLock<Course> = OnceLock::new();
    COURSE.get_or_init(|| {
        let maze = tolman_maze::read(include_str!("../../mazes/large.maze")).unwrap();
        Course::for_body("Large", &maze, &body()).unwrap()
    })
}

fn learned() -> &'static BetterLearned {
    static LEARNED: OnceLock<BetterLearned> = OnceLock::new();
    LEARNED.get_or_init(|| learn_better(course(), &robot(), 1, 5).unwrap())
}

/// Measures the memory of a navigating robot's map, plan and belief, per place.
#[test]
fn what_navigates_takes_less_than_a_kibibyte_a_place() {
    let learned = learned();
    assert_eq!(learned.ended.end, TaskEnd::Done);
    let chart = learned.map.chart();
    let config = better_config(course().corridor_width, &robot());
    let mut kept = None;
    let held = allocation_counter::measure(|| {
        let map = BetterMap::of(chart.clone(), pioneer::ring(), &config).unwrap();
        kept = Some(BetterNavigator::new(Arc::new(map)));
    });
    let places = chart.places().len() as i64;
    let bytes = held.bytes_current;
    assert!(places > 50, "{places} places");
    assert!(bytes < 1024 * places, "{bytes} bytes for {places} places");
    drop(kept);
}

#[test]
fn by_the_map_of_a_file_it_goes_the_very_same_way() {
    let learned = learned();
    let config = better_config(course().corridor_width, &robot());
    let file = BetterMapFile {
        origin: Origin {
            world: "Large".to_owned(),
            drawing: None,
            robot: pioneer::LASER_PIONEER.to_owned(),
            seed: 5,
        },
        config,
        chart: learned.map.chart().clone(),
        sites: learned.positions.clone(),
    };
    let text = file.to_json().unwrap();
    let read = BetterMapFile::from_json(&text).unwrap();
    assert_eq!(read, file);
    let read = BetterMap::of(read.chart, pioneer::ring(), &read.config).unwrap();
    let read = Arc::new(read);
    for seed in 0..3 {
        let trial = Trial {
            course: course(),
            robot: robot(),
            start: random_start(course(), &body(), seed),
            step_limit: 500,
            seed,
        };
        let [learned, read] = [&learned.map, &read].map(|map| {
            let mut mind = Mind::Rolling(Box::new(BetterNavigator::new(Arc::clone(map))));
            episode::run(&trial, &mut mind, |_| {}).unwrap()
        });
        assert_eq!(learned, read);
    }
}

/// A loop, from which the goal lies off.
const LOOP: &str = "\
+---+---+---+---+
|               |
+   +---+---+   +
|   | G     |   |
+   +---+   +   +
| S             |
+---+---+---+---+
";

/// Returns the map of the loop, and the loop with a wall since across its short way from the start
/// to the goal.
fn learned_before() -> (BetterLearned, Course) {
    let course = |maze: &str| {
        let maze = tolman_maze::read(maze).unwrap();
        Course::for_body("loop", &maze, &body()).unwrap()
    };
    let shut = LOOP.replace("| S             |", "| S     |       |");
    assert_ne!(shut, LOOP);
    let learned = learn_better(&course(LOOP), &robot(), 1, 1).unwrap();
    (learned, course(&shut))
}

#[test]
fn it_goes_round_a_wall_that_was_not_there_when_it_learned() {
    let (learned, shut) = learned_before();
    for seed in 0..3 {
        let trial = Trial {
            course: &shut,
            robot: robot(),
            start: shut.in_cell(Cell::new(0, 2), Direction::North),
            step_limit: 150,
            seed,
        };
        let navigator = BetterNavigator::new(Arc::clone(&learned.map));
        let mut mind = Mind::Rolling(Box::new(navigator));
        let episode = episode::run(&trial, &mut mind, |_| {}).unwrap();
        assert!(episode.reached, "seed {seed}");
    }
}

#[test]
fn a_stuck_beam_ahead_does_not_stop_it() {
    let mut robot = robot();
    let stuck = StuckBeam {
        beam: 0,
        range: 0.4,
    };
    robot.faults.stuck_beams.push(stuck);
    let learned = learn_better(course(), &robot, 1, 3).unwrap();
    assert_eq!(learned.ended.end, TaskEnd::Done);
    let places = learned.positions.len() as f64;
    assert!(places <= 1.25 * learned.true_places.len() as f64);
    for seed in 0..3 {
        let trial = Trial {
            course: course(),
            robot: robot.clone(),
            start: random_start(course(), &body(), seed),
            step_limit: 500,
            seed,
        };
        let navigator = BetterNavigator::new(Arc::clone(&learned.map));
        let mut mind = Mind::Rolling(Box::new(navigator));
        let episode = episode::run(&trial, &mut mind, |_| {}).unwrap();
        assert!(episode.reached, "seed {seed}");
    }
}
