//! Checks that each stable crate re-exports the crates that its signatures name.

use std::path::Path;

use anyhow::Result;

use super::rules::Package;
use crate::workspace::read;

/// Returns the breaches, each with the missing line and where it belongs.
///
/// # Errors
/// If a crate's `lib.rs` cannot be read.
pub(super) fn faults(
    stable: &[String],
    packages: &[Package],
    crates: &Path,
) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for name in stable {
        let package = format!("tolman-{name}");
        let Some(package) = packages.iter().find(|other| other.name == package) else {
            faults.push(format!(
                "`{name}` stands under API boundaries but is not a crate of the workspace: remove it"
            ));
            continue;
        };
        let path = crates.join(name).join("src/lib.rs");
        let text = read(&path)?;
        for line in missing(package, &text) {
            faults.push(format!("{}: add `{line}`", path.display()));
        }
    }
    Ok(faults)
}

/// Returns the re-exports that a `lib.rs` lacks.
fn missing(package: &Package, text: &str) -> Vec<String> {
    let house = package
        .uses()
        .filter_map(|used| used.strip_prefix("tolman-"));
    house
        .map(|used| format!("pub use tolman_{used} as {used};"))
        .filter(|line| !text.lines().any(|other| other == line))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::rules::Kind;
    use super::*;

    #[test]
    fn a_missing_reexport_is_told() {
        let package = Package {
            name: "tolman-sim".to_owned(),
            dependencies: vec![
                ("tolman-geom".to_owned(), Kind::Normal),
                ("tolman-maze".to_owned(), Kind::Normal),
                ("tolman-draw".to_owned(), Kind::Development),
                ("libm".to_owned(), Kind::Normal),
            ],
        };
        let text = "mod a;\npub use tolman_geom as geom;\n";
        assert_eq!(missing(&package, text), ["pub use tolman_maze as maze;"]);
    }
}
