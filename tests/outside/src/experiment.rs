//! An experiment: how long a wanderer takes to the goal of a maze of teeth.

use crate::world::TEETH;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{self, Episode, Trial, random_start};
use tolman_arena::pioneer::{body, calibrated};
use tolman_experiment::{
    BoxError, Entry, Experiment, Fields, Job, Options, Procedure, Record, Row, Table, record,
};

pub const ENTRY: Entry = Entry {
    name: "combs",
    title: "Wanderers in combs",
    source: "",
    runs: 20,
    quick_runs: 5,
    main: &[],
    tour: &[],
    open,
};

record! {
    /// A run among teeth of its own.
    struct CombRun {
        /// Whether the robot came to the goal.
        reached: bool => higher("success"),
        /// Time steps.
        steps: u32 => lower("steps"),
    }
}

#[derive(Debug)]
struct Combs;

fn open(_options: &Options) -> Result<Experiment, BoxError> {
    let table = Table::of::<CombRun>("combs", "Combs of 5 × 3 cells").row(Row::new("Avoid"));
    let config = toml::Table::from_iter([("side".to_owned(), toml::Value::Integer(5))]);
    Ok(Experiment::new(ENTRY, vec![table], config, Combs))
}

impl Procedure for Combs {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let maze = (TEETH.draw)((5, 3), &mut ChaCha8Rng::seed_from_u64(job.seed))?;
        let course = Course::for_body("teeth", &maze.into(), &body())?;
        let start = random_start(&course, &body(), job.seed);
        let trial = Trial {
            course: &course,
            robot: calibrated(),
            start,
            step_limit: 500,
            seed: job.seed,
        };
        let mut mind = Cast::default().mind(Agent::Avoid, &course, &trial.robot)?;
        let Episode { reached, steps, .. } = episode::run(&trial, &mut mind, |_| {})?;
        Ok(CombRun { reached, steps }.fields()?)
    }
}
