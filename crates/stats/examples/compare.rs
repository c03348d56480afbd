//! Two systems made the same number of runs: is one better, and by how much?
#![expect(clippy::print_stdout, reason = "its answer is its result")]

use tolman_stats::{Method, SampleError, SampleSummary, a12, exact_binomial_interval};
use tolman_stats::{mann_whitney, mean, mean_difference_interval, median_interval};
use tolman_stats::{rate_difference_interval, standard_deviation};

fn main() -> Result<(), SampleError> {
    // Steps to the goal in the runs that came there, of ten each.
    let ours = [31.0, 35.0, 36.0, 38.0, 40.0, 41.0, 44.0, 47.0, 52.0];
    let theirs = [37.0, 42.0, 45.5, 46.0, 49.0, 55.0];
    for (name, steps) in [("ours", &ours[..]), ("theirs", &theirs)] {
        let median = median_interval(steps, 0.95)?;
        let success = exact_binomial_interval(steps.len() as u64, 10, 0.95)?;
        println!(
            "{name:6}  median between {} and {} steps, success between {:.0} % and {:.0} %",
            median.low,
            median.high,
            100.0 * success.low,
            100.0 * success.high
        );
    }

    let summary = |sample: &[f64]| -> Result<_, SampleError> {
        Ok(SampleSummary {
            count: sample.len() as u64,
            mean: mean(sample)?,
            sd: standard_deviation(sample)?,
        })
    };
    let saved = mean_difference_interval(summary(&theirs)?, summary(&ours)?, 0.95)?;
    println!(
        "saves  between {:.1} and {:.1} steps",
        saved.low, saved.high
    );
    let test = mann_whitney(&ours, &theirs, Method::Auto)?;
    println!("p      {} that chance alone does this", test.p);
    let longer = a12(&theirs, &ours)?;
    println!(
        "A12    theirs takes longer in {:.0} % of pairs",
        100.0 * longer
    );
    assert!(longer > 0.5);

    // Nine of ten against six of ten is not evidence yet.
    let more = rate_difference_interval((9, 10), (6, 10), 0.95)?;
    assert!(more.contains(0.0));
    Ok(())
}
