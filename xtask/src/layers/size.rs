//! Checks that no crate grows too large.

use std::path::Path;

use anyhow::Result;

use crate::workspace::{entries, read, rust_files};

/// Maximum share of all lines of `src` that one crate may have.
const LARGEST_SHARE: f64 = 0.25;

/// Returns the breaches, each with the crate and its number of lines.
///
/// # Errors
/// If a folder cannot be read.
pub(super) fn faults(crates: &Path) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    for entry in entries(crates)? {
        let source = entry.join("src");
        if source.is_dir() {
            lines.push((entry, lines_below(&source)?));
        }
    }
    let all: usize = lines.iter().map(|(_, lines)| lines).sum();
    let too_large = lines
        .into_iter()
        .filter(|(_, lines)| *lines as f64 > LARGEST_SHARE * all as f64);
    let told = too_large.map(|(folder, lines)| {
        format!(
            "{} has {lines} of the {all} lines of src, more than a quarter: split it",
            folder.display()
        )
    });
    Ok(told.collect())
}

/// Returns the number of lines of all Rust files in a folder and below.
fn lines_below(folder: &Path) -> Result<usize> {
    let mut lines = 0;
    for path in rust_files(folder)? {
        lines += read(&path)?.lines().count();
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_crate_of_more_than_a_quarter_is_told() {
        let crates = std::env::temp_dir().join(format!("xtask-size-{}", std::process::id()));
        for (name, lines) in [("a", 10), ("b", 10), ("c", 10), ("d", 10), ("e", 15)] {
            let source = crates.join(name).join("src");
            fs::create_dir_all(&source).unwrap();
            fs::write(source.join("lib.rs"), "\n".repeat(lines)).unwrap();
        }
        let found = faults(&crates).unwrap();
        assert_eq!(found.len(), 1);
        assert!(found[0].contains("e has 15 of the 55 lines"), "{found:?}");
        fs::remove_dir_all(crates).unwrap();
    }
}
