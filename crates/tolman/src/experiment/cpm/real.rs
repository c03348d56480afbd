//! The pair of figure 11: the maze of the real robot, walked to the goal and back, and driven again.

use tolman_maps::cpm::Done;

use super::trials;
use crate::agents::cpm::{CommonPatterns, Episode, Venue};
use crate::experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};

/// The name of the table.
pub(super) const FIGURE_11: &str = "11";

pub(super) fn table(venue: &Venue) -> Table {
    Table::new(FIGURE_11, "The maze of the real robot")
        .field("solved", Kind::Flag)
        .optional_field("observations_1", Kind::Count)
        .optional_field("seconds_1", Kind::Number)
        .optional_field("observations_both_ways", Kind::Count)
        .optional_field("observations_2", Kind::Count)
        .optional_field("seconds_2", Kind::Number)
        .optional_field("steps_reduction", Kind::Number)
        .optional_field("time_reduction", Kind::Number)
        .field("tried", Kind::Count)
        .field("given_up", Kind::Count)
        .metric(Metric::percent("solved_percent", "solved"))
        .metric(
            Metric::mean("observations_1")
                .titled("observations to the goal")
                .decimals(1),
        )
        .metric(Metric::mean("seconds_1").titled("time").unit("s").decimals(1))
        .metric(
            Metric::mean("observations_both_ways")
                .titled("with the way back")
                .decimals(1),
        )
        .metric(
            Metric::mean("observations_2")
                .titled("in episode 2")
                .decimals(1),
        )
        .metric(Metric::mean("seconds_2").titled("time").unit("s").decimals(1))
        .metric(
            Metric::mean("steps_reduction")
                .titled("reduction of observations")
                .unit("%"),
        )
        .metric(Metric::mean("time_reduction").titled("of time").unit("%"))
        .metric(
            Metric::mean("tried")
                .titled("fragments tried on the way back"),
        )
        .metric(Metric::mean("given_up").titled("given up"))
        .row(
            Row::new(&venue.name)
                .paper("solved_percent", 100.0)
                .paper("observations_1", 20.0)
                .paper("seconds_1", 121.0)
                .paper("observations_both_ways", 33.0)
                .paper("observations_2", 4.0)
                .paper("seconds_2", 44.0)
                .paper("steps_reduction", 80.0)
                .paper("time_reduction", 63.636)
                .paper("tried", 1.0)
                .paper("given_up", 1.0),
        )
        .note(
            "Figure 11's maze drawn anew: four fragments, two junctions. To the goal, back with a look at fragments that may be shorter, and to the \
             goal again by the map. The paper's robot made one trial and looked every 6 s; ours looks every 2 cm of a larger maze, so only the \
             reductions can be compared. Solved: goal, start and goal again were reached; whether the last way is the shortest is not asked.",
        )
}

/// There, back and there again.
pub(super) fn run(
    venue: &Venue,
    patterns: &CommonPatterns,
    job: &Job<'_>,
) -> Result<Fields, BoxError> {
    let trip = trials::trial(venue, patterns, trials::faithful(), job.seed).round_trip()?;
    let reached = |episode: Option<Episode>| episode.filter(|one| one.done == Done::Reached);
    let (there, back) = (reached(Some(trip.there)), reached(trip.back));
    let again = reached(trip.again);
    let solved = there.is_some() && back.is_some() && again.is_some();
    let mut fields = Fields::new()
        .flag("solved", solved)
        .count("tried", trip.tried.into())
        .count("given_up", trip.given_up.into());
    if let Some(there) = there {
        fields = fields
            .count("observations_1", there.observations.into())
            .number("seconds_1", there.seconds);
    }
    if let (Some(there), Some(back), Some(again)) = (there, back, again) {
        let observations = [there, again].map(|episode| f64::from(episode.observations));
        let both_ways = there.observations + back.observations;
        fields = fields
            .count("observations_both_ways", both_ways.into())
            .count("observations_2", again.observations.into())
            .number("seconds_2", again.seconds)
            .number("steps_reduction", less(observations))
            .number("time_reduction", less([there.seconds, again.seconds]));
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
    if number("observations_both_ways") < number("observations_1") && solved {
        return Err("there and back is farther than there".into());
    }
    if number("given_up") > number("tried") {
        return Err("more fragments given up than tried".into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::venue;
    use super::*;
    use crate::agents::cpm::learn;

    #[test]
    fn a_round_trip_is_measured() {
        let (venue, learning) = (venue::real().unwrap(), venue::learning().unwrap());
        let patterns = learn(&learning.maze, learning.corridor_width, 1).unwrap();
        let job = Job {
            table: FIGURE_11,
            row: &venue.name,
            run: 0,
            seed: 1,
        };
        let fields = run(&venue, &patterns, &job).unwrap();
        assert_eq!(fields.get("solved"), Some(&Field::Flag(true)), "{fields:?}");
        let run = Run {
            table: job.table.into(),
            row: job.row.into(),
            run: 0,
            seed: 1,
            fields,
        };
        check(&run).unwrap();
        let wrong = Run {
            fields: run.fields.clone().number("time_reduction", 5.0),
            ..run
        };
        assert!(check(&wrong).is_err());
    }
}
