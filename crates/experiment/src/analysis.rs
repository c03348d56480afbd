//! Every metric of every row, compared with the paper and with the reference row.

use super::sample::Sample;
use super::verdict::Case;
use super::{
    Doubt, Experiment, Finding, Metric, PaperValue, Reached, Row, RowPair, Run, Table, Verdict,
    VerdictTally, run_seed,
};
use tolman_stats::{ConfidenceInterval, Method, PValue};

/// All tables of an experiment, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Tables that have runs, or would have them if their data files were here, in the experiment's
    /// order.
    pub tables: Vec<TableAnalysis>,
}

/// One table, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TableAnalysis {
    /// Table that was analysed.
    pub table: Table,
    /// Metrics in the table's order.
    pub metrics: Vec<MetricAnalysis>,
    /// Rows that are compared pairwise; empty if none are.
    pub pairs: Vec<RowPair>,
}

/// One metric of a table, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct MetricAnalysis {
    /// Metric that was analysed.
    pub metric: Metric,
    /// The rows that have the metric, in the table's order.
    pub rows: Vec<Measured>,
}

/// One metric of one row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// Name of the row.
    pub row: String,
    /// Number of runs measured; 0 if there is only the paper's value.
    pub n: u64,
    /// Value in the metric's unit; NaN without runs.
    pub value: f64,
    /// Whether the event that the metric waits for happened. If not, the value is a lower bound.
    pub reached: Reached,
    /// Standard deviation, in the metric's unit, for means and medians of two runs or more.
    pub sd: Option<f64>,
    /// Mean of the runs, for means and medians.
    pub mean: Option<f64>,
    /// Median of the runs, for means and medians.
    pub median: Option<f64>,
    /// 95 % confidence interval of the value.
    pub interval: Option<ConfidenceInterval>,
    /// Value of the paper.
    pub paper: Option<PaperValue>,
    /// Verdict on the paper's value; `None` if the paper has none.
    pub verdict: Option<Verdict>,
    /// Difference from the reference row.
    pub contrast: Option<Contrast>,
}

/// Difference of a row from the reference row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contrast {
    /// Mann and Whitney's p-value, corrected for the comparisons of the metric.
    pub p: PValue,
    /// Probability that a run of this row has a greater value than a run of the reference row, 0 …
    /// 1.
    pub a12: f64,
}

impl Contrast {
    /// Returns the uncorrected difference of two samples; `None` if one has no numbers.
    pub(super) fn of(a: &[f64], b: &[f64]) -> Option<Self> {
        let p = tolman_stats::mann_whitney(a, b, Method::Auto).ok()?.p;
        let a12 = tolman_stats::a12(a, b).ok()?;
        Some(Self { p, a12 })
    }
}

impl Analysis {
    /// Returns the analysis of runs that are sorted by table, row and index.
    pub(super) fn of(experiment: &Experiment, runs: &[Run], master_seed: u64) -> Self {
        let tables = experiment
            .tables
            .iter()
            .filter(|table| table.is_shown())
            .map(|table| TableAnalysis {
                metrics: table
                    .metrics
                    .iter()
                    .map(|metric| measure(table, metric, runs, master_seed))
                    .collect(),
                pairs: table
                    .pairwise
                    .as_ref()
                    .map_or_else(Vec::new, |pairwise| pairwise.compare(table, runs)),
                table: table.clone(),
            })
            .collect();
        Self { tables }
    }

    /// Returns the values that disagree with the paper's, each with its table and metric, for
    /// `--check`.
    pub fn disagreements(&self) -> impl Iterator<Item = (&Table, &Metric, &Measured)> {
        self.values().filter(|(_, _, measured)| {
            let verdict = measured.verdict.as_ref();
            verdict.is_some_and(|verdict| verdict.finding == Finding::Differs)
        })
    }

    /// Returns the number of the paper's values by verdict.
    #[must_use]
    pub fn tally(&self) -> VerdictTally {
        self.tables
            .iter()
            .flat_map(TableAnalysis::verdicts)
            .collect()
    }

    /// Returns every measured value with its table and metric.
    pub fn values(&self) -> impl Iterator<Item = (&Table, &Metric, &Measured)> {
        self.tables.iter().flat_map(|table| {
            table.metrics.iter().flat_map(move |metric| {
                metric
                    .rows
                    .iter()
                    .map(move |measured| (&table.table, &metric.metric, measured))
            })
        })
    }
}

