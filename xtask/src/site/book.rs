//! The written pages as a book with a search, by mdBook.

use core::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::exhibits::BEHIND;
use crate::workspace::{entries, metadata, read, root, succeed, target_folder};

/// Chapters of the book: a title, and the folder below `docs` whose pages it has.
const PARTS: &[(&str, &str)] = &[
    ("Pages", ""),
    ("Notebook", "notebook"),
    ("Decisions", "decisions"),
];

/// Pages outside `docs`, by the names that they have in the book.
const OUTSIDE: &[(&str, &str)] = &[
    ("README.md", "index.md"),
    ("CONTRIBUTING.md", "contributing.md"),
    ("CHANGELOG.md", "changelog.md"),
];

/// Settings of mdBook. Code that could be run in a browser would be sent to another host.
const BOOK: &str = "\
[book]
title = \"tolman\"

[output.html]
preferred-dark-theme = \"navy\"
input-404 = \"\"
no-section-label = true

[output.html.playground]
runnable = false

[output.html.print]
enable = false
";

/// Returns how to install mdBook, if it is not installed.
pub(super) fn missing() -> Option<String> {
    let found = Command::new("mdbook").arg("--version").output();
    found.is_err().then(|| {
        "mdBook is missing: cargo install mdbook --locked --no-default-features --features search"
            .to_owned()
    })
}

/// Writes the book into the folder `docs` of the site at `out`.
///
/// # Errors
/// If a page cannot be read, or mdBook fails.
pub(super) fn make(out: &Path) -> Result<()> {
    let work = target_folder()?.join("book");
    if work.exists() {
        fs::remove_dir_all(&work)?;
    }
    let source = work.join("src");
    let mut summary = String::from("# Summary\n\n[tolman](index.md)\n");
    let mut pages: Vec<(PathBuf, String)> = OUTSIDE
        .iter()
        .map(|(from, to)| (root().join(from), (*to).to_owned()))
        .collect();
    for (title, folder) in PARTS {
        writeln!(summary, "\n# {title}\n")?;
        let below = source.join(folder);
        fs::create_dir_all(&below)?;
        for path in entries(&root().join("docs").join(folder))? {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.ends_with(".md") {
                let place = Path::new(folder).join(name.replace("README", "index"));
                let place = place.to_string_lossy().into_owned();
                writeln!(summary, "- [{}]({place})", heading(&read(&path)?))?;
                pages.push((path, place));
            }
        }
    }
    writeln!(
        summary,
        "\n# Project\n\n- [How to take part](contributing.md)\n- [Changelog](changelog.md)"
    )?;
    let images = source.join("images");
    fs::create_dir_all(&images)?;
    for picture in entries(&root().join("docs/images"))? {
        fs::copy(
            &picture,
            images.join(picture.file_name().unwrap_or_default()),
        )?;
    }
    let repository = repository()?;
    for (from, place) in &pages {
        let mut text = with_links(&read(from)?, from, place, &repository);
        if place == "gallery.md" {
            text = with_replays(&text)?;
        }
        fs::write(source.join(place), text)?;
    }
    fs::write(source.join("SUMMARY.md"), summary)?;
    fs::write(work.join("book.toml"), BOOK)?;
    let mut build = Command::new("mdbook");
    build.arg("build").arg(&work).arg("--dest-dir");
    succeed(build.arg(out.join("docs")))
}

/// Returns the address of the project's sources.
fn repository() -> Result<String> {
    let metadata = metadata()?;
    let address = metadata["packages"][0]["repository"].as_str();
    let address = address.context("Cargo.toml names no repository")?;
    Ok(format!("{address}/blob/main"))
}

/// Returns a page's first heading, without marks.
fn heading(text: &str) -> String {
    let line = text.lines().find(|line| line.starts_with("# "));
    line.unwrap_or_default()
        .trim_start_matches("# ")
        .replace('`', "")
}

/// Returns the text of the page `from` with its links as they are at `place` in the book: those to
/// pages of the book stay in it, those to other files lead to `repository`.
fn with_links(text: &str, from: &Path, place: &str, repository: &str) -> String {
    let mut parts = text.split("](");
    let mut linked = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        linked.push_str("](");
        let end = part.find([')', ' ', '\n']).unwrap_or(part.len());
        let (target, rest) = part.split_at(end);
        linked.push_str(&moved(target, from, place, repository));
        linked.push_str(rest);
    }
    linked
}

fn moved(target: &str, from: &Path, place: &str, repository: &str) -> String {
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    if path.is_empty() || path.contains(':') {
        return target.to_owned();
    }
    let there = from
        .parent()
        .and_then(|folder| folder.join(path).canonicalize().ok());
    let Some(there) = there
        .as_deref()
        .and_then(|there| there.strip_prefix(root()).ok())
    else {
        return target.to_owned();
    };
    let outside = OUTSIDE.iter().find(|(page, _)| there == Path::new(page));
    let in_book = match outside {
        Some((_, page)) => Some(Path::new(page)),
        None => there.strip_prefix("docs").ok(),
    };
    let is_page = |page: &Path| {
        let ending = page.extension().unwrap_or_default();
        ["md", "svg", "png"].iter().any(|known| ending == *known)
    };
    let anchor = match anchor {
        "" => String::new(),
        anchor => format!("#{anchor}"),
    };
    match in_book.filter(|page| is_page(page)) {
        Some(page) => {
            let up = "../".repeat(Path::new(place).components().count() - 1);
            let page = page.to_string_lossy().replace("README", "index");
            format!("{up}{page}{anchor}")
        }
        None => format!("{repository}/{}{anchor}", there.display()),
    }
}

/// Returns the gallery with a replay behind each picture.
fn with_replays(text: &str) -> Result<String> {
    let mut lines = Vec::new();
    for line in text.lines() {
        let picture = line
            .strip_prefix("![")
            .and_then(|rest| rest.split("](images/").nth(1));
        let Some(picture) = picture.and_then(|rest| rest.strip_suffix(')')) else {
            lines.push(line.to_owned());
            continue;
        };
        let behind = BEHIND.iter().find(|behind| behind.0 == picture);
        let (_, page) = behind.with_context(|| {
            format!("docs/gallery.md: nothing is behind {picture}: name a page in BEHIND")
        })?;
        lines.push(format!("[{line}](../{page})"));
    }
    ensure!(lines.len() > 10, "docs/gallery.md has no pictures");
    Ok(lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_stay_in_the_book_or_lead_to_the_sources() {
        let page = root().join("docs/notebook/arena.md");
        let moved = |target| moved(target, &page, "notebook/arena.md", "https://sources");
        assert_eq!(moved("../arena.md#wings"), "../arena.md#wings");
        assert_eq!(moved("../../README.md"), "../index.md");
        assert_eq!(
            moved("../../crates/geom/src/lib.rs"),
            "https://sources/crates/geom/src/lib.rs"
        );
        for other in ["#here", "https://example.org/a.md", "nowhere.md"] {
            assert_eq!(moved(other), other);
        }
    }

    #[test]
    fn every_picture_of_the_gallery_has_a_page_behind_it() {
        let gallery = read(&root().join("docs/gallery.md")).unwrap();
        let linked = with_replays(&gallery).unwrap();
        assert_eq!(linked.matches("[![").count(), BEHIND.len());
        assert!(with_replays("![new](images/new.svg)").is_err());
    }
}
