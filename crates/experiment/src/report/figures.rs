//! Figures inline on the page.

use maud::{Markup, html};

use tolman_draw::Figure;

/// Figures side by side where there is room.
pub(super) fn grid<'a>(figures: impl Iterator<Item = &'a Figure>) -> Markup {
    let figures: Vec<&Figure> = figures.collect();
    html! {
        @if !figures.is_empty() {
            div.figures { @for figure in figures { (one(figure)) } }
        }
    }
}

/// Returns the figures that belong to no table.
pub(super) fn others(figures: &[Figure]) -> Markup {
    let mut others = figures
        .iter()
        .filter(|figure| figure.table.is_none())
        .peekable();
    html! {
        @if others.peek().is_some() {
            section {
                h2 { "More figures" }
                (grid(others))
            }
        }
    }
}

/// A picture wider than this may have to be scrolled on a phone, which the keyboard can do in
/// focus.
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
