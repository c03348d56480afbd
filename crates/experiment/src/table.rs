//! Tables: rows, the metrics that summarize their runs, and the paper's values.

use core::fmt;

use super::{Better, Column, Contrast, Kind, Pairwise, Record, RecordType, Settling};
use tolman_stats::PValue;

/// Returns a name as it is shown: it may be that of a file, with anything in it.
fn shown(name: impl Into<String>) -> String {
    tolman_draw::visible(&name.into()).into_owned()
}

/// One table of a paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name of the table in `summary.json`, such as `2 (J)`.
    pub name: String,
    /// Title of the table, in words.
    pub title: String,
    /// Rows, in the order in which they are shown.
    pub rows: Vec<Row>,
    /// Type of its runs' records. A run with other fields is not a run of this table.
    pub record: RecordType,
    /// Metrics of every row, in the order in which they are shown.
    pub metrics: Vec<Metric>,
    /// Number of runs of each of the paper's rows; `None` if the paper does not say.
    pub paper_runs: Option<u32>,
    /// Comparison of the rows with a reference row; `None` for no comparison.
    pub comparison: Option<Comparison>,
    /// Rows that are compared pairwise; `None` for no comparison.
    pub pairwise: Option<Pairwise>,
    /// Note that a reader needs to understand the values, such as how runs without success count;
    /// empty for none.
    pub note: String,
}

impl Table {
    /// Returns an empty table whose runs measure a `T`.
    pub fn of<T: Record>(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: shown(name),
            title: shown(title),
            rows: Vec::new(),
            record: RecordType::of::<T>(),
            metrics: Vec::new(),
            paper_runs: None,
            comparison: None,
            pairwise: None,
            note: String::new(),
        }
    }

    /// Adds a row.
    #[must_use]
    pub fn row(mut self, row: Row) -> Self {
        self.rows.push(row);
        self
    }

    /// Adds rows below those that the table has.
    #[must_use]
    pub fn rows(mut self, rows: impl IntoIterator<Item = Row>) -> Self {
        self.rows.extend(rows);
        self
    }

    /// Returns whether it is shown: a row has runs, or would have if its data files were here.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.is_filled() || self.rows.iter().any(|row| row.missing.is_some())
    }

    /// Returns the missing files that its rows need, each once.
    #[must_use]
    pub fn missing(&self) -> Vec<&str> {
        let mut told: Vec<&str> = Vec::new();
        for what in self.rows.iter().filter_map(|row| row.missing.as_deref()) {
            if !told.contains(&what) {
                told.push(what);
            }
        }
        told
    }

    /// Returns whether every row with runs has a fixed number of them.
    pub(super) fn is_fixed(&self) -> bool {
        let mut rows = self.rows.iter().filter(|row| row.runs != Some(0));
        self.is_filled() && rows.all(|row| row.is_fixed)
    }

    /// Returns whether a row has runs.
    #[must_use]
    pub fn is_filled(&self) -> bool {
        self.rows.iter().any(|row| row.runs != Some(0))
    }

    /// Refuses runs of this table with a value of a field above `high`.
    #[must_use]
    pub fn at_most(mut self, field: &str, high: impl Into<f64>) -> Self {
        if let Some(column) = self.record.column_mut(field) {
            column.high = Some(high.into());
        }
        self
    }

    /// Adds a metric, which summarizes fields of the table. Unset properties of the metric come
    /// from the column of its field.
    #[must_use]
    pub fn metric(mut self, mut metric: Metric) -> Self {
        // For several fields, no single column defines the metric.
        if let [(field, _)] = metric.statistic.fields()[..]
            && let Some(column) = self.record.column(field)
        {
            metric.complete(column);
        }
        if metric.title.is_empty() {
            metric.title.clone_from(&metric.name);
        }
        self.metrics.push(metric);
        self
    }

    /// Adds a metric for each field from this one on, in the order of the record. A flag gives the
    /// percentage of runs, named `FIELD_percent`; a number gives the mean. Words and curves give
    /// none.
    ///
    /// ```
    /// use tolman_experiment::{Table, record};
    ///
    /// record! {
    ///     /// One throw.
    ///     struct Throw {
    ///         /// Throws before.
    ///         before: u32 => neither("throws before"),
    ///         /// Whether the dart hit the board.
    ///         hit: bool => higher("hits"),
    ///         /// Distance from the middle, where it hit.
    ///         miss: Option<f64> => lower("miss").unit("cm"),
    ///     }
    /// }
    ///
    /// let table = Table::of::<Throw>("1", "Throws").metrics_from(Throw::hit);
    /// let names: Vec<&str> = table.metrics.iter().map(|metric| metric.name.as_str()).collect();
    /// assert_eq!(names, ["hit_percent", "miss"]);
    /// ```
    #[must_use]
    pub fn metrics_from(self, field: &str) -> Self {
        let columns = self.record.columns().to_vec();
        let shown = columns.iter().skip_while(|column| column.field != field);
        let metrics = shown.filter_map(|Column { field, kind, .. }| match kind {
            Kind::Flag => Some(Metric::percent(format!("{field}_percent"), field)),
            Kind::Count | Kind::Number => Some(Metric::mean(field)),
            Kind::Text | Kind::Curve => None,
        });
        metrics.fold(self, Self::metric)
    }

    /// Sets the number of runs of each of the paper's rows.
    #[must_use]
    pub fn paper_runs(mut self, runs: u32) -> Self {
        self.paper_runs = Some(runs);
        self
    }

    /// Sets the note that explains the values.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// Compares rows pairwise by the Mann–Whitney U test.
    #[must_use]
    pub fn pairwise(mut self, pairwise: Pairwise) -> Self {
        self.pairwise = Some(pairwise);
        self
    }

    /// Compares every other row with the row named `reference` by the Mann–Whitney U test.
    #[must_use]
    pub fn compared_with(mut self, reference: impl Into<String>, correction: Correction) -> Self {
        self.comparison = Some(Comparison {
            reference: reference.into(),
            correction,
        });
        self
    }
}

