//! Tables as text for a terminal, ours beside the paper's.

use core::fmt::Write;

use super::{
    Analysis, Centre, Finding, Measured, Metric, MetricAnalysis, Reached, Statistic, TableAnalysis,
    Tolerance, Verdict,
};

/// Whether text is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// Text without colours.
    Plain,
    /// Text with ANSI colours.
    Coloured,
}

/// Maximum width of a line, columns.
const WIDTH: usize = 80;

/// Maximum width for the names of rows; a longer name has a line of its own.
const NAMES: usize = 28;

/// Returns all tables of an analysis as lines of at most 80 columns.
///
/// After each of our values comes the verdict in words, with the tolerance and the smallest
/// difference that could have been detected, or the number of the reason why it cannot be told. The
/// reasons are below the table, the reasons for the tolerances below all tables. The last line
/// counts the verdicts.
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
        text += &tolerances(analysis);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\nOf the paper's values {tally}.");
    }
    text
}

/// Explanation of the text after a verdict.
const BESIDE: &str = "Beside a verdict: the tolerance, and in brackets the smallest difference from the paper that \
                      could have been seen.";

/// Returns the tolerances with the metrics that have them, and their reasons; empty if no value was
/// judged.
fn tolerances(analysis: &Analysis) -> String {
    let mut told: Vec<(Tolerance, Vec<String>)> = Vec::new();
    for (_, metric, measured) in analysis.values() {
        let seen = measured
            .verdict
            .as_ref()
            .and_then(|verdict| verdict.resolution);
        let Some((tolerance, _)) = metric.tolerance.zip(seen) else {
            continue;
        };
        let place = told.iter().position(|(known, _)| *known == tolerance);
        let place = place.unwrap_or_else(|| {
            told.push((tolerance, Vec::new()));
            told.len() - 1
        });
        let title = heading(metric);
        if !told[place].1.contains(&title) {
            told[place].1.push(title);
        }
    }
    if told.is_empty() {
        return String::new();
    }
    let told = told.iter().map(|(tolerance, titles)| {
        let Tolerance { within, reason } = tolerance;
        format!("{within} for {}: {reason}.", titles.join(", "))
    });
    let lines = core::iter::once(BESIDE.to_owned()).chain(told);
    lines.fold("\n".to_owned(), |text, line| {
        text + &wrapped(&line, WIDTH).join("\n") + "\n"
    })
}

/// Returns the words of a text in lines of at most `width` columns; a longer word has a line of its
/// own.
#[must_use]
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                *line += " ";
                *line += word;
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Returns a value in the form of papers: `73.16 ± 70.23`, `68.0`.
pub(crate) fn value_with_spread(metric: &Metric, value: f64, sd: Option<f64>) -> String {
    let decimals = metric.places();
    match sd {
        Some(sd) => format!("{value:.decimals$} ± {sd:.decimals$}"),
        None => format!("{value:.decimals$}"),
    }
}

/// Returns our value: a mean with its spread, any other value alone, and a lower bound as `> 2000`.
pub(crate) fn ours(metric: &Metric, measured: &Measured) -> String {
    let sd = match metric.statistic {
        Statistic::Of(Centre::Mean, _) => measured.sd,
        _ => None,
    };
    let value = value_with_spread(metric, measured.value, sd);
    match measured.reached {
        Reached::Yes if measured.n == 0 => "–".to_owned(),
        Reached::Yes => value,
        Reached::No => format!("> {value}"),
    }
}

