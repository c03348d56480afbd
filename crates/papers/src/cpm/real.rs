//! The real robot's maze of figure 11: a walk to the goal and back, and then a drive to the goal.

use std::sync::OnceLock;

use serde::Serialize;
use tolman_geom::Pose;
use tolman_robot::Landmark;
use tolman_sim::robots::{Epuck, EpuckConfig};

use super::trials::faithful;
use super::{agree, less, mazes};
use crate::kept::once;
use crate::tolerances::{COUNTED, SAVED, SUCCESS};
use tolman_arena::course::Course;
use tolman_arena::cpm::{CpmRun, SimulatedEpuck, learn_by, slow_epuck, walker_config};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record, require};
use tolman_systems::cpm::{
    Aim, CommonPatterns, Done, EpisodeSummary, FragmentStep, Layer3, Lesson, Walker, WalkerConfig,
};

/// Name of the table.
pub(super) const FIGURE_11: &str = "11";

/// "The learning time of 90 min (5400 s) is provided" (section 7).
const LESSON: Lesson = Lesson::Seconds(5400.0);

/// Duration of a drive between two observations, s. In the paper "20 CPs (*ca.* 121 s)" are 6 s
/// each, of which a sweep takes 3.3 s.
const STRIDE_S: f64 = 2.7;

/// The real robot's maze, and the patterns that such a robot learned before.
#[derive(Debug)]
pub(super) struct Real {
    pub(super) course: Course,
    learning: Course,
    seed: u64,
    patterns: OnceLock<CommonPatterns>,
}

/// Returns the configuration that the runs depend on.
pub(super) fn config() -> impl Serialize {
    #[derive(Serialize)]
    struct Config {
        robot: EpuckConfig,
        lesson: Lesson,
        stride_s: f64,
    }
    Config {
        robot: slow_epuck(),
        lesson: LESSON,
        stride_s: STRIDE_S,
    }
}

/// Returns the configuration of a walker in the corridors of a course.
fn walker(course: &Course) -> Result<WalkerConfig, BoxError> {
    let mut config = walker_config(&slow_epuck(), course.corridor_width)?;
    config.stride_s = STRIDE_S;
    Ok(config)
}

impl Real {
    pub(super) fn new(seed: u64) -> Result<Self, BoxError> {
        Ok(Self {
            course: mazes::real()?,
            learning: mazes::learning()?,
            seed,
            patterns: OnceLock::new(),
        })
    }

    /// Returns the learned patterns. Learning takes a second.
    fn patterns(&self) -> Result<&CommonPatterns, BoxError> {
        once(&self.patterns, || {
            let config = walker(&self.learning)?;
            learn_by(&self.learning, slow_epuck(), config, LESSON, self.seed)
        })
    }

    /// Plays the way to the goal, back, and to the goal again, and returns it. Calls `see` with
    /// every fragment of the first two ways.
    pub(super) fn play(
        &self,
        job: &Job<'_>,
        mut see: impl FnMut(&Layer3, &Walker<SimulatedEpuck>, &FragmentStep),
    ) -> Result<Trip, BoxError> {
        let (course, patterns) = (&self.course, self.patterns()?);
        let body = course.robot_at(course.start()?, Epuck::new(slow_epuck())?, job.seed)?;
        let mut run = CpmRun::begin(body, walker(course)?, patterns, faithful(), job.seed)?;
        let mut trip = Trip {
            ways: vec![run.pursue(Aim::Find(Landmark::Goal), &mut see)?],
            begun: vec![0],
            tried: 0,
            given_up: 0,
            path: Vec::new(),
        };
        run.layer.optimize()?;
        if run.layer.map().has_goal() {
            trip.begun.push(run.walker.body().path().len());
            let back = run.pursue(Aim::WayBack, |layer, walker, step| {
                see(layer, walker, step);
                trip.tried += u32::from(step.leg.known.is_none());
                trip.given_up += u32::from(step.walked.sighting.is_none());
            })?;
            trip.ways.push(back);
            trip.begun.push(run.walker.body().path().len());
            trip.ways.extend(run.drive_to_goal()?);
        }
        trip.path = run.walker.body().path().to_vec();
        Ok(trip)
    }

    /// Plays a run and returns its record.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        measured(&self.play(job, |_, _, _| {})?)
    }
}

/// To the goal, back, and to the goal again (sections 6 and 7, figure 11). "On the way back, the
/// robot tries a new path-fragment" as long as it may be shorter than the known way.
///
/// The paper's robot made 20 observations to the goal, 13 on the way back and 4 on its second way.
pub(super) struct Trip {
    /// The ways that the robot went, up to three.
    pub(super) ways: Vec<EpisodeSummary>,
    /// Time step at which each way began.
    pub(super) begun: Vec<usize>,
    /// Number of unknown fragments that the robot entered on the way back.
    pub(super) tried: u32,
    /// Number of these in which the robot turned round, as they "will never be shorter".
    pub(super) given_up: u32,
    /// Pose of the robot after every time step.
    pub(super) path: Vec<Pose>,
}

