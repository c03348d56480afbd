//! The pair of figure 11: the maze of the real robot, learned on the way to the goal and driven again.

use tolman_maps::cpm::Done;

use super::trials;
use super::venue::Venue;
use crate::agents::cpm::{CommonPatterns, Episode};
use crate::experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};

/// The name of the table.
pub(super) const FIGURE_11: &str = "11";

pub(super) fn table(venue: &Venue) -> Table {
    Table::new(FIGURE_11, "The maze of the real robot")
        .field("solved", Kind::Flag)
        .optional_field("observations_1", Kind::Count)
        .optional_field("seconds_1", Kind::Number)
        .optional_field("observations_2", Kind::Count)
        .optional_field("seconds_2", Kind::Number)
        .optional_field("steps_reduction", Kind::Number)
        .optional_field("time_reduction", Kind::Number)
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(Metric::mean("observations_1").titled("observations to the goal").decimals(1))
        .metric(Metric::mean("seconds_1").titled("time").unit("s").decimals(1))
        .metric(Metric::mean("observations_2").titled("observations in episode 2").decimals(1))
        .metric(Metric::mean("seconds_2").titled("time").unit("s").decimals(1))
        .metric(Metric::mean("steps_reduction").titled("reduction of observations").unit("%"))
        .metric(Metric::mean("time_reduction").titled("of time").unit("%"))
        .row(
            Row::new(&venue.name)
                .paper("solved_percent", 100.0)
                .paper("observations_1", 20.0)
                .paper("seconds_1", 121.0)
                .paper("observations_2", 4.0)
                .paper("seconds_2", 44.0)
                .paper("steps_reduction", 80.0)
                .paper("time_reduction", 63.636),
        )
        .note(
            "Figure 11's maze drawn anew: four fragments, two junctions. The paper's robot made one trial and looked every 6 s; ours looks every 2 cm \
             of a larger maze, so only the reductions can be compared.",
        )
}

/// Both episodes.
pub(super) fn run(
    venue: &Venue,
    patterns: &CommonPatterns,
    job: &Job<'_>,
) -> Result<Fields, BoxError> {
    let record = trials::trial(venue, patterns, trials::faithful(), job.seed).play()?;
    let mut fields = Fields::new().flag("solved", record.is_solved());
    let reached = |episode: &Episode| episode.done == Done::Reached;
    if let Some(first) = record.first.filter(reached) {
        fields = fields
            .count("observations_1", first.observations.into())
            .number("seconds_1", first.seconds);
    }
    if let (Some(first), Some(second)) = (record.first, record.second)
        && record.is_solved()
    {
        let observations = [first, second].map(|episode| f64::from(episode.observations));
        fields = fields
            .count("observations_2", second.observations.into())
            .number("seconds_2", second.seconds)
            .number("steps_reduction", less(observations))
            .number("time_reduction", less([first.seconds, second.seconds]));
    }
    Ok(fields)
}

/// By how many percent of the first the second is less.
fn less([first, second]: [f64; 2]) -> f64 {
    100.0 * (1.0 - second / first)
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    let solved = run.fields.get("solved").and_then(Field::as_flag) == Some(true);
    for (name, first, second) in [
        ("steps_reduction", "observations_1", "observations_2"),
        ("time_reduction", "seconds_1", "seconds_2"),
    ] {
        let expected = match (number(first), number(second)) {
            (Some(first), Some(second)) => Some(less([first, second])),
            _ => None,
        };
        let is_right = match (number(name), expected) {
            (Some(found), Some(expected)) => solved && (found - expected).abs() < 1e-9,
            (None, None) => !solved,
            _ => false,
        };
        if !is_right {
            return Err(format!("{name} is {:?}, expected {expected:?}", number(name)).into());
        }
    }
    Ok(())
}
