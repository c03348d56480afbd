//! Text in SVG pictures, where lines do not break by themselves.

use maud::{Markup, html};

use super::number::tenths;

/// The height of a line, user units.
pub(super) const LINE: f64 = 14.0;

/// Returns the approximate width of a text in the font of drawings, user units.
pub(super) fn width(text: &str) -> f64 {
    6.6 * text.chars().count() as f64
}

/// Returns an upper bound for the width of a text in a broad font, user units.
pub(super) fn broad(text: &str) -> f64 {
    7.6 * text.chars().count() as f64
}

/// Returns a text in lines of at most `most` characters, broken between words where possible. There
/// are at most three lines; the last may end in `…`.
pub(super) fn lines(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    if lines.len() > 3 {
        lines.truncate(3);
        lines[2].push('…');
    }
    for line in &mut lines {
        *line = cut(line, most + 4);
    }
    lines
}

/// Returns the first `most` characters of a text, ending in `…` if more would follow.
pub(super) fn cut(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let kept = text.chars().take(most.saturating_sub(1));
    kept.chain(['…']).collect()
}

/// Returns lines centred below each other, the first with its base line at `y`.
pub(super) fn centred(lines: &[String], x: f64, y: f64) -> Markup {
    html! {
        @for (i, line) in lines.iter().enumerate() {
            text x=(tenths(x)) y=(tenths(y + LINE * i as f64)) text-anchor="middle" { (line) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::lines;

    #[test]
    fn lines_break_between_words() {
        for (text, expect) in [
            ("Wall-follow", vec!["Wall-follow"]),
            (
                "GNG with a map of 40 nodes",
                vec!["GNG with a map", "of 40 nodes"],
            ),
            ("", vec![]),
            ("a b", vec!["a b"]),
            ("abcdefghijklmnopqrstuvwxyz", vec!["abcdefghijklmnopq…"]),
        ] {
            assert_eq!(lines(text, 14), expect);
        }
        assert_eq!(
            lines("one two three four five", 5).last().unwrap(),
            "three…"
        );
    }
}
