//! The page of a tour: the tables of several experiments.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::folds::{Folds, Part, Shown};
use super::header::matching;
use super::{figures, head, table};
use crate::ExperimentOutcome;
use tolman_draw::Figure;

/// Returns a text whose parts between backticks are code.
fn with_code(text: &str) -> Markup {
    html! {
        @for (place, part) in text.split('`').enumerate() {
            @if place % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

/// Returns the page of a tour: tables, figures and verdicts of every experiment.
///
/// Each links to its own report, which is in the folder `NAME` beside the page and carries the
/// replays. `last` is the sentence at the end, which says what is missing.
#[must_use]
pub fn tour_html(outcomes: &[ExperimentOutcome], last: &str) -> String {
    let numbered = || (1_usize..).zip(outcomes);
    let stops: Vec<Stop<'_>> = outcomes.iter().map(Stop::of).collect();
    let parts: Vec<Part<'_>> = stops.iter().flat_map(Stop::parts).collect();
    let shown = Folds::of_tour(outcomes.len()).of_tables(&parts);
    let mut shown = shown.into_iter();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head("A tour of all experiments", ""))
            body {
            main {
                header {
                    h1 { "A tour of all experiments" }
                    p.source { "The main tables at small counts, beside the papers'. " (with_code(last)) }
                }
                nav aria-label="experiments" {
                    @for (number, outcome) in numbered() {
                        a href={ "#experiment-" (number) } {
                            (outcome.entry.name) (matching(&outcome.analysis.tally()))
                        }
                    }
                }
                @for (number, stop) in (1..).zip(&stops) { (stop.section(number, &mut shown)) }
            }
            script { (PreEscaped(include_str!("folds.js"))) }
            }
        }
    };
    tolman_draw::visible(&page.into_string()).into_owned()
}

/// One experiment on the page.
struct Stop<'a> {
    outcome: &'a ExperimentOutcome,
    /// Figures of the experiment, under names that are unique on the page: several experiments may
    /// use the same ids.
    figures: Vec<Figure>,
}

impl<'a> Stop<'a> {
    fn of(outcome: &'a ExperimentOutcome) -> Self {
        let name = outcome.entry.name;
        let figures = outcome.figures.iter().map(|figure| Figure {
            name: format!("{name}-{}", figure.name),
            ..figure.clone()
        });
        Self {
            outcome,
            figures: figures.collect(),
        }
    }

    /// Returns its tables; the first comes before those of later experiments.
    fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        let tables = self.outcome.analysis.tables.iter().enumerate();
        tables.map(|(place, table)| Part::of(table, &self.figures, place == 0))
    }

    fn section(&self, number: usize, shown: &mut impl Iterator<Item = Shown>) -> Markup {
        let Self { outcome, figures } = self;
        let name = outcome.entry.name;
        let own = format!("{name}/report.html");
        html! {
            section id={ "experiment-" (number) } {
                h1 { (number) " · " (outcome.entry.title) }
                @if !outcome.entry.source.is_empty() { p.source { (outcome.entry.source) } }
                p.meta {
                    @let told = outcome.analysis.tally();
                    @if told.all() > 0 { "of the paper's values " (told) " · " }
                    a href=(own) { "its own page, with replays" }
                    " · make it again: " code { (outcome.command) }
                }
            }
            @for (part, shown) in self.parts().zip(shown) { (table::section(None, &part, shown)) }
            (figures::folded(&figures::of_no_table(figures), true))
        }
    }
}
