//! Small multiples: pictures in rows, each with a caption.

use maud::html;

use super::number::tenths;
use super::words;
use super::{Drawing, Image};

/// Space between tiles, user units.
const GAP: f64 = 12.0;

/// A grid of pictures, filled row by row.
///
/// ```
/// use tolman_draw::{Image, Tiles};
///
/// let mut faces = Tiles::new(5);
/// for shade in [0, 80, 160] {
///     faces.image(&format!("grey {shade}"), &Image::grey(2, 2, &[shade; 4])?, 48.0);
/// }
/// let drawing = faces.drawing("Three grey squares.");
/// assert!(drawing.body.into_string().contains("grey 160"));
/// # Ok::<(), tolman_draw::ImageError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tiles {
    columns: usize,
    tiles: Vec<(String, Drawing)>,
}

impl Tiles {
    /// Returns an empty sheet with `columns` tiles to a row, at least one.
    pub const fn new(columns: usize) -> Self {
        Self {
            columns: if columns == 0 { 1 } else { columns },
            tiles: Vec::new(),
        }
    }

    /// Adds a picture with its caption, which may be empty. Captions wider than their tile are
    /// shortened.
    pub fn tile(&mut self, caption: impl Into<String>, drawing: Drawing) {
        self.tiles.push((caption.into(), drawing));
    }

    /// Adds an image, `width` user units wide, with its caption.
    pub fn image(&mut self, caption: &str, image: &Image, width: f64) {
        self.tile(caption, image.drawing(caption, width));
    }

    /// Returns the finished picture. `description` describes it in words.
    pub fn drawing(self, description: impl Into<String>) -> Drawing {
        let widest = |size: fn(&Drawing) -> f64| {
            self.tiles
                .iter()
                .map(|(_, drawing)| size(drawing))
                .fold(0.0, f64::max)
        };
        let (width, height) = (widest(|d| d.width), widest(|d| d.height));
        let captions = if self.tiles.iter().any(|(caption, _)| !caption.is_empty()) {
            words::LINE + 4.0
        } else {
            0.0
        };
        let columns = self.columns.min(self.tiles.len()).max(1);
        let rows = self.tiles.len().div_ceil(columns).max(1);
        let (pitch_x, pitch_y) = (width + GAP, height + captions + GAP);
        let body = html! {
            @for (i, (caption, drawing)) in self.tiles.iter().enumerate() {
                @let (x, y) = ((i % columns) as f64 * pitch_x, (i / columns) as f64 * pitch_y);
                svg x=(tenths(x)) y=(tenths(y))
                    width=(tenths(drawing.width)) height=(tenths(drawing.height))
                    viewBox={ "0 0 " (tenths(drawing.width)) " " (tenths(drawing.height)) }
                {
                    title { @if caption.is_empty() { (drawing.description) } @else { (caption) } }
                    (drawing.body)
                }
                @if !caption.is_empty() {
                    text class="small" text-anchor="middle" x=(tenths(x + 0.5 * drawing.width))
                        y=(tenths(y + height + words::LINE)) { (cut(caption, width + GAP)) }
                }
            }
        };
        Drawing {
            width: columns as f64 * pitch_x - GAP,
            height: (rows as f64 * pitch_y - GAP).max(1.0),
            description: description.into(),
            body,
        }
    }
}

/// Returns the part of a caption that fits.
fn cut(caption: &str, room: f64) -> String {
    // Small text has a size of ten user units instead of twelve.
    let most = (room / words::width("x") * 1.2) as usize;
    words::cut(caption, most)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(size: f64) -> Drawing {
        Drawing {
            width: size,
            height: size,
            description: "a square".into(),
            body: html! { rect width="1" height="1" {} },
        }
    }

    #[test]
    fn tiles_fill_rows_from_the_left() {
        let mut tiles = Tiles::new(2);
        for name in ["a", "b", "c <"] {
            tiles.tile(name, square(50.0));
        }
        let drawing = tiles.drawing("three squares");
        assert!((drawing.width - (100.0 + GAP)).abs() < 1e-9);
        assert!((drawing.height - (100.0 + GAP + 2.0 * (words::LINE + 4.0))).abs() < 1e-9);
        let svg = drawing.body.into_string();
        for place in ["x=\"0\" y=\"0\"", "x=\"62\" y=\"0\"", "x=\"0\" y=\"80\""] {
            assert!(svg.contains(&format!("<svg {place}")), "{place} in {svg}");
        }
        assert!(roxmltree::Document::parse(&format!("<g>{svg}</g>")).is_ok());
    }

    #[test]
    fn few_tiles_take_no_room_for_more_and_long_captions_are_cut() {
        let mut tiles = Tiles::new(0);
        assert!(tiles.clone().drawing("none").width.is_finite());
        tiles.tile("a caption that is far too long for its tile", square(40.0));
        let drawing = tiles.drawing("one");
        assert!((drawing.width - 40.0).abs() < 1e-9);
        assert!(drawing.body.into_string().contains("a captio…"));
    }
}