impl TableAnalysis {
    /// Returns the verdicts on the paper's values: of all metrics, then of the pairs of rows.
    pub fn verdicts(&self) -> impl Iterator<Item = &Verdict> {
        let rows = self.metrics.iter().flat_map(|metric| &metric.rows);
        let of_values = rows.filter_map(|measured| measured.verdict.as_ref());
        of_values.chain(self.pairs.iter().filter_map(|pair| pair.verdict.as_ref()))
    }
}

impl Measured {
    /// Returns the entry of a row for which only the paper has a value.
    fn alone(row: &Row, paper: &PaperValue) -> Self {
        let doubt = row.missing.clone().map_or(Doubt::NoRuns, Doubt::NoData);
        Self {
            row: row.name.clone(),
            value: f64::NAN,
            paper: Some(paper.clone()),
            verdict: Some(Verdict::unknown(doubt)),
            ..Self::default()
        }
    }
}

fn measure(table: &Table, metric: &Metric, runs: &[Run], master_seed: u64) -> MetricAnalysis {
    let runs_of = |row: &str| -> Vec<&Run> {
        let own = runs.iter().filter(|run| run.is_of(&table.name, row));
        own.collect()
    };
    let others = metric.statistic.other_row();
    let others = others.map_or_else(Vec::new, |of| runs_of(of));
    let by_row = table.rows.iter().map(|row| match row.is_pooled {
        true => runs.iter().filter(|run| run.table == table.name).collect(),
        false => runs_of(&row.name),
    });
    let by_row: Vec<Vec<&Run>> = by_row.collect();
    let mut samples = Vec::new();
    for (row, runs) in table.rows.iter().zip(&by_row) {
        if let Some(sample) = Sample::of(&metric.statistic, runs, &others, &by_row) {
            samples.push((row, sample));
        }
    }
    let mut rows: Vec<Measured> = samples
        .iter()
        .map(|(row, sample)| {
            let stream = format!("bootstrap of {}, {}, {}", table.name, row.name, metric.name);
            let (value, reached) = sample.value();
            let paper = row.paper_value(&metric.name);
            Measured {
                row: row.name.clone(),
                n: sample.len() as u64,
                value,
                reached,
                sd: sample.sd(),
                mean: sample.mean(),
                median: sample.median(),
                interval: sample.interval(run_seed(master_seed, &stream, 0)),
                paper: paper.cloned(),
                verdict: paper.map(|paper| {
                    let stream = format!(
                        "difference of {}, {}, {}",
                        table.name, row.name, metric.name
                    );
                    let case = Case {
                        table,
                        row,
                        metric,
                        sample,
                        paper,
                        seed: run_seed(master_seed, &stream, 0),
                    };
                    case.judge()
                }),
                contrast: None,
            }
        })
        .collect();
    contrast(table, &samples, &mut rows);
    for (place, row) in table.rows.iter().enumerate() {
        let is_there = rows.iter().any(|measured| measured.row == row.name);
        if let (false, Some(paper)) = (is_there, row.paper_value(&metric.name)) {
            let before = |measured: &&Measured| {
                let mut rows = table.rows[..place].iter();
                rows.any(|row| row.name == measured.row)
            };
            let at = rows.iter().filter(before).count();
            rows.insert(at, Measured::alone(row, paper));
        }
    }
    MetricAnalysis {
        metric: metric.clone(),
        rows,
    }
}

/// Compares every row with the reference row, if the table asks for that and the row was measured.
fn contrast(table: &Table, samples: &[(&Row, Sample<'_>)], rows: &mut [Measured]) {
    let Some(comparison) = &table.comparison else {
        return;
    };
    let is_reference = |row: &Row| row.name == comparison.reference;
    let Some((_, reference)) = samples.iter().find(|(row, _)| is_reference(row)) else {
        return;
    };
    let reference = reference.numbers();
    for ((row, sample), measured) in samples.iter().zip(&mut *rows) {
        if !is_reference(row) {
            measured.contrast = Contrast::of(&sample.numbers(), &reference);
        }
    }
    let contrasts = rows.iter_mut().filter_map(|row| row.contrast.as_mut());
    comparison.correction.correct(contrasts);
}
