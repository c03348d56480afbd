//! `cargo xtask layers`: checks three rules. The dependencies between the crates are those of
//! docs/architecture.md. Every public name means one thing. Configurations can grow.
//!
//! [`rules::faults`] compares the page's tables with `cargo metadata`. [`names::faults`] compares
//! the names of types with docs/glossary.md.

mod configs;
mod names;
mod page;
mod reexports;
mod rules;
mod size;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::workspace;
pub(crate) use page::{Library, Page};
use rules::{Kind, Package};

/// Compares the workspace with the pages.
///
/// # Errors
/// One line for each dependency or crate that breaks a rule.
pub(crate) fn run() -> Result<()> {
    let page = read_page()?;
    let packages = packages()?;
    let mut faults = rules::faults(&page, &packages);
    let crates = workspace::root().join("crates");
    faults.extend(reexports::faults(&page.stable, &packages, &crates)?);
    faults.extend(size::faults(&crates)?);
    faults.extend(configs::faults(&crates)?);
    faults.extend(names::faults(&crates, &workspace::root().join(GLOSSARY))?);
    if faults.is_empty() {
        let edges: usize = packages
            .iter()
            .map(|package| package.dependencies.len())
            .sum();
        eprintln!(
            "{} crates and {edges} dependencies keep to {PAGE}, the names of types to {GLOSSARY}",
            packages.len()
        );
        return Ok(());
    }
    bail!(
        "{} breaches of {PAGE} and {GLOSSARY}:\n- {}",
        faults.len(),
        faults.join("\n- ")
    )
}

/// Returns the tables of the architecture page.
///
/// # Errors
/// If the page cannot be read or a row of a table is not understood.
pub(crate) fn read_page() -> Result<Page> {
    let path = workspace::root().join(PAGE);
    Page::parse(&workspace::read(&path)?).with_context(|| PAGE.to_owned())
}

const PAGE: &str = "docs/architecture.md";
const GLOSSARY: &str = "docs/glossary.md";

/// Returns the workspace's packages from `cargo metadata`.
fn packages() -> Result<Vec<Package>> {
    packages_of(&workspace::metadata()?).context("`cargo metadata` has another form than expected")
}

fn packages_of(metadata: &Value) -> Option<Vec<Package>> {
    let package = |package: &Value| {
        let dependency = |dependency: &Value| {
            let name = dependency["name"].as_str()?.to_owned();
            let kind = match dependency["kind"].as_str() {
                Some("dev") => Kind::Development,
                _ => Kind::Normal,
            };
            Some((name, kind))
        };
        Some(Package {
            name: package["name"].as_str()?.to_owned(),
            dependencies: package["dependencies"]
                .as_array()?
                .iter()
                .map(dependency)
                .collect::<Option<_>>()?,
        })
    };
    metadata["packages"]
        .as_array()?
        .iter()
        .map(package)
        .collect()
}
