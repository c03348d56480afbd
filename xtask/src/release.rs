//! `cargo xtask release --dry-run`: everything of a release but the uploads.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};

use crate::packages::{self, Package};
use crate::workspace::{output, read, root, succeed, target_folder};
use crate::{dist, site};

/// Makes the files of a release in `target/release-VERSION`, and prints what is left to type.
///
/// # Errors
/// If the tree has changes that are not committed, the versions of packages, changelog and citation
/// differ, or a part cannot be made or fails its tests.
pub(crate) fn run() -> Result<()> {
    let changes = output(
        Command::new("git")
            .args(["status", "--porcelain"])
            .current_dir(root()),
    )?;
    ensure!(
        changes.is_empty(),
        "commit or remove these first, since a release is a commit:\n{changes}"
    );
    // Before anything that takes long.
    dist::target()?;
    if let Some(why) = site::missing()? {
        bail!("{why}");
    }
    let ordered = packages::in_order()?;
    let version = version(&ordered)?;
    let notes = notes(&read(&root().join("CHANGELOG.md"))?, &version)?;
    let cited = read(&root().join("CITATION.cff"))?;
    ensure!(
        cited.contains(&format!("\nversion: {version}\n")),
        "CITATION.cff does not name version {version}"
    );
    let folder = target_folder()?.join(format!("release-{version}"));
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let write = |name: &str, text: String| {
        fs::write(folder.join(name), text).with_context(|| format!("cannot write {name}"))
    };
    write("tag.txt", format!("tolman {version}\n\n{notes}"))?;
    // The packages last: their tests take longest.
    let command = dist::run()?;
    let name = command
        .file_name()
        .context("the command's file has no name")?;
    fs::copy(&command, folder.join(name))?;
    let pages = folder.join("site");
    site::run(Some(&pages))?;
    let mut pack = Command::new("tar");
    succeed(
        pack.arg("-czf")
            .arg(folder.join("site.tar.gz"))
            .arg("-C")
            .arg(&pages)
            .arg("."),
    )?;
    packages::all()?;
    for package in &ordered {
        let file = format!("{}.crate", package.stem());
        let made = target_folder()?.join("package").join(&file);
        fs::copy(&made, folder.join(&file)).with_context(|| made.display().to_string())?;
    }
    eprintln!("{}", left_to_type(&folder, &version, &ordered));
    Ok(())
}

/// Returns the one version of all packages.
fn version(packages: &[Package]) -> Result<String> {
    let first = packages.first().context("no package is published")?;
    for package in packages {
        ensure!(
            package.version == first.version,
            "{} has version {}, and {} has {}",
            first.name,
            first.version,
            package.name,
            package.version
        );
    }
    Ok(first.version.clone())
}

/// Returns the changelog's section of a version, or what is not released yet.
fn notes(changelog: &str, version: &str) -> Result<String> {
    let mut sections = changelog.split("\n## [").skip(1);
    let section = sections.find(|section| {
        section.starts_with(&format!("{version}]")) || section.starts_with("Unreleased]")
    });
    let Some((_, text)) = section.and_then(|section| section.split_once('\n')) else {
        bail!("CHANGELOG.md has no section [{version}] or [Unreleased]");
    };
    let text = text.trim();
    ensure!(!text.is_empty(), "the section of CHANGELOG.md is empty");
    Ok(format!("{text}\n"))
}

fn left_to_type(folder: &Path, version: &str, packages: &[Package]) -> String {
    let mut lines = vec![
        format!(
            "Everything of {version} is in {}. Left to type:",
            folder.display()
        ),
        format!(
            "  git tag --sign --file {}/tag.txt v{version}",
            folder.display()
        ),
        format!("  git push origin v{version}"),
    ];
    let upload = |package: &Package| format!("  cargo publish --package {}", package.name);
    lines.extend(packages.iter().map(upload));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_the_section_of_the_version_or_what_is_not_released() {
        let log = "# Changelog\n\n## [Unreleased]\n\n- new\n\n## [0.1.0] - 2026\n\n- old\n";
        assert_eq!(notes(log, "0.2.0").unwrap(), "- new\n");
        assert_eq!(
            notes(&log.replace("[Unreleased]", "[0.2.0]"), "0.2.0").unwrap(),
            "- new\n"
        );
        assert!(notes("# Changelog\n", "0.1.0").is_err());
        assert!(notes("# Changelog\n\n## [Unreleased]\n\n", "0.1.0").is_err());
    }

    #[test]
    fn every_package_comes_after_what_it_needs() {
        let ordered = packages::in_order().unwrap();
        assert!(ordered.len() > 10);
        let place = |name: &str| ordered.iter().position(|package| package.name == name);
        assert!(place("tolman-geom") < place("tolman-sim"));
        assert!(place("tolman-sim") < place("tolman"));
    }
}
