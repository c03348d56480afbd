//! Tables: rows, the metrics that summarize their runs, and the paper's values.

use super::{Better, Column, Contrast, Kind, Pairwise, Record, RecordType, Settling};
use tolman_stats::PValue;

/// One table of a paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The name it has in `summary.json`, such as `2 (J)`.
    pub name: String,
    /// Title in words.
    pub title: String,
    /// The rows, in the order they are shown.
    pub rows: Vec<Row>,
    /// Record of its runs. A run with other fields is not a run of this table.
    pub record: RecordType,
    /// Metrics of every row, in the order they are shown.
    pub metrics: Vec<Metric>,
    /// Number of runs of each of the paper's rows, if it says so.
    pub paper_runs: Option<u32>,
    /// Comparison of the rows with each other; `None` compares none.
    pub comparison: Option<Comparison>,
    /// Rows that are compared pairwise; `None` compares none.
    pub pairwise: Option<Pairwise>,
    /// Note that a reader needs to read the values, such as how runs without success count; empty
    /// for none.
    pub note: String,
}

impl Table {
    /// Returns an empty table whose runs measure a `T`.
    pub fn of<T: Record>(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
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

    /// Adds rows.
    #[must_use]
    pub fn rows(mut self, rows: impl IntoIterator<Item = Row>) -> Self {
        self.rows.extend(rows);
        self
    }

    /// Returns whether it is shown: a row has runs, or would have if its files were here.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.is_filled() || self.rows.iter().any(|row| row.missing.is_some())
    }

    /// Returns which files are not here that its rows need, each once.
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

    /// Returns whether every row with runs has a number of its own.
    pub(super) fn is_fixed(&self) -> bool {
        let mut rows = self.rows.iter().filter(|row| row.runs != Some(0));
        self.is_filled() && rows.all(|row| row.is_fixed)
    }

    /// Returns whether a row has runs.
    #[must_use]
    pub fn is_filled(&self) -> bool {
        self.rows.iter().any(|row| row.runs != Some(0))
    }

    /// Refuses runs of this table with more than `high` of a field.
    #[must_use]
    pub fn at_most(mut self, field: &str, high: impl Into<f64>) -> Self {
        if let Some(column) = self.record.column_mut(field) {
            column.high = Some(high.into());
        }
        self
    }

    /// Adds a metric, which summarizes fields of the table. What it does not say of itself it takes
    /// from the column of its field.
    #[must_use]
    pub fn metric(mut self, mut metric: Metric) -> Self {
        // Of several fields no column says what is measured.
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

    /// Adds a metric for each field from this one on, in the order of the record: of a flag the
    /// percentage of runs, named `FIELD_percent`, of a number the mean. Words and curves have none.
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

    /// Says how many runs each of the paper's rows has.
    #[must_use]
    pub fn paper_runs(mut self, runs: u32) -> Self {
        self.paper_runs = Some(runs);
        self
    }

    /// Says what a reader must know to read the values.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// Compares rows each with each by Mann–Whitney's U.
    #[must_use]
    pub fn pairwise(mut self, pairwise: Pairwise) -> Self {
        self.pairwise = Some(pairwise);
        self
    }

    /// Compares every other row with the row named `reference` by Mann–Whitney's U.
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
    /// The row all others are compared with.
    pub reference: String,
    /// Correction of p-values for the number of comparisons in one metric.
    pub correction: Correction,
}

/// Correction of p-values for the number of comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correction {
    /// Every p-value times the number of comparisons.
    Bonferroni,
    /// Holm's step-down procedure: never weaker than Bonferroni's.
    Holm,
}