record! {
    /// A way to the goal, back, and to the goal again.
    #[check(RoundTripRun::relations)]
    struct RoundTripRun {
        /// Whether goal, start and goal again were reached.
        solved: bool => higher("solved").tolerance(SUCCESS),
        /// Number of observations to the goal.
        observations_1: Option<u32> => lower("observations to the goal").decimals(1),
        /// Time to the goal.
        seconds_1: Option<f64> => lower("time to the goal").unit("s").at_least(0).decimals(1),
        /// Number of observations to the goal and back to the start.
        observations_both_ways: Option<u32> => lower("observations there and back").decimals(1),
        /// Number of observations to the goal by the map.
        observations_2: Option<u32> => lower("observations in episode 2").decimals(1),
        /// Time to the goal by the map.
        seconds_2: Option<f64> => lower("time in episode 2").unit("s").at_least(0).decimals(1),
        /// Share of observations that the second episode saves.
        steps_reduction: Option<f64> => higher("observations saved").unit("%").at_most(100).tolerance(SAVED),
        /// Share of time that the second episode saves.
        time_reduction: Option<f64> => higher("time saved").unit("%").at_most(100).tolerance(SAVED),
        /// Number of fragments that the robot tried on its way back because they might be shorter.
        tried: u32 => neither("fragments tried on the way back").tolerance(COUNTED),
        /// Number of these fragments that it gave up.
        given_up: u32 => neither("fragments given up").tolerance(COUNTED),
    }
}

impl RoundTripRun {
    fn relations(&self) -> Result<(), String> {
        let observations = [self.observations_1, self.observations_2];
        let observations = observations.map(|count| count.map(f64::from));
        let seconds = [self.seconds_1, self.seconds_2];
        for (name, [first, second], found) in [
            (Self::steps_reduction, observations, self.steps_reduction),
            (Self::time_reduction, seconds, self.time_reduction),
        ] {
            let both = first.zip(second);
            let expected = both.map(|(first, second)| less([first, second]));
            let is_right = agree(found, expected) && found.is_some() == self.solved;
            let told = format!("{name} is {found:?}, expected {expected:?}");
            require(is_right, &told)?;
        }
        let farther = !self.solved || self.observations_both_ways >= self.observations_1;
        require(farther, "there and back is farther than there")?;
        require(
            self.given_up <= self.tried,
            "more fragments given up than tried",
        )
    }
}

/// Reason why numbers of observations and seconds cannot be compared.
const SMALLER: &str = "the paper's maze is smaller than this drawing of it";

pub(super) fn table(course: &Course) -> Table {
    Table::of::<RoundTripRun>(FIGURE_11, "The maze of the real robot")
        .metrics_from(RoundTripRun::solved)
        .paper_runs(1)
        .row(
            Row::new(&course.name)
                .paper("solved_percent", 100.0)
                .paper_aside(RoundTripRun::observations_1, 20.0, SMALLER)
                .paper_aside(RoundTripRun::seconds_1, 121.0, SMALLER)
                .paper_aside(RoundTripRun::observations_both_ways, 33.0, SMALLER)
                .paper_aside(RoundTripRun::observations_2, 4.0, SMALLER)
                .paper_aside(RoundTripRun::seconds_2, 44.0, SMALLER)
                .paper(RoundTripRun::steps_reduction, 80.0)
                .paper(RoundTripRun::time_reduction, 63.636)
                .paper(RoundTripRun::tried, 1.0)
                .paper(RoundTripRun::given_up, 1.0),
        )
        .note(
            "Figure 11's maze redrawn: four fragments, two junctions. The robot goes to the goal, \
             back with a look at fragments that may be shorter, and to the goal again by the map. \
             Like the paper's, it sweeps at 3π/5 rad/s, looks every 6 s and has learned for 5400 s. \
             The paper made one trial. The maze is larger than the paper's, so only the reductions \
             can be compared. Solved: goal, start and goal again were reached, whether or not the \
             last way is the shortest.",
        )
}

fn measured(trip: &Trip) -> Result<Fields, BoxError> {
    let reached = |way: usize| {
        let way = trip.ways.get(way).copied();
        way.filter(|way| way.done == Done::Reached)
    };
    let [there, back, again] = [0, 1, 2].map(reached);
    let all = there.zip(back).zip(again);
    let again = all.map(|(_, again)| again);
    let both_ways = |((there, back), _): ((EpisodeSummary, EpisodeSummary), EpisodeSummary)| {
        there.observations + back.observations
    };
    let saved = |measure: fn(EpisodeSummary) -> f64| {
        all.map(|((there, _), again)| less([measure(there), measure(again)]))
    };
    let run = RoundTripRun {
        solved: all.is_some(),
        observations_1: there.map(|there| there.observations),
        seconds_1: there.map(|there| there.seconds),
        observations_both_ways: all.map(both_ways),
        observations_2: again.map(|again| again.observations),
        seconds_2: again.map(|again| again.seconds),
        steps_reduction: saved(|episode| f64::from(episode.observations)),
        time_reduction: saved(|episode| episode.seconds),
        tried: trip.tried,
        given_up: trip.given_up,
    };
    Ok(run.fields()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_trip_is_measured() {
        let real = Real::new(1).unwrap();
        let job = Job {
            table: FIGURE_11,
            row: &real.course.name,
            run: 0,
            seed: 1,
        };
        let run: RoundTripRun = real.run(&job).unwrap().record().unwrap();
        assert!(run.solved, "{run:?}");
        run.relations().unwrap();
        let wrong = RoundTripRun {
            time_reduction: Some(5.0),
            ..run
        };
        assert!(wrong.relations().is_err());
    }
}
