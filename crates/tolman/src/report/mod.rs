//! The report: one HTML file that opens anywhere, without network.
//!
//! The page is put together from parts, each a function of the [`Outcome`]: header and cards
//! (`header`), one section for each table (`table`), figures (`figures`) and the notes that
//! say how to read it all (`notes`). Every dot of a plot bears `data-table`, `data-row`,
//! `data-run` and `data-seed`.

mod figures;
mod header;
mod notes;
mod table;

use maud::{DOCTYPE, PreEscaped, html};

use crate::draw;
use crate::experiment::Outcome;

/// The whole page.
pub fn html(outcome: &Outcome) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content="tolman";
                title { (outcome.title) }
                style { (PreEscaped(draw::style())) (PreEscaped(include_str!("style.css"))) }
            }
            body {
                main {
                    (header::header(outcome))
                    (header::cards(outcome))
                    @for table in &outcome.analysis.tables {
                        (table::section(table, &outcome.figures))
                    }
                    (figures::others(&outcome.figures))
                    (notes::notes(outcome))
                }
            }
        }
    };
    page.into_string()
}
