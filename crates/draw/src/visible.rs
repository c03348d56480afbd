use alloc::borrow::Cow;

/// Returns a text in which every character that a reader cannot see stands as an escape of JSON,
/// such as `\u202e`. So no text from outside moves the cursor of a terminal, or turns the words
/// around it. Line ends and tabs stay.
///
/// These are the control characters, those that give text a direction, the separators of lines and
/// paragraphs, and the two that no XML may hold.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match is_hidden(c) {
            true => shown += &format!("\\u{:04x}", u32::from(c)),
            false => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

fn is_hidden(c: char) -> bool {
    match c {
        '\n' | '\t' => false,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            true
        }
        '\u{fffe}' | '\u{ffff}' => true,
        c => c.is_control(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_shown_and_words_stay() {
        let plain = "ä\tb – 迷\n";
        assert_eq!(visible(plain), plain);
        let hostile = "a\u{1b}[31m\u{9b}\r\u{202e}b\u{2067}\u{7f}";
        assert_eq!(
            visible(hostile),
            r"a\u001b[31m\u009b\u000d\u202eb\u2067\u007f"
        );
    }
}
