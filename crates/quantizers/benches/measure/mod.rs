//! Criterion's measurement, and the rate by this thread's processor time, so that a busy machine does not blur it.

use core::time::Duration;
use std::time::Instant;

use criterion::Criterion;

/// Lets criterion measure `work` and gives how often it is done a second: the median over samples; none if the
/// command line left it out.
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
            let (wall, processor) = (Instant::now(), processor_time());
            for _ in 0..iterations {
                core::hint::black_box(work());
            }
            let elapsed = wall.elapsed();
            let used = processor_time()
                .zip(processor)
                .map_or(elapsed, |(now, then)| now - then);
            // The kernel counts processor time in scheduler ticks of up to 4 ms.
            if used > Duration::from_millis(40) {
                samples.push(iterations as f64 / used.as_secs_f64());
            }
            elapsed
        });
    });
    group.finish();
    samples.sort_by(f64::total_cmp);
    samples.get(samples.len() / 2).copied()
}

/// How long this thread has had a processor, where the system tells.
fn processor_time() -> Option<Duration> {
    let schedule = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    schedule
        .split(' ')
        .next()?
        .parse()
        .ok()
        .map(Duration::from_nanos)
}
