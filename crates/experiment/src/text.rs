//! Tables as text for a terminal, ours beside the paper's.

use core::fmt::Write;

use super::{
    Analysis, Finding, Measured, Metric, MetricAnalysis, Reached, Statistic, TableAnalysis,
};

/// Whether text is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// Plain text.
    Plain,
    /// ANSI colours.
    Coloured,
}

/// All tables of an analysis, each with a line end. Behind a value of ours stands `=` where it
/// matches the paper's, `!` where it differs, `+` where it is better and `?` where nobody can tell,
/// and how much of a difference could have been seen. The last line counts them.
pub fn tables_as_text(analysis: &Analysis, ink: Ink) -> String {
    let mut text = String::new();
    for table in &analysis.tables {
        if !text.is_empty() {
            text.push('\n');
        }
        text += &table_as_text(table, ink);
    }
    let tally = analysis.tally();
    if tally.all() > 0 {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\nOf the paper's values {tally}.");
    }
    text
}

/// A value in the form of papers: `73.16 ± 70.23`, `68.0`.
pub(crate) fn value_with_spread(metric: &Metric, value: f64, sd: Option<f64>) -> String {
    let decimals = metric.places();
    match sd {
        Some(sd) => format!("{value:.decimals$} ± {sd:.decimals$}"),
        None => format!("{value:.decimals$}"),
    }
}

/// Our value: a mean with its spread, anything else alone; what was not reached as `> 2000`.
pub(crate) fn ours(metric: &Metric, measured: &Measured) -> String {
    let sd = match metric.statistic {
        Statistic::Mean(_) => measured.sd,
        _ => None,
    };
    let value = value_with_spread(metric, measured.value, sd);
    match measured.reached {
        Reached::Yes if measured.n == 0 => "–".to_owned(),
        Reached::Yes => value,
        Reached::No => format!("> {value}"),
    }
}

/// A metric's title and unit.
pub(crate) fn heading(metric: &Metric) -> String {
    match metric.unit.as_str() {
        "" => metric.title.clone(),
        unit if unit.starts_with("of ") => format!("{} {unit}", metric.title),
        "%" => format!("{} %", metric.title),
        unit => format!("{} ({unit})", metric.title),
    }
}

fn table_as_text(analysis: &TableAnalysis, ink: Ink) -> String {
    let table = &analysis.table;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{}",
        painted(&format!("Table {}  {}", table.name, table.title), "1", ink)
    );
    let names = table
        .rows
        .iter()
        .map(|row| row.name.chars().count())
        .max()
        .unwrap_or(0);
    let columns: Vec<Column<'_>> = analysis.metrics.iter().map(Column::new).collect();

    let mut heads = " ".repeat(names);
    let mut subheads = heads.clone();
    for column in &columns {
        let width = column.paper.map_or(0, |paper| paper + 2) + column.ours + 2 + column.seen;
        let _ = write!(heads, "   {:<width$}", column.heading);
        let _ = match column.paper {
            Some(paper) => write!(subheads, "   {:>paper$}  ", "paper"),
            None => write!(subheads, "   "),
        };
        let (ours, seen) = (column.ours, column.seen);
        let _ = write!(subheads, "{:>ours$}  {:seen$}", "ours", "");
    }
    let _ = writeln!(text, "{}\n{}", heads.trim_end(), subheads.trim_end());

    for row in &table.rows {
        let mut line = format!("{:<names$}", row.name);
        for column in &columns {
            let measured = column
                .metric
                .rows
                .iter()
                .find(|measured| measured.row == row.name);
            let (paper, ours) =
                measured.map_or_else(Default::default, |m| cells(&column.metric.metric, m));
            let _ = match column.paper {
                Some(width) => write!(line, "   {paper:>width$}  "),
                None => write!(line, "   "),
            };
            let _ = write!(line, "{ours:>0$} ", column.ours);
            line += &mark(measured, ink);
            let seen = measured.and_then(|measured| seen(&column.metric.metric, measured));
            let _ = write!(line, "{:<1$}", seen.unwrap_or_default(), column.seen);
        }
        let _ = writeln!(text, "{}", line.trim_end());
    }
    for missing in table.missing() {
        let _ = writeln!(text, "{missing}");
    }
    for pair in &analysis.pairs {
        let paper = pair
            .paper
            .map_or_else(String::new, |p| format!(", paper {p}"));
        let _ = writeln!(text, "p = {} for {}{paper}", pair.contrast.p, pair.name());
    }
    text
}

/// The columns of one metric.
struct Column<'a> {
    metric: &'a MetricAnalysis,
    heading: String,
    /// The width of the paper's values, if there are any.
    paper: Option<usize>,
    ours: usize,
    /// The width of how much of a difference could have been seen.
    seen: usize,
}

impl<'a> Column<'a> {
    fn new(metric: &'a MetricAnalysis) -> Self {
        let heading = heading(&metric.metric);
        let cells: Vec<_> = metric
            .rows
            .iter()
            .map(|row| cells(&metric.metric, row))
            .collect();
        let widest = |texts: Vec<&String>| texts.iter().map(|text| text.chars().count()).max();
        let of_paper = metric.rows.iter().any(|row| row.paper.is_some());
        let paper = of_paper.then(|| {
            let widest = widest(cells.iter().map(|cell| &cell.0).collect());
            widest.unwrap_or(0).max("paper".len())
        });
        let ours = widest(cells.iter().map(|cell| &cell.1).collect())
            .unwrap_or(0)
            .max(4);
        let seen = metric
            .rows
            .iter()
            .filter_map(|row| seen(&metric.metric, row));
        let seen = seen.map(|text| text.chars().count()).max().unwrap_or(0);
        // A long heading widens the last column.
        let before = paper.map_or(0, |paper| paper + 2) + seen;
        let ours = ours.max(heading.chars().count().saturating_sub(before + 2));
        Self {
            metric,
            heading,
            paper,
            ours,
            seen,
        }
    }
}

/// How much of a difference could have been seen, as ` ± 12.3`; `None` where nobody can say.
pub(crate) fn seen(metric: &Metric, measured: &Measured) -> Option<String> {
    let resolution = measured.verdict.as_ref()?.resolution()?;
    let decimals = metric.places();
    Some(format!(" ±{resolution:.decimals$}"))
}

fn cells(metric: &Metric, measured: &Measured) -> (String, String) {
    let paper = measured.paper.as_ref();
    (
        paper.map_or_else(
            || "–".into(),
            |paper| value_with_spread(metric, paper.value, paper.sd),
        ),
        ours(metric, measured),
    )
}

fn mark(measured: Option<&Measured>, ink: Ink) -> String {
    let verdict = measured.and_then(|measured| measured.verdict.as_ref());
    let (mark, colour) = match verdict.map(|verdict| &verdict.finding) {
        None => return " ".into(),
        Some(Finding::Matches) => ("=", "32"),
        Some(Finding::Better) => ("+", "32"),
        Some(Finding::Differs) => ("!", "31"),
        Some(Finding::CannotTell(_)) => ("?", "33"),
    };
    painted(mark, colour, ink)
}

fn painted(text: &str, code: &str, ink: Ink) -> String {
    match ink {
        Ink::Plain => text.to_owned(),
        Ink::Coloured => format!("\u{1b}[{code}m{text}\u{1b}[0m"),
    }
}
