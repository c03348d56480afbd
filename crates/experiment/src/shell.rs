//! Quotes arguments for a shell.

/// Returns an argument as a shell reads it: in single quotes if it has unusual characters, and in
/// `$'…'` if it has control characters.
#[must_use]
pub fn quoted(argument: &str) -> String {
    let usual = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(usual) {
        argument.to_owned()
    } else if argument.contains(char::is_control) {
        let escaped = |c: char| match c {
            '\'' | '\\' => format!("\\{c}"),
            c if c.is_control() => {
                let bytes = c.to_string().into_bytes();
                bytes.iter().map(|byte| format!("\\x{byte:02x}")).collect()
            }
            c => c.to_string(),
        };
        format!("$'{}'", argument.chars().map(escaped).collect::<String>())
    } else {
        format!("'{}'", argument.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_survive_the_shell() {
        for (argument, expect) in [
            ("a/b.txt", "a/b.txt"),
            ("my maze", "'my maze'"),
            ("it's", r"'it'\''s'"),
            ("", "''"),
            ("it's \u{1b}[31m\u{85}", r"$'it\'s \x1b[31m\xc2\x85'"),
        ] {
            assert_eq!(quoted(argument), expect);
        }
    }
}
