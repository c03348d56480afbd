//! Pairwise comparison of all rows of a table, as papers report it.

use super::sample::Sample;
use super::{Centre, Contrast, Correction, Doubt, Run, Statistic, Table, Verdict};

/// Rows that are compared pairwise, and the metric.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairwise {
    /// Numeric field that is compared.
    pub field: String,
    /// Names of the rows. Every two of them are a pair.
    pub rows: Vec<String>,
    /// Correction of p-values for the number of pairs.
    pub correction: Correction,
    /// The paper's p-values, each with its two rows in either order.
    pub paper: Vec<(String, String, f64)>,
}

/// Comparison of two rows.
#[derive(Clone, Debug, PartialEq)]
pub struct RowPair {
    /// Name of the row that comes first in the table.
    pub first: String,
    /// Name of the other row.
    pub second: String,
    /// Number of runs of both rows together.
    pub n: u64,
    /// Difference of the first row from the second; its p-value is corrected for the number of
    /// pairs.
    pub contrast: Contrast,
    /// p-value that the paper gives.
    pub paper: Option<f64>,
    /// Verdict on the paper's p-value, which is never judged; `None` if the paper has none.
    pub verdict: Option<Verdict>,
}

/// Reason why p-values are not judged.
const OF_SAMPLES: &str = "a p-value speaks of its samples, not of a quantity";

impl RowPair {
    /// Returns the names of both rows in words.
    pub fn name(&self) -> String {
        format!("{} – {}", self.first, self.second)
    }
}

impl Pairwise {
    /// Returns the comparison of every pair of measured rows, in the order of the rows.
    pub(super) fn compare(&self, table: &Table, runs: &[Run]) -> Vec<RowPair> {
        let statistic = Statistic::Of(Centre::Mean, self.field.clone());
        let samples: Vec<(&String, Vec<f64>)> = self
            .rows
            .iter()
            .filter_map(|row| {
                let own = runs.iter().filter(|run| run.is_of(&table.name, row));
                let runs: Vec<&Run> = own.collect();
                Some((row, Sample::of(&statistic, &runs, &[], &[])?.numbers()))
            })
            .collect();
        let mut pairs = Vec::new();
        for (place, (first, a)) in samples.iter().enumerate() {
            for (second, b) in &samples[place + 1..] {
                let paper = self.paper_value(first, second);
                let aside = |_| Verdict::unknown(Doubt::Aside(OF_SAMPLES.to_owned()));
                pairs.extend(Contrast::of(a, b).map(|contrast| RowPair {
                    first: (*first).clone(),
                    second: (*second).clone(),
                    n: (a.len() + b.len()) as u64,
                    contrast,
                    paper,
                    verdict: paper.map(aside),
                }));
            }
        }
        let contrasts = pairs.iter_mut().map(|pair| &mut pair.contrast);
        self.correction.correct(contrasts);
        pairs
    }

    fn paper_value(&self, first: &str, second: &str) -> Option<f64> {
        let mut values = self.paper.iter();
        let found =
            values.find(|(a, b, _)| (a == first && b == second) || (a == second && b == first));
        found.map(|(_, _, p)| *p)
    }
}