impl Correction {
    /// Returns the name of its author.
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
    /// The name it has in `summary.json`.
    pub name: String,
    /// The paper's values, at most one for each metric.
    pub paper: Vec<PaperValue>,
    /// Number of its runs, whatever the caller asks for, for deterministic rows: one for each case.
    /// `None` leaves it to the caller.
    pub runs: Option<u32>,
    /// Whether no caller changes the number of its runs.
    pub(super) is_fixed: bool,
    /// Number of runs of the paper's row, if it differs from the table's.
    pub paper_runs: Option<u32>,
    /// Whether it is a system of our own, which may be better than what the paper has; others
    /// reproduce the paper.
    pub own: bool,
    /// Missing files that its runs need, and where they come from; `None` if all is here.
    pub missing: Option<String>,
    /// Whether it has no runs of its own, but those of all other rows.
    pub(super) is_pooled: bool,
}

impl Row {
    /// Returns a row of which the paper says nothing.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            paper: Vec::new(),
            runs: None,
            is_fixed: false,
            paper_runs: None,
            own: false,
            missing: None,
            is_pooled: false,
        }
    }

    /// Returns a row of the runs of all other rows. A run without a metric's field is left out.
    pub fn of_all(name: impl Into<String>) -> Self {
        Self {
            is_pooled: true,
            ..Self::new(name).runs(0)
        }
    }

    /// Leaves it without runs.
    pub(super) fn leave_out(&mut self) {
        self.runs = Some(0);
        self.missing = None;
    }

    /// Adds a value of the paper that stands without a spread: a percentage, a median, a count.
    #[must_use]
    pub fn paper(self, metric: impl Into<String>, value: f64) -> Self {
        self.said(metric.into(), value, None)
    }

    /// Adds a value of the paper given as mean ± standard deviation.
    #[must_use]
    pub fn paper_mean(self, metric: impl Into<String>, mean: f64, sd: f64) -> Self {
        self.said(metric.into(), mean, Some(sd))
    }

    /// Adds a number of the paper that ours is not judged by, with the reason: a bound, a range, a
    /// world of another size.
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

    /// Says of how many runs the paper's values are, if of another number than the table's.
    #[must_use]
    pub fn paper_runs(mut self, runs: u32) -> Self {
        self.paper_runs = Some(runs);
        self
    }

    /// Says which files its runs need that are not here, and where they come from. It stands with
    /// the paper's values alone.
    #[must_use]
    pub fn missing(mut self, what: impl Into<String>) -> Self {
        self.missing = Some(what.into());
        self.runs(0)
    }

    /// Says that it is a system of our own, which may be better than what the paper has.
    #[must_use]
    pub fn own(mut self) -> Self {
        self.own = true;
        self
    }

    /// Sets how many runs it has, where that is not what the caller asks of every row but follows
    /// from it.
    #[must_use]
    pub fn runs(mut self, runs: u32) -> Self {
        self.runs = Some(runs);
        self
    }

    /// Gives it a number of runs that no caller changes: one for each of `things` that it is tried
    /// on, or as many as its paper has.
    #[must_use]
    pub fn run_each(mut self, things: u32) -> Self {
        self.is_fixed = true;
        self.runs(things)
    }

    /// Returns how many runs it has where the caller asks for `runs` of each row.
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
    /// The name of the metric.
    pub metric: String,
    /// The value, in the metric's unit.
    pub value: f64,
    /// The standard deviation, where it is given.
    pub sd: Option<f64>,
    /// Reason why ours is not judged by it; `None` if it is.
    pub aside: Option<String>,
}

