//! The report: one HTML file that opens anywhere, without network.
//!
//! The page is made of parts, each a function of the [`ExperimentOutcome`]:
//!
//! - header, cards and contents (`header`)
//! - one section for each table (`table`), and figures (`figures`)
//! - notes on how to read them (`notes`)
//! - what is folded (`folds`)
//! - replays with the script (`replays`, `page.js`)
//!
//! `docs/report.md` names the ids and attributes that tests and other scripts may rely on.

mod abstracts;
mod figures;
mod folds;
mod header;
mod league;
mod notes;
mod pairs;
mod replays;
mod table;
mod tour;

pub use league::{League, LeagueTable, LeagueValue, league_html};
pub use tour::tour_html;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::ExperimentOutcome;
use folds::{Folds, Part};

/// Returns the whole page.
pub(crate) fn html(outcome: &ExperimentOutcome) -> String {
    let main = outcome.entry.main;
    let tables = outcome.analysis.tables.iter();
    let parts: Vec<Part<'_>> = tables
        .map(|table| {
            let is_main = main.contains(&table.table.name.as_str());
            Part::of(table, &outcome.figures, is_main)
        })
        .collect();
    let mut folds = Folds::of_report();
    let shown = folds.of_tables(&parts);
    let others = figures::of_no_table(&outcome.figures);
    let seen = folds.of_figures(&others);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(outcome.entry.title, replays::style(outcome)))
            body {
                main {
                    (header::header(outcome))
                    p.abstract { (abstracts::of(outcome)) }
                    (header::cards(outcome))
                    (header::contents(outcome))
                    @for (number, (part, shown)) in (1_u32..).zip(parts.iter().zip(&shown)) {
                        (table::section(Some(number), part, *shown))
                    }
                    (figures::others(&others, seen))
                    (notes::notes(outcome))
                }
                (replays::dialog(outcome))
                (replays::scripts(outcome))
                script { (PreEscaped(include_str!("folds.js"))) }
            }
        }
    };
    tolman_draw::visible(&page.into_string()).into_owned()
}

/// Returns the head of a page, with the style of all pages and its own `style`.
fn head(title: &str, style: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="generator" content="tolman report";
            meta http-equiv="Content-Security-Policy"
                content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
            title { (title) }
            style {
                (PreEscaped(tolman_draw::style())) (PreEscaped(include_str!("style.css")))
                (PreEscaped(style))
            }
        }
    }
}
