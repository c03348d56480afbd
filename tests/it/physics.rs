//! What a run may do, whatever drives: compared with the walls themselves, not with the simulator's
//! own idea of them.

use tolman_arena::course::Course;
use tolman_arena::episode;
use tolman_arena::pioneer::{body, calibrated, without_noise};
use tolman_geom::{Point, Pose, Vector};
use tolman_robot::Robot;

use tolman_arena::cast::{Agent, Cast};

use crate::support::{mind, own_course, trial, trial_of};

const SEEDS: u64 = 5;

fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Whether the straight way between two places meets a wall.
fn crosses(course: &Course, from: Point, to: Point) -> bool {
    course.world.walls().iter().any(|wall| {
        let side = |point: Point| cross(wall.end - wall.start, point - wall.start);
        let other = |point: Point| cross(to - from, point - from);
        side(from) * side(to) < 0.0 && other(wall.start) * other(wall.end) < 0.0
    })
}

/// How far it is from a place to the nearest wall.
fn clearance(course: &Course, place: Point) -> f64 {
    let distances = course.world.walls().iter().map(|wall| {
        let along = wall.end - wall.start;
        let share = (place - wall.start).dot(&along) / along.norm_squared();
        (place - (wall.start + along * share.clamp(0.0, 1.0))).norm()
    });
    distances.fold(f64::INFINITY, f64::min)
}

/// Metres along a beam to the first wall, by every wall in turn.
fn range(course: &Course, from: Point, bearing: Vector) -> f64 {
    let meets = course.world.walls().iter().filter_map(|wall| {
        let along = wall.end - wall.start;
        let turn = cross(bearing, along);
        let share = cross(wall.start - from, bearing) / turn;
        let range = cross(wall.start - from, along) / turn;
        ((0.0..=1.0).contains(&share) && range >= 0.0).then_some(range)
    });
    meets.fold(f64::INFINITY, f64::min)
}

#[test]
fn no_body_gets_into_or_through_a_wall() {
    let radius = body().radius();
    for maze in ["j.maze", "large.maze"] {
        let course = own_course(maze);
        let cast = Cast::default();
        for agent in Agent::ALL {
            let name = agent.name();
            for seed in 0..SEEDS {
                let trial = trial(&course, seed);
                let path = episode::run(&trial, &mut mind(&cast, agent, &course), |_| {})
                    .unwrap()
                    .path;
                for pair in path.windows(2) {
                    let [from, to] = [pair[0].position, pair[1].position];
                    assert!(
                        !crosses(&course, from, to),
                        "{name}, seed {seed}: {from} → {to}"
                    );
                    let free = clearance(&course, to);
                    assert!(
                        free > radius - 1e-9,
                        "{name}, seed {seed}: {free} m free at {to}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_run_ends_where_it_says() {
    let course = own_course("j.maze");
    let cast = Cast::default();
    for agent in Agent::ALL {
        let name = agent.name();
        for seed in 0..SEEDS {
            let trial = trial(&course, seed);
            let episode = episode::run(&trial, &mut mind(&cast, agent, &course), |_| {}).unwrap();
            let inside = |pose: &Pose| course.is_destination(pose.position);
            let (last, before) = episode.path.split_last().unwrap();
            assert_eq!(inside(last), episode.reached, "{name}, seed {seed}");
            assert!(
                !before.iter().any(inside),
                "{name}, seed {seed}: went on inside"
            );
            assert_eq!(episode.path.len(), episode.steps as usize + 1);
            assert!(episode.reached || episode.steps == trial.step_limit);
            assert!(episode.failed_actions <= episode.actions && episode.actions <= episode.steps);
        }
    }
}

#[test]
fn a_laser_without_noise_measures_the_walls() {
    let robot = without_noise(&calibrated());
    for maze in ["j.maze", "large.maze"] {
        let course = own_course(maze);
        let mut avoid = mind(&Cast::default(), Agent::Avoid, &course);
        let mut beams = 0;
        episode::run(&trial_of(&course, robot.clone(), 3), &mut avoid, |step| {
            let solo = step.robot;
            let (pose, scan) = (solo.truth().pose, solo.sensing().scan.as_ref().unwrap());
            for (beam, measured) in (0..).zip(&scan.ranges) {
                let direction = pose.heading.turned(scan.ring.bearing(beam)).unit();
                let expected = range(&course, pose.position, direction).min(scan.ring.max_range);
                assert!(
                    (measured - expected).abs() < 1e-9,
                    "{pose:?}, beam {beam}: {measured}"
                );
                beams += 1;
            }
        })
        .unwrap();
        assert!(beams > 1000);
    }
}
