//! A drawing with its name, title and caption, alone or on a page.

use maud::{Markup, PreEscaped, html};

use super::number::tenths;
use super::visible;

/// Returns the style rules of all drawings, with the colours of the light and the dark scheme. A
/// stand-alone file contains them itself; a page contains them once.
///
/// The reader's scheme decides, unless the root element's `data-theme` is `light` or `dark`.
pub const fn style() -> &'static str {
    concat!(
        ":root { color-scheme: light;\n",
        include_str!("light.css"),
        "}\n@media (prefers-color-scheme: dark) { :root:not([data-theme=light]) {\n",
        include_str!("dark.css"),
        "} }\n:root[data-theme=dark] {\n",
        include_str!("dark.css"),
        "}\n",
        include_str!("style.css")
    )
}

/// The content of a picture.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Width in user units, which are pixels at natural size.
    pub width: f64,
    /// Height in user units.
    pub height: f64,
    /// Description of the picture in words, for readers who cannot see it.
    pub description: String,
    /// The SVG elements.
    pub body: Markup,
}

/// A picture of an experiment.
///
/// ```
/// use tolman_draw::{Figure, FloorPlan};
/// use tolman_geom::Point;
///
/// let wall = [Point::new(0.0, 0.0), Point::new(2.0, 1.0)];
/// let drawing = FloorPlan::of_walls(&[wall], 200.0).drawing("One wall.");
/// let figure = Figure::new("wall", "A wall", drawing).caption("It stands alone.");
/// assert!(figure.standalone().ends_with("</svg>"));
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the figure's file without the extension, and prefix of its ids. It has lower-case
    /// letters, digits and hyphens.
    pub name: String,
    /// Title, in a few words.
    pub title: String,
    /// Explanation of the picture; empty if the picture is clear without one.
    pub caption: String,
    /// Table to which the figure belongs; `None` puts the figure after all tables.
    pub table: Option<String>,
    /// Picture of the figure.
    pub drawing: Drawing,
}

impl Figure {
    /// Returns a figure without a caption that belongs to no table.
    pub fn new(name: impl Into<String>, title: impl Into<String>, drawing: Drawing) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            caption: String::new(),
            table: None,
            drawing,
        }
    }

    /// Sets the caption, which explains how to read it.
    #[must_use]
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// Sets the table that it belongs to.
    #[must_use]
    pub fn table(mut self, table: impl Into<String>) -> Self {
        self.table = Some(table.into());
        self
    }

    /// Returns the picture as an element for a page that contains [`style`].
    pub fn inline(&self) -> Markup {
        self.element(None, &html! {})
    }

    /// Returns the picture as a file of its own.
    pub fn standalone(&self) -> String {
        let backdrop = html! {
            style { (PreEscaped(style())) }
            rect width="100%" height="100%" style="fill: var(--page)" {}
        };
        self.element(Some("http://www.w3.org/2000/svg"), &backdrop)
            .into_string()
    }

    fn element(&self, namespace: Option<&str>, backdrop: &Markup) -> Markup {
        let Drawing {
            width,
            height,
            description,
            body,
        } = &self.drawing;
        let (title_id, description_id) = (
            format!("{}-title", self.name),
            format!("{}-description", self.name),
        );
        let element = html! {
            svg xmlns=[namespace] class="drawing" id=(self.name)
                viewBox={ "0 0 " (tenths(*width)) " " (tenths(*height)) }
                width=(tenths(*width)) height=(tenths(*height))
                role="img" aria-labelledby={ (title_id) " " (description_id) }
            {
                title id=(title_id) { (self.title) }
                desc id=(description_id) { (description) }
                (backdrop)
                (body)
            }
        };
        PreEscaped(visible(&element.into_string()).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_makes_xml() {
        let all: String = ('\0'..='\u{ffff}').collect();
        let drawing = Drawing {
            width: 1.0,
            height: 1.0,
            description: all.clone(),
            body: html! { text data-row=(all) { (all) } },
        };
        let svg = Figure::new("all", all, drawing).standalone();
        assert!(roxmltree::Document::parse(&svg).is_ok());
    }
}
