//! How to read the page.

use maud::{Markup, html};

use super::replays;

use crate::{ExperimentOutcome, Metric, RESAMPLES, Statistic, Tolerance, heading};

/// The notes below everything, only about what the page shows.
pub(super) fn notes(outcome: &ExperimentOutcome) -> Markup {
    let analysis = &outcome.analysis;
    let metrics: Vec<&Metric> = analysis
        .tables
        .iter()
        .flat_map(|table| table.metrics.iter().map(|metric| &metric.metric))
        .collect();
    let has = |wanted: fn(&Statistic) -> bool| metrics.iter().any(|m| wanted(&m.statistic));
    let percent = has(|of| matches!(of, Statistic::Percent(_)));
    let count = has(|of| matches!(of, Statistic::Count { .. }));
    let median = has(|of| matches!(of, Statistic::Median(_)));
    let mean = has(|of| matches!(of, Statistic::Mean(_)));
    let ratio = has(|of| matches!(of, Statistic::Ratio { .. } | Statistic::Multiple { .. }));
    let settling = has(|of| matches!(of, Statistic::Settling(_)));
    let compared = analysis
        .tables
        .iter()
        .any(|table| table.table.comparison.is_some());
    // Of each value that is judged, whether a tolerance is stated for it.
    let judged: Vec<bool> = analysis
        .values()
        .filter(|(_, _, measured)| measured.verdict.is_some())
        .map(|(_, metric, _)| metric.tolerance.is_some())
        .collect();
    let carried = replays::carried(outcome);
    let partly = outcome.replays.of_each_row < outcome.runs_per_row;
    html! {
        section.notes {
            h2 { "How to read this" }
            ul {
                @if !judged.is_empty() {
                    li { b { "Verdict. " } (tolerances(&metrics))
                        @if judged.contains(&false) {
                            "Where no tolerance is stated, our value matches if it lies within the 95 % \
                             interval of the paper's own sample: exact binomial for a share, mean \
                             ± 1.96 standard errors for a mean. "
                        }
                        "The accepted values stand beside the verdict."
                    }
                }
                li { b { "95 % interval. " }
                    @if percent || count { "Percentages and counts: exact binomial (Clopper–Pearson). " }
                    @if median { "Medians: the order statistics that hold it with at least that probability, whatever the distribution; six runs or more. " }
                    @if mean || ratio { "Means and ratios: BCa bootstrap, " (RESAMPLES) " resamples. " }
                    @if settling { "When a mean curve settles: the same bootstrap over runs, with the limit held. " }
                }
                @if mean { li { b { "Means " } "stand with the standard deviation (n − 1)." } }
                @if median { li { b { "Medians " } "are R-7 quantiles, as in R and NumPy." } }
                @if count { li { b { "Counts " } "of a few runs, such as 19 of 20, are the share of all our runs times that few." } }
                @if ratio { li { b { "Ratios " } "are sums over all runs divided by sums over all runs." } }
                @if settling {
                    li { b { "Settling. " } "A row settles where the mean curve of all its runs has gone below a limit, which all \
                         rows of the table share, for good. A value behind > is the length of the runs: the row does not settle." }
                }
                @if compared {
                    li { b { "p. " } "Mann–Whitney U, two-sided, against the reference row, corrected for the \
                         comparisons within a metric. " b { "A" sub { "12" } ". " }
                         "The probability that a run of the row has a greater value than one of the \
                         reference row; 0.5 is no difference, 0.56, 0.64 and 0.71 (0.44, 0.36, 0.29) begin a small, \
                         medium and large one (Vargha and Delaney)."
                    }
                }
                @if mean || median {
                    li { b { "Box plots. " } "Box: R-7 quartiles and median. Whiskers: the last datum within \
                         1.5 interquartile ranges. Dots: every run. Diamond and bar: the paper's value and \
                         standard deviation." }
                }
                @if !carried.is_empty() {
                    li { b { "Replays. " } "A click on a dot opens that run. With the keyboard: Tab to a plot, \
                         arrow keys from dot to dot, Enter to open, Esc to close. " (carried)
                        @if partly { " The dots of these runs are drawn stronger; the others show the command that replays them." }
                    }
                }
                li { b { "Seeds. " } "The seed of a run comes from the master seed, the table and the index of \
                     the run, so the rows of a table meet the same starts. " code { "runs.jsonl" }
                     " lists every run with its seed; " code { "config.toml" } " is all that is needed to make \
                     them again."
                }
            }
        }
    }
}

/// The stated tolerances in words, each metric once.
fn tolerances(metrics: &[&Metric]) -> String {
    let mut told: Vec<String> = Vec::new();
    for metric in metrics {
        let Some(tolerance) = metric.tolerance else {
            continue;
        };
        let decimals = metric.places();
        let text = match (tolerance, &metric.statistic) {
            (Tolerance::Absolute(points), Statistic::Percent(_)) => {
                format!("{} within ± {points:.0} percentage points", metric.title)
            }
            (Tolerance::Absolute(by), _) => format!("{} within ± {by:.decimals$}", heading(metric)),
            (Tolerance::Relative(share), _) => {
                format!("{} within ± {:.0} %", metric.title, 100.0 * share)
            }
            (Tolerance::Spread, _) => {
                format!("{} within the paper's standard deviation", metric.title)
            }
            (Tolerance::Factor(factor), _) => {
                format!("{} within a factor of {factor}", metric.title)
            }
        };
        if !told.contains(&text) {
            told.push(text);
        }
    }
    if told.is_empty() {
        return String::new();
    }
    format!(
        "Our value matches the paper's if it lies within the stated tolerance: {}. ",
        told.join(", ")
    )
}