/// Returns a metric's title and unit.
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
    for line in wrapped(&format!("Table {}: {}", table.name, table.title), WIDTH) {
        text += &painted(&line, "1", ink);
        text.push('\n');
    }
    let lengths = table.rows.iter().map(|row| row.name.chars().count());
    let names = lengths.filter(|&length| length <= NAMES).max().unwrap_or(0);
    let doubts = doubts(analysis);
    let columns = analysis.metrics.iter();
    let columns: Vec<Column<'_>> = columns.map(|one| Column::new(one, &doubts)).collect();
    let mut left = &columns[..];
    while !left.is_empty() {
        let mut room = WIDTH - names;
        let fits = left.iter().take_while(|column| {
            let fits = GAP.len() + column.width() <= room;
            room = room.saturating_sub(GAP.len() + column.width());
            fits
        });
        let (block, rest) = left.split_at(fits.count().max(1));
        text += &block_as_text(analysis, names, block, &doubts, ink);
        left = rest;
    }
    let pairs = analysis.pairs.iter().map(|pair| {
        let paper = pair.paper.zip(pair.verdict.as_ref());
        let paper = paper.map_or_else(String::new, |(p, verdict)| {
            format!(
                ", paper {p}: {}{}",
                verdict.finding.word(),
                doubt_number(verdict, &doubts)
            )
        });
        format!("p = {} for {}{paper}", pair.contrast.p, pair.name())
    });
    let missing = table.missing().into_iter().map(str::to_owned);
    let missing = missing.filter(|missing| !doubts.contains(missing));
    let numbered = (1..).zip(&doubts);
    let numbered = numbered.map(|(number, doubt)| format!("[{number}] {doubt}"));
    let lines = pairs.chain(missing).chain(numbered);
    for line in lines.flat_map(|line| wrapped(&line, WIDTH)) {
        text += &line;
        text.push('\n');
    }
    text
}

/// Returns the reasons why values of the table cannot be judged, each once.
fn doubts(analysis: &TableAnalysis) -> Vec<String> {
    let mut doubts = Vec::new();
    for doubt in analysis.verdicts().filter_map(|one| one.finding.doubt()) {
        let doubt = doubt.to_string();
        if !doubts.contains(&doubt) {
            doubts.push(doubt);
        }
    }
    doubts
}

/// Gap between two columns.
const GAP: &str = "   ";

