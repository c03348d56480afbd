//! Checks that every public configuration can grow: that it is `#[non_exhaustive]`.

use std::path::Path;

use anyhow::Result;

use crate::workspace::{entries, read, rust_files};

/// Returns a line for each configuration that a new field would break for its users.
///
/// # Errors
/// If a folder or a file cannot be read.
pub(super) fn faults(crates: &Path) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for entry in entries(crates)? {
        let source = entry.join("src");
        let files = if source.is_dir() {
            rust_files(&source)?
        } else {
            Vec::new()
        };
        for path in files {
            let text = read(&path)?;
            faults.extend(fixed(&text).into_iter().map(|name| {
                let path = path.display();
                format!("{path}: `{name}` is not `#[non_exhaustive]`, so it cannot get a field")
            }));
        }
    }
    Ok(faults)
}

/// Returns the names of the configurations of a text that cannot grow.
fn fixed(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut grows = false;
    for line in text.lines().map(str::trim_start) {
        let name = line.strip_prefix("pub struct ").map(|rest| {
            let end = rest.find(|letter: char| !letter.is_alphanumeric());
            &rest[..end.unwrap_or(rest.len())]
        });
        match name {
            Some(name) if name.ends_with("Config") && !grows => found.push(name),
            _ => {}
        }
        // An attribute of several lines ends in one that begins with a bracket.
        let above = line.starts_with(['#', ')', ']']) || line.starts_with("//");
        grows = line == "#[non_exhaustive]" || (grows && above);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_configuration_that_cannot_grow_is_told() {
        let text = "\
#[non_exhaustive]
#[derive(Clone)]
/// A configuration that can grow.
pub struct GrowingConfig {
    pub moves: u32,
}

pub struct FixedConfig {}
pub struct Configured;
struct OwnConfig;
#[non_exhaustive]
pub enum Kind {}
    pub struct Config<T>(T);
";
        assert_eq!(fixed(text), ["FixedConfig", "Config"]);
    }
}
