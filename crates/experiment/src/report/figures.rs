//! Figures inline on the page.

use maud::{Markup, html};

use super::header::counted;
use tolman_draw::Figure;

/// Returns figures side by side, as far as there is room.
pub(super) fn grid(figures: &[&Figure]) -> Markup {
    html! {
        @if !figures.is_empty() {
            div.figures { @for figure in figures { (one(figure)) } }
        }
    }
}

/// Returns figures in a fold that names them. `more` says that others are shown before it.
pub(super) fn folded(figures: &[&Figure], more: bool) -> Markup {
    let noun = if more { "more figure" } else { "figure" };
    html! {
        @if !figures.is_empty() {
            details.more { summary { (counted(figures.len(), noun)) } (grid(figures)) }
        }
    }
}

/// Returns the figures that belong to no table.
pub(super) fn of_no_table(figures: &[Figure]) -> Vec<&Figure> {
    let figures = figures.iter().filter(|figure| figure.table.is_none());
    figures.collect()
}

/// Returns the section of the figures that belong to no table; the first `shown` are open.
pub(super) fn others(figures: &[&Figure], shown: usize) -> Markup {
    let (seen, rest) = figures.split_at(shown.min(figures.len()));
    html! {
        @if !figures.is_empty() {
            section {
                h2 { "More figures" }
                (grid(seen))
                (folded(rest, !seen.is_empty()))
            }
        }
    }
}

/// Width above which a picture may scroll on a phone, px. It must then be focusable, so that the
/// keyboard can scroll it.
const PHONE: f64 = 340.0;

fn one(figure: &Figure) -> Markup {
    let wide = figure.drawing.width > PHONE;
    html! {
        // As wide as its picture, so that the caption does not push the next figure away.
        figure style=(format!("width: min(100%, {:.0}px)", figure.drawing.width)) {
            div.wide tabindex=[wide.then_some("0")] { (figure.inline()) }
            figcaption {
                strong { (figure.title) "." }
                @if !figure.caption.is_empty() { " " (figure.caption) }
            }
        }
    }
}
