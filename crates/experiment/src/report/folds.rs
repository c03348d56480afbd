//! Chooses the parts of a page that are open, and those that are folded until a reader opens them.
//!
//! The open part takes at most six desktop screens. The main tables come first, each with its first
//! metrics and figures. The rest is one click away. Heights are estimates on the safe side, because
//! no browser is known when the page is written.

use tolman_draw::Figure;

use super::table;
use crate::TableAnalysis;

/// Height of six screens of 1280 × 800 pixels, px.
const STORY: f64 = 4800.0;

/// Width of the page's text and figures, px.
const WIDTH: f64 = 1200.0;

/// Height of the page's head with abstract, cards and contents, and of what follows the tables, px.
const HEAD: f64 = 620.0;

/// Maximum number of rows that a table shows, except for those of its first metric.
const ROWS: usize = 16;

/// Height of a folded table, px.
const FOLDED: f64 = 56.0;

/// Height of a row whose verdict may take two lines, and of other rows, px.
const JUDGED_ROW: f64 = 56.0;
const ROW: f64 = 40.0;

/// Height of a metric's heading with a tolerance, whose reason may take a second line, and of other
/// headings, px.
const JUDGED_HEADING: f64 = 66.0;
const HEADING: f64 = 44.0;

/// Height of a figure's caption, px.
const CAPTION: f64 = 90.0;

/// Open parts of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shown {
    /// Whether the table is open.
    pub(super) open: bool,
    /// Number of the table's varying metrics that are shown while the table is open.
    pub(super) metrics: usize,
    /// Number of the table's figures that are shown while the table is open.
    pub(super) figures: usize,
}

/// Budget for the open parts of a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Folds {
    /// Remaining height, px.
    left: f64,
}

/// A table with its figures.
#[derive(Clone, Debug)]
pub(super) struct Part<'a> {
    pub(super) table: &'a TableAnalysis,
    pub(super) figures: Vec<&'a Figure>,
    /// Whether the table is one of the main tables, which come first.
    pub(super) main: bool,
}

impl<'a> Part<'a> {
    pub(super) fn of(table: &'a TableAnalysis, figures: &'a [Figure], main: bool) -> Self {
        let own = figures
            .iter()
            .filter(|figure| figure.table.as_deref() == Some(&table.table.name));
        Self {
            table,
            figures: own.collect(),
            main,
        }
    }
}

impl Folds {
    /// Returns the budget for the page of one experiment.
    pub(super) const fn of_report() -> Self {
        Self { left: STORY - HEAD }
    }

    /// Returns the open parts of each table, in order.
    pub(super) fn of_tables(&mut self, parts: &[Part<'_>]) -> Vec<Shown> {
        self.left -= FOLDED * parts.len() as f64;
        let mut shown = vec![Shown::default(); parts.len()];
        for wanted in [true, false] {
            for (part, shown) in parts.iter().zip(&mut shown) {
                if part.main == wanted {
                    *shown = self.of_table(part);
                }
            }
        }
        shown
    }

    /// Returns the number of these figures that are shown open, and subtracts their height.
    pub(super) fn of_figures(&mut self, figures: &[&Figure]) -> usize {
        let (count, height) = first_line(figures);
        if count > 0 && height <= self.left {
            self.left -= height;
            count
        } else {
            0
        }
    }

    fn of_table(&mut self, part: &Part<'_>) -> Shown {
        let analysis = part.table;
        let (row, heading) = match analysis.verdicts().next() {
            Some(_) => (JUDGED_ROW, JUDGED_HEADING),
            None => (ROW, HEADING),
        };
        let (mut metrics, mut rows) = (0, 0);
        for metric in table::varying(analysis) {
            let more = rows + metric.rows.len();
            if metrics > 0 && more > ROWS {
                break;
            }
            metrics += 1;
            rows = more;
        }
        let notes = 44.0 * (analysis.table.missing().len() + 2) as f64;
        let mut height = 150.0 + notes + row * rows as f64 + heading * metrics as f64;
        let (line, line_height) = first_line(&part.figures);
        height += line_height;
        let open = height <= self.left;
        if open {
            self.left -= height;
        }
        Shown {
            open,
            metrics,
            figures: line,
        }
    }
}

/// Returns the number of figures in the first line, and its height.
fn first_line(figures: &[&Figure]) -> (usize, f64) {
    let (mut count, mut width, mut height) = (0, 0.0, 0.0_f64);
    for figure in figures {
        width += figure.drawing.width + 32.0;
        if count > 0 && width > WIDTH {
            break;
        }
        count += 1;
        height = height.max(figure.drawing.height + CAPTION);
    }
    (count, height)
}
