//! Reads the lines of a text with their numbers, so that every fault can name its place.

use super::{MazeError, MazeFault};

/// A position in a text, both counted from 1; columns count characters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    line: usize,
    column: usize,
}

impl Place {
    pub(super) const fn fault(self, fault: MazeFault) -> MazeError {
        MazeError {
            line: self.line,
            column: self.column,
            fault,
        }
    }

    /// Returns the place `columns` further on in the same line.
    pub(super) const fn right(self, columns: usize) -> Self {
        Self {
            line: self.line,
            column: self.column + columns,
        }
    }

    pub(super) const fn line(self) -> usize {
        self.line
    }
}

impl Default for Place {
    fn default() -> Self {
        Self { line: 1, column: 1 }
    }
}

/// A line of a text, without its end.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// Number of the line, from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
}

impl<'a> Line<'a> {
    /// Returns the place of the character at byte `offset` of the line.
    pub(super) fn place(self, offset: usize) -> Place {
        let before = self
            .text
            .char_indices()
            .take_while(|(at, _)| *at < offset)
            .count();
        Place {
            line: self.number,
            column: before + 1,
        }
    }

    /// Returns the place of `piece`, which must be a part of this line's text.
    pub(super) fn place_of(self, piece: &'a str) -> Place {
        // Splitting and trimming forget where the pieces were; their addresses do not.
        self.place((piece.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize))
    }

    pub(super) fn fault(self, offset: usize, fault: MazeFault) -> MazeError {
        self.place(offset).fault(fault)
    }

    pub(super) fn is_blank(self) -> bool {
        self.text.trim().is_empty()
    }
}

/// The lines of a text, with their numbers. They end with LF or CR LF, or with CR in a text without
/// any LF. A leading byte order mark is dropped.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: core::str::Split<'a, char>,
    read: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let end = if text.contains('\n') { '\n' } else { '\r' };
        Self {
            rest: text.strip_prefix('\u{feff}').unwrap_or(text).split(end),
            read: 0,
        }
    }

    /// Skips blank lines, so that the next line, if any, is not blank.
    pub(super) fn skip_blank(&mut self) {
        let mut ahead = self.clone();
        while ahead.next().is_some_and(Line::is_blank) {
            *self = ahead.clone();
        }
    }

    /// Returns the next line that is not blank.
    pub(super) fn next_filled(&mut self) -> Option<Line<'a>> {
        self.find(|line| !line.is_blank())
    }

    /// Returns the number of lines read so far.
    pub(super) const fn read(&self) -> usize {
        self.read
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let text = self.rest.next()?;
        self.read += 1;
        Some(Line {
            number: self.read,
            text: text.strip_suffix('\r').unwrap_or(text),
        })
    }
}
