//! The diktiometry on the same robot in the same mazes: junctions and dead ends as places.

use tolman_arena::cpm::Venue;
use tolman_arena::diktiometry::{EpuckSurveyConfig, survey_maze};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table};

/// The name of the table.
pub(super) const PLACES: &str = "places";

/// Moves of a run: several times as many as a maze has ways.
const MOVES: u32 = 40;

/// The shares that a map is scored by.
const SHARES: [(&str, &str); 5] = [
    ("purity", "purity"),
    ("share_once", "places with one node"),
    ("link_precision", "links: precision"),
    ("link_recall", "recall"),
    ("bounded", "odometry within its bounds"),
];

pub(super) fn table(venues: &[Venue]) -> Table {
    let mut table = Table::new(PLACES, "The diktiometry on the e-puck")
        .field("moves", Kind::Count)
        .field("places", Kind::Count)
        .field("visited", Kind::Count)
        .optional_field("trouble", Kind::Text);
    for (name, title) in SHARES {
        table = table
            .field(name, Kind::Number)
            .metric(Metric::mean(name).titled(title));
    }
    table = table
        .metric(
            Metric::mean("places")
                .titled("places on the map")
                .decimals(1),
        )
        .metric(
            Metric::mean("visited")
                .titled("true places visited")
                .decimals(1),
        );
    for venue in venues {
        table = table.row(Row::new(&venue.name));
    }
    table.note(format!(
        "{MOVES} moves from one junction or dead end to the next by layers 0 and 1, a random walk that heeds the map's advice 30 % of the \
         time. Odometry is the encoders' with headings trued up by the walls, a place looks as one sweep there does. Recall is of all ways of \
         the maze, each in both directions."
    ))
}

/// What the runs depend on.
pub(super) fn config() -> String {
    format!("{:?}", EpuckSurveyConfig::usual(MOVES))
}

/// One survey.
pub(super) fn run(venue: &Venue, job: &Job<'_>) -> Result<Fields, BoxError> {
    let config = EpuckSurveyConfig::usual(MOVES);
    let survey = survey_maze(&venue.maze, venue.corridor_width, &config, job.seed)?;
    let score = survey.score;
    let bounded = f64::from(survey.bounded) / f64::from(survey.moves.max(1));
    let fields = Fields::new()
        .count("moves", survey.moves.into())
        .count("places", score.places as u64)
        .count("visited", score.visited as u64)
        .number("purity", score.purity)
        .number("share_once", score.share_once)
        .number("link_precision", score.link_precision)
        .number("link_recall", score.link_recall)
        .number("bounded", bounded);
    Ok(match survey.trouble {
        Some(trouble) => fields.text("trouble", trouble),
        None => fields,
    })
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    for (name, _) in SHARES {
        let share = number(name);
        if share.is_none_or(|share| !(0.0..=1.0).contains(&share)) {
            return Err(format!("{name} is {share:?}, which is no share of 1").into());
        }
    }
    let moves = number("moves").unwrap_or_default();
    if moves > f64::from(MOVES) || number("visited") > Some(moves + 1.0) {
        return Err(format!("{moves} moves to {:?} places", number("visited")).into());
    }
    Ok(())
}
