//! `summary.json`: one value for each metric of each row.

use serde::Serialize;

use super::{Analysis, Doubt, Error, Reached, Tolerance, Verdict};

/// Name of the table with all p-values of pairwise comparisons.
pub const P_TABLE: &str = "p";

/// The contents of `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the experiment.
    pub experiment: String,
    /// Version of this format: 1.
    pub version: u32,
    /// Master seed of the experiment.
    pub seed: u64,
    /// Values by table, row and metric, in the experiment's order.
    pub rows: Vec<SummaryRow>,
}

/// One value of `summary.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SummaryRow {
    /// Name of the table.
    pub table: String,
    /// Name of the row.
    pub row: String,
    /// Name of the metric.
    pub metric: String,
    /// Value in the metric's unit: the mean unless the metric says otherwise; `null` if it is not a
    /// number.
    pub value: f64,
    /// `false` if the metric waits for an event that did not happen: `value` is then a lower bound.
    /// Missing otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reached: Option<bool>,
    /// Standard deviation, for means and medians of two runs or more.
    pub sd: Option<f64>,
    /// Number of runs measured.
    pub n: u64,
    /// Value that the paper gives.
    pub paper: Option<f64>,
    /// Verdict, if the paper has a value: `matches`, `close`, `better`, `differs` or `cannot tell`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<&'static str>,
    /// Reason why the value cannot be judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// Number of runs that would do to judge the value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runs_needed: Option<u32>,
    /// Smallest difference that could have been detected, by the 95 % interval of the difference.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<f64>,
    /// Tolerance of the verdict with its reason: `±15: mazes are drawn again`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<String>,
}

impl SummaryRow {
    /// Returns the row with the verdict and the tolerance that it rests on.
    fn judged(self, verdict: Option<&Verdict>, tolerance: Option<Tolerance>) -> Self {
        let Some(verdict) = verdict else {
            return self;
        };
        let doubt = verdict.finding.doubt();
        Self {
            verdict: Some(verdict.finding.word()),
            why: doubt.map(ToString::to_string),
            runs_needed: doubt.and_then(Doubt::runs_needed),
            resolution: verdict.resolution,
            tolerance: tolerance.map(|Tolerance { within, reason }| format!("{within}: {reason}")),
            ..self
        }
    }
}

impl Summary {
    pub(super) fn of(experiment: &str, seed: u64, analysis: &Analysis) -> Self {
        let mut rows = Vec::new();
        for table in &analysis.tables {
            for row in &table.table.rows {
                for metric in &table.metrics {
                    rows.extend(
                        metric
                            .rows
                            .iter()
                            .filter(|measured| measured.row == row.name)
                            .map(|measured| {
                                let summary = SummaryRow {
                                    table: table.table.name.clone(),
                                    row: row.name.clone(),
                                    metric: metric.metric.name.clone(),
                                    value: measured.value,
                                    reached: (measured.reached == Reached::No).then_some(false),
                                    sd: measured.sd,
                                    n: measured.n,
                                    paper: measured.paper.as_ref().map(|paper| paper.value),
                                    ..SummaryRow::default()
                                };
                                let tolerance = metric.metric.tolerance;
                                summary.judged(measured.verdict.as_ref(), tolerance)
                            }),
                    );
                }
            }
        }
        for table in &analysis.tables {
            rows.extend(table.pairs.iter().map(|pair| {
                let summary = SummaryRow {
                    table: P_TABLE.to_owned(),
                    row: format!("{}: {}", table.table.name, pair.name()),
                    metric: "p".to_owned(),
                    value: pair.contrast.p.value(),
                    n: pair.n,
                    paper: pair.paper,
                    ..SummaryRow::default()
                };
                summary.judged(pair.verdict.as_ref(), None)
            }));
        }
        Self {
            experiment: experiment.to_owned(),
            version: 1,
            seed,
            rows,
        }
    }

    /// Returns the text of `summary.json`, with a line end.
    ///
    /// # Errors
    /// [`Error::Summary`].
    pub fn to_json(&self) -> Result<String, Error> {
        serde_json::to_string_pretty(self)
            .map(|text| text + "\n")
            .map_err(|source| Error::Summary {
                name: self.experiment.clone(),
                source,
            })
    }
}
