//! Writes the head of the page: the runs, their settings, and the result at a glance.

use maud::{Markup, html};

use crate::{ExperimentOutcome, VerdictTally, duration};

/// Corrected p-value below which there is a difference.
pub(super) const SIGNIFICANT: f64 = 0.05;

/// Returns title, source, provenance, and the command that repeats the results.
pub(super) fn header(outcome: &ExperimentOutcome) -> Markup {
    let time = match outcome.played {
        0 => "no run played now".to_owned(),
        played => format!(
            "{} runs in {} on {}",
            grouped(played),
            duration(outcome.elapsed),
            counted(outcome.jobs as usize, "thread")
        ),
    };
    html! {
        header {
            button #theme type="button" title="light or dark" aria-label="dark colours" { "◐" }
            h1 { (outcome.entry.title) }
            @if !outcome.entry.source.is_empty() { p.source { (outcome.entry.source) } }
            p.meta {
                "commit " (outcome.build.commit)
                " · " (short_compiler(&outcome.build.compiler))
                " · seed " (outcome.seed)
                " · " (time)
            }
            p.meta { "make it again: " code { (outcome.command) } }
            @if let Some(skipped) = &outcome.skipped { p.skipped { (skipped) } }
        }
    }
}

/// Returns the result in a few numbers.
pub(super) fn cards(outcome: &ExperimentOutcome) -> Markup {
    let values = || outcome.analysis.values().map(|(_, _, measured)| measured);
    let told = outcome.analysis.tally();
    let contrasts = || values().filter_map(|one| one.contrast);
    let differing = contrasts().filter(|contrast| contrast.p.value() < SIGNIFICANT);
    let (differing, contrasts) = (differing.count(), contrasts().count());
    let total = outcome.runs.len() as u64;
    html! {
        div.cards {
            @if told.all() > 0 {
                (card(&format!("{} of {} match", told.matches, told.all()), &format!("of the paper's values; {}", told.others())))
            }
            (card(&grouped(total), &runs_of_rows(outcome)))
            @if outcome.played < total {
                (card(&grouped(total - outcome.played), "runs reused from before"))
            }
            @if contrasts > 0 {
                (card(
                    &format!("{differing} / {contrasts}"),
                    &format!("comparisons differ (p < {SIGNIFICANT})"),
                ))
            }
            @if outcome.played > 0 { (card(&duration(outcome.elapsed), "to play the runs")) }
        }
    }
}

/// Returns links to the tables, with their shares of matching values; empty for a single table.
pub(super) fn contents(outcome: &ExperimentOutcome) -> Markup {
    let tables = &outcome.analysis.tables;
    html! {
        @if tables.len() > 1 {
            nav aria-label="tables" {
                @for (number, table) in (1_u32..).zip(tables) {
                    @let told: VerdictTally = table.verdicts().collect();
                    a href={ "#table-" (number) } {
                        "Table " (table.table.name)
                        (matching(&told))
                    }
                }
            }
        }
    }
}

/// Returns how many of the paper's values match, short enough for a list of links; the pointer
/// shows the rest. Empty if the paper has none.
pub(super) fn matching(told: &VerdictTally) -> Markup {
    html! {
        @if told.all() > 0 { span title=(told) { (told.matches) "/" (told.all()) } }
    }
}

/// Returns the number of runs of each row, if all have the same number.
fn runs_of_rows(outcome: &ExperimentOutcome) -> String {
    let tables = &outcome.analysis.tables;
    let mut rows = tables.iter().flat_map(|table| &table.table.rows);
    if rows.all(|row| row.runs.is_none()) {
        format!(
            "runs, {} of each row",
            grouped(u64::from(outcome.runs_per_row))
        )
    } else {
        "runs".to_owned()
    }
}

fn card(value: &str, label: &str) -> Markup {
    html! {
        div.card {
            strong { (value) }
            span { (label) }
        }
    }
}

/// Returns `rustc 1.95.0 (59807616e 2026-04-14)` without the part in parentheses.
fn short_compiler(compiler: &str) -> &str {
    compiler.split(" (").next().unwrap_or(compiler)
}

/// Returns a count with its noun: `1 thread`, `2 threads`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        _ => format!("{count} {noun}s"),
    }
}

/// Returns a whole number with thin spaces between groups of three digits.
pub(super) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_in_groups_of_three() {
        for (number, expect) in [
            (0, "0"),
            (999, "999"),
            (1000, "1\u{202f}000"),
            (1_234_567, "1\u{202f}234\u{202f}567"),
        ] {
            assert_eq!(grouped(number), expect);
        }
    }
}
