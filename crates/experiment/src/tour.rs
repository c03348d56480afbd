//! A line of the tour: one value, beside the paper's or a rival's.

use super::sample::Sample;
use super::{Beside, Better, Contrast, ExperimentOutcome, Headline, Measured, Metric, Run};

/// A line of the tour, measured.
#[derive(Clone, Debug)]
pub struct TourLine {
    /// What was to be measured.
    pub headline: Headline,
    /// Value of the paper or the rival, with its name; empty if there is neither.
    pub beside: String,
    /// Our value.
    pub ours: String,
    /// Number of our runs.
    pub runs: u64,
    /// Verdict in a word; empty if there is nothing to compare with.
    pub verdict: &'static str,
    /// Name of the line's folder, which has the report.
    pub folder: String,
    /// Command that repeats the results.
    pub command: String,
}

impl TourLine {
    /// Returns the name of a line's folder: that of its experiment and of its table.
    #[must_use]
    pub fn folder_of(experiment: &str, line: &Headline) -> String {
        let is_plain = |&c: &char| c.is_ascii_alphanumeric() || matches!(c, ' ' | '-' | '.');
        let table: String = line.table.chars().filter(is_plain).collect();
        format!("{experiment}-{}", table.to_lowercase().replace(' ', "-"))
    }

    /// Returns the line of an outcome.
    ///
    /// # Errors
    /// The reason in words if the row has no value: its data is missing, or no run was made.
    pub fn of(headline: Headline, outcome: &ExperimentOutcome) -> Result<Self, String> {
        let find = |row: &str| {
            let mut values = outcome.analysis.values();
            values.find(|(table, metric, measured)| {
                (&*table.name, &*metric.name, &*measured.row)
                    == (headline.table, headline.metric, row)
            })
        };
        let Headline { table, row, .. } = headline;
        let runs_of = |measured: &Measured| -> Vec<&Run> {
            let runs = outcome.runs.iter();
            runs.filter(|run| run.is_of(table, &measured.row)).collect()
        };
        let (_, metric, ours) = find(row).ok_or_else(|| format!("{table} has no row {row}"))?;
        let verdict = ours.verdict.as_ref().map(|verdict| &verdict.finding);
        if ours.n == 0 {
            let why = verdict.and_then(|finding| finding.doubt());
            return Err(why.map_or_else(|| "no run was made".to_owned(), ToString::to_string));
        }
        let shown = |value: f64| format!("{value:.*}", metric.places());
        let (beside, verdict) = match headline.beside {
            Beside::Paper => {
                let paper = ours.paper.as_ref().map(|paper| shown(paper.value));
                let word = verdict.map_or("", |finding| finding.word());
                (
                    paper.map_or_else(String::new, |paper| format!("paper {paper}")),
                    word,
                )
            }
            Beside::Rival { row, called } => match find(row) {
                Some((_, _, rival)) if rival.n > 0 => {
                    let told = format!("{called} {}", shown(rival.value));
                    (told, against(metric, &runs_of(ours), &runs_of(rival)))
                }
                _ => return Err(format!("{called} has no value")),
            },
            Beside::Nothing => (String::new(), ""),
        };
        Ok(Self {
            headline,
            beside,
            ours: shown(ours.value),
            runs: ours.n,
            verdict,
            folder: Self::folder_of(outcome.entry.name, &headline),
            command: outcome.command.clone(),
        })
    }
}

/// Level below which the test of Mann and Whitney tells two rows apart.
const LEVEL: f64 = 0.05;

/// Returns the verdict on our row beside a rival's.
fn against(metric: &Metric, ours: &[&Run], rival: &[&Run]) -> &'static str {
    let numbers = |runs: &[&Run]| Some(Sample::of(&metric.statistic, runs, &[], &[])?.numbers());
    let contrast = numbers(ours).zip(numbers(rival));
    let contrast = contrast.and_then(|(ours, rival)| Contrast::of(&ours, &rival));
    let Some(contrast) = contrast.filter(|contrast| contrast.p.value() < LEVEL) else {
        return "cannot tell";
    };
    match (metric.better.unwrap_or_default(), contrast.a12 > 0.5) {
        (Better::Neither, _) => "differs",
        (Better::Higher, true) | (Better::Lower, false) => "better",
        _ => "worse",
    }
}
