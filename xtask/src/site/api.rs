//! The pages of the API, by rustdoc.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result};

use super::remove;
use crate::workspace::{cargo, metadata, succeed, target_folder};

/// Page to which rustdoc's own pages lead back.
const INDEX: &str = "<!DOCTYPE html><meta charset=\"utf-8\"><title>tolman: the API</title>\
    <meta http-equiv=\"refresh\" content=\"0; url=tolman_systems/index.html\">\
    <a href=\"tolman_systems/index.html\">The API</a>\n";

/// Writes the pages of all published crates into the folder `api` of the site at `out`.
///
/// # Errors
/// If rustdoc fails, or a file cannot be written.
pub(super) fn make(out: &Path) -> Result<()> {
    let made = target_folder()?.join("doc");
    remove(&made)?;
    // rustdoc writes a link to another crate only if its folder is there, done or not. cargo takes
    // that of the crate in work away: one after another.
    let mut doc = cargo("doc --all-features --no-deps --quiet --jobs 1");
    let mut check = cargo("check --all-features --quiet");
    let metadata = metadata()?;
    let packages = metadata["packages"].as_array();
    for package in packages.context("the workspace has no packages")? {
        let is_published = package["publish"].is_null();
        if let (true, Some(name)) = (is_published, package["name"].as_str()) {
            doc.args(["--package", name]);
            check.args(["--package", name]);
            fs::create_dir_all(made.join(name.replace('-', "_")))?;
        }
    }
    // What does not depend on the order is built in parallel.
    succeed(&mut check)?;
    succeed(&mut doc)?;
    succeed(Command::new("cp").arg("-r").arg(&made).arg(out.join("api")))?;
    fs::write(out.join("api/index.html"), INDEX)?;
    Ok(())
}