/// One measured quantity: how the runs of a row become one value.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// The name it has in `summary.json`, such as `success_percent`.
    pub name: String,
    /// The name it has on a page, such as `success`; empty until the table's column says it.
    pub title: String,
    /// The unit, shown behind the title; empty if there is none.
    pub unit: String,
    /// Statistic by which the runs are summarized.
    pub statistic: Statistic,
    /// Direction in which its values are better; `None` until the table's column says it.
    pub better: Option<Better>,
    /// Definition, in a sentence.
    pub definition: String,
    /// Number of decimals shown; `None`: two, unless the column says it.
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

    /// Takes over what the column of its field says, where it says nothing itself.
    fn complete(&mut self, column: &Column) {
        self.better = self.better.or(Some(column.better));
        if self.definition.is_empty() {
            self.definition.clone_from(&column.definition);
        }
        // How many times a row's value is neither titled nor measured as the value is.
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

    /// Returns the definition and which way is better, as a reader is told them.
    pub fn explanation(&self) -> String {
        let better = self.better.unwrap_or_default().sentence();
        let sentences = [self.definition.as_str(), better];
        let told: Vec<&str> = sentences.into_iter().filter(|s| !s.is_empty()).collect();
        told.join(" ")
    }

    /// Returns the number of decimals shown.
    pub(super) fn places(&self) -> usize {
        usize::from(self.decimals.unwrap_or(2))
    }

    /// Returns the mean of the numeric field that bears the metric's name.
    pub fn mean(name: impl Into<String>) -> Self {
        let field = name.into();
        Self::new(field.clone(), Statistic::Mean(field))
    }

    /// Returns the median of a numeric field, by definition R-7; its interval is that of order
    /// statistics.
    pub fn median(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Median(field.into()))
    }

    /// Returns the number of a numeric field below which a share of the runs lies, 0 … 1, by
    /// definition R-7.
    pub fn quantile(name: impl Into<String>, field: impl Into<String>, share: f64) -> Self {
        let field = field.into();
        Self::new(name, Statistic::Quantile { field, share })
    }

    /// Returns the least of a numeric field.
    pub fn least(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Least(field.into()))
    }

    /// Returns the greatest of a numeric field.
    pub fn greatest(name: impl Into<String>, field: impl Into<String>) -> Self {
        Self::new(name, Statistic::Greatest(field.into()))
    }

    /// Returns the sum over all runs of the numeric field that bears the metric's name.
    pub fn total(name: impl Into<String>) -> Self {
        let field = name.into();
        Self::new(field.clone(), Statistic::Total(field)).decimals(0)
    }

    /// Returns the percentage of runs in which the flag named `field` is set.
    pub fn percent(name: impl Into<String>, field: impl Into<String>) -> Self {
        let metric = Self::new(name, Statistic::Percent(field.into()));
        metric.unit("%").decimals(1)
    }

    /// In how many of `whole` runs the flag named `field` is set, as a paper that made that many
    /// counts them: `whole` × the share of our runs.
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

    /// Returns the sum of a numeric field over all runs divided by its sum over the runs of the row
    /// named `of` that bear the same index: how many times that row's value.
    pub fn multiple(
        name: impl Into<String>,
        field: impl Into<String>,
        of: impl Into<String>,
    ) -> Self {
        let (field, of) = (field.into(), of.into());
        Self::new(name, Statistic::Multiple { field, of })
    }

    /// Returns how much better forecasts are than always telling how often the flag named `outcome`
    /// is set (Brier 1950): 1 − the mean of the field named `error`, which is the squared error of
    /// each forecast, over the variance of the flag. 1 is never wrong, 0 as good as that, below it
    /// worse. No value of a row in which the flag is always the same.
    pub fn skill(
        name: impl Into<String>,
        error: impl Into<String>,
        outcome: impl Into<String>,
    ) -> Self {
        let (error, outcome) = (error.into(), outcome.into());
        Self::new(name, Statistic::Skill { error, outcome }).better(Better::Higher)
    }

    /// Returns when the mean of the runs' curves settles.
    pub fn settling(name: impl Into<String>, settling: Settling) -> Self {
        let metric = Self::new(name, Statistic::Settling(settling));
        metric.decimals(0).better(Better::Lower)
    }

    /// Sets the name in `summary.json`, where several metrics are of one field.
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

    /// Sets the unit.
    #[must_use]
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// Sets which way values are better.
    #[must_use]
    pub const fn better(mut self, better: Better) -> Self {
        self.better = Some(better);
        self
    }

    /// Sets what is measured, in a sentence.
    #[must_use]
    pub fn defined(mut self, definition: impl Into<String>) -> Self {
        self.definition = definition.into();
        self
    }

    /// Sets how many decimals values are shown with.
    #[must_use]
    pub const fn decimals(mut self, decimals: u8) -> Self {
        self.decimals = Some(decimals);
        self
    }

    /// Sets how far our value may lie from the paper's.
    #[must_use]
    pub fn tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = Some(tolerance);
        self
    }
}

