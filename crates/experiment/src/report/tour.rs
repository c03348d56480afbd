//! The page of a tour: the tables of several experiments in turn.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{figures, table};
use crate::ExperimentOutcome;
use tolman_draw::Figure;

/// Returns the page of a tour: of every experiment its tables, figures and verdicts, with a link to
/// the report of its own, which lies in the folder `NAME` beside the page and carries the replays.
/// `last` says what is not on it.
#[must_use]
pub fn tour_html(outcomes: &[ExperimentOutcome], last: &str) -> String {
    let numbered = || (1_usize..).zip(outcomes);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content="tolman report";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
                title { "A tour of all experiments" }
                style { (PreEscaped(tolman_draw::style())) (PreEscaped(include_str!("style.css"))) }
            }
            body { main {
                header {
                    h1 { "A tour of all experiments" }
                    p.source { "The main tables at small counts, beside the papers'. " (last) }
                }
                nav aria-label="experiments" {
                    @for (number, outcome) in numbered() {
                        a href={ "#experiment-" (number) } {
                            (outcome.entry.name) span { (outcome.analysis.tally()) }
                        }
                    }
                }
                @for (number, outcome) in numbered() { (experiment(number, outcome)) }
            } }
        }
    };
    page.into_string()
}

fn experiment(number: usize, outcome: &ExperimentOutcome) -> Markup {
    // Ids are of one experiment, and the page has several.
    let name = outcome.entry.name;
    let figures: Vec<Figure> = outcome
        .figures
        .iter()
        .map(|figure| Figure {
            name: format!("{name}-{}", figure.name),
            ..figure.clone()
        })
        .collect();
    let own = format!("{name}/report.html");
    html! {
        section id={ "experiment-" (number) } {
            h1 { (number) " · " (outcome.entry.title) }
            @if !outcome.entry.source.is_empty() { p.source { (outcome.entry.source) } }
            p.meta {
                (outcome.analysis.tally()) " of the paper's values · "
                a href=(own) { "its own page, with replays" }
                " · make it again: " code { (outcome.command) }
            }
        }
        @for analysis in &outcome.analysis.tables { (table::section(None, analysis, &figures)) }
        (figures::others(&figures))
    }
}
