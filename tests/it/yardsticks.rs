//! The floor and the ceiling are what they are called.

use tolman_arena::course::Course;
use tolman_arena::episode;

use tolman_arena::cast::{Agent, Cast};

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
    for maze in ["j.maze", "large.maze"] {
        let course = own_course(maze);
        let cast = Cast::default();
        let means = Agent::ALL.map(|agent| mean_steps(&course, &cast, agent));
        let [.., random, oracle, unlocalized] = means;
        let names = Agent::ALL.map(Agent::name);
        for (name, steps) in names.into_iter().zip(means).take(4) {
            assert!(
                oracle <= steps && steps <= random,
                "{maze}: {name} of {means:?}"
            );
        }
        // Both have one plan, which reckons without noise, so that either may be the luckier; but it takes
        // time to find out where one is only where places look alike.
        assert!(
            (0.9 * oracle..1.5 * oracle).contains(&unlocalized),
            "{maze}: {means:?}"
        );
        assert!(oracle < 0.5 * random, "{maze}: {means:?}");
    }
}
