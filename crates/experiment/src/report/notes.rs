//! Notes on how to read the page.

use maud::{Markup, html};

use super::replays;

use crate::{Centre, ExperimentOutcome, Metric, RESAMPLES, Statistic, Within, heading};

/// Returns the notes at the end of the page. They explain only what the page shows.
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
    let median = has(|of| matches!(of, Statistic::Of(Centre::Median, _)));
    let mean = has(|of| matches!(of, Statistic::Of(Centre::Mean, _)));
    let ratio = has(|of| matches!(of, Statistic::Ratio { .. } | Statistic::Multiple { .. }));
    let settling = has(|of| matches!(of, Statistic::Settling(_)));
    let compared = analysis
        .tables
        .iter()
        .any(|table| table.table.comparison.is_some());
    let judged = analysis.tally().all() > 0;
    let carried = replays::carried(outcome);
    let partly = outcome.replays.of_each_row < outcome.runs_per_row;
    html! {
        section.notes { details {
            summary { h2 { "How to read this" } }
            ul {
                @if judged {
                    li { b { "Verdict. " } "Ours " b { "differs" } " from the paper's value where the 95 % interval of the difference, with \
                         the spread of both samples, excludes 0 and the difference exceeds the tolerance. It " b { "matches" }
                         " where the difference is within the tolerance and the interval includes 0. Of all else the runs " b { "cannot tell" }
                         ". A system of our own may be " b { "better" } ". Behind ± stands half the width of the interval: a smaller difference \
                         could not have been seen. Shares: Newcombe's interval; means with the paper's spread: Welch's; all else: "
                         (RESAMPLES) " resamples of our runs, which stand for the paper's too. " (tolerances(&metrics))
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
                         reference row; 0.5 means no difference, 0.56, 0.64 and 0.71 (0.44, 0.36, 0.29) begin a small, \
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
        } }
    }
}

/// Returns the tolerances in words, each metric once.
fn tolerances(metrics: &[&Metric]) -> String {
    let mut told: Vec<String> = Vec::new();
    for metric in metrics {
        let Some(tolerance) = metric.tolerance else {
            continue;
        };
        let decimals = metric.places();
        let size = match (tolerance.within, &metric.statistic) {
            (Within::Absolute(points), Statistic::Percent(_)) => {
                format!("{} ± {points:.0} percentage points", metric.title)
            }
            (Within::Absolute(by), _) => format!("{} ± {by:.decimals$}", heading(metric)),
            (Within::Relative(share), _) => {
                format!("{} ± {:.0} %", metric.title, 100.0 * share)
            }
            (Within::Factor(factor), _) => format!("{} a factor of {factor}", metric.title),
        };
        let text = format!("{size} ({})", tolerance.reason);
        if !told.contains(&text) {
            told.push(text);
        }
    }
    if told.is_empty() {
        return String::new();
    }
    format!("Tolerances: {}.", told.join("; "))
}
