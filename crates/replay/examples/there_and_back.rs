//! A robot drives, and a page plays what it did:
//! `cargo run -p tolman-replay --example there_and_back > run.html`
#![expect(clippy::print_stdout, reason = "the page is its result")]

use core::error::Error;
use core::f64::consts::PI;

use tolman_replay::{Notes, Replay, RobotTrack, Scenery, page};
use tolman_robot::{Body, Robot, TurnTranslate};
use tolman_sim::geom::{Heading, Pose};
use tolman_sim::maze::{Cell, Grid, Maze};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{CorridorSize, Solo, World};

fn main() -> Result<(), Box<dyn Error>> {
    let size = CorridorSize::thin(0.95);
    let world = World::from_maze(&Maze::open(Grid::new(4, 1)), &size)?;
    let scenery = Scenery::of_world(&world);
    let start = Pose::new(world.cell_centre(Cell::new(0, 0)), Heading::EAST);
    let mut config = LaserPioneerConfig::noiseless();
    config.turn_per_step = PI;
    config.translate_per_step = 0.1;
    let (radius, step_s) = (config.radius, config.step_us as f64 * 1e-6);
    let mut robot = Solo::new(world, LaserPioneer::new(config)?, start, 7)?;

    // There and back: it turns round when it touches the wall.
    let mut poses = vec![start];
    let mut thoughts = Notes::new("thinks");
    thoughts.say(0, "on the way there");
    let (mut turn, mut bumps) = (0.0, 0);
    while bumps < 2 {
        let command = TurnTranslate {
            turn,
            translate: 1.0,
        };
        robot.step(&command)?;
        poses.push(robot.truth().pose);
        turn = 0.0;
        if robot.truth().bump {
            bumps += 1;
            turn = 1.0;
            thoughts.say(poses.len() as u32 - 1, "met a wall");
        }
    }

    let body = Body::Circle { radius };
    let mut track = RobotTrack::new("robot", body, poses);
    track.notes.push(thoughts);
    let replay = Replay::new("There and back", step_s, scenery, vec![track]);
    println!("{}", page(&replay)?);
    Ok(())
}
