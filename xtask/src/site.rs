//! `cargo xtask site`: one folder of pages that shows the project before anything is compiled. It
//! opens from disk, and no page asks another host for anything.

mod api;
mod book;
mod exhibits;
mod links;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use crate::ci::Outcome;
use crate::playground;
use crate::workspace::{cargo, root, succeed, target_folder};

/// Page that the folder begins with. Its pictures and links are those that the other parts make.
const FRONT: &str = include_str!("site/front.html");

/// Size that the front page and its pictures stay below, bytes.
const LARGEST_FRONT: u64 = 6_000_000;

/// Builds the folder and checks its links.
///
/// # Errors
/// If a tool is missing, a command fails, a link leads nowhere, or `out` is a folder of something
/// else.
pub(crate) fn run(out: Option<&Path>) -> Result<()> {
    if let Some(why) = missing()? {
        bail!("{why}");
    }
    let out = match out {
        Some(out) => std::env::current_dir()?.join(out),
        None => usual()?,
    };
    ensure!(
        !out.exists() || is_site(&out),
        "{} is not a site: give a folder that does not exist",
        out.display()
    );
    // The folder that is there stays until the new one is whole.
    let mut new = out.clone().into_os_string();
    new.push(".new");
    let new = PathBuf::from(new);
    remove(&new)?;
    build(&new)?;
    remove(&out)?;
    fs::rename(&new, &out).with_context(|| format!("cannot write {}", out.display()))?;
    eprintln!("open {}", out.join("index.html").display());
    Ok(())
}

/// Builds the folder and looks at it in a browser, if all tools are installed.
///
/// # Errors
/// As [`run`], and if a test of the pages fails.
pub(crate) fn check() -> Result<Outcome> {
    if let Some(why) = missing()? {
        return Ok(Outcome::Missing(why));
    }
    run(None)?;
    let mut test =
        cargo("test --workspace --all-features --test browser --quiet -- --ignored site::");
    succeed(test.env("TOLMAN_SITE", usual()?))?;
    Ok(Outcome::Passed)
}

fn usual() -> Result<PathBuf> {
    Ok(target_folder()?.join("site"))
}

/// Returns the tool that is not installed, with the command that installs it.
pub(crate) fn missing() -> Result<Option<String>> {
    Ok(match playground::missing()? {
        None => book::missing(),
        why => why,
    })
}

/// Returns whether a folder was made by this chore.
fn is_site(folder: &Path) -> bool {
    let front = fs::read_to_string(folder.join("index.html")).unwrap_or_default();
    front.contains("<meta name=\"generator\" content=\"cargo xtask site\">")
}

fn remove(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)
            .with_context(|| format!("cannot replace {}", folder.display()))?;
    }
    Ok(())
}

fn build(out: &Path) -> Result<()> {
    fs::create_dir_all(out).with_context(|| format!("cannot make {}", out.display()))?;
    succeed(&mut cargo("build --release --quiet --package tolman"))?;
    exhibits::make(&target_folder()?.join("release/tolman"), out)?;
    playground::run(Some(&out.join("playground.html")))?;
    book::make(out)?;
    api::make(out)?;
    front(out)?;
    links::check(out)
}

/// Writes the front page.
fn front(out: &Path) -> Result<()> {
    let picture = fs::read(root().join("docs/images/demo.svg"))?;
    fs::write(out.join("demo.svg"), &picture)?;
    fs::write(out.join("index.html"), FRONT)?;
    let size = (FRONT.len() + picture.len()) as u64;
    ensure!(
        size < LARGEST_FRONT,
        "the front page has {size} bytes, and may have {LARGEST_FRONT}: leave something out"
    );
    Ok(())
}
