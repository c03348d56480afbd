//! A table of the paper with our values beside it.

use maud::{Markup, html};

use super::folds::{Part, Shown};
use super::header::{SIGNIFICANT, counted};
use super::{figures, pairs};
use crate::{
    Centre, Comparison, Doubt, Measured, Metric, MetricAnalysis, Reached, Statistic, TableAnalysis,
    Verdict, VerdictTally, heading, ours, value_with_spread,
};
use tolman_draw::Series;

/// Returns the section of the table with its figures. `number`, from 1, names it if the page has
/// only one table of that number.
///
/// Each metric is a body of the table. A header with `data-sort` sorts the rows of every body by
/// the `data-value` of their cells with that `data-column`. On a narrow page a row becomes a card:
/// name and verdict on top, the other cells below with their `data-label`.
pub(super) fn section(number: Option<u32>, part: &Part<'_>, shown: Shown) -> Markup {
    let analysis = part.table;
    let table = &analysis.table;
    let told: VerdictTally = analysis.verdicts().collect();
    let metrics: Vec<&MetricAnalysis> = varying(analysis).collect();
    let (first, more) = metrics.split_at(shown.metrics.min(metrics.len()));
    let constant = analysis.metrics.iter().filter(|metric| is_constant(metric));
    let constant = constant.filter_map(same).collect::<Vec<_>>().join("; ");
    let (seen, folded) = part.figures.split_at(shown.figures.min(part.figures.len()));
    html! {
        section id=[number.map(|number| format!("table-{number}"))] {
            details.table open[shown.open] {
                summary {
                    h2 { "Table " (table.name) @if !table.title.is_empty() { " · " (table.title) } }
                    @if told.all() > 0 { " " span.told { (told) } }
                }
                @for missing in table.missing() { p.note.missing { (missing) } }
                (matrix(analysis, first))
                @if !more.is_empty() {
                    details.more {
                        summary { (counted(more.len(), "more metric")) ": " (titles(more)) }
                        (matrix(analysis, more))
                    }
                }
                @if !constant.is_empty() { p.note { "The same in every run: " (constant) "." } }
                @if !analysis.pairs.is_empty() {
                    details.more {
                        summary { "Each row with each: " (counted(analysis.pairs.len(), "pair")) }
                        (pairs::table(analysis))
                        @if let Some(doubt) = analysis.pairs.iter().find_map(pairs::doubt) {
                            p.note { "Of the paper's p nobody can tell: " (doubt) "." }
                        }
                    }
                }
                @if !table.note.is_empty() { p.note { (table.note) } }
                (figures::grid(seen))
                (figures::folded(folded, !seen.is_empty()))
            }
        }
    }
}

/// Returns the rows of these metrics beside the paper's.
fn matrix(analysis: &TableAnalysis, metrics: &[&MetricAnalysis]) -> Markup {
    let table = &analysis.table;
    let columns = Columns::of(analysis);
    html! {
        div.wide {
            table class=[columns.paper.then_some("judged")] aria-label={ "Table " (table.name) } {
                thead { tr {
                    (sortable("row", &html! { "row" }))
                    @if columns.paper { (sortable("paper", &html! { "paper" })) }
                    (sortable("ours", &html! { "ours" }))
                    @if columns.also { th.also { "median or mean" } }
                    th.interval { "95 % interval" }
                    @if let Some(Comparison { reference, correction }) = columns.comparison {
                        (sortable("p", &html! { "p vs. " (reference) " (" (correction.name()) ")" }))
                        (sortable("effect", &html! { "A" sub { "12" } }))
                    }
                    @if columns.paper { (sortable("verdict", &html! { "verdict" })) }
                } }
                @for metric in metrics { (group(analysis, &columns, metric)) }
            }
        }
    }
}

/// Returns the metrics that vary between runs.
pub(super) fn varying(analysis: &TableAnalysis) -> impl Iterator<Item = &MetricAnalysis> {
    let metrics = analysis.metrics.iter();
    metrics.filter(|metric| !is_constant(metric))
}

/// Returns the titles of the metrics.
fn titles(metrics: &[&MetricAnalysis]) -> String {
    let titles = metrics.iter().map(|metric| metric.metric.title.as_str());
    titles.collect::<Vec<_>>().join(", ")
}