/// Statistic by which the runs of a row become one value. A run without the field is left out.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Statistic {
    /// 100 × the share of runs whose flag is set, a field of [`Kind::Flag`](crate::Kind::Flag).
    Percent(String),
    /// The mean of a numeric field.
    Mean(String),
    /// The median of a numeric field.
    Median(String),
    /// A quantile of a numeric field, of which no interval is told.
    Quantile {
        /// A numeric field.
        field: String,
        /// The share of the runs that lie below, 0 … 1.
        share: f64,
    },
    /// The least of a numeric field, of which no interval is told.
    Least(String),
    /// The greatest of a numeric field, of which no interval is told.
    Greatest(String),
    /// The sum of a numeric field, of which no interval is told.
    Total(String),
    /// `whole` × the share of runs whose flag is set.
    Count {
        /// A field of [`Kind::Flag`](crate::Kind::Flag).
        field: String,
        /// Number of runs in which the paper counts.
        whole: u32,
    },
    /// The ratio of two sums.
    Ratio {
        /// The numeric field of the numerator.
        over: String,
        /// The numeric field of the denominator.
        under: String,
    },
    /// The ratio of two standard deviations, of which no interval is told.
    RatioOfSpreads {
        /// The numeric field of the numerator.
        over: String,
        /// The numeric field of the denominator.
        under: String,
    },
    /// The ratio of a sum to that of another row, over the runs that both have.
    Multiple {
        /// A numeric field.
        field: String,
        /// The name of the other row.
        of: String,
    },
    /// Skill of forecasts over the base rate; see [`Metric::skill`]. It has no interval.
    Skill {
        /// The numeric field of the squared errors.
        error: String,
        /// The flag that was forecast.
        outcome: String,
    },
    /// When the mean of curves settles; see [`Settling`].
    Settling(Settling),
}

impl Statistic {
    /// Returns the fields that it is of, each with the kinds that it may have.
    pub(super) fn fields(&self) -> Vec<(&str, &'static [Kind])> {
        const FLAG: &[Kind] = &[Kind::Flag];
        const NUMERIC: &[Kind] = &[Kind::Count, Kind::Number];
        match self {
            Self::Percent(field) | Self::Count { field, .. } => vec![(field, FLAG)],
            Self::Mean(field)
            | Self::Median(field)
            | Self::Least(field)
            | Self::Greatest(field)
            | Self::Total(field)
            | Self::Quantile { field, .. }
            | Self::Multiple { field, .. } => vec![(field, NUMERIC)],
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

    /// Returns the row whose runs it needs beside a row's own.
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
    /// The distance allowed.
    pub within: Within,
    /// Reason it is so much, as a sentence without its full stop.
    pub reason: &'static str,
}

/// The size of a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Within {
    /// By this much, in the metric's unit.
    Absolute(f64),
    /// By this share of the paper's value: 0.35 is ± 35 %.
    Relative(f64),
    /// By this factor, at least 1: 1.5 is from two thirds of the paper's value to one and a half of
    /// it.
    Factor(f64),
}

impl Tolerance {
    /// Returns a tolerance of so much, in the metric's unit.
    #[must_use]
    pub const fn absolute(by: f64, reason: &'static str) -> Self {
        let within = Within::Absolute(by);
        Self { within, reason }
    }

    /// Returns a tolerance of this share of the paper's value.
    #[must_use]
    pub const fn relative(share: f64, reason: &'static str) -> Self {
        let within = Within::Relative(share);
        Self { within, reason }
    }

    /// Returns a tolerance by this factor, at least 1.
    #[must_use]
    pub const fn factor(factor: f64, reason: &'static str) -> Self {
        let within = Within::Factor(factor);
        Self { within, reason }
    }
}
