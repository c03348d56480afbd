//! The result in three sentences, made from the rows.

use super::header::grouped;
use crate::{
    Doubt, ExperimentOutcome, Finding, Measured, Metric, Table, heading, value_with_spread,
};

/// Returns up to three sentences. They give the runs and the number of values that match the
/// paper's, the greatest difference, and the reason why others cannot be judged.
pub(super) fn of(outcome: &ExperimentOutcome) -> String {
    let analysis = &outcome.analysis;
    let told = analysis.tally();
    let tables = match analysis.tables.len() {
        1 => "One table".to_owned(),
        count => format!("{count} tables"),
    };
    let runs = grouped(outcome.runs.len() as u64);
    let first = match told.all() {
        0 => format!("{tables} of {runs} runs, of which no paper says anything."),
        _ => format!("{tables} of {runs} runs: of the paper's values {told}."),
    };
    let most = analysis
        .disagreements()
        .filter_map(|one| Some((excess(one.2)?, one)))
        .max_by(|(a, _), (b, _)| a.total_cmp(b));
    let second = most.and_then(|(_, one)| differs(one));
    let third = doubt(analysis.values().map(|(_, _, measured)| measured));
    let sentences: Vec<String> = [Some(first), second, third].into_iter().flatten().collect();
    sentences.join(" ")
}

/// Returns the difference of a value from the paper's, in tolerances.
fn excess(measured: &Measured) -> Option<f64> {
    let accepted = measured.verdict.as_ref()?.accepted?;
    let far = (measured.value - measured.paper.as_ref()?.value).abs();
    Some(far / (accepted.high - accepted.low).max(f64::MIN_POSITIVE))
}

fn differs((table, metric, measured): (&Table, &Metric, &Measured)) -> Option<String> {
    let value = |value| value_with_spread(metric, value, None);
    Some(format!(
        "What differs most is {} of {} in table {}: {}, where the paper has {}.",
        heading(metric),
        measured.row,
        table.name,
        value(measured.value),
        value(measured.paper.as_ref()?.value)
    ))
}

/// Returns the most frequent reason why values cannot be judged, with the greatest number of runs
/// that would do.
fn doubt<'a>(values: impl Iterator<Item = &'a Measured>) -> Option<String> {
    let mut doubts: Vec<(&Doubt, usize)> = Vec::new();
    for verdict in values.filter_map(|measured| measured.verdict.as_ref()) {
        if let Finding::CannotTell(doubt) = &verdict.finding {
            let is_same = |known: &Doubt| match (known.runs_needed(), doubt.runs_needed()) {
                (Some(_), Some(_)) => true,
                _ => known == doubt,
            };
            match doubts.iter_mut().find(|(known, _)| is_same(known)) {
                Some((known, count)) => {
                    *count += 1;
                    if known.runs_needed() < doubt.runs_needed() {
                        *known = doubt;
                    }
                }
                None => doubts.push((doubt, 1)),
            }
        }
    }
    let (doubt, count) = doubts.into_iter().rev().max_by_key(|(_, count)| *count)?;
    Some(match count {
        1 => format!("Of one value nobody can tell: {doubt}."),
        _ => format!("Of {count} values nobody can tell: {doubt}."),
    })
}