/// Returns whether all rows have the same value without spread, and the paper has no value.
fn is_constant(metric: &MetricAnalysis) -> bool {
    let Some(first) = metric.rows.first() else {
        return false;
    };
    let is_same = |row: &Measured| {
        row.value.total_cmp(&first.value).is_eq()
            && row.reached == Reached::Yes
            && row.paper.is_none()
            && row.n > 1
            && row.sd.is_none_or(|sd| sd <= 0.0)
    };
    metric.rows.len() > 1 && metric.rows.iter().all(is_same)
}

/// Returns the value of a constant metric, in words.
fn same(metric: &MetricAnalysis) -> Option<String> {
    let (first, decimals) = (metric.rows.first()?, metric.metric.places());
    Some(format!(
        "{} {:.decimals$}",
        heading(&metric.metric),
        first.value
    ))
}

/// Columns that a table has in addition to the common ones.
struct Columns<'a> {
    /// Whether there is a column for the paper.
    paper: bool,
    /// Whether there is a column for the median beside means, or the mean beside medians.
    also: bool,
    comparison: Option<&'a Comparison>,
}

impl<'a> Columns<'a> {
    fn of(analysis: &'a TableAnalysis) -> Self {
        let mut rows = analysis.metrics.iter().flat_map(|metric| &metric.rows);
        let mut metrics = analysis
            .metrics
            .iter()
            .map(|metric| &metric.metric.statistic);
        Self {
            paper: rows.any(|row| row.paper.is_some()),
            also: metrics.any(|s| matches!(s, Statistic::Of(Centre::Mean | Centre::Median, _))),
            comparison: analysis.table.comparison.as_ref(),
        }
    }

    fn count(&self) -> u32 {
        let when = |there: bool, columns: u32| if there { columns } else { 0 };
        3 + when(self.paper, 2) + when(self.also, 1) + when(self.comparison.is_some(), 2)
    }
}

fn sortable(column: &str, title: &Markup) -> Markup {
    html! {
        th class=(column) scope="col" data-sort=(column) aria-sort="none" {
            button type="button" title="sort; once more for the other way, and again for the table's order" {
                (title)
            }
        }
    }
}

/// Returns the rows of one metric below its heading.
fn group(analysis: &TableAnalysis, columns: &Columns<'_>, metric: &MetricAnalysis) -> Markup {
    html! {
        tbody data-metric=(metric.metric.name) {
            tr.metric {
                th colspan=(columns.count()) scope="rowgroup" title=[explained(&metric.metric)] {
                    (heading(&metric.metric))
                    @if let Some(tolerance) = tolerance(metric) { " " span.tolerance { (tolerance) } }
                }
            }
            @for measured in &metric.rows {
                @let place = analysis.table.rows.iter().position(|row| row.name == measured.row);
                (row(columns, &metric.metric, measured, place.unwrap_or(0)))
            }
        }
    }
}

/// Returns the tolerance of the metric's verdicts with its reason; `None` without verdicts.
fn tolerance(metric: &MetricAnalysis) -> Option<String> {
    let is_judged = metric.rows.iter().any(|row| row.verdict.is_some());
    let tolerance = metric.metric.tolerance.filter(|_| is_judged)?;
    Some(format!(
        "tolerance {}: {}",
        tolerance.within, tolerance.reason
    ))
}

/// Returns the explanation shown when the pointer is on the heading of a metric; `None` if there is
/// none.
fn explained(metric: &Metric) -> Option<String> {
    let explanation = metric.explanation();
    (!explanation.is_empty()).then_some(explanation)
}

