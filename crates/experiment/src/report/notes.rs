//! Notes on how to read the page.

use maud::{Markup, html};

use super::replays;

use crate::{Centre, ExperimentOutcome, Metric, RESAMPLES, Statistic};

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
                    li { b { "Verdict. " } "A difference is sure where its 95 % interval, with the spread of both samples, excludes 0. Ours "
                         b { "differs" } " from the paper's value where the difference is sure and exceeds the tolerance. It is " b { "close" }
                         " where the difference is sure and within the tolerance, and " b { "matches" } " where it is not sure and within the \
                         tolerance. Otherwise the sample is too small, and the runs " b { "cannot tell" } "; the cell says how many would do. \
                         A system of our own may be " b { "better" } ". Fewer than five runs differ only where ours leaves nothing to \
                         chance and the paper gives no spread. Behind a word stands the tolerance, whose reason is beside the metric's name. \
                         In brackets is how far the interval reaches towards 0: a smaller difference could not have been seen. Shares: Newcombe's \
                         interval; means with the paper's spread: Welch's; all else: "
                         (RESAMPLES) " resamples of our runs, which stand for the paper's too."
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
