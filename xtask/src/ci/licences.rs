//! Checks where each dependency comes from, and under which licence.

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::workspace::{cargo, output};

/// Licences that dependencies may have.
const ALLOWED: [&str; 11] = [
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "ISC",
    "MIT",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "bzip2-1.0.6",
];

/// Where they may come from.
const SOURCE: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Checks all dependencies of all features.
///
/// # Errors
/// One line for each that is not from crates.io, or has another licence.
pub(super) fn check() -> Result<()> {
    let text = output(&mut cargo("metadata --format-version 1 --all-features"))?;
    let metadata: Value = serde_json::from_str(&text)?;
    let packages = metadata["packages"].as_array();
    let packages = packages.context("`cargo metadata` names no packages")?;
    let others = packages
        .iter()
        .filter(|package| !package["source"].is_null());
    let wrong: Vec<String> = others
        .filter_map(|package| {
            let licence = package["license"].as_str().unwrap_or_default();
            let good = package["source"] == SOURCE && may_be_used(licence);
            (!good).then(|| {
                format!(
                    "{}: {} of {}",
                    package["name"], package["license"], package["source"]
                )
            })
        })
        .collect();
    if wrong.is_empty() {
        return Ok(());
    }
    bail!("neither allowed nor from crates.io:\n{}", wrong.join("\n"))
}

/// Returns whether a licence expression of SPDX can be met. AND is taken to bind less than OR,
/// which refuses rather too much.
fn may_be_used(licence: &str) -> bool {
    let licence = licence.replace('/', " OR ").replace(['(', ')'], "");
    let is_allowed = |choice: &str| ALLOWED.contains(&choice.trim());
    licence
        .split(" AND ")
        .all(|part| part.split(" OR ").any(is_allowed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_choice_of_each_part_has_to_be_allowed() {
        for good in ["MIT", "GPL-3.0/MIT", "(MIT OR 0BSD) AND Unicode-3.0"] {
            assert!(may_be_used(good), "{good}");
        }
        for wrong in ["", "GPL-3.0", "MIT AND GPL-3.0", "MIT-0"] {
            assert!(!may_be_used(wrong), "{wrong}");
        }
    }
}
