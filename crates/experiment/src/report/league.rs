//! The page of a league: what many entrants did in the same worlds, one table for each task.

use maud::{DOCTYPE, Markup, html};
use tolman_stats::ConfidenceInterval;

use super::head;

/// Style of the page beside that of all pages.
const STYLE: &str =
    "main thead tr::before { content: none; } main :is(th, td):first-child { text-align: left; }
td small { display: block; opacity: 0.7; }";

/// Results of many entrants, on one page.
#[derive(Clone, Debug, Default)]
pub struct League {
    /// Sentences above the tables: what was played, and what is not alike.
    pub told: Vec<String>,
    /// The tables, one for each task.
    pub tables: Vec<LeagueTable>,
    /// Each entrant with its version, and the command that plays it again.
    pub commands: Vec<(String, String)>,
}

/// What entrants did in one task.
#[derive(Clone, Debug, Default)]
pub struct LeagueTable {
    /// The task, and what is measured.
    pub title: String,
    /// Kinds of worlds, each a column.
    pub columns: Vec<String>,
    /// Entrants, the best first, with a value for each column; `None` where they did not play.
    pub rows: Vec<(String, Vec<Option<LeagueValue>>)>,
}

/// A mean in percent over a number of worlds.
#[derive(Clone, Copy, Debug)]
pub struct LeagueValue {
    /// The mean, %.
    pub mean: f64,
    /// Its 95 % interval, %.
    pub interval: ConfidenceInterval,
    /// Number of worlds.
    pub worlds: usize,
}

/// Returns the page of a league: one HTML file that opens anywhere, without network.
#[must_use]
pub fn league_html(league: &League) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head("Arena league", STYLE))
            body { main {
                header {
                    h1 { "Arena league" }
                    @for sentence in &league.told { p.meta { (sentence) } }
                }
                @for table in &league.tables { (section(table)) }
                section {
                    h2 { "Play it again" }
                    @for (entrant, command) in &league.commands {
                        p.meta { (entrant) ": " code { (command) } }
                    }
                }
            } }
        }
    };
    tolman_draw::visible(&page.into_string()).into_owned()
}

fn section(table: &LeagueTable) -> Markup {
    html! {
        section {
            h2 { (table.title) }
            table {
                thead { tr { th { "entrant" } @for column in &table.columns { th { (column) } } } }
                tbody { @for (entrant, values) in &table.rows {
                    tr data-place="" {
                        th scope="row" { (entrant) }
                        @for (column, value) in table.columns.iter().zip(values) {
                            td.none[value.is_none()] data-label=(column) { (cell(*value)) }
                        }
                    }
                } }
            }
        }
    }
}

fn cell(value: Option<LeagueValue>) -> Markup {
    html! {
        @if let Some(LeagueValue { mean, interval, worlds }) = value {
            b { (format!("{mean:.0}")) }
            small { (format!("{:.0} to {:.0}, {worlds} worlds", interval.low, interval.high)) }
        }
    }
}
