//! Describes the result of a task in words.

use serde::Serialize;
use tolman_arena::contest::{Claim, FoundOut, LearnRecord, LocateOutcome, WayHome};
use tolman_arena::run::TaskEnd;

use crate::session::count;

/// Result of a task in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskVerdict {
    /// Description of the result, in one or two sentences.
    pub told: String,
    /// Tone of the description.
    pub tone: Tone,
}

/// Tone of a sentence, which chooses its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// The run went well.
    Good,
    /// The run went wrong.
    Bad,
    /// The result is neither good nor bad.
    Neutral,
}

/// Returns the result of learning, in words.
pub(crate) fn explored(name: &str, record: &LearnRecord) -> TaskVerdict {
    let LearnRecord {
        end,
        claim,
        judgement,
        places,
        ..
    } = record;
    let places = count(*places, "place");
    let says = match (end, claim) {
        (TaskEnd::GaveUp { why }, _) => format!("{name} gave up with {places} on its map: {why}."),
        (TaskEnd::OutOfTime, _) => format!("{name} was stopped with {places} on its map."),
        (TaskEnd::Done, Claim::Right) => {
            format!("{name} says that its map is complete: {places}.")
        }
        (TaskEnd::Done, Claim::Wrong) => {
            format!("{name} doubts its map of {places}.")
        }
        (TaskEnd::Done, Claim::Undecided) => format!("{name} is done: {places} on its map."),
    };
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let recall = percent(judgement.link_recall);
    let (truth, tone) = if judgement.is_right {
        ("The map is right.".to_owned(), Tone::Good)
    } else if judgement.is_right_of_visited {
        let truth = format!("The map is right as far as it goes: {recall} of the ways are on it.");
        (truth, Tone::Neutral)
    } else if matches!((end, claim), (TaskEnd::Done, Claim::Undecided)) {
        let truth = "It does not say that its places are the maze's: put it elsewhere, and see what \
                     the map is worth.";
        (truth.to_owned(), Tone::Neutral)
    } else {
        let precision = judgement
            .link_precision
            .map(|precision| format!(" {} of its links are true ways, and", percent(precision)));
        let truth = format!(
            "The map is not the maze's:{} {recall} of the ways are on it.",
            precision.unwrap_or_default()
        );
        (truth, Tone::Bad)
    };
    let told = format!("{says} {truth}");
    TaskVerdict { told, tone }
}

/// Returns the result of localizing, in words.
pub(crate) fn found(record: &FoundOut) -> TaskVerdict {
    let after = format!(
        "after {}, {:.1} m",
        count(record.actions as usize, "action"),
        record.metres
    );
    let (told, tone) = match (&record.outcome, record.was_put_down) {
        (LocateOutcome::Abstained { why }, false) => (
            format!("It cannot be put elsewhere, so it was put back: {why}."),
            Tone::Neutral,
        ),
        (LocateOutcome::Right, _) => (format!("It found out where it is {after}."), Tone::Good),
        (LocateOutcome::Wrong, _) => (
            format!("It believes that it is elsewhere, {after}."),
            Tone::Bad,
        ),
        (LocateOutcome::Abstained { why }, true) => (
            format!("It did not find out where it is, {after}: {why}."),
            Tone::Bad,
        ),
    };
    TaskVerdict { told, tone }
}

/// Returns the result of the way to the goal, in words.
pub(crate) fn home(record: &WayHome) -> TaskVerdict {
    let shortest = record.shortest;
    let (told, tone) = match record.metres {
        Some(metres) => (
            format!("It is at the goal after {metres:.1} m; the shortest way is {shortest:.1} m."),
            Tone::Good,
        ),
        None if record.gave_up.is_empty() => {
            ("It did not come to the goal in time.".to_owned(), Tone::Bad)
        }
        None => {
            let why = &record.gave_up;
            (format!("It did not come to the goal: {why}."), Tone::Bad)
        }
    };
    TaskVerdict { told, tone }
}
