//! The page of a tour: one table with a line for each system, and a moving picture.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::head;
use crate::TourLine;

/// Style of the page beside that of all pages.
const STYLE: &str = ".film svg { max-width: 100%; max-height: 70vh; height: auto; } main thead tr::before { content: none; }
main :is(th, td):is(:first-child, :nth-child(2)) { text-align: left; }";

/// Returns a text whose parts between backticks are code.
fn with_code(text: &str) -> Markup {
    html! {
        @for (place, part) in text.split('`').enumerate() {
            @if place % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

/// Returns the page of a tour.
///
/// Each line links to the report in its folder beside the page, which carries the replays.
/// `picture` is an SVG that shows a robot at work, and a link to the file `demo.html` beside the
/// page. `last` are the sentences at the end, which say what is missing.
#[must_use]
pub fn tour_html(lines: &[TourLine], picture: &str, last: &str) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head("Robots learn a map and find their way by it", STYLE))
            body {
            main {
                header {
                    h1 { "Robots learn a map and find their way by it" }
                    p.abstract {
                        "A robot explores a maze that it has never seen, is put down elsewhere, finds out where it is, and drives to \
                         the goal. Five published systems do this here in their papers' version and in a better one. Each line of the \
                         table was measured a minute ago on this computer, with few runs, beside the paper's value or beside a rival's \
                         in the same worlds."
                    }
                }
                figure.film {
                    a href="demo.html" { (PreEscaped(picture)) }
                    figcaption { a href="demo.html" { "Play it" } ": what the robot senses, knows and believes, step by step." }
                }
                table {
                    thead { tr {
                        th { "system" } th { "what is measured" } th { "beside" } th { "ours" } th { "verdict" } th { "runs" }
                    } }
                    tbody { @for line in lines { (row(line)) } }
                }
                p.meta {
                    "The verdict compares with the paper: ours " em { "matches" } ", is " em { "close" } " (it differs by less than a \
                     stated tolerance), " em { "better" } " or " em { "differs" } ", or the runs " em { "cannot tell" } ". Beside a \
                     rival, ours is better or worse if the test of Mann and Whitney tells the two apart (p < 0.05). " (with_code(last))
                }
            }
            }
        }
    };
    tolman_draw::visible(&page.into_string()).into_owned()
}

fn row(line: &TourLine) -> Markup {
    html! {
        tr data-place="" {
            th scope="row" { (line.headline.system) }
            td data-label="what is measured" { (line.headline.measures) }
            td.none[line.beside.is_empty()] data-label="beside" { (line.beside) }
            td data-label="ours" { b { (line.ours) } }
            td.none[line.verdict.is_empty()] data-label="verdict" { (line.verdict) }
            td data-label="runs" { a href={ (line.folder) "/report.html" } title=(line.command) { (line.runs) } }
        }
    }
}
