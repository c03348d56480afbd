//! `cargo xtask docs`: the API documentation builds without a warning, the links between the
//! written pages lead somewhere, and the moving picture of README is made again.

mod links;

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::workspace::{cargo, entries, read, root, succeed};

/// All of it.
///
/// # Errors
/// If rustdoc warns, a link leads nowhere or the demo fails.
pub(crate) fn run() -> Result<()> {
    api()?;
    moving_picture()?;
    pages()
}

/// Writes the moving picture of README from the run of `tolman demo`.
fn moving_picture() -> Result<()> {
    let demo = "run --quiet --package tolman -- demo --svg docs/images/demo.svg \
                --out target/tmp/demo.html --force";
    succeed(&mut cargo(demo))
}

/// `cargo doc` of the workspace with all its features, warnings denied.
///
/// # Errors
/// If rustdoc warns.
pub(crate) fn api() -> Result<()> {
    succeed(cargo("doc --workspace --all-features --no-deps").env("RUSTDOCFLAGS", "-Dwarnings"))
}

/// Every relative link of every Markdown page names a file that exists, and a heading of it.
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

/// The Markdown files below `folder`, build products and hidden folders left out.
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
