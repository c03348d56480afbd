//! Bodies in random mazes, under random commands.

use proptest::prelude::*;
use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Maze};
use tolman_robot::TurnTranslate;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{Contact, Model, Simulation, World};

use crate::worlds::{maze, size};

fn command() -> impl Strategy<Value = TurnTranslate> {
    (-1.0..1.0, -1.0..1.0).prop_map(|(turn, translate)| TurnTranslate { turn, translate })
}

fn robot(contact: Contact, turn_per_step: f64, translate_per_step: f64) -> LaserPioneer {
    let config = LaserPioneerConfig {
        contact,
        turn_per_step,
        translate_per_step,
        ..LaserPioneerConfig::noiseless()
    };
    LaserPioneer::new(config).unwrap()
}

proptest! {
    /// Whatever it is told and however far a step goes, a robot overlaps no wall and no other robot,
    /// stays in the cells it can reach, and bumps exactly when its motion was cut.
    #[test]
    fn bodies_pass_through_nothing(
        maze in maze(),
        size in size(),
        contact in prop_oneof![Just(Contact::Stop), Just(Contact::Slide)],
        turn_per_step in 0.0..4.0_f64,
        translate_per_step in 0.0..3.0_f64,
        commands in prop::collection::vec(command(), 2..60),
    ) {
        let world = World::from_maze(&maze, &size).unwrap();
        let mut sim = Simulation::new(world, 1);
        let grid = maze.grid();
        let starts: Vec<Cell> = [grid.cells().next(), grid.cells().nth(1)].into_iter().flatten().collect();
        for cell in &starts {
            let pose = Pose::new(sim.world().cell_centre(*cell), Heading::EAST);
            sim.add(robot(contact, turn_per_step, translate_per_step), pose).unwrap();
        }
        let robots: Vec<_> = sim.robots().collect();
        for commands in commands.chunks_exact(robots.len()) {
            let before: Vec<Pose> = robots.iter().map(|robot| sim.truth(*robot).pose).collect();
            sim.step(commands).unwrap();
            for ((robot, before), command) in robots.iter().zip(before).zip(commands) {
                let truth = *sim.truth(*robot);
                let body = sim.model(*robot).body();
                prop_assert!(sim.world().clear_for(body, truth.pose), "{:?}", truth);
                let free = before.displaced(
                    command.translate * translate_per_step,
                    command.turn * turn_per_step,
                );
                let cut = (free.position - truth.pose.position).norm();
                prop_assert_eq!(truth.bump, cut > 1e-12, "{:?} {}", truth, cut);
            }
            if let [first, second] = robots[..] {
                let apart = sim.truth(first).pose.position - sim.truth(second).pose.position;
                prop_assert!(apart.norm() > 0.5);
            }
        }
        for (robot, start) in robots.iter().zip(&starts) {
            let here = sim.world().cell_at(sim.truth(*robot).pose.position).unwrap();
            prop_assert!(reaches(&maze, *start, here), "from {start} through a wall to {here}");
        }
    }
}

fn reaches(maze: &Maze, from: Cell, to: Cell) -> bool {
    let mut goal = maze.clone();
    goal.set_goals(vec![to]);
    goal.steps_to_goal()[maze.grid().index(from)].is_some()
}
