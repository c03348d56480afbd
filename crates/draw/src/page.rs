//! A page of figures and tables in one file that opens anywhere.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Figure, style, visible};

/// A page: facts and text first, then figures and tables from top to bottom.
///
/// ```
/// use tolman_draw::{Page, PageTable};
///
/// let page = Page::new("Two poses")
///     .fact("closures", "1")
///     .text("One closure joins them.")
///     .table(&PageTable::new("Closures", ["from", "to"]).row(["0", "1"]));
/// assert!(page.html().starts_with("<!DOCTYPE html>"));
/// ```
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    facts: Vec<(String, String)>,
    parts: Vec<Markup>,
}

/// A table of words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PageTable {
    title: String,
    headings: Vec<String>,
    rows: Vec<Vec<String>>,
    note: String,
}

impl Page {
    /// Returns a page that has only a title.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            facts: Vec::new(),
            parts: Vec::new(),
        }
    }

    /// Adds a fact to the cards at the top.
    #[must_use]
    pub fn fact(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.facts.push((name.into(), value.into()));
        self
    }

    /// Adds a paragraph.
    #[must_use]
    pub fn text(mut self, text: impl AsRef<str>) -> Self {
        self.parts.push(html! { p { (text.as_ref()) } });
        self
    }

    /// Adds a figure with its title and caption.
    #[must_use]
    pub fn figure(mut self, figure: &Figure) -> Self {
        self.parts.push(html! {
            figure {
                div class="wide" { (figure.inline()) }
                figcaption { strong { (figure.title) } " " (figure.caption) }
            }
        });
        self
    }

    /// Adds a table.
    #[must_use]
    pub fn table(mut self, table: &PageTable) -> Self {
        self.parts.push(table.markup());
        self
    }

    /// Returns the text of the HTML file.
    #[must_use]
    pub fn html(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="generator" content="tolman page";
                    meta http-equiv="Content-Security-Policy"
                        content="default-src 'none'; style-src 'unsafe-inline'; img-src data:";
                    title { (self.title) }
                    style { (PreEscaped(style())) (PreEscaped(include_str!("page.css"))) }
                }
                body {
                    main {
                        h1 { (self.title) }
                        div class="cards" {
                            @for (name, value) in &self.facts {
                                div class="card" { strong { (value) } span { (name) } }
                            }
                        }
                        @for part in &self.parts { (part) }
                    }
                }
            }
        };
        visible(&page.into_string()).into_owned()
    }
}

impl PageTable {
    /// Returns a table without rows.
    #[must_use]
    pub fn new<S: Into<String>>(
        title: impl Into<String>,
        headings: impl IntoIterator<Item = S>,
    ) -> Self {
        Self {
            title: title.into(),
            headings: headings.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
            note: String::new(),
        }
    }

    /// Adds a row.
    #[must_use]
    pub fn row<S: Into<String>>(mut self, cells: impl IntoIterator<Item = S>) -> Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }

    /// Sets the note below the table.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    fn markup(&self) -> Markup {
        html! {
            section {
                h2 { (self.title) }
                div class="wide" {
                    table {
                        thead { tr { @for heading in &self.headings { th { (heading) } } } }
                        tbody {
                            @for row in &self.rows {
                                tr { @for cell in row { td { (cell) } } }
                            }
                        }
                    }
                }
                @if !self.note.is_empty() { p class="quiet" { (self.note) } }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_nothing_is_loaded() {
        let page = Page::new("a < b").fact("<i>", "&").text("<script>").html();
        assert!(page.contains("a &lt; b") && page.contains("&lt;script&gt;"));
        assert!(!page.contains("http://") && !page.contains("https://"));
    }
}
