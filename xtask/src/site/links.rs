//! Checks that every link of the site leads somewhere, and that no page asks another host for
//! anything.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::workspace::{entries, read};

/// Attributes that name another file, and whether a browser fetches it without being asked.
const ATTRIBUTES: [(&str, bool); 2] = [(" href=\"", false), (" src=\"", true)];

/// Checks all pages below `site`.
///
/// # Errors
/// One line for each link that leads nowhere or to another host unasked.
pub(super) fn check(site: &Path) -> Result<()> {
    let mut pages = Vec::new();
    collect(site, &mut pages)?;
    let mut names = HashMap::new();
    let mut faults = Vec::new();
    for page in &pages {
        for link in links(&read(page)?) {
            if let Some(fault) = fault(site, page, &link, &mut names) {
                let page = page.strip_prefix(site).unwrap_or(page);
                faults.push(format!("{}: {fault}", page.display()));
            }
        }
    }
    if faults.is_empty() {
        eprintln!("{} pages, every link leads somewhere", pages.len());
        return Ok(());
    }
    bail!("{} links are wrong:\n{}", faults.len(), faults.join("\n"))
}

fn collect(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<()> {
    for path in entries(folder)? {
        if path.is_dir() {
            collect(&path, pages)?;
        } else if path.extension().is_some_and(|ending| ending == "html") {
            pages.push(path);
        }
    }
    Ok(())
}

/// A link of a page.
struct Link {
    target: String,
    /// Whether the browser fetches it by itself.
    is_fetched: bool,
}

/// Returns the links of a page, without those that scripts make.
fn links(page: &str) -> Vec<Link> {
    let mut links = Vec::new();
    // What stands in a script is not a link.
    for part in page.split("</script>") {
        let part = part.split("<script>").next().unwrap_or_default();
        for tag in part.split('<').skip(1) {
            let tag = tag.split('>').next().unwrap_or_default();
            for (attribute, fetches) in ATTRIBUTES {
                if let Some((_, rest)) = tag.split_once(attribute) {
                    links.push(Link {
                        target: rest.split('"').next().unwrap_or_default().to_owned(),
                        is_fetched: fetches || tag.starts_with("link "),
                    });
                }
            }
        }
    }
    links
}

/// Returns what is wrong with a link of `page` in `site`, or `None`. `names` keeps the names within
/// the pages that links have led to.
fn fault(
    site: &Path,
    page: &Path,
    link: &Link,
    names: &mut HashMap<PathBuf, HashSet<String>>,
) -> Option<String> {
    let target = &link.target;
    if ["data:", "javascript:", "mailto:"]
        .iter()
        .any(|form| target.starts_with(form))
        || is_left_by_rustdoc(target)
    {
        return None;
    }
    if target.contains("://") || target.starts_with("//") {
        return link
            .is_fetched
            .then(|| format!("fetches {target} from another host"));
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let path = path.split('?').next().unwrap_or_default();
    let mut there = match path {
        "" => page.to_owned(),
        path => page.parent()?.join(path),
    };
    if there.is_dir() {
        there.push("index.html");
    }
    if !there.is_file() {
        return Some(format!("{target} leads nowhere"));
    }
    // A replay's anchor is a time, and the API's pages make some of theirs by a script.
    if anchor.is_empty() || !there.starts_with(site.join("docs")) {
        return None;
    }
    let known = names.entry(there).or_insert_with_key(|there| ids(there));
    (!known.contains(anchor)).then(|| format!("{target}: no such heading"))
}

/// Returns whether rustdoc writes such a link to something that need not be there: a list of
/// implementations in other crates, or a path in the text of a crate that is not in the site.
fn is_left_by_rustdoc(target: &str) -> bool {
    target.contains("trait.impl/") || target.contains("::") && !target.starts_with("tolman_")
}

/// Returns the ids in a page.
fn ids(page: &Path) -> HashSet<String> {
    let text = fs::read_to_string(page).unwrap_or_default();
    let ids = text.split(" id=\"").skip(1);
    ids.filter_map(|rest| rest.split('"').next().map(str::to_owned))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_into_the_void_and_a_request_to_another_host_are_faults() {
        let site = std::env::temp_dir().join("tolman-site-links");
        fs::create_dir_all(site.join("docs")).unwrap();
        fs::write(site.join("docs/a.html"), "<h2 id=\"here\">").unwrap();
        let faults = |page: &str| {
            fs::write(site.join("index.html"), page).unwrap();
            check(&site).err().map(|error| error.to_string())
        };
        for right in ["docs/a.html#here", "https://example.org", "#"] {
            assert_eq!(faults(&format!("<a href=\"{right}\">")), None, "{right}");
        }
        for wrong in ["docs/b.html", "docs/a.html#there", "tolman_maze::Grid"] {
            let told = faults(&format!("<a href=\"{wrong}\">")).unwrap();
            assert!(told.contains(wrong), "{told}");
        }
        let told = faults("<img src=\"https://example.org/a.png\">").unwrap();
        assert!(told.contains("from another host"), "{told}");
    }
}
