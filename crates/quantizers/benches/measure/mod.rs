//! Criterion's measurement, and the rate by this thread's processor time, so that a busy machine
//! does not blur it.

use core::time::Duration;
use std::time::Instant;

use cpu_time::ThreadTime;
use criterion::Criterion;

/// Measures `work` with criterion and returns how often it is done per second, the median over
/// samples; `None` if the command line left it out.
pub(crate) fn per_second<R>(
    criterion: &mut Criterion,
    label: &str,
    work: &mut impl FnMut() -> R,
) -> Option<f64> {
    let mut samples: Vec<f64> = Vec::new();
    let mut group = criterion.benchmark_group("quantizers");
    group.warm_up_time(Duration::from_millis(200));
    group.measurement_time(Duration::from_millis(900));
    group.sample_size(10);
    group.sampling_mode(criterion::SamplingMode::Flat);
    group.bench_function(label, |bencher| {
        bencher.iter_custom(|iterations| {
            let (wall, processor) = (Instant::now(), ThreadTime::now());
            for _ in 0..iterations {
                core::hint::black_box(work());
            }
            samples.push(iterations as f64 / processor.elapsed().as_secs_f64());
            wall.elapsed()
        });
    });
    group.finish();
    samples.sort_by(f64::total_cmp);
    samples.get(samples.len() / 2).copied()
}
