//! The quantizers alone: table 1 of MSLST, SOINN's five clusters, and other differences between
//! them.

mod any;
mod figures;
mod five;
mod order;
mod shapes;
pub(crate) mod sonar;
mod states;
mod streams;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_quantizers::{GngConfig, SecondLayerConfig, SoinnConfig};
use tolman_sim::robots::LaserPioneerConfig;

use crate::data;
use tolman_arena::pioneer;
use tolman_draw::Figure;
use tolman_experiment::{BoxError, Easel, Entry, Experiment, Fields, Job, Options, Procedure, Run};

use sonar::Log;
use states::Mazes;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "quantizers",
    title: "Quantizers: states out of scans, clusters out of noise",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, table 1; F. Shen, O. Hasegawa: An \
             incremental network for on-line unsupervised classification and topology learning, 2006",
    runs: 20,
    quick_runs: 10,
    main: &["1"],
    tour: &[],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Quantizers {
    mazes: Mazes,
    log: Option<Log>,
}

/// Configuration of the runs.
#[derive(Serialize)]
struct Config<'a> {
    robot: LaserPioneerConfig,
    mazes: BTreeMap<&'a str, String>,
    parameters: Parameters,
}

#[derive(Serialize)]
struct Parameters {
    mslst: GngConfig,
    gng: GngConfig,
    soinn_literal: SoinnConfig,
    soinn: SoinnConfig,
    second_layer_literal: SecondLayerConfig,
    second_layer: SecondLayerConfig,
}

/// Returns the same configuration. A number of units without bound becomes TOML's largest integer.
fn unbounded(mut config: GngConfig) -> GngConfig {
    config.max_units = config.max_units.min(i64::MAX as usize);
    config
}

/// Returns the experiment with its data and tables.
///
/// # Errors
/// If the log of sonars cannot be read, or the caller names mazes, which this experiment does not
/// use.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("table 1 is of the J and the Large maze: leave --maze out".into());
    }
    let log = Log::find()?;
    let mut tables = vec![states::table(), states::decay_table()];
    tables.extend(five::tables());
    tables.extend([shapes::table(), order::table()]);
    if log.is_some() {
        tables.push(sonar::table());
    } else if let Some(table) = tables.last_mut() {
        let missing = data::missing("the logs of a ring of sonars");
        table.note = format!("{} {missing}", table.note);
    }
    let mazes = Mazes::new()?;
    let courses = mazes.all().into_iter();
    let courses = courses.map(|course| (&*course.name, course.maze.to_string()));
    let config = toml::Table::try_from(Config {
        robot: pioneer::calibrated(),
        mazes: courses.collect(),
        parameters: Parameters {
            mslst: unbounded(GngConfig::mslst(50.0)),
            gng: unbounded(GngConfig::fritzke()),
            soinn_literal: SoinnConfig::shen_hasegawa(),
            soinn: SoinnConfig::noisy(),
            second_layer_literal: SecondLayerConfig::shen_hasegawa(),
            second_layer: SecondLayerConfig::noisy(),
        },
    })?;
    let quantizers = Quantizers { mazes, log };
    Ok(Experiment::new(ENTRY, tables, config, quantizers))
}

impl Procedure for Quantizers {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match (job.table, &self.log) {
            (states::NAME, _) => self.mazes.run(job),
            (states::DECAY, _) => self.mazes.run_decay(job),
            (shapes::NAME, _) => shapes::run(job),
            (order::NAME, _) => order::run(&self.mazes, job),
            (sonar::NAME, Some(log)) => log.run(job),
            (table, _) if five::has(table) => five::run(job),
            (table, _) => Err(format!("there is no table {table}").into()),
        }
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(&self.mazes, runs, easel)
    }
}
