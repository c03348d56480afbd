//! The same seed gives the same bits.

use tolman_arena::episode;
use tolman_arena::pioneer::calibrated;
use tolman_robot::Robot;
use tolman_sim::Solo;
use tolman_sim::robots::LaserPioneer;

use tolman_arena::cast::{Agent, Cast};

use crate::support::{mind, own_course, trial};

#[test]
fn a_run_is_its_seed() {
    let course = own_course("j.maze");
    let cast = Cast::default();
    for agent in Agent::ALL {
        let name = agent.name();
        let run = |seed| {
            episode::run(
                &trial(&course, seed),
                &mut mind(&cast, agent, &course),
                |_| {},
            )
            .unwrap()
        };
        assert_eq!(run(8), run(8), "{name}");
        assert_ne!(run(8), run(9), "{name}");
    }
}

/// A recorded run is played again from its commands alone: the brain and the layers have no part in
/// the world's chance.
#[test]
fn the_commands_of_a_run_make_it_again() {
    let course = own_course("large.maze");
    let cast = Cast::default();
    for agent in Agent::ALL {
        let name = agent.name();
        let trial = trial(&course, 4);
        let mut commands = Vec::new();
        let mut sensed = Vec::new();
        let episode = episode::run(&trial, &mut mind(&cast, agent, &course), |step| {
            commands.push(step.command);
            sensed.push(step.robot.sensing().clone());
        })
        .unwrap();

        let robot = LaserPioneer::new(calibrated()).unwrap();
        let mut solo = Solo::new(course.world.clone(), robot, trial.start, trial.seed).unwrap();
        for (step, command) in commands.iter().enumerate() {
            solo.step(command).unwrap();
            assert_eq!(
                solo.truth().pose,
                episode.path[step + 1],
                "{name}, step {step}"
            );
            assert_eq!(*solo.sensing(), sensed[step], "{name}, step {step}");
        }
    }
}
