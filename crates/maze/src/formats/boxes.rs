//! Drawings of box characters and blocks, rewritten as drawings of ASCII characters. Each character
//! stays in its column, so that faults name the places of the text.

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

/// Returns the text with ASCII characters in place of box characters and blocks.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    if !text.contains(|c: char| matches!(c, '\u{2500}'..='\u{25a0}')) {
        return Cow::Borrowed(text);
    }
    let mut lines: Vec<Vec<char>> = text
        .split('\n')
        .map(|line| line.chars().map(ascii).collect())
        .collect();
    // Where lines run through a post, or none meet there, the drawing has no corner: all corners
    // together tell where posts are.
    let first = lines.iter().position(|line| line.contains(&'+'));
    let indent = first.and_then(|first| lines.get(first)?.iter().position(|c| *c == '+'));
    let (Some(first), Some(indent)) = (first, indent) else {
        return Cow::Owned(joined(&lines));
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
    Cow::Owned(joined(&lines))
}

fn joined(lines: &[Vec<char>]) -> String {
    let mut text = String::new();
    for (number, line) in lines.iter().enumerate() {
        if number > 0 {
            text.push('\n');
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
