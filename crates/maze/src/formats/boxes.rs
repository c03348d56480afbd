//! [`Format::Boxes`](super::Format::Boxes): drawings of box characters, read and written by way of
//! drawings of ASCII characters. Each character stays in its column, so that faults name the places
//! of the text.

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

/// Returns the text with ASCII characters in place of box characters and blocks.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    if !text.contains(|c: char| matches!(c, '\u{2500}'..='\u{25a0}')) {
        return Cow::Borrowed(text);
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // Old files end a line by a carriage return alone.
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let mut lines: Vec<Vec<char>> = text
        .split(end)
        .map(|line| line.chars().map(ascii).collect())
        .collect();
    // Where lines run through a post, or none meet there, the drawing has no corner: all corners
    // together tell where posts are.
    let first = lines.iter().position(|line| line.contains(&'+'));
    let indent = first.and_then(|first| lines.get(first)?.iter().position(|c| *c == '+'));
    let (Some(first), Some(indent)) = (first, indent) else {
        return Cow::Owned(joined(&lines, end));
    };
    let corners = lines.iter().flat_map(|line| {
        line.iter()
            .enumerate()
            .filter(|(_, c)| **c == '+')
            .map(|(at, _)| at)
    });
    let pitch = corners.fold(0, |pitch, at| divisor(pitch, at.abs_diff(indent)));
    if pitch >= 2 {
        for line in lines.iter_mut().skip(first).step_by(2) {
            for c in line.iter_mut().skip(indent).step_by(pitch) {
                if matches!(c, '-' | '|' | ' ') {
                    *c = '+';
                }
            }
        }
    }
    Cow::Owned(joined(&lines, end))
}

/// Returns whether a drawing begins with box characters.
pub(super) fn begins(text: &str) -> bool {
    text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}')
        .starts_with(|c: char| matches!(c, '\u{2500}'..='\u{257f}'))
}

/// Returns a drawing with posts and walls of box characters.
pub(super) fn drawn(plain: &str) -> String {
    let lines: Vec<&[u8]> = plain.lines().map(str::as_bytes).collect();
    let at = |line: Option<usize>, column: Option<usize>| {
        let line = lines.get(line?)?;
        line.get(column?).copied()
    };
    let mut text = String::new();
    for (number, line) in lines.iter().enumerate() {
        for (column, byte) in line.iter().enumerate() {
            let walls = || {
                [
                    at(number.checked_sub(1), Some(column)) == Some(b'|'),
                    at(Some(number), Some(column + 1)) == Some(b'-'),
                    // The northern border has a tick at each column, from which a reader knows how
                    // wide cells are.
                    number == 0 || at(Some(number + 1), Some(column)) == Some(b'|'),
                    at(Some(number), column.checked_sub(1)) == Some(b'-'),
                ]
            };
            text.push(match byte {
                b'-' => '─',
                b'|' => '│',
                b'o' => post(walls()),
                other => char::from(*other),
            });
        }
        text.push('\n');
    }
    text
}

/// Returns the post at which walls end in the north, east, south and west.
const fn post(walls: [bool; 4]) -> char {
    match walls {
        [false, false, false, false] => '+',
        [true, false, false, false] => '╵',
        [false, true, false, false] => '╶',
        [true, true, false, false] => '└',
        [false, false, true, false] => '╷',
        [true, false, true, false] => '│',
        [false, true, true, false] => '┌',
        [true, true, true, false] => '├',
        [false, false, false, true] => '╴',
        [true, false, false, true] => '┘',
        [false, true, false, true] => '─',
        [true, true, false, true] => '┴',
        [false, false, true, true] => '┐',
        [true, false, true, true] => '┤',
        [false, true, true, true] => '┬',
        [true, true, true, true] => '┼',
    }
}

fn joined(lines: &[Vec<char>], end: char) -> String {
    let mut text = String::new();
    for (number, line) in lines.iter().enumerate() {
        if number > 0 {
            text.push(end);
        }
        text.extend(line);
    }
    text
}

/// Returns the greatest common divisor.
const fn divisor(mut a: usize, mut b: usize) -> usize {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

const fn ascii(c: char) -> char {
    match c {
        '─' | '━' | '═' | '╌' | '╍' | '┄' | '┅' => '-',
        '│' | '┃' | '║' | '╎' | '╏' | '┆' | '┇' => '|',
        '\u{2500}'..='\u{257f}' => '+',
        '\u{2580}'..='\u{25a0}' => '#',
        '\u{a0}' => ' ',
        c => c,
    }
}