/// Comparison of the rows of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// Row that all others are compared with.
    pub reference: String,
    /// Correction of p-values for the number of comparisons of one metric.
    pub correction: Correction,
}

/// Correction of p-values for the number of comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correction {
    /// Every p-value times the number of comparisons.
    Bonferroni,
    /// Holm's step-down procedure, which is never weaker than Bonferroni's correction.
    Holm,
}

impl Correction {
    /// Returns the name of the correction's author.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bonferroni => "Bonferroni",
            Self::Holm => "Holm",
        }
    }

    /// Corrects the p-values of all contrasts that are compared together.
    pub(super) fn correct<'a>(self, contrasts: impl Iterator<Item = &'a mut Contrast>) {
        let contrasts: Vec<&mut Contrast> = contrasts.collect();
        let p_values: Vec<PValue> = contrasts.iter().map(|contrast| contrast.p).collect();
        let corrected = match self {
            Self::Bonferroni => tolman_stats::bonferroni(&p_values),
            Self::Holm => tolman_stats::holm(&p_values),
        };
        for (contrast, p) in contrasts.into_iter().zip(corrected) {
            contrast.p = p;
        }
    }
}

/// One row of a table: one brain, one quantizer, one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the row in `summary.json`.
    pub name: String,
    /// Values from the paper, at most one for each metric.
    pub paper: Vec<PaperValue>,
    /// Number of the row's runs; `None` leaves it to the caller.
    pub runs: Option<u32>,
    /// Whether the caller cannot change the number of the row's runs.
    pub(super) is_fixed: bool,
    /// Number of runs of the paper's row; `None` if the table's number holds.
    pub paper_runs: Option<u32>,
    /// Whether the row shows our own system, which may be better than the paper's. Other rows
    /// reproduce the paper.
    pub own: bool,
    /// Missing files that its runs need, and where to get them; `None` if all are here.
    pub missing: Option<String>,
    /// Whether it has no runs of its own, but uses those of all other rows.
    pub(super) is_pooled: bool,
}

