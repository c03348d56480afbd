//! Values over two parameters.

use maud::html;

use super::number::tenths;
use super::words;
use super::{Drawing, Shade};

const CELL_HEIGHT: f64 = 30.0;
const LEAST_CELL_WIDTH: f64 = 46.0;

/// A table of values as a picture: one parameter across, another down, each value written in its cell and
/// shown by the depth of its colour.
///
/// ```
/// use tolman_draw::{HeatMap, Shade};
///
/// let success = vec![vec![40.0, 68.0], vec![72.0, f64::NAN]];
/// let map = HeatMap {
///     across: "corridor width (m)".into(),
///     columns: vec!["0.5".into(), "0.6".into()],
///     down: "beams".into(),
///     rows: vec!["36".into(), "72".into()],
///     shade: Shade::of("success %", success.concat()),
///     values: success,
/// };
/// let drawing = map.drawing("Success by width and beams.");
/// # assert!(drawing.body.into_string().contains(">72<"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// What the columns are values of.
    pub across: String,
    /// The columns, from left to right.
    pub columns: Vec<String>,
    /// What the rows are values of.
    pub down: String,
    /// The rows, from the top.
    pub rows: Vec<String>,
    /// By row and column; one that is not finite, or not there, leaves its cell empty.
    pub values: Vec<Vec<f64>>,
    /// How values become colours.
    pub shade: Shade,
}

impl HeatMap {
    /// The finished picture; `description` says in words what it shows.
    pub fn drawing(&self, description: impl Into<String>) -> Drawing {
        let widest = |texts: &[String]| texts.iter().map(|t| words::width(t)).fold(0.0, f64::max);
        let written = self
            .values
            .iter()
            .flatten()
            .filter(|value| value.is_finite());
        let written: Vec<String> = written.map(|value| self.shade.text(*value)).collect();
        let cell = (widest(&self.columns).max(widest(&written)) + 14.0).max(LEAST_CELL_WIDTH);
        let left = widest(&self.rows).max(words::width(&self.down)) + 12.0;
        // The title of the columns, then their names.
        let top = 2.0 * words::LINE + 8.0;
        let (columns, rows) = (self.columns.len() as f64, self.rows.len() as f64);
        let bottom = top + rows * CELL_HEIGHT;
        let legend = 140.0 + words::width(&self.shade.title);
        let cells = self.rows.iter().enumerate().flat_map(|(row, _)| {
            let value = move |column: usize| self.values.get(row)?.get(column).copied();
            let columns = (0..self.columns.len()).map(move |column| (column, value(column)));
            columns.filter_map(move |(column, value)| {
                Some((row as f64, column as f64, value.filter(|v| v.is_finite())?))
            })
        });
        let body = html! {
            text class="quiet" x=(tenths(left)) y="11" { (self.across) }
            text class="quiet" x="0" y=(tenths(top - 7.0)) { (self.down) }
            @for (i, column) in self.columns.iter().enumerate() {
                text x=(tenths(left + (i as f64 + 0.5) * cell)) y=(tenths(top - 7.0))
                    text-anchor="middle" { (column) }
            }
            @for (i, row) in self.rows.iter().enumerate() {
                text x=(tenths(left - 8.0)) y=(tenths(top + (i as f64 + 0.5) * CELL_HEIGHT))
                    text-anchor="end" dominant-baseline="central" { (row) }
            }
            g class=(self.shade.series.class()) {
                @for (row, column, value) in cells {
                    @let (x, y) = (left + column * cell, top + row * CELL_HEIGHT);
                    rect class="heat" fill-opacity=(self.shade.opacity(value))
                        x=(tenths(x + 1.0)) y=(tenths(y + 1.0)) rx="3"
                        width=(tenths(cell - 2.0)) height=(tenths(CELL_HEIGHT - 2.0)) {}
                    text class=(self.shade.text_class(value)) text-anchor="middle"
                        dominant-baseline="central" x=(tenths(x + 0.5 * cell))
                        y=(tenths(y + 0.5 * CELL_HEIGHT)) { (self.shade.text(value)) }
                }
            }
            (self.shade.legend(left, bottom + 10.0))
        };
        Drawing {
            width: left + (columns * cell).max(legend),
            height: bottom + 10.0 + Shade::LEGEND,
            description: description.into(),
            body,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finite_value_has_a_cell_in_its_row_and_column() {
        let map = HeatMap {
            across: "a < b".into(),
            columns: vec!["1".into(), "2".into(), "3".into()],
            down: "y".into(),
            rows: vec!["p".into(), "q".into()],
            values: vec![vec![1.0, f64::NAN, 3.0], vec![5.0]],
            shade: Shade::new("v", 1.0, 5.0),
        };
        let drawing = map.drawing("a test");
        let svg = drawing.body.into_string();
        assert_eq!(svg.matches("rx=\"3\"").count(), 3);
        // The third column of the first row, the first of the second; names are one character wide.
        let (left, top) = (words::width("p") + 12.0, 2.0 * words::LINE + 8.0);
        for (row, column) in [(0.0, 2.0), (1.0, 0.0)] {
            let (x, y) = (
                left + 1.0 + column * LEAST_CELL_WIDTH,
                top + 1.0 + row * CELL_HEIGHT,
            );
            let place = format!("x=\"{}\" y=\"{}\"", tenths(x), tenths(y));
            assert!(svg.contains(&place), "{place} in {svg}");
        }
        assert!(roxmltree::Document::parse(&format!("<g>{svg}</g>")).is_ok());
    }
}
