//! `cargo xtask prose`: checks that comments keep to the code's width. Also checks that comments,
//! messages and pages use no phrase for which the project has a better word.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::workspace::{entries, read, root};

/// Maximum length of a comment's line, in characters, as rustfmt's `max_width`.
const WIDTH: usize = 100;

/// Phrases that read as translated, each with what to write instead. Lower case, whole words.
const PHRASES: &[(&str, &str)] = &[
    (
        "so many",
        "the parameter or a number, as in \"by `angle`, rad\"",
    ),
    (
        "is none",
        "\"is invalid\", \"is not one\" or \"does not exist\"",
    ),
    ("are none", "\"are invalid\" or \"do not exist\""),
    ("for ever", "\"forever\""),
    ("yardstick", "\"baseline\" or \"oracle\""),
    ("what it is.", "what the field holds, with its unit"),
    ("all chance", "\"all random numbers\" or \"seed\""),
    ("anew", "\"again\""),
    ("one after the other", "\"one by one\" or \"in turn\""),
    ("on the spot", "\"in place\""),
    ("nobody has been through", "\"unexplored\""),
    ("that in which", "what it is, by its noun"),
    ("that which", "what it is, by its noun"),
    ("whoever", "who it is, such as \"the caller\""),
    ("nobody is left", "what cannot be done"),
    ("held against", "\"compared with\""),
    ("takes itself", "\"believes that it is\""),
    ("took itself", "\"believed that it was\""),
    ("taken for one of", "\"counts as one of\""),
    ("amid a", "\"in the middle of\" or \"inside\""),
    (
        "so far apart",
        "the distance, as in \"at least `spacing` apart, m\"",
    ),
    ("to the letter", "\"literally\""),
    ("is no number", "\"is not a number\""),
    ("is no length", "\"is not a positive length\""),
    ("is no text", "\"is not text\""),
    ("that there is not", "what is missing"),
    ("a line each", "\"one per line\""),
    ("one a core", "\"one per core\""),
];

/// "There is none" is plain English.
const PLAIN: &[&str] = &["there is none", "there are none"];

/// Checks every Rust file and every page of the project.
///
/// # Errors
/// If there are breaches; one line for each, with its place and the repair.
pub(crate) fn run() -> Result<()> {
    let mut files = Vec::new();
    collect(root(), &mut files)?;
    let mut faults = Vec::new();
    for path in &files {
        let name = path.strip_prefix(root()).unwrap_or(path);
        for fault in faults_of(&read(path)?, Kind::of(path)) {
            faults.push(format!("{}:{}: {}", name.display(), fault.line, fault.what));
        }
    }
    if faults.is_empty() {
        eprintln!("{} files, all in plain English", files.len());
        return Ok(());
    }
    bail!("{} lines to reword:\n{}", faults.len(), faults.join("\n"))
}

/// Kind of file, which decides where its prose is.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Rust,
    Page,
}

impl Kind {
    fn of(path: &Path) -> Self {
        if path.extension().is_some_and(|extension| extension == "rs") {
            Self::Rust
        } else {
            Self::Page
        }
    }
}

/// A line to reword.
#[derive(Debug, PartialEq)]
struct Fault {
    /// Line number, counted from 1.
    line: usize,
    /// Fault and what to write instead.
    what: String,
}

/// Returns the breaches of one file, in order of lines.
fn faults_of(text: &str, kind: Kind) -> Vec<Fault> {
    let lines: Vec<_> = text.lines().map(|line| prose(line, kind)).collect();
    let mut faults = Vec::new();
    // Examples in comments and tables cannot be wrapped.
    let mut is_example = false;
    for (index, (line, words)) in text.lines().zip(&lines).enumerate() {
        let mut tell = |what| {
            faults.push(Fault {
                line: index + 1,
                what,
            });
        };
        let length = line.chars().count();
        let is_comment = kind == Kind::Rust && line.trim_start().starts_with("//");
        is_example = is_comment && (is_example ^ words.starts_with("```"));
        let wraps = !is_example && !words.starts_with('|') && words.contains(' ');
        if is_comment && length > WIDTH && wraps {
            tell(format!("{length} characters; wrap comments at {WIDTH}"));
        }
        // A phrase may go on in the next line.
        let next = lines.get(index + 1).map_or("", String::as_str);
        let joined = format!("{words} {next}");
        for (phrase, instead) in PHRASES {
            if begins_in(&joined, words.len(), phrase) {
                tell(format!("\"{phrase}\": write {instead}"));
            }
        }
    }
    faults
}

/// Returns whether `phrase` begins, as whole words, in the first `length` bytes of `text`.
fn begins_in(text: &str, length: usize, phrase: &str) -> bool {
    text.match_indices(phrase).any(|(start, _)| {
        let (before, rest) = (&text[..start], &text[start..]);
        let after = &rest[phrase.len()..];
        let is_plain = PLAIN.iter().any(|plain| {
            plain
                .strip_suffix(phrase)
                .is_some_and(|lead| !lead.is_empty() && before.ends_with(lead))
        });
        start < length
            && !before.ends_with(char::is_alphanumeric)
            && !after.starts_with(|next: char| next.is_alphanumeric() || next == '(')
            && !is_plain
    })
}

/// Returns the words of a line in lower case. A comment loses its slashes; a line of code counts
/// only in quotes; a line of a page counts whole.
fn prose(line: &str, kind: Kind) -> String {
    let line = line.trim();
    let words = match kind {
        Kind::Rust if line.starts_with("//") => {
            line.trim_start_matches(['/', '!']).trim().to_owned()
        }
        // Every second part lies between quotes; a string of several lines is taken as a whole.
        Kind::Rust if line.matches('"').count() >= 2 => line
            .split('"')
            .skip(1)
            .step_by(2)
            .collect::<Vec<_>>()
            .join(" | "),
        Kind::Rust | Kind::Page => line.to_owned(),
    };
    words.to_lowercase()
}

/// Collects the Rust files and pages below `folder`. Build products, hidden folders and this list
/// itself are left out. So are the notebooks, which keep their old words.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    for path in entries(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            let is_left_out = matches!(&*name, "target" | "results" | "notebook");
            if !name.starts_with('.') && !is_left_out {
                collect(&path, files)?;
            }
        } else if (name.ends_with(".rs") || name.ends_with(".md")) && !path.ends_with(file!()) {
            files.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_line_and_repair() {
        let text = "/// Turns by so\n/// many radians.\nfn turn() {}\n// Why there is none.\n";
        let faults = faults_of(text, Kind::Rust);
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert_eq!(faults[0].line, 1);
        assert!(faults[0].what.starts_with("\"so many\": write"));
    }

    #[test]
    fn reads_messages_but_not_names() {
        let text = "let yardstick = 1;\nlet text = \"the map is none\";\n";
        let lines: Vec<_> = faults_of(&text.replace("let yardstick", "let y"), Kind::Rust);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].line, 2);
    }

    #[test]
    fn a_comment_is_as_wide_as_code() {
        let fits = format!("// {} é", "x".repeat(95));
        assert_eq!(faults_of(&fits, Kind::Rust), []);
        let wide = format!("{fits} ");
        assert_eq!(faults_of(&format!("{wide}y"), Kind::Rust).len(), 1);
        // One word cannot be wrapped.
        assert_eq!(
            faults_of(&format!("// {}", "x".repeat(120)), Kind::Rust),
            []
        );
    }
}
