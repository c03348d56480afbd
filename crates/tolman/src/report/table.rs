//! One table of the paper beside ours.

use maud::{Markup, html};

use super::figures;
use super::header::SIGNIFICANT;
use crate::draw::{Figure, Series};
use crate::experiment::{
    Comparison, Measured, Metric, MetricAnalysis, Statistic, TableAnalysis, Verdict, heading, ours,
    value_with_spread,
};

/// The section of a table with its figures.
pub(super) fn section(analysis: &TableAnalysis, figures: &[Figure]) -> Markup {
    let table = &analysis.table;
    let comparison = table.comparison.as_ref();
    let of_paper = of_paper(analysis);
    html! {
        section {
            h2 { "Table " (table.name) @if !table.title.is_empty() { " · " (table.title) } }
            div.wide {
                table {
                    thead { tr {
                        th { "row" }
                        @if of_paper { th { "paper" } }
                        th { "ours" }
                        th { "also" }
                        th { "95 % interval" }
                        @if let Some(Comparison { reference, correction }) = comparison {
                            th { "p vs. " (reference) " (" (correction.name()) ")" }
                            th { "A" sub { "12" } }
                        }
                        @if of_paper { th { "verdict" } }
                    } }
                    @for metric in &analysis.metrics { (group(analysis, metric)) }
                }
            }
            @if !table.note.is_empty() { p.note { (table.note) } }
            (figures::grid(figures.iter().filter(|f| f.table.as_deref() == Some(&table.name))))
        }
    }
}

/// The rows of one metric below its heading.
fn group(analysis: &TableAnalysis, metric: &MetricAnalysis) -> Markup {
    let comparison = analysis.table.comparison.as_ref();
    let columns = if comparison.is_some() { 6 } else { 4 } + if of_paper(analysis) { 2 } else { 0 };
    html! {
        tbody {
            tr.metric { th colspan=(columns) { (heading(&metric.metric)) } }
            @for measured in &metric.rows {
                @let place = analysis.table.rows.iter().position(|row| row.name == measured.row);
                (row(analysis, &metric.metric, measured, place.unwrap_or(0)))
            }
        }
    }
}

/// Whether the paper says anything of the table.
fn of_paper(analysis: &TableAnalysis) -> bool {
    let mut rows = analysis.metrics.iter().flat_map(|metric| &metric.rows);
    rows.any(|row| row.paper.is_some())
}

fn row(analysis: &TableAnalysis, metric: &Metric, measured: &Measured, place: usize) -> Markup {
    let comparison = analysis.table.comparison.as_ref();
    let of_paper = of_paper(analysis);
    let decimals = usize::from(metric.decimals);
    let series = Series(u32::try_from(place).unwrap_or(0));
    let is_reference = comparison.is_some_and(|comparison| comparison.reference == measured.row);
    html! {
        tr {
            th scope="row" { span class={ "swatch " (series.class()) } {} (measured.row) }
            @if of_paper {
                td {
                    @if let Some(paper) = &measured.paper {
                        (value_with_spread(metric, paper.value, paper.sd))
                    } @else { (none()) }
                }
            }
            td { (ours(metric, measured)) }
            td.quiet { (also(metric, measured)) }
            td.quiet {
                @if let Some(interval) = measured.interval {
                    (format!("{:.decimals$} – {:.decimals$}", interval.low, interval.high))
                } @else { (none()) }
            }
            @if comparison.is_some() {
                @if let Some(contrast) = measured.contrast {
                    td class=[(contrast.p.value() < SIGNIFICANT).then_some("strong")] { (contrast.p) }
                    td { (format!("{:.2}", contrast.a12)) }
                } @else if is_reference {
                    td.quiet colspan="2" { "reference" }
                } @else {
                    td { (none()) }
                    td { (none()) }
                }
            }
            @if of_paper { td { (badge(metric, measured.verdict)) } }
        }
    }
}

fn badge(metric: &Metric, verdict: Option<Verdict>) -> Markup {
    let decimals = usize::from(metric.decimals);
    html! {
        @if let Some(Verdict { matches, accepted, .. }) = verdict {
            span class=(if matches { "badge matches" } else { "badge differs" })
                title=(format!("matches between {:.decimals$} and {:.decimals$}", accepted.low, accepted.high))
            { (if matches { "matches" } else { "differs" }) }
        } @else { (none()) }
    }
}

/// The median beside a mean, the mean beside a median.
fn also(metric: &Metric, measured: &Measured) -> Markup {
    let decimals = usize::from(metric.decimals);
    let told = match metric.statistic {
        Statistic::Mean { .. } => measured
            .median
            .map(|value| format!("median {value:.decimals$}")),
        Statistic::Median { .. } => measured
            .mean
            .map(|mean| format!("mean {}", value_with_spread(metric, mean, measured.sd))),
        _ => None,
    };
    html! {
        @if let Some(told) = told { (told) } @else { (none()) }
    }
}

/// A cell without a value.
fn none() -> Markup {
    html! { span.quiet { "–" } }
}