impl Row {
    /// Returns a row without values from the paper.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: shown(name),
            paper: Vec::new(),
            runs: None,
            is_fixed: false,
            paper_runs: None,
            own: false,
            missing: None,
            is_pooled: false,
        }
    }

    /// Returns a row that uses the runs of all other rows. A run without a metric's field is left
    /// out.
    pub fn of_all(name: impl Into<String>) -> Self {
        Self {
            is_pooled: true,
            ..Self::new(name).runs(0)
        }
    }

    /// Removes its runs.
    pub(super) fn leave_out(&mut self) {
        self.runs = Some(0);
        self.missing = None;
    }

    /// Adds a value of the paper without a spread: a percentage, a median or a count.
    #[must_use]
    pub fn paper(self, metric: impl Into<String>, value: f64) -> Self {
        self.said(metric.into(), value, None)
    }

    /// Adds a value that the paper gives as mean ± standard deviation.
    #[must_use]
    pub fn paper_mean(self, metric: impl Into<String>, mean: f64, sd: f64) -> Self {
        self.said(metric.into(), mean, Some(sd))
    }

    /// Adds a value of the paper that ours is not compared with, and the reason: a bound, a range,
    /// or a world of another size.
    #[must_use]
    pub fn paper_aside(
        mut self,
        metric: impl Into<String>,
        value: f64,
        why: impl Into<String>,
    ) -> Self {
        self.paper.push(PaperValue {
            metric: metric.into(),
            value,
            sd: None,
            aside: Some(why.into()),
        });
        self
    }

    fn said(mut self, metric: String, value: f64, sd: Option<f64>) -> Self {
        self.paper.push(PaperValue {
            metric,
            value,
            sd,
            aside: None,
        });
        self
    }

    /// Sets the number of runs of the paper's row, if it differs from the table's.
    #[must_use]
    pub fn paper_runs(mut self, runs: u32) -> Self {
        self.paper_runs = Some(runs);
        self
    }

    /// Sets the files that its runs need and that are missing, with their source. Only the paper's
    /// values are then shown.
    #[must_use]
    pub fn missing(mut self, what: impl Into<String>) -> Self {
        self.missing = Some(what.into());
        self.runs(0)
    }

    /// Marks the row as our own system, which may be better than the paper's.
    #[must_use]
    pub fn own(mut self) -> Self {
        self.own = true;
        self
    }

    /// Sets the number of its runs, if it follows from the caller's number.
    #[must_use]
    pub fn runs(mut self, runs: u32) -> Self {
        self.runs = Some(runs);
        self
    }

    /// Sets a fixed number of runs: one for each of `things` on which it is tried, or as many as in
    /// the paper. One run means that nothing is left to chance.
    #[must_use]
    pub fn run_each(mut self, things: u32) -> Self {
        self.is_fixed = true;
        self.runs(things)
    }

    /// Returns whether it leaves nothing to chance: one run tells all.
    pub(super) const fn is_deterministic(&self) -> bool {
        self.is_fixed && matches!(self.runs, Some(1))
    }

    /// Returns the number of its runs if the caller asks for `runs` of each row.
    #[must_use]
    pub fn runs_of(&self, runs: u32) -> u32 {
        self.runs.unwrap_or(runs)
    }

    /// Returns the paper's value of a metric.
    pub fn paper_value(&self, metric: &str) -> Option<&PaperValue> {
        self.paper.iter().find(|value| value.metric == metric)
    }
}

/// The paper's value of one metric in one row.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperValue {
    /// Name of the metric.
    pub metric: String,
    /// Value, in the metric's unit.
    pub value: f64,
    /// Standard deviation, in the metric's unit; `None` if the paper gives none.
    pub sd: Option<f64>,
    /// Reason why our value is not compared with the paper's; `None` if the two are compared.
    pub aside: Option<String>,
}

