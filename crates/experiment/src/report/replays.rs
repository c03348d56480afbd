//! Embeds the page's replays and the player, and replaces the replays of other runs.

use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

use crate::ExperimentOutcome;
use crate::shell;

/// Returns the window in which a replay opens, hidden until then, and the small text beside a dot.
pub(super) fn dialog(outcome: &ExperimentOutcome) -> Markup {
    html! {
        div #tip role="status" hidden {}
        dialog #replay-dialog aria-labelledby="replay-title" {
            div.bar {
                h2 #replay-title {}
                button #replay-before type="button" title="the run before" aria-label="the run before" { "‹" }
                button #replay-after type="button" title="the next run" aria-label="the next run" { "›" }
                button #replay-close type="button" title="close (Esc)" aria-label="close" { "✕" }
            }
            div #replay-stage {}
            div #replay-absent hidden {
                p { (carried(outcome)) " This command plays this run again, just as it was, and writes its replay:" }
                pre { code #replay-command {} }
                p {
                    button #replay-copy type="button" { "copy" }
                    " Then open " a #replay-link {} " beside this page."
                }
            }
        }
    }
}

/// Returns a sentence that names the replays in the page, and the reason for missing ones; empty if
/// no run is recorded.
pub(super) fn carried(outcome: &ExperimentOutcome) -> String {
    let replays = &outcome.replays;
    let megabytes = replays.budget as f64 / 1e6;
    match replays.of_each_row {
        _ if replays.tables.is_empty() => String::new(),
        0 if !replays.recorded.is_empty() => {
            format!(
                "This page carries {} replays, as many as fit.",
                replays.recorded.len()
            )
        }
        0 => format!(
            "This page carries no replays: the first of each row alone would take more than the {megabytes:.1} MB that are left."
        ),
        runs if runs == outcome.runs_per_row => {
            "This page carries the replay of every run.".to_owned()
        }
        1 => {
            format!("{CARRIES} run 0 of each row, so that it stays small enough to open anywhere.")
        }
        runs => format!(
            "{CARRIES} runs 0 to {} of each row, so that it stays small enough to open anywhere.",
            runs - 1
        ),
    }
}

const CARRIES: &str = "This page carries the replays of";

/// Returns the player's style rules; empty for a page without replays.
pub(super) fn style(outcome: &ExperimentOutcome) -> &'static str {
    match outcome.replays.recorded.is_empty() {
        true => "",
        false => tolman_replay::style(),
    }
}

/// Returns the data for the page's script, the replays, the player and the script.
pub(super) fn scripts(outcome: &ExperimentOutcome) -> Markup {
    html! {
        script #report-data type="application/json" { (PreEscaped(data(outcome))) }
        @for recorded in &outcome.replays.recorded {
            script type="application/json" data-replay data-table=(recorded.table)
                data-row=(recorded.row) data-run=(recorded.run) { (PreEscaped(&recorded.json)) }
        }
        @if !outcome.replays.recorded.is_empty() { script { (PreEscaped(tolman_replay::script())) } }
        script { (PreEscaped(include_str!("page.js"))) }
    }
}

/// Returns the command that plays a run again, in the parts that the script joins.
fn data(outcome: &ExperimentOutcome) -> String {
    let tables = (1_u32..)
        .zip(&outcome.analysis.tables)
        .map(|(number, table)| {
            let table = &table.table;
            let rows = (1_u32..).zip(&table.rows).map(|(number, row)| {
                let value = json!({ "number": number, "shell": shell::quoted(&row.name) });
                (row.name.clone(), value)
            });
            let value = json!({
                "number": number,
                "shell": shell::quoted(&table.name),
                "recorded": outcome.replays.tables.contains(&table.name),
                "rows": rows.collect::<Value>(),
            });
            (table.name.clone(), value)
        });
    let data = json!({
        "command": outcome.command,
        "runs": outcome.runs_per_row,
        "tables": tables.collect::<Value>(),
    });
    // Nothing in a script element may look like its end.
    data.to_string().replace('<', "\\u003c")
}
