//! The floor and the ceiling are what they are called.

use tolman::course::Course;
use tolman::episode;

use crate::support::{Cast, own_course, trial};

const RUNS: u32 = 40;

/// Mean steps over the same starts for every mind; a run that does not arrive counts its limit.
fn mean_steps(course: &Course, cast: &Cast, name: &str) -> f64 {
    let run = |seed: u32| {
        let trial = trial(course, seed.into());
        episode::run(&trial, &mut cast.mind(name), |_, _| {})
            .unwrap()
            .steps
    };
    f64::from((0..RUNS).map(run).sum::<u32>()) / f64::from(RUNS)
}

#[test]
fn nobody_beats_the_oracle_and_nobody_is_worse_than_chance() {
    for maze in ["j.maze", "large.maze"] {
        let course = own_course(maze);
        let cast = Cast::on(&course);
        let means = Cast::NAMES.map(|name| mean_steps(&course, &cast, name));
        let [.., random, oracle] = means;
        for (name, steps) in Cast::NAMES.into_iter().zip(means) {
            assert!(
                oracle <= steps && steps <= random,
                "{maze}: {name} of {means:?}"
            );
        }
        assert!(oracle < 0.5 * random, "{maze}: {means:?}");
    }
}