/// One measured quantity: how the runs of a row give one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// Name of the metric in `summary.json`, such as `success_percent`.
    pub name: String,
    /// Title of the metric on a page, such as `success`; empty to take the column's.
    pub title: String,
    /// Unit of the metric's values, shown after the title; empty if there is none.
    pub unit: String,
    /// Statistic by which the runs are summarized.
    pub statistic: Statistic,
    /// Direction in which the metric's values are better; `None` to take the column's.
    pub better: Option<Better>,
    /// Definition of the metric, in a sentence.
    pub definition: String,
    /// Number of decimals shown; `None` for the column's, or else two.
    pub decimals: Option<u8>,
    /// Tolerance between our value and the paper's.
    pub tolerance: Option<Tolerance>,
}

impl Metric {
    fn new(name: impl Into<String>, statistic: Statistic) -> Self {
        Self {
            name: name.into(),
            title: String::new(),
            unit: String::new(),
            statistic,
            better: None,
            definition: String::new(),
            decimals: None,
            tolerance: None,
        }
    }

    /// Takes unset properties of the metric from its column.
    fn complete(&mut self, column: &Column) {
        self.better = self.better.or(Some(column.better));
        if self.definition.is_empty() {
            self.definition.clone_from(&column.definition);
        }
        // A multiple of another row's value has its own title and unit.
        if matches!(self.statistic, Statistic::Multiple { .. }) {
            return;
        }
        if self.title.is_empty() {
            self.title.clone_from(&column.title);
        }
        if self.unit.is_empty() {
            self.unit.clone_from(&column.unit);
        }
        self.decimals = self.decimals.or(column.decimals);
        self.tolerance = self.tolerance.or(column.tolerance);
    }

    /// Returns the definition and the better direction in words.
    pub fn explanation(&self) -> String {
        let better = self.better.unwrap_or_default().sentence();
        let sentences = [self.definition.as_str(), better];
        let told: Vec<&str> = sentences.into_iter().filter(|s| !s.is_empty()).collect();
        told.join(" ")
    }

    /// Returns a difference of two values, with its unit.
    pub(super) fn difference(&self, by: f64) -> String {
        let by = format!("{by:.0$}", self.places());
        match self.unit.as_str() {
            unit if unit.is_empty() || unit.starts_with("of ") => by,
            unit => format!("{by} {unit}"),
        }
    }

    /// Returns the number of decimals shown.
    pub(super) fn places(&self) -> usize {
        usize::from(self.decimals.unwrap_or(2))
    }

    /// Returns the mean of the numeric field that has the metric's name.
    pub fn mean(name: impl Into<String>) -> Self {
        let field = name.into();
        Self::new(field.clone(), Statistic::Of(Centre::Mean, field))
    }

