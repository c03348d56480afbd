//! What the paper had no time for: MSLST under other thresholds, training times, memories and noises, and in other
//! worlds.
//!
//! A run learns a map of its own and plays [`STARTS`] starts by it, so that the spread over runs is that
//! between maps. All rows of a table share the seeds of maps and starts.

mod drawings;
mod figures;
mod settings;

use alloc::sync::Arc;

use tolman_arena::Mind;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::episode::{self, Episode, Trial};
use tolman_arena::mslst::learn;
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Experiment, Field, Fields, Job, Kind, Metric, Options, Row, Run, Table, run_seed,
};
use tolman_robot::Body;
use tolman_systems::mslst::Navigator;

use settings::{Setting, Sweep};

/// Starts for each map.
const STARTS: u32 = 10;

/// The experiment, ready to run.
#[derive(Debug)]
struct Sweeps {
    sweeps: Vec<Sweep>,
    tables: Vec<Table>,
}

/// Sets the tables up. Maze files have no part in it: `mslst` takes them.
///
/// # Errors
/// If a world cannot be built.
pub(super) fn open(_options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let sweeps = settings::all()?;
    let tables = sweeps.iter().map(table).collect();
    Ok(Box::new(Sweeps { sweeps, tables }))
}

/// Who is measured in every setting, and the prefix of its fields.
const OTHERS: [(Agent, &str); 2] = [
    (Agent::WallFollow, "wall_follow"),
    (Agent::Oracle, "oracle"),
];

fn table(sweep: &Sweep) -> Table {
    let mut table = Table::new(sweep.name, sweep.title)
        .field("states", Kind::Count)
        .field("nodes", Kind::Count)
        .field("success_percent", Kind::Number)
        .field("steps", Kind::Number)
        .metric(Metric::mean("states"))
        .metric(Metric::mean("nodes"))
        .metric(
            Metric::mean("success_percent")
                .titled("MSLST arrives")
                .unit("%"),
        )
        .metric(Metric::mean("steps"));
    for (agent, field) in OTHERS {
        let steps = format!("{field}_steps");
        table = table
            .field(&steps, Kind::Number)
            .metric(Metric::mean(&steps).titled(format!("steps of {}", agent.name())));
    }
    for setting in &sweep.settings {
        table = table.row(Row::new(&setting.row));
    }
    table.note(format!(
        "{} A run is a map with {STARTS} starts; ± is the spread between maps. Runs that time out count with their limit.",
        sweep.note
    ))
}

impl Sweeps {
    fn setting(&self, table: &str, row: &str) -> Option<&Setting> {
        let sweep = self.sweeps.iter().find(|sweep| sweep.name == table)?;
        sweep.settings.iter().find(|setting| setting.row == row)
    }
}

impl Experiment for Sweeps {
    fn name(&self) -> &str {
        "mslst-sweeps"
    }

    fn title(&self) -> &str {
        "MSLST under other settings and in other worlds"
    }

    fn source(&self) -> &str {
        "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, future work"
    }

    fn default_runs(&self) -> u32 {
        10
    }

    fn quick_runs(&self) -> u32 {
        2
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut config = toml::Table::new();
        for sweep in &self.sweeps {
            let mut rows = toml::Table::new();
            for setting in &sweep.settings {
                rows.insert(setting.row.clone(), setting.config()?.into());
            }
            config.insert(sweep.name.into(), rows.into());
        }
        Ok(config)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let setting = self
            .setting(job.table, job.row)
            .ok_or_else(|| format!("there is no row {:?}", job.row))?;
        let course = setting.world.course(job.seed)?;
        let robot = &setting.robot;
        let learned = learn(&course, robot, &setting.config, job.seed)?;
        let (states, nodes) = (learned.map.states.models().len(), learned.map.graph.len());
        let map = Arc::new(learned.map);
        let cast = Cast::default();
        let play = |mind: &mut Mind, start: u32| -> Result<Episode, BoxError> {
            let seed = run_seed(job.seed, "starts", start);
            let body = Body::Circle {
                radius: robot.radius,
            };
            let trial = Trial {
                course: &course,
                robot: robot.clone(),
                start: episode::random_start(&course, &body, seed),
                step_limit: setting.world.step_limit(&course),
                seed,
            };
            Ok(episode::run(&trial, mind, |_| {})?)
        };
        let (mut reached, mut steps) = (0_u32, 0_u32);
        for start in 0..STARTS {
            let mslst = Navigator::new(Arc::clone(&map), &setting.config);
            let episode = play(&mut Mind::Brain(Box::new(mslst)), start)?;
            reached += u32::from(episode.reached);
            steps += episode.steps;
        }
        let mean = |sum: u32| f64::from(sum) / f64::from(STARTS);
        let mut fields = Fields::new()
            .count("states", states as u64)
            .count("nodes", nodes as u64)
            .number("success_percent", 100.0 * mean(reached))
            .number("steps", mean(steps));
        for (agent, field) in OTHERS {
            let mut steps = 0;
            for start in 0..STARTS {
                steps += play(&mut cast.mind(agent, &course, robot)?, start)?.steps;
            }
            fields = fields.number(format!("{field}_steps"), mean(steps));
        }
        Ok(fields)
    }

    fn check(&self, run: &Run) -> Result<(), BoxError> {
        let percent = run.fields.get("success_percent").and_then(Field::as_number);
        match percent {
            Some(percent) if !(0.0..=100.0).contains(&percent) => {
                Err(format!("success_percent is {percent}").into())
            }
            _ => Ok(()),
        }
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        Ok(figures::of(&self.sweeps, runs))
    }
}
