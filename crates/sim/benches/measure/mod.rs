//! What the benches share: criterion's measurement, and a table of it with ratios.
//!
//! The table counts seconds of this thread's processor time, so that a busy machine does not blur
//! it. Criterion's own report counts wall-clock seconds.

use core::fmt;
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
    let mut group = criterion.benchmark_group("sim");
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
            let (elapsed, used) = (wall.elapsed(), processor.elapsed());
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

/// Figures by row and column, grouped, each with its ratio to one row of its group.
pub(crate) struct Table {
    unit: &'static str,
    reference: &'static str,
    figures: Vec<(String, String, String, f64)>,
}

impl Table {
    pub(crate) fn new(unit: &'static str, reference: &'static str) -> Self {
        Self {
            unit,
            reference,
            figures: Vec::new(),
        }
    }

    pub(crate) fn enter(&mut self, group: &str, row: &str, column: &str, figure: Option<f64>) {
        if let Some(figure) = figure {
            self.figures
                .push((group.into(), row.into(), column.into(), figure));
        }
    }
}

impl fmt::Display for Table {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = self.unit;
        writeln!(
            formatter,
            "| world | caster | unit walls | {unit} | ratio to {} |",
            self.reference
        )?;
        writeln!(formatter, "| --- | --- | ---: | ---: | ---: |")?;
        for (group, row, column, figure) in &self.figures {
            let reference =
                self.figures
                    .iter()
                    .find(|(other_group, other_row, other_column, _)| {
                        (other_group, other_row.as_str(), other_column)
                            == (group, self.reference, column)
                    });
            let ratio = match reference {
                Some((.., reference)) => format!("{:.1}", figure / reference),
                None => String::new(),
            };
            let digits = if *figure < 1.0 { 3 } else { 1 };
            writeln!(
                formatter,
                "| {group} | {row} | {column} | {figure:.digits$} | {ratio} |"
            )?;
        }
        Ok(())
    }
}
