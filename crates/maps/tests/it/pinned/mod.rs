//! Runs whose figures are pinned: whatever changes one of them changes what robots learn.

use std::{env, fs, path::PathBuf};

/// Compares figures with those in `pinned/NAME.txt`. `TOLMAN_PIN=1` writes them there instead,
/// where a change is meant.
pub(crate) fn pinned(name: &str, figures: &[String]) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/it/pinned");
    let path = folder.join(name).with_extension("txt");
    let found: Vec<String> = figures.iter().map(|line| rounded(line)).collect();
    if env::var_os("TOLMAN_PIN").is_some() {
        fs::write(&path, found.join("\n") + "\n").unwrap();
    }
    let expected = fs::read_to_string(&path).unwrap();
    for (number, (found, expected)) in (1..).zip(found.iter().zip(expected.lines())) {
        assert_eq!(
            found, expected,
            "{name}, line {number}: is the change meant?"
        );
    }
    assert_eq!(found.len(), expected.lines().count(), "{name}");
}

/// Returns a line with all its fractions to nine digits, so that it says the same wherever the
/// last bits differ.
fn rounded(line: &str) -> String {
    let is_part = |letter: char| letter.is_ascii_digit() || ".-e".contains(letter);
    let (mut text, mut number) = (String::new(), String::new());
    for letter in line.chars().chain(['\n']) {
        if is_part(letter) {
            number.push(letter);
            continue;
        }
        match number.parse::<f64>() {
            Ok(value) if number.contains(['.', 'e']) => {
                let value = (value * 1e9).round() / 1e9 + 0.0;
                text.push_str(&value.to_string());
            }
            _ => text.push_str(&number),
        }
        number.clear();
        text.push(letter);
    }
    text.trim_end().to_owned()
}