/// Writes the rows of a table below as many metrics as fit side by side.
fn block_as_text(
    analysis: &TableAnalysis,
    names: usize,
    columns: &[Column<'_>],
    doubts: &[String],
    ink: Ink,
) -> String {
    let mut lines: Vec<String> = Vec::new();
    let heads = columns.iter().map(|column| column.heading.len());
    let heads = heads.max().unwrap_or(0);
    for at in 0..heads {
        let mut line = " ".repeat(names);
        for column in columns {
            // The last line of every heading is directly above its values.
            let place = (at + column.heading.len()).checked_sub(heads);
            let head = place.map_or("", |place| &column.heading[place]);
            line += &format!("{GAP}{head:<0$}", column.width());
        }
        lines.push(line);
    }
    let mut line = " ".repeat(names);
    for column in columns {
        line += &column.line("paper", "ours", "", "");
    }
    lines.push(line);
    for row in &analysis.table.rows {
        let mut line = format!("{:<names$}", row.name);
        if row.name.chars().count() > names {
            lines.extend(wrapped(&row.name, WIDTH));
            line = " ".repeat(names);
        }
        for column in columns {
            let mut rows = column.metric.rows.iter();
            let measured = rows.find(|measured| measured.row == row.name);
            let (paper, ours) =
                measured.map_or_else(Default::default, |m| cells(&column.metric.metric, m));
            let verdict = verdict(&column.metric.metric, measured, doubts);
            let painted = told(&verdict, measured, ink);
            line += &column.line(&paper, &ours, &verdict, &painted);
        }
        lines.push(line);
    }
    let lines = lines.iter().map(|line| line.trim_end());
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The columns of one metric.
struct Column<'a> {
    metric: &'a MetricAnalysis,
    /// Title of the metric, line by line.
    heading: Vec<String>,
    /// Width of the paper's values, columns; `None` if there are none.
    paper: Option<usize>,
    ours: usize,
    /// Width of the verdicts, columns; 0 if there are none.
    verdict: usize,
}

impl<'a> Column<'a> {
    fn new(metric: &'a MetricAnalysis, doubts: &[String]) -> Self {
        let width = |text: String| text.chars().count();
        let rows = || metric.rows.iter();
        let cells = || rows().map(|row| cells(&metric.metric, row));
        let of_paper = rows().any(|row| row.paper.is_some());
        let paper = cells().map(|cell| width(cell.0)).max().unwrap_or(0);
        let ours = cells().map(|cell| width(cell.1)).max().unwrap_or(0);
        let verdicts = rows().map(|row| width(verdict(&metric.metric, Some(row), doubts)));
        let mut column = Self {
            metric,
            heading: Vec::new(),
            paper: of_paper.then_some(paper.max("paper".len())),
            ours: ours.max("ours".len()),
            verdict: verdicts.max().unwrap_or(0),
        };
        column.heading = wrapped(&heading(&metric.metric), column.width().max(HEADING));
        // A long heading widens its values.
        let head = column.heading.iter().map(|line| line.chars().count()).max();
        column.ours += head.unwrap_or(0).saturating_sub(column.width());
        column
    }

    fn width(&self) -> usize {
        let apart = |width: usize| if width > 0 { width + 1 } else { 0 };
        self.paper.map_or(0, |paper| paper + 2) + self.ours + apart(self.verdict)
    }

    /// Returns a line of the metric's columns, with the gap before it. `verdict` gives the width,
    /// `painted` the coloured text of the verdict.
    fn line(&self, paper: &str, ours: &str, verdict: &str, painted: &str) -> String {
        let paper = match self.paper {
            Some(width) => format!("{paper:>width$}  "),
            None => String::new(),
        };
        let ours = format!("{ours:>0$}", self.ours);
        if self.verdict == 0 {
            return format!("{GAP}{paper}{ours}");
        }
        let rest = " ".repeat(self.verdict.saturating_sub(verdict.chars().count()));
        format!("{GAP}{paper}{ours} {painted}{rest}")
    }
}

/// Maximum width of a heading's line, columns.
const HEADING: usize = 14;

/// Returns the verdict in words with the tolerance, the smallest detectable difference and the
/// number of the reason why it cannot be told: `close ±15 (3.1)`, `cannot tell (20.3) [1]`. Empty
/// without a verdict.
fn verdict(metric: &Metric, measured: Option<&Measured>, doubts: &[String]) -> String {
    let Some(verdict) = measured.and_then(|measured| measured.verdict.as_ref()) else {
        return String::new();
    };
    let tolerance = metric
        .tolerance
        .filter(|_| verdict.finding.doubt().is_none());
    let tolerance = tolerance.map_or_else(String::new, |one| format!(" {}", one.within));
    let resolution = verdict.resolution;
    let resolution =
        resolution.map_or_else(String::new, |by| format!(" ({by:.0$})", metric.places()));
    let doubt = doubt_number(verdict, doubts);
    format!("{}{tolerance}{resolution}{doubt}", verdict.finding.word())
}

/// Returns the number of the reason why a value cannot be judged, as ` [1]`; empty if it can.
fn doubt_number(verdict: &Verdict, doubts: &[String]) -> String {
    let doubt = verdict.finding.doubt().map(ToString::to_string);
    let place = doubt.and_then(|doubt| doubts.iter().position(|known| *known == doubt));
    place.map_or_else(String::new, |place| format!(" [{}]", place + 1))
}

/// Returns the text of a verdict in its colour.
fn told(text: &str, measured: Option<&Measured>, ink: Ink) -> String {
    let verdict = measured.and_then(|measured| measured.verdict.as_ref());
    let colour = match verdict.map(|verdict| &verdict.finding) {
        None => return text.to_owned(),
        Some(Finding::Matches | Finding::Close | Finding::Better) => "32",
        Some(Finding::Differs) => "31",
        Some(Finding::CannotTell(_)) => "33",
    };
    painted(text, colour, ink)
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

fn painted(text: &str, code: &str, ink: Ink) -> String {
    match ink {
        Ink::Plain => text.to_owned(),
        Ink::Coloured => format!("\u{1b}[{code}m{text}\u{1b}[0m"),
    }
}
