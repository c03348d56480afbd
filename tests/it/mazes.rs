//! Maze files as worlds for the robot.

use tolman_arena::course::Course;
use tolman_arena::episode::{self, Trial, random_start};
use tolman_arena::pioneer::body;
use tolman_geom::{Heading, Pose};
use tolman_robot::{Body, epuck};

use tolman_arena::cast::{Agent, Cast};

use crate::support::{course, course_for, data_of_others, files, mind, root, trial};

/// Every random start is on the floor, clear of the walls and outside the destination.
fn check_starts(course: &Course, body: &Body) {
    for seed in 0..50 {
        let start = random_start(course, body, seed);
        assert!(
            course.world.clear_for(body, start),
            "{}: {start:?}",
            course.name
        );
        let steps = course.maze.steps_to_goal();
        let cell = course.world.cell_at(start.position).unwrap();
        assert!(
            steps[course.maze.grid().index(cell)].is_some_and(|steps| steps > 0),
            "{}: no run can start at {cell}",
            course.name
        );
    }
}

#[test]
fn the_projects_mazes_are_courses() {
    let files = files(&root().join("mazes"));
    assert!(files.len() >= 2);
    for file in files {
        let name = file.file_stem().unwrap().to_string_lossy();
        // Those of CPM are an e-puck's.
        let body = match name.starts_with("cpm-") {
            true => Body::Circle {
                radius: epuck::BODY_RADIUS,
            },
            false => body(),
        };
        check_starts(&course_for(&file, &body), &body);
    }
}

#[test]
fn the_mazes_of_others_are_courses() {
    let Some(data) = data_of_others() else { return };
    let mut courses = 0;
    for file in files(&data.join("mazes/classic")) {
        let text = std::fs::read_to_string(&file).unwrap();
        // Some of them cannot be solved, and say so in their names.
        if let Ok(maze) = tolman_maze::read(&text) {
            let course = Course::for_body(&file.to_string_lossy(), &maze, &body()).unwrap();
            check_starts(&course, &body());
            courses += 1;
        }
    }
    assert!(courses > 200, "{courses}");
}

#[test]
fn an_oracle_crosses_a_competition_maze() {
    let Some(data) = data_of_others() else { return };
    let course = course(&data.join("mazes/classic/taiwan2016f.txt"));
    let (cell, _) = course.maze.start().unwrap();
    let trial = Trial {
        start: Pose::new(course.world.cell_centre(cell), Heading::EAST),
        step_limit: 5000,
        ..trial(&course, 1)
    };
    let mut oracle = mind(&Cast::default(), Agent::Oracle, &course);
    let episode = episode::run(&trial, &mut oracle, |_| {}).unwrap();
    assert!(episode.reached, "{} steps", episode.steps);
}
