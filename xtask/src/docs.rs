//! `cargo xtask docs`: builds the API documentation without warnings, checks the links of the
//! written pages, and makes README's animated picture.

mod links;

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, bail};

use crate::workspace::{cargo, entries, read, root, succeed};

/// Builds the API documentation, makes the picture and checks the pages.
///
/// # Errors
/// If rustdoc warns, a link leads nowhere or the demo fails.
pub(crate) fn run() -> Result<()> {
    api(|arguments| Ok(cargo(arguments)))?;
    moving_picture()?;
    pages()
}

/// Writes README's animated picture from the run of `tolman demo`.
fn moving_picture() -> Result<()> {
    let demo = "run --quiet --package tolman -- demo --svg docs/images/demo.svg \
                --out target/tmp/demo.html --force";
    succeed(&mut cargo(demo))
}

/// Runs this cargo's `doc` on the workspace with all features; warnings are errors.
///
/// # Errors
/// If there is no such cargo, or rustdoc warns.
pub(crate) fn api(cargo: impl Fn(&str) -> Result<Command>) -> Result<()> {
    let mut doc = cargo("doc --workspace --all-features --no-deps --quiet")?;
    succeed(doc.env("RUSTDOCFLAGS", "-Dwarnings"))
}

/// Checks that every relative link of every Markdown page names an existing file, and a heading of
/// it.
///
/// # Errors
/// One line for each link that leads nowhere.
pub(crate) fn pages() -> Result<()> {
    let mut pages = Vec::new();
    collect(root(), &mut pages)?;
    pages.sort();
    let mut broken = Vec::new();
    for page in &pages {
        let text = read(page)?;
        for link in links::of(&text) {
            if let Some(fault) = links::fault(page, &text, link.target) {
                let page = page.strip_prefix(root()).unwrap_or(page);
                broken.push(format!("{}:{}: {fault}", page.display(), link.line));
            }
        }
    }
    if broken.is_empty() {
        eprintln!("{} pages, every link leads somewhere", pages.len());
        return Ok(());
    }
    bail!(
        "{} links lead nowhere:\n{}",
        broken.len(),
        broken.join("\n")
    )
}

/// Collects the Markdown files below `folder`, without build products and hidden folders.
fn collect(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<()> {
    for path in entries(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if !name.starts_with('.') && name != "target" && name != "results" {
                collect(&path, pages)?;
            }
        } else if path.extension().is_some_and(|extension| extension == "md") {
            pages.push(path);
        }
    }
    Ok(())
}
