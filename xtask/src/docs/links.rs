//! Links in Markdown, as far as the project's pages use it: inline links and images, reference
//! definitions, headings. Code is skipped.

use std::fs;
use std::path::Path;

/// A link on a page.
#[derive(Debug, PartialEq)]
pub(super) struct Link<'a> {
    /// Number of the line, from 1.
    pub(super) line: usize,
    /// Path, address or `#heading`.
    pub(super) target: &'a str,
}

/// Returns all links of a page, in order.
pub(super) fn of(text: &str) -> Vec<Link<'_>> {
    let mut links = Vec::new();
    for (line, content) in prose(text) {
        if let Some(target) = definition(content) {
            links.push(Link { line, target });
            continue;
        }
        // Every second part is between backticks. A link whose text is code still shows its `](`.
        let mut outside_code = true;
        for part in content.split('`') {
            if outside_code {
                links.extend(inline(part).map(|target| Link { line, target }));
            }
            outside_code = !outside_code;
        }
    }
    links
}

/// Returns the reason why `target` on `page` leads nowhere; `None` if it leads somewhere or out of
/// the project.
pub(super) fn fault(page: &Path, text: &str, target: &str) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, heading) = target.split_once('#').unwrap_or((target, ""));
    let file = if path.is_empty() {
        page.to_path_buf()
    } else {
        page.with_file_name(path)
    };
    if !path.is_empty() && !file.exists() {
        return Some(format!("`{target}`: there is no {path}"));
    }
    let other;
    let there = if path.is_empty() {
        text
    } else if file.extension().is_some_and(|extension| extension == "md") {
        other = fs::read_to_string(&file).ok()?;
        &other
    } else {
        return None;
    };
    let found = heading.is_empty() || headings(there).any(|anchor| anchor == heading);
    (!found).then(|| format!("`{target}`: there is no such heading"))
}

/// Returns the lines outside fenced code, numbered from 1.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    (1..).zip(text.lines()).filter(move |(_, line)| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    })
}

/// Returns the target of a line `[name]: target`.
fn definition(line: &str) -> Option<&str> {
    let (name, rest) = line.strip_prefix('[')?.split_once("]:")?;
    (!name.starts_with('^')).then(|| rest.split_whitespace().next())?
}

/// Returns the targets of all `](target)`.
fn inline(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| {
        let (target, _) = rest.split_once(')')?;
        target.split_whitespace().next()
    })
}

/// Returns the anchors of a page's headings, as GitHub makes them.
fn headings(text: &str) -> impl Iterator<Item = String> {
    prose(text).filter_map(|(_, line)| {
        let title = line.trim_start_matches('#');
        (title.len() < line.len() && title.starts_with(' ')).then(|| anchor(title.trim()))
    })
}

fn anchor(title: &str) -> String {
    title
        .to_lowercase()
        .chars()
        .filter(|letter| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_'))
        .map(|letter| if letter == ' ' { '-' } else { letter })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "\
# A Page, of sorts
See [this](docs/a.md#b) and ![a picture](b.svg \"title\"), [`code`](c.rs), not `[d](e)`.

```
[in code](f)
```
[ref]: g.md
";

    #[test]
    fn finds_links_outside_code() {
        let targets: Vec<_> = of(PAGE)
            .iter()
            .map(|link| (link.line, link.target))
            .collect();
        assert_eq!(
            targets,
            [(2, "docs/a.md#b"), (2, "b.svg"), (2, "c.rs"), (7, "g.md")]
        );
    }

    #[test]
    fn names_what_is_missing() {
        let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
        let fault = |target| fault(&page, PAGE, target);
        assert_eq!(fault("https://example.org/x"), None);
        assert_eq!(fault("Cargo.toml"), None);
        assert_eq!(fault("#a-page-of-sorts"), None);
        assert!(fault("#b-page").unwrap().contains("no such heading"));
        assert!(
            fault("nowhere.md#a")
                .unwrap()
                .contains("there is no nowhere.md")
        );
    }
}
