//! The report: one HTML file that opens anywhere, without network.
//!
//! The page is put together from parts, each a function of the [`ExperimentOutcome`]: header, cards
//! and contents (`header`), one section for each table (`table`), figures (`figures`), the notes
//! that say how to read it all (`notes`), and the replays with the script (`replays`, `page.js`).
//! `docs/report.md` names the ids and attributes that tests and other scripts may rely on.

mod abstracts;
mod figures;
mod header;
mod notes;
mod pairs;
mod replays;
mod table;
mod tour;

pub use tour::tour_html;

use maud::{DOCTYPE, PreEscaped, html};

use crate::ExperimentOutcome;

/// Returns the whole page.
pub(crate) fn html(outcome: &ExperimentOutcome) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content="tolman report";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
                title { (outcome.entry.title) }
                style {
                    (PreEscaped(tolman_draw::style())) (PreEscaped(include_str!("style.css")))
                    (PreEscaped(replays::style(outcome)))
                }
            }
            body {
                main {
                    (header::header(outcome))
                    p.abstract { (abstracts::of(outcome)) }
                    (header::cards(outcome))
                    (header::contents(outcome))
                    @for (number, table) in (1_u32..).zip(&outcome.analysis.tables) {
                        (table::section(Some(number), table, &outcome.figures))
                    }
                    (figures::others(&outcome.figures))
                    (notes::notes(outcome))
                }
                (replays::dialog(outcome))
                (replays::scripts(outcome))
            }
        }
    };
    page.into_string()
}
