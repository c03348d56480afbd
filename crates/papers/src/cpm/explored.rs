//! Mazes explored to their end: how far from the best the robot's walk is, and Theorem 1's bound with the times it took.

use tolman_systems::cpm::Done;

use super::trials::{Place, Setting, better, cast, in_both_modes, modes, trial};
use tolman_arena::cpm::Venue;
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};
use tolman_systems::cpm::CommonPatterns;

/// The name of the table.
pub(super) const EXPLORED: &str = "explored";

/// Runs of a row: of a walk that is half as long again as the best one, the mean is known to within a thirtieth then.
const RUNS: u32 = 40;

/// As many for a first look.
const QUICK_RUNS: u32 = 3;

/// The table, and what is tried in each of its rows.
#[derive(Debug)]
pub(super) struct Explored {
    pub(super) table: Table,
    settings: Vec<Setting>,
}

/// `papers`: the mazes are the paper's, and others are drawn beside them; `quick`: for a first look.
pub(super) fn explored(venues: &[Venue], papers: bool, quick: bool) -> Explored {
    let mut settings = in_both_modes(venues);
    if papers {
        settings.push(Setting {
            row: "Aliased better".into(),
            place: Place::Aliased,
            mode: better(),
        });
    }
    let mut table = Table::new(EXPLORED, "Mazes explored to their end")
        .field("finished", Kind::Flag)
        .field("map_right", Kind::Flag)
        .field("traversals", Kind::Count)
        .field("fragments", Kind::Count)
        .optional_field("best", Kind::Count)
        .optional_field("traversals_to_best", Kind::Number)
        .optional_field("seconds", Kind::Number)
        .field("bound", Kind::Number)
        .field("within_bound", Kind::Flag)
        .field("bumps", Kind::Count)
        .optional_field("trouble", Kind::Text)
        .metric(Metric::percent("finished_percent", "finished"))
        .metric(Metric::percent("map_right_percent", "map_right").titled("map right"))
        .metric(Metric::mean("fragments"))
        .metric(Metric::mean("traversals").titled("fragments walked"))
        .metric(Metric::mean("best").titled("best covering walk"))
        .metric(Metric::mean("traversals_to_best").titled("walked / best"))
        .metric(Metric::mean("seconds").titled("all walked after").unit("s"))
        .metric(Metric::mean("bound").titled("Theorem 1").unit("s"))
        .metric(Metric::percent("within_bound_percent", "within_bound").titled("within it"))
        .note(
            "The robot walks until no port of its map is unknown. The best covering walk is the shortest from the start through all fragments, \
             for who knows the maze. Theorem 1 bounds the time until the last fragment is walked, whether the robot knows it or not: \
             from the times that it took for the fragments before the first it had walked before, and the longest that it took for any.",
        );
    let runs = if quick { QUICK_RUNS } else { RUNS };
    for setting in &settings {
        table = table.row(Row::new(&setting.row).runs(runs));
    }
    Explored { table, settings }
}

impl Explored {
    /// Every row with the way it maps, for the configuration.
    pub(super) fn modes(&self) -> toml::Table {
        modes(&self.settings)
    }

    /// Explores one maze.
    pub(super) fn run(&self, patterns: &CommonPatterns, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (venue, mode) = cast(&self.settings, job)?;
        let found = trial(&venue, patterns, mode, job.seed).explore()?;
        let is_within = found.seconds.is_some_and(|seconds| seconds <= found.bound);
        let is_finished = found.done == Some(Done::Reached);
        let mut fields = Fields::new()
            .flag("finished", is_finished)
            .flag("map_right", is_finished && found.is_map_right)
            .count("traversals", found.traversals.into())
            .count("fragments", found.fragments.into())
            .number("bound", found.bound)
            .flag("within_bound", is_within)
            .count("bumps", found.bumps.into());
        if let Some(best) = found.best {
            fields = fields.count("best", best.into());
            if is_finished {
                let ratio = f64::from(found.traversals) / f64::from(best);
                fields = fields.number("traversals_to_best", ratio);
            }
        }
        if let Some(seconds) = found.seconds {
            fields = fields.number("seconds", seconds);
        }
        if let Some(trouble) = found.trouble {
            fields = fields.text("trouble", trouble);
        }
        Ok(fields)
    }
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let flag = |name: &str| run.fields.get(name).and_then(Field::as_flag) == Some(true);
    let seconds = number("seconds");
    let is_within = seconds.is_some() && seconds <= number("bound");
    if flag("within_bound") != is_within {
        return Err("within_bound is not whether the seconds are within the bound".into());
    }
    if flag("map_right") {
        if !flag("finished") {
            return Err("an exploration that is not finished has no right map".into());
        }
        if number("best").is_some() && number("traversals") < number("best") {
            return Err("a maze was explored by less than the best covering walk".into());
        }
    }
    Ok(())
}