fn row(columns: &Columns<'_>, metric: &Metric, measured: &Measured, place: usize) -> Markup {
    let decimals = metric.places();
    let series = Series(u32::try_from(place).unwrap_or(0));
    let also = also(metric, measured);
    html! {
        tr data-place=(place) {
            th scope="row" data-column="row" data-value=(measured.row) {
                span class={ "swatch " (series.class()) } {} (measured.row)
            }
            @if columns.paper {
                @if let Some(paper) = &measured.paper {
                    td data-label="paper" data-column="paper" data-value=(paper.value) {
                        (value_with_spread(metric, paper.value, paper.sd))
                    }
                } @else { td.none { "–" } }
            }
            @if measured.n > 0 {
                td data-label="ours" data-column="ours" data-value=(measured.value) { (ours(metric, measured)) }
            } @else { td.none { "–" } }
            @if columns.also {
                @if let Some(also) = also { td.quiet data-label="median or mean" { (also) } } @else { td.none { "–" } }
            }
            @if let Some(interval) = measured.interval {
                td.quiet data-label="95 % interval" {
                    (format!("{:.decimals$} – {:.decimals$}", interval.low, interval.high))
                }
            } @else { td.none { "–" } }
            @if let Some(comparison) = columns.comparison { (contrast(comparison, measured)) }
            @if columns.paper { (verdict(metric, measured.verdict.as_ref())) }
        }
    }
}

/// Returns p and effect size.
fn contrast(comparison: &Comparison, measured: &Measured) -> Markup {
    let versus = format!("p vs. {}", comparison.reference);
    html! {
        @if let Some(contrast) = measured.contrast {
            td class=[(contrast.p.value() < SIGNIFICANT).then_some("strong")] data-label=(versus)
                data-column="p" data-value=(contrast.p.ln()) { (contrast.p) }
            td data-label="A₁₂" data-column="effect" data-value=(contrast.a12) {
                (format!("{:.2}", contrast.a12)) " " span.quiet { (magnitude(contrast.a12)) }
            }
        } @else if comparison.reference == measured.row {
            td.quiet.none colspan="2" { "reference" }
        } @else {
            td.none { "–" }
            td.none { "–" }
        }
    }
}

/// Returns the size of an effect in the words of Vargha and Delaney. Source: "A critique and
/// improvement of the CL common language effect size statistics of McGraw and Wong" (2000).
fn magnitude(a12: f64) -> &'static str {
    match (a12 - 0.5).abs() {
        distance if distance < 0.06 => "none",
        distance if distance < 0.14 => "small",
        distance if distance < 0.21 => "medium",
        _ => "large",
    }
}

/// Returns the verdict, with the tolerance, the smallest difference that could have been detected,
/// and the reason if the value cannot be judged. The tolerated range shows when the pointer is on
/// it.
fn verdict(metric: &Metric, verdict: Option<&Verdict>) -> Markup {
    let decimals = metric.places();
    let accepted = verdict.and_then(|verdict| verdict.accepted);
    let range = accepted.map(|range| {
        format!(
            "tolerated: {:.decimals$} – {:.decimals$}",
            range.low, range.high
        )
    });
    html! {
        @if let Some(verdict) = verdict {
            @let word = verdict.finding.word();
            td.verdict data-column="verdict" data-value=(word) title=[range] {
                span class={ "badge " (word.replace(' ', "-")) } { (word) }
                @if let (Some(tolerance), None) = (metric.tolerance, verdict.finding.doubt()) {
                    " " span.accepted { (tolerance.within) }
                }
                @if let Some(resolution) = verdict.resolution {
                    " " span.accepted { (format!("({resolution:.decimals$})")) }
                }
                @match verdict.finding.doubt() {
                    // The files are named above the table.
                    Some(Doubt::NoData(_)) => span.why { "its files are missing" },
                    Some(doubt) => span.why { (doubt) },
                    None => {}
                }
            }
        } @else { td.verdict.none { "–" } }
    }
}

/// Returns the median if the value is a mean, and the mean if it is a median.
fn also(metric: &Metric, measured: &Measured) -> Option<String> {
    let decimals = metric.places();
    match metric.statistic {
        Statistic::Of(Centre::Mean, _) => measured
            .median
            .map(|value| format!("median {value:.decimals$}")),
        Statistic::Of(Centre::Median, _) => {
            let mean = value_with_spread(metric, measured.mean?, measured.sd);
            Some(format!("mean {mean}"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::magnitude;

    #[test]
    fn effects_have_vargha_and_delaneys_names() {
        for (a12, expect) in [
            (0.5, "none"),
            (0.57, "small"),
            (0.37, "small"),
            (0.35, "medium"),
            (0.72, "large"),
            (0.0, "large"),
        ] {
            assert_eq!(magnitude(a12), expect, "{a12}");
        }
    }
}