    /// Returns the median of a numeric field by definition R-7. Its interval is that of order
    /// statistics.
    pub fn median(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Of(Centre::Median, field.into()))
    }

    /// Returns the quantile of a numeric field below which `share` of the runs are, 0 … 1, by
    /// definition R-7.
    pub fn quantile(name: impl Into<String>, field: impl Into<String>, share: f64) -> Self {
        Self::new(name, Statistic::Of(Centre::Quantile(share), field.into()))
    }

    /// Returns the minimum of a numeric field.
    pub fn least(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Of(Centre::Least, field.into()))
    }

    /// Returns the maximum of a numeric field.
    pub fn greatest(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Of(Centre::Greatest, field.into()))
    }

    /// Returns the sum over all runs of the numeric field that has the metric's name.
    pub fn total(name: impl Into<String>) -> Self {
        let field = name.into();
        Self::new(field.clone(), Statistic::Of(Centre::Total, field)).decimals(0)
    }

    /// Returns the percentage of runs in which the flag named `field` is set.
    pub fn percent(name: impl Into<String>, field: impl Into<String>) -> Self {
        let metric = Self::new(name, Statistic::Percent(field.into()));
        metric.unit("%").decimals(1)
    }

    /// Returns the number of runs out of `whole` in which the flag named `field` is set, for a
    /// paper that made `whole` runs. It is `whole` × the share of our runs.
    ///
    /// ```
    /// use tolman_experiment::{Metric, Statistic};
    ///
    /// // The paper converged in 20 of 20 runs; of our 1000, 990 make 19.8 of 20.
    /// let metric = Metric::count_of("five_of_twenty", "found_five", 20).titled("five found");
    /// assert_eq!(metric.unit, "of 20");
    /// # assert!(matches!(metric.statistic, Statistic::Count { whole: 20, .. }));
    /// ```
    pub fn count_of(name: impl Into<String>, field: impl Into<String>, whole: u32) -> Self {
        let field = field.into();
        let metric = Self::new(name, Statistic::Count { field, whole });
        metric.unit(format!("of {whole}")).decimals(1)
    }

    /// Returns the sum of one numeric field over all runs divided by the sum of another.
    pub fn ratio(
        name: impl Into<String>,
        over: impl Into<String>,
        under: impl Into<String>,
    ) -> Self {
        let (over, under) = (over.into(), under.into());
        Self::new(name, Statistic::Ratio { over, under })
    }

    /// Returns the standard deviation of one numeric field over all runs divided by that of
    /// another.
    pub fn ratio_of_spreads(
        name: impl Into<String>,
        over: impl Into<String>,
        under: impl Into<String>,
    ) -> Self {
        let (over, under) = (over.into(), under.into());
        Self::new(name, Statistic::RatioOfSpreads { over, under })
    }

    /// Returns the ratio of two sums of a numeric field. The first is over all runs, the second
    /// over the runs with the same indices in the row named `of`.
    pub fn multiple(
        name: impl Into<String>,
        field: impl Into<String>,
        of: impl Into<String>,
    ) -> Self {
        let (field, of) = (field.into(), of.into());
        Self::new(name, Statistic::Multiple { field, of })
    }

    /// Returns the Brier skill of forecasts (Brier 1950): 1 − the mean of `error` over the variance
    /// of the flag `outcome`.
    ///
    /// The field `error` is the squared error of each forecast. A skill of 1 means always right, 0
    /// as good as always forecasting the share of set flags, and below 0 worse. A row in which the
    /// flag is always the same has no value.
    pub fn skill(
        name: impl Into<String>,
        error: impl Into<String>,
        outcome: impl Into<String>,
    ) -> Self {
        let (error, outcome) = (error.into(), outcome.into());
        Self::new(name, Statistic::Skill { error, outcome }).better(Better::Higher)
    }

    /// Returns the time at which the mean of the runs' curves settles.
    pub fn settling(name: impl Into<String>, settling: Settling) -> Self {
        let metric = Self::new(name, Statistic::Settling(settling));
        metric.decimals(0).better(Better::Lower)
    }

    /// Sets the name in `summary.json`, for several metrics of one field.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Sets the name shown on a page.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Sets the unit, which is shown after the title.
    #[must_use]
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// Sets the better direction.
    #[must_use]
    pub const fn better(mut self, better: Better) -> Self {
        self.better = Some(better);
        self
    }

    /// Sets the definition, a sentence.
    #[must_use]
    pub fn defined(mut self, definition: impl Into<String>) -> Self {
        self.definition = definition.into();
        self
    }

    /// Sets the number of decimals.
    #[must_use]
    pub const fn decimals(mut self, decimals: u8) -> Self {
        self.decimals = Some(decimals);
        self
    }

    /// Sets the maximum difference between our value and the paper's.
    #[must_use]
    pub fn tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = Some(tolerance);
        self
    }
}

