//! The pair of figure 11: the maze of the real robot, walked to the goal and back, and driven again.

use tolman_systems::cpm::{CpmConfig, Done};

use std::sync::OnceLock;

use super::venue;
use tolman_arena::cpm::{
    RoundTrip, SimulatedEpuck, Venue, learn_by, placed, slow_epuck, walker_config,
};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};
use tolman_systems::cpm::{CommonPatterns, Episode, Lesson, Reasoner, Step, Walker, WalkerConfig};

/// The name of the table.
pub(super) const FIGURE_11: &str = "11";

/// "The learning time of 90 min (5400 s) is provided" (section 7).
const LESSON: Lesson = Lesson::Seconds(5400.0);

/// How long the robot drives from one observation to the next, s: "20 CPs (*ca.* 121 s)" are 6 s each, of which a sweep takes 3.3.
const STRIDE_S: f64 = 2.7;

/// The real robot's maze, and what such a robot learned before.
#[derive(Debug)]
pub(super) struct Real {
    pub(super) venue: Venue,
    learning: Venue,
    seed: u64,
    patterns: OnceLock<CommonPatterns>,
}

pub(super) fn config() -> Result<toml::Value, BoxError> {
    let mut config = toml::Table::new();
    config.insert("robot".into(), toml::Value::try_from(slow_epuck())?);
    config.insert("lesson".into(), format!("{LESSON:?}").into());
    config.insert("stride_s".into(), STRIDE_S.into());
    Ok(config.into())
}

/// How it observes in the corridors of a venue.
fn walker(venue: &Venue) -> Result<WalkerConfig, BoxError> {
    Ok(WalkerConfig {
        stride_s: STRIDE_S,
        ..walker_config(&slow_epuck(), venue.corridor_width)?
    })
}

impl Real {
    pub(super) fn new(seed: u64) -> Result<Self, BoxError> {
        Ok(Self {
            venue: venue::real()?,
            learning: venue::learning()?,
            seed,
            patterns: OnceLock::new(),
        })
    }

    /// What it learned, which takes a second; two threads that ask at once learn the same.
    fn patterns(&self) -> Result<&CommonPatterns, BoxError> {
        if let Some(patterns) = self.patterns.get() {
            return Ok(patterns);
        }
        let (maze, config) = (&self.learning.maze, walker(&self.learning)?);
        let patterns = learn_by(maze, slow_epuck(), config, LESSON, self.seed)?;
        Ok(self.patterns.get_or_init(|| patterns))
    }

    /// There, back and there again. `see` is told of every fragment of the first two ways.
    pub(super) fn play(
        &self,
        job: &Job<'_>,
        see: impl FnMut(&Reasoner<'_, SimulatedEpuck>, &Step),
    ) -> Result<RoundTrip, BoxError> {
        let Venue {
            maze,
            corridor_width,
            ..
        } = &self.venue;
        let body = placed(maze, *corridor_width, slow_epuck(), job.seed)?;
        let walker = Walker::new(body, walker(&self.venue)?);
        let (patterns, config) = (self.patterns()?, CpmConfig::online());
        Ok(RoundTrip::watch(walker, patterns, config, job.seed, see)?)
    }

    /// Measures a run.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        measured(&self.play(job, |_, _| {})?)
    }

    pub(super) fn table(&self) -> Table {
        table(&self.venue)
    }
}

fn table(venue: &Venue) -> Table {
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
             goal again by the map. The robot sweeps at 3π/5 rad/s, looks every 6 s and has learned for 5400 s, as the paper's, which made one trial; \
             the maze is larger than the paper's, so only the reductions can be compared. Solved: goal, start and goal again were reached; whether the last way is the shortest is not asked.",
        )
}

fn measured(trip: &RoundTrip) -> Result<Fields, BoxError> {
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
    use super::*;

    #[test]
    fn a_round_trip_is_measured() {
        let real = Real::new(1).unwrap();
        let job = Job {
            table: FIGURE_11,
            row: &real.venue.name,
            run: 0,
            seed: 1,
        };
        let fields = real.run(&job).unwrap();
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
