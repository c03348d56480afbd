use rand::SeedableRng;
use std::time::Instant;
use tolman_arena::course::Course;
use tolman_arena::episode::layers;
use tolman_arena::episode::random_start;
use tolman_arena::pioneer::calibrated;
use tolman_arena::run::{self, Limited};
use tolman_control::Drive;
use tolman_geom::Point;
use tolman_robot::{Body, Task};
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_systems::mslst::better::*;
use tolman_systems::{Actor, stream};

pub fn noisy(seed: u64, enc: f64) -> LaserPioneerConfig {
    let mut config = calibrated();
    config.odometry_distance_noise = Gaussian::relative(enc);
    config.scan_noise = Gaussian::relative(0.02);
    let _ = seed;
    let _: Option<Fault> = None;
    config
}

fn courses(kind: &str, seed: u64) -> Course {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    let text = |name: &str| std::fs::read_to_string(format!("mazes/{name}.maze")).unwrap();
    let maze = match kind {
        "p10" => tolman_maze::Perfect {
            width: 10,
            height: 10,
        }
        .generate(&mut rng)
        .unwrap(),
        "p20" => tolman_maze::Perfect {
            width: 20,
            height: 20,
        }
        .generate(&mut rng)
        .unwrap(),
        "b10" => tolman_maze::Braided {
            width: 10,
            height: 10,
            share: 0.5,
        }
        .generate(&mut rng)
        .unwrap(),
        "b20" => tolman_maze::Braided {
            width: 20,
            height: 20,
            share: 0.5,
        }
        .generate(&mut rng)
        .unwrap(),
        name => tolman_maze::read(&text(name)).unwrap().maze,
    };
    Course::new(kind, maze, 0.95).unwrap()
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let kind = &args[1];
    let n: u64 = args[2].parse().unwrap();
    let enc: f64 = args.get(3).map_or(0.03, |a| a.parse().unwrap());
    let first: u64 = args.get(4).map_or(1, |a| a.parse().unwrap());
    for seed in first..first + n {
        let course = courses(kind, seed);
        let config = noisy(seed, enc);
        let body = Body::Circle {
            radius: config.radius,
        };
        let start = random_start(&course, &body, seed);
        let robot = course
            .robot_at(start, LaserPioneer::new(config.clone()).unwrap(), seed)
            .unwrap();
        let mut robot = Limited::new(robot, 60000);
        let drive = Drive::new(layers(&course, &config).unwrap(), stream(seed, 1));
        let mut actor = Actor::new(
            BetterExplorer::new(BetterConfig::pioneer()),
            drive,
            stream(seed, 2),
        );
        let start_of = start.position;
        let cast = tolman_arena::cast::Cast::default();
        let t = Instant::now();
        let mut truth: Vec<Point> = vec![start.position];
        let mut worst: f64 = 0.0;
        let mut true_places: Vec<Point> = vec![];
        let world = course.world.clone();
        let _ = &world;
        let ended = run::until_done(&mut robot, |robot| {
            let s = actor.act(robot, Task::Explore);
            let p = robot.robot().truth().pose.position;
            truth.push(p);
            let q = actor.brain().learned().position();
            let err = ((q - Point::origin()) - (p - start.position)).norm();
            worst = worst.max(err);
            if !true_places.iter().any(|t| (t - p).norm() < 0.5) {
                true_places.push(p);
            }
            if std::env::var("DRIFT").is_ok() {
                let e = (q - Point::origin()) - (p - start.position);
                println!(
                    "D {} {:.4} {:.4} {} {:.2}",
                    truth.len(),
                    e.x,
                    e.y,
                    robot.robot().bumps(),
                    actor.brain().learned().agreement()
                );
            }
            if std::env::var("TRACE").is_ok() {
                println!(
                    "{:?} {:?} err {err:.3} {}",
                    p,
                    q,
                    tolman_systems::Brain::words(actor.brain())
                );
            }
            s
        })
        .map_err(|_| "failed")
        .unwrap();
        let end = format!("{:?}", ended.end);
        let p = robot.robot().truth().pose.position;
        let q = actor.brain().learned().position();
        let err = ((q - Point::origin()) - (p - start.position)).norm();
        println!(
            "seed {seed} {end} actions {} steps {} places {} true {} ratio {:.2} err last {err:.3} worst {worst:.3} goal {} bumps {} time {:?}",
            ended.actions,
            ended.steps,
            actor.brain().learned().places().len(),
            true_places.len(),
            actor.brain().learned().places().len() as f64 / true_places.len() as f64,
            actor.brain().learned().goal().len(),
            robot.robot().bumps(),
            t.elapsed()
        );
        if std::env::var("DUMP").is_ok() {
            let cell = |p: Point| ((p.x / 0.95) as i32, (p.y / 0.95) as i32);
            let seen: std::collections::BTreeSet<_> = truth.iter().map(|p| cell(*p)).collect();
            println!(
                "cells visited {} of {}",
                seen.len(),
                course.maze.grid().cell_count()
            );
            let grid = course.maze.grid();
            for c in grid.cells() {
                let here = (i32::from(c.x), i32::from(c.y));
                if !seen.contains(&here) {
                    continue;
                }
                for (_, n) in course.maze.neighbours(c) {
                    let there = (i32::from(n.x), i32::from(n.y));
                    if seen.contains(&there) {
                        continue;
                    }
                    println!("from {here:?} to {there:?} unvisited");
                    let mid =
                        Point::new((f64::from(c.x) + 0.5) * 0.95, (f64::from(c.y) + 0.5) * 0.95)
                            - start.position.coords;
                    let m = actor.brain().learned();
                    for row in (-16..=16).rev() {
                        let line: String = (-16..=16)
                            .map(|col| {
                                let p = Point::new(
                                    mid.x + f64::from(col) * 0.05,
                                    mid.y + f64::from(row) * 0.05,
                                );
                                if m.grid().wall_distance(p).is_some_and(|d| d < 0.03) {
                                    '#'
                                } else if m.clearings().stands(p) {
                                    '+'
                                } else if m.grid().is_known(p) {
                                    '.'
                                } else {
                                    ' '
                                }
                            })
                            .collect();
                        println!("{line}");
                    }
                }
            }
        }
        let Ok(starts) = std::env::var("STARTS") else {
            continue;
        };
        let starts: u64 = starts.parse().unwrap();
        let t = Instant::now();
        let map = std::sync::Arc::new(
            BetterMap::of(
                actor.brain().learned().clone(),
                config.ring,
                &BetterConfig::pioneer(),
            )
            .unwrap(),
        );
        println!("  map ready in {:?}", t.elapsed());
        let limit = (course.maze.grid().cell_count() as u32 * 20).max(500);
        let mut sums = [0u32; 2];
        let mut reached = [0u32; 2];
        for k in 0..starts {
            let seed = seed * 1000 + k;
            let start = random_start(&course, &body, seed);
            let robot = course
                .robot_at(start, LaserPioneer::new(config.clone()).unwrap(), seed)
                .unwrap();
            let mut robot = Limited::new(robot, limit);
            let drive = Drive::new(layers(&course, &config).unwrap(), stream(seed, 1))
                .longest_action(u32::MAX);
            let mut nav = Actor::new(BetterNavigator::new(map.clone()), drive, stream(seed, 2));
            let t = Instant::now();
            let ended = run::until_done(&mut robot, |robot| {
                let s = nav.act(
                    robot,
                    Task::Reach(tolman_robot::Goal::Landmark(tolman_robot::Landmark::Goal)),
                );
                if std::env::var("WATCH").ok() == Some(k.to_string()) {
                    let p = robot.robot().truth().pose.position - start_of.coords;
                    let b = tolman_robot::Mapper::belief(nav.brain());
                    println!(
                        "    {:.2},{:.2} believes {:?}",
                        p.x,
                        p.y,
                        b.iter()
                            .take(3)
                            .map(|g| (g.at, g.weight))
                            .collect::<Vec<_>>()
                    );
                }
                s
            })
            .map_err(|_| "failed")
            .unwrap();
            let time = t.elapsed();
            let trial = tolman_arena::episode::Trial {
                course: &course,
                robot: config.clone(),
                start,
                step_limit: limit,
                seed,
            };
            let mut mind = cast
                .mind(
                    tolman_arena::cast::Agent::UnlocalizedOracle,
                    &course,
                    &config,
                )
                .unwrap();
            let episode = tolman_arena::episode::run(&trial, &mut mind, |_| {}).unwrap();
            sums[0] += ended.steps;
            sums[1] += episode.steps;
            reached[0] += u32::from(ended.end == run::TaskEnd::Done);
            reached[1] += u32::from(episode.reached);
            if std::env::var("EACH").is_ok() {
                println!(
                    "   start {k} {:?} {} oracle {} {} {time:?}",
                    ended.end, ended.steps, episode.reached, episode.steps
                );
            }
        }
        println!(
            "  better {} of {starts}, oracle {}, steps {} {} ratio {:.3}",
            reached[0],
            reached[1],
            sums[0],
            sums[1],
            f64::from(sums[0]) / f64::from(sums[1])
        );
    }
}
use tolman_robot::System;
