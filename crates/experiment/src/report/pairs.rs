//! Pairwise comparison of a table's rows.

use maud::{Markup, html};

use super::header::SIGNIFICANT;
use crate::{Doubt, RowPair, TableAnalysis};

/// Returns the table of all pairs of rows, with the paper's p-value and ours.
pub(super) fn table(analysis: &TableAnalysis) -> Markup {
    let pairwise = analysis.table.pairwise.as_ref();
    html! {
        div.wide tabindex="0" { table aria-label={ "Table " (analysis.table.name) ", each row with each" } {
            thead { tr {
                th {
                    @if let Some(pairwise) = pairwise {
                        (pairwise.field) ", each with each"
                    }
                }
                th { "paper's p" }
                th {
                    "p"
                    @if let Some(pairwise) = pairwise { " (" (pairwise.correction.name()) ")" }
                }
                th { "A" sub { "12" } }
            } }
            tbody { @for pair in &analysis.pairs { tr {
                th scope="row" { (pair.name()) }
                td {
                    @if let Some(p) = pair.paper { (p) } @else { span.quiet { "–" } }
                }
                td class=[(pair.contrast.p.value() < SIGNIFICANT).then_some("strong")] { (pair.contrast.p) }
                td { (format!("{:.2}", pair.contrast.a12)) }
            } } }
        } }
    }
}

/// Returns the reason why the paper's p-value of a pair is not judged; `None` if it gives none.
pub(super) fn doubt(pair: &RowPair) -> Option<&Doubt> {
    pair.verdict.as_ref()?.finding.doubt()
}
