//! The drawings of MSLST's mazes: which ones of a seeded sequence are kept, and why the others
//! are rejected.
//!
//! Run n is drawing n of the sequence, whatever the master seed. MSLST plays no part in it.

use tolman_experiment::{
    BoxError, Entry, Experiment, Fields, Job, Metric, Options, Procedure, Record, Row, Table,
    record, require,
};

use crate::rows::row_of;
use crate::venue::{Condition, Drawing};

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "mslst-drawings",
    title: "The drawings of MSLST's mazes: which are kept",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 2 and 3",
    runs: 378,
    quick_runs: 2,
    main: &[],
    tour: &[],
    open,
};

/// Maximum number of drawings of a sequence that are judged. If none is kept by then, the rule
/// has no result.
const MOST_DRAWINGS: u32 = 2000;

const DRAWINGS: [Drawing; 2] = [Drawing::J, Drawing::Large];

record! {
    /// A drawing, and why it is kept or not. If the loop alone rules it out, it is not played,
    /// and its other values are missing.
    #[check(DrawingRun::relations)]
    struct DrawingRun {
        /// Whether it meets all conditions.
        kept: bool => neither("kept"),
        /// Whether exact right-hand tours are trapped on the loop too seldom or too often.
        misses_traps: bool => neither("× loop"),
        /// Whether the Oracle needs too many steps.
        misses_oracle_steps: bool => neither("× Oracle"),
        /// Whether Avoid's success lies outside the paper's interval.
        misses_avoid_success: bool => neither("× Avoid %"),
        /// Whether Avoid's steps lie outside the paper's interval.
        misses_avoid_steps: bool => neither("× Avoid steps"),
        /// Whether Wall-follow's success lies outside the paper's interval.
        misses_wall_follow_success: bool => neither("× Wall-follow %"),
        /// Whether Wall-follow's steps lie outside the paper's interval.
        misses_wall_follow_steps: bool => neither("× Wall-follow steps"),
        /// Whether the lists in the source agree with this result; no value beyond their end.
        as_listed: Option<bool> => neither("as listed"),
        /// Sum of the excesses over the conditions' bounds, as shares of the bounds.
        excess: Option<f64> => lower("excess").at_least(0),
        /// Share of starts from which an exact right-hand tour never arrives.
        trapped_percent: Option<f64> => neither("trapped").percent(),
        /// Share of Avoid's runs that arrive.
        avoid_success_percent: Option<f64> => neither("Avoid arrives").percent(),
        /// Mean number of steps of Avoid.
        avoid_steps: Option<f64> => neither("Avoid's steps").at_least(0),
        /// Share of Wall-follow's runs that arrive.
        wall_follow_success_percent: Option<f64> => neither("Wall-follow arrives").percent(),
        /// Mean number of steps of Wall-follow.
        wall_follow_steps: Option<f64> => neither("Wall-follow's steps").at_least(0),
        /// Mean number of steps of the Oracle.
        oracle_steps: Option<f64> => neither("Oracle's steps").at_least(0),
    }
}

impl DrawingRun {
    fn relations(&self) -> Result<(), String> {
        let missed = [
            self.misses_traps,
            self.misses_oracle_steps,
            self.misses_avoid_success,
            self.misses_avoid_steps,
            self.misses_wall_follow_success,
            self.misses_wall_follow_steps,
        ];
        let contradicted =
            "a drawing is kept if it misses nothing, and rejected if it misses something";
        require(self.kept != missed.contains(&true), contradicted)
    }
}

/// The prepared experiment.
#[derive(Debug)]
struct Drawings;

fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("the tables are of random drawings: leave --maze out".into());
    }
    let judged = options.runs_of(&ENTRY);
    if judged > MOST_DRAWINGS {
        return Err(format!("{judged} drawings: the rule judges {MOST_DRAWINGS} at most").into());
    }
    let tables = DRAWINGS.map(|drawing| table(drawing, judged)).into();
    Ok(Experiment::new(ENTRY, tables, toml::Table::new(), Drawings))
}

fn table(drawing: Drawing, judged: u32) -> Table {
    let name = drawing.name();
    let count = |field: &str| Metric::count_of(field, field, judged).decimals(0);
    let counts = [
        DrawingRun::kept,
        DrawingRun::misses_traps,
        DrawingRun::misses_oracle_steps,
        DrawingRun::misses_avoid_success,
        DrawingRun::misses_avoid_steps,
        DrawingRun::misses_wall_follow_success,
        DrawingRun::misses_wall_follow_steps,
    ];
    let table = Table::of::<DrawingRun>(
        name,
        format!("Drawings of the {name} maze, kept and rejected"),
    );
    counts
        .into_iter()
        .fold(table, |table, field| table.metric(count(field)))
        .metrics_from(DrawingRun::as_listed)
        .row(Row::new("drawings"))
        .note(
            "Run n is drawing n of a sequence with its own seed. A drawing is rejected (×) for each \
             condition that it misses. One that its loop rules out is not played. Each is judged by \
             1000 runs of Avoid, Wall-follow and the Oracle.",
        )
}

impl Procedure for Drawings {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let drawing = row_of(job, DRAWINGS, |drawing| drawing.name() == job.table)?;
        let run = match drawing.judged(job.run)? {
            None => DrawingRun {
                misses_traps: true,
                ..DrawingRun::default()
            },
            Some(judged) => DrawingRun {
                kept: judged.summed_excess() <= 0.0,
                misses_oracle_steps: judged.misses(Condition::OracleSteps),
                misses_avoid_success: judged.misses(Condition::AvoidSuccess),
                misses_avoid_steps: judged.misses(Condition::AvoidSteps),
                misses_wall_follow_success: judged.misses(Condition::WallFollowSuccess),
                misses_wall_follow_steps: judged.misses(Condition::WallFollowSteps),
                excess: Some(judged.summed_excess()),
                trapped_percent: Some(judged.trapped_percent),
                avoid_success_percent: Some(judged.avoid.success_percent()),
                avoid_steps: Some(judged.avoid.steps()),
                wall_follow_success_percent: Some(judged.wall_follow.success_percent()),
                wall_follow_steps: Some(judged.wall_follow.steps()),
                oracle_steps: Some(judged.oracle.steps()),
                ..DrawingRun::default()
            },
        };
        let listed = drawing.listed(job.run);
        let run = DrawingRun {
            as_listed: listed.map(|listed| listed == run.kept),
            ..run
        };
        Ok(run.fields()?)
    }
}
