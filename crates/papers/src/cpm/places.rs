//! The diktiometry on the same robot in the same mazes, with junctions and dead ends as places.

use tolman_arena::course::Course;
use tolman_arena::diktiometry::{EpuckSurveyConfig, survey_maze};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record, require};

/// Name of the table.
pub(super) const PLACES: &str = "places";

/// Number of moves of a run: several times as many as a maze has ways.
const MOVES: u32 = 40;

record! {
    /// A survey by the diktiometry.
    #[check(PlacesRun::relations)]
    struct PlacesRun {
        /// Number of moves from one place to the next.
        moves: u32 => neither("moves").at_most(MOVES),
        /// Share of the visits that were to the true place that their place on the map stands for.
        purity: f64 => higher("purity").share(),
        /// Share of the visited true places that have exactly one place on the map.
        share_once: f64 => higher("places with one node").share(),
        /// Share of the map's links that lead where their action truly leads.
        link_precision: f64 => higher("links: precision").share(),
        /// Share of all ways of the maze, counted in both directions, that are on the map.
        link_recall: f64 => higher("links: recall").share(),
        /// Share of the moves after which odometry was within its bounds.
        bounded: f64 => higher("odometry within its bounds").share(),
        /// Number of places on the map.
        places: usize => neither("places on the map").decimals(1),
        /// Number of true places where the robot was.
        visited: usize => neither("true places visited").decimals(1),
        /// Reason why the survey ended early.
        trouble: Option<String> => neither("trouble"),
    }
}

impl PlacesRun {
    fn relations(&self) -> Result<(), String> {
        let possible = self.visited <= self.moves as usize + 1;
        require(possible, "more places were visited than moves lead to")
    }
}

pub(super) fn table(courses: &[Course]) -> Table {
    Table::of::<PlacesRun>(PLACES, "The diktiometry on the e-puck")
        .metrics_from(PlacesRun::purity)
    .rows(courses.iter().map(|course| Row::new(&course.name)))
    .note(format!(
        "{MOVES} moves from one junction or dead end to the next by layers 0 and 1: a random walk \
         that follows the map's advice 30 % of the time. Odometry is that of the encoders, with \
         headings corrected by the walls. A place looks like one sweep there. Recall is over all \
         ways of the maze, counted in both directions."
    ))
}

/// Returns the configuration that the runs depend on.
pub(super) const fn config() -> EpuckSurveyConfig {
    EpuckSurveyConfig::usual(MOVES)
}

/// Plays one survey.
pub(super) fn run(course: &Course, job: &Job<'_>) -> Result<Fields, BoxError> {
    let survey = survey_maze(&course.maze, course.corridor_width, &config(), job.seed)?;
    let score = survey.score;
    let run = PlacesRun {
        moves: survey.moves,
        places: score.places,
        visited: score.visited,
        purity: score.purity,
        share_once: score.share_once,
        link_precision: score.link_precision,
        link_recall: score.link_recall,
        bounded: f64::from(survey.bounded) / f64::from(survey.moves.max(1)),
        trouble: survey.trouble,
    };
    Ok(run.fields()?)
}