/// Statistic that turns the runs of a row into one value. Runs without the field are left out.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Statistic {
    /// 100 × the share of runs whose flag is set, a field of [`Kind::Flag`](crate::Kind::Flag).
    Percent(String),
    /// A statistic of a numeric field.
    Of(Centre, String),
    /// `whole` × the share of runs whose flag is set.
    Count {
        /// Name of a field of [`Kind::Flag`](crate::Kind::Flag).
        field: String,
        /// Number of runs that the paper made.
        whole: u32,
    },
    /// The ratio of the sums of two numeric fields.
    Ratio {
        /// Name of the numeric field of the numerator.
        over: String,
        /// Name of the numeric field of the denominator.
        under: String,
    },
    /// The ratio of two standard deviations, without interval.
    RatioOfSpreads {
        /// Name of the numeric field of the numerator.
        over: String,
        /// Name of the numeric field of the denominator.
        under: String,
    },
    /// The ratio of a sum to that of another row, over the run indices that both have.
    Multiple {
        /// Name of a numeric field.
        field: String,
        /// Name of the other row.
        of: String,
    },
    /// Skill of forecasts over the base rate, without interval; see [`Metric::skill`].
    Skill {
        /// Name of the numeric field of the squared errors.
        error: String,
        /// Name of the flag that was forecast.
        outcome: String,
    },
    /// Time at which the mean of curves settles; see [`Settling`].
    Settling(Settling),
}

/// Statistic that turns the numbers of a row's runs into one value. Only the first two have
/// intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Centre {
    /// The mean.
    Mean,
    /// The median.
    Median,
    /// The quantile below which this share of the runs is, 0 … 1.
    Quantile(f64),
    /// The minimum.
    Least,
    /// The maximum.
    Greatest,
    /// The sum.
    Total,
}

impl Statistic {
    /// Returns the fields that the statistic reads, each with the types that it may have.
    pub(super) fn fields(&self) -> Vec<(&str, &'static [Kind])> {
        const FLAG: &[Kind] = &[Kind::Flag];
        const NUMERIC: &[Kind] = &[Kind::Count, Kind::Number];
        match self {
            Self::Percent(field) | Self::Count { field, .. } => vec![(field, FLAG)],
            Self::Of(_, field) | Self::Multiple { field, .. } => vec![(field, NUMERIC)],
            Self::Ratio { over, under } | Self::RatioOfSpreads { over, under } => {
                vec![(over, NUMERIC), (under, NUMERIC)]
            }
            Self::Skill { error, outcome } => vec![(error, NUMERIC), (outcome, FLAG)],
            Self::Settling(Settling {
                curve,
                level,
                scale,
                ..
            }) => vec![(curve, &[Kind::Curve]), (level, NUMERIC), (scale, NUMERIC)],
        }
    }

    /// Returns the name of the other row whose runs the statistic needs, or `None`.
    pub(super) fn other_row(&self) -> Option<&String> {
        match self {
            Self::Multiple { of, .. } | Self::Settling(Settling { of, .. }) => Some(of),
            _ => None,
        }
    }
}

/// Tolerance within which our value matches the paper's. A quantity has one tolerance in all
/// tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Maximum difference between our value and the paper's.
    pub within: Within,
    /// Reason for the tolerance's size, a sentence without full stop.
    pub reason: &'static str,
}

/// Size of a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Within {
    /// This difference, in the metric's unit.
    Absolute(f64),
    /// This share of the paper's value: 0.35 is ± 35 %.
    Relative(f64),
    /// This factor, at least 1: 1.5 is from two thirds of the paper's value to one and a half times
    /// that value.
    Factor(f64),
}

/// `±15`, `±35%` or `×1.5`.
impl fmt::Display for Within {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Absolute(by) => write!(f, "±{by}"),
            Self::Relative(share) => write!(f, "±{:.0}%", 100.0 * share),
            Self::Factor(factor) => write!(f, "×{factor}"),
        }
    }
}

impl Tolerance {
    /// Returns a tolerance of `by`, in the metric's unit.
    #[must_use]
    pub const fn absolute(by: f64, reason: &'static str) -> Self {
        let within = Within::Absolute(by);
        Self { within, reason }
    }

    /// Returns a tolerance of `share` times the paper's value.
    #[must_use]
    pub const fn relative(share: f64, reason: &'static str) -> Self {
        let within = Within::Relative(share);
        Self { within, reason }
    }

    /// Returns a tolerance of this factor, at least 1.
    #[must_use]
    pub const fn factor(factor: f64, reason: &'static str) -> Self {
        let within = Within::Factor(factor);
        Self { within, reason }
    }
}
