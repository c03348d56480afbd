//! The floor and the ceiling are what they are called.

use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::{episode, pioneer};
use tolman_maze::{Braided, MazeFile};
use tolman_systems::stream;

use crate::support::{mind, own_course, trial};

const RUNS: u32 = 40;

/// Mean steps over the same starts for every mind; a run that does not arrive counts its limit.
fn mean_steps(course: &Course, cast: &Cast, agent: Agent) -> f64 {
    let run = |seed: u32| {
        let trial = trial(course, seed.into());
        episode::run(&trial, &mut mind(cast, agent, course), |_| {})
            .unwrap()
            .steps
    };
    f64::from((0..RUNS).map(run).sum::<u32>()) / f64::from(RUNS)
}

#[test]
fn nobody_beats_the_oracle_and_nobody_is_worse_than_chance() {
    let papers = ["j.maze", "large.maze"].map(own_course);
    let random = (1..=3).map(random_course);
    for course in papers.into_iter().chain(random) {
        let name = &course.name;
        let cast = Cast::default();
        let means = Agent::ALL.map(|agent| mean_steps(&course, &cast, agent));
        let [.., chance, oracle, unlocalized] = means;
        assert!(oracle <= chance, "{name}: {means:?}");
        for (agent, steps) in Agent::ALL.into_iter().zip(means).take(4) {
            let bounds = oracle..=chance;
            assert!(
                bounds.contains(&steps),
                "{name}: {} of {means:?}",
                agent.name()
            );
        }
        // It has the same plan and a worse idea of where it is, so that by luck alone it is the
        // faster.
        assert!(
            (0.95 * oracle..1.7 * oracle).contains(&unlocalized),
            "{name}: {means:?}"
        );
        assert!(oracle < 0.5 * chance, "{name}: {means:?}");
    }
}

/// A small maze with loops.
fn random_course(seed: u64) -> Course {
    let maze = Braided {
        width: 8,
        height: 6,
        share: 0.5,
    };
    let maze = maze.generate(&mut stream(seed, 0)).unwrap();
    let name = format!("braided maze {seed}");
    Course::for_body(&name, &MazeFile::from(maze), &pioneer::body()).unwrap()
}
