use std::io::BufRead;
use std::path::Path;

use super::{Line, LogError, LogReport, LogTrouble, NumberedLines, open};
use crate::fields::{Fields, Wrong};
use crate::input::MOST_BYTES;

/// Records of a file with one record per line, and the report on reading it.
pub(crate) type Records<T> = (Vec<T>, LogReport);

/// Reads a file, plain or gzipped, whose lines `parse` understands. `what` names its contents in
/// errors.
///
/// # Errors
/// If there is no such file, or no line can be used.
pub(crate) fn read_records<T>(
    path: &Path,
    what: &str,
    parse: impl Fn(&mut Fields<'_>) -> Result<T, Wrong>,
) -> Result<Records<T>, LogError> {
    let (records, report) = records(open(path, MOST_BYTES)?, parse);
    if report.count(LogTrouble::TooLarge) > 0 {
        return Err(report.nothing(path, "too much text; give it in parts"));
    }
    match records.is_empty() {
        true => Err(report.nothing(path, &format!("no line of `{what}`"))),
        false => Ok((records, report)),
    }
}

/// Reads from `source`. A line that `parse` does not understand is left out and reported. Empty
/// lines and comments are ignored.
pub(crate) fn records<T>(
    source: impl BufRead,
    parse: impl Fn(&mut Fields<'_>) -> Result<T, Wrong>,
) -> Records<T> {
    let (mut records, mut report) = (Vec::new(), LogReport::default());
    let mut lines = NumberedLines::new(source);
    while let Some((number, line)) = lines.next_line() {
        report.lines = number;
        let content = content(&line).map(|text| text.map(Fields::of));
        match content.and_then(|fields| fields.map(|mut fields| parse(&mut fields)).transpose()) {
            Ok(record) => records.extend(record),
            Err((trouble, what)) => report.met_trouble(trouble, number, what),
        }
    }
    (records, report)
}

/// Returns the text of a line that is neither empty nor a comment.
fn content<'a>(line: &Line<'a>) -> Result<Option<&'a str>, Wrong> {
    match line {
        Line::Text(text) => Ok((!text.is_empty() && !text.starts_with('#')).then_some(*text)),
        line => Err(line.trouble()),
    }
}
