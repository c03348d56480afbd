//! Numbered lines of a file, with a bound on their length.

use std::io::{self, BufRead, Read};

use super::LogTrouble;
use crate::fields::Wrong;

/// Maximum length of a line, bytes. Longer lines do not come from a log.
const LONGEST: u64 = 1 << 20;

/// A file line by line.
#[derive(Debug)]
pub(crate) struct NumberedLines<R> {
    source: R,
    buffer: Vec<u8>,
    number: u64,
    has_ended: bool,
}

/// Contents of a line.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Line<'a> {
    /// Text, without its end.
    Text(&'a str),
    /// Bytes that are not UTF-8 text.
    NoText,
    /// The line is longer than a megabyte.
    TooLong,
    /// The rest of the file cannot be read.
    Lost(io::ErrorKind),
}

impl Line<'_> {
    /// Returns the trouble with a line that has no text, in general and in words.
    pub(crate) fn trouble(&self) -> Wrong {
        match self {
            Self::Text(_) | Self::NoText => (LogTrouble::NoText, String::new()),
            Self::TooLong => (LogTrouble::TooLong, String::new()),
            Self::Lost(io::ErrorKind::FileTooLarge) => (LogTrouble::TooLarge, String::new()),
            Self::Lost(kind) => (LogTrouble::EndsEarly, kind.to_string()),
        }
    }
}

impl<R: BufRead> NumberedLines<R> {
    pub(crate) const fn new(source: R) -> Self {
        Self {
            source,
            buffer: Vec::new(),
            number: 0,
            has_ended: false,
        }
    }

    /// Returns the next line with its number, from 1; `None` at the end.
    pub(crate) fn next_line(&mut self) -> Option<(u64, Line<'_>)> {
        if self.has_ended {
            return None;
        }
        self.buffer.clear();
        let mut part = self.source.by_ref().take(LONGEST);
        let read = part.read_until(b'\n', &mut self.buffer);
        self.number += 1;
        match read {
            Ok(0) => {
                self.has_ended = true;
                None
            }
            Ok(_) if self.buffer.len() as u64 == LONGEST && self.buffer.last() != Some(&b'\n') => {
                self.has_ended = !skip_line(&mut self.source);
                Some((self.number, Line::TooLong))
            }
            Ok(_) => Some((self.number, text(&self.buffer))),
            Err(error) => {
                self.has_ended = true;
                Some((self.number, Line::Lost(error.kind())))
            }
        }
    }
}

fn text(bytes: &[u8]) -> Line<'_> {
    core::str::from_utf8(bytes).map_or(Line::NoText, |text| Line::Text(text.trim()))
}

/// Maximum number of bytes skipped in a line. A longer line ends the file: it has no lines, or
/// never ends.
const SKIPPED: usize = 64 << 20;

/// Reads to the end of a line, and returns whether there may be another.
fn skip_line(source: &mut impl BufRead) -> bool {
    let mut skipped = 0;
    while skipped < SKIPPED {
        let Ok(buffer) = source.fill_buf() else {
            return false;
        };
        if buffer.is_empty() {
            return false;
        }
        let end = buffer.iter().position(|byte| *byte == b'\n');
        let used = end.map_or(buffer.len(), |end| end + 1);
        source.consume(used);
        if end.is_some() {
            return true;
        }
        skipped += used;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_numbered_and_long_ones_passed_over() {
        let mut bytes = b"one\n\xff\xfe\n".to_vec();
        let more = usize::try_from(3 * LONGEST).unwrap();
        bytes.resize(bytes.len() + more, b'x');
        bytes.extend(b"\n last");
        let mut lines = NumberedLines::new(&bytes[..]);
        assert_eq!(lines.next_line(), Some((1, Line::Text("one"))));
        assert_eq!(lines.next_line(), Some((2, Line::NoText)));
        assert_eq!(lines.next_line(), Some((3, Line::TooLong)));
        assert_eq!(lines.next_line(), Some((4, Line::Text("last"))));
        assert_eq!(lines.next_line(), None);
    }
}
