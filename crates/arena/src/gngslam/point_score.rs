use rand::{Rng, RngExt};
use tolman_geom::{Point, Vector};
use tolman_maze::Cell;

use super::CellGrid;

/// Score of a position, in cells, for a cell of the field. Cell (0, 0) reaches from (0, 0) to (1,
/// 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointScore {
    /// Equation 3.2: 1 inside the cell, else 0.5 / distance to its middle, in cells; 0.047 to 1 on
    /// the field.
    pub by_centre: f64,
    /// 0.5 / (0.5 + distance to the cell), in cells: 1 inside the cell, and falling from its border
    /// on. Not in the paper, which wishes for a distance "to the border of the square".
    pub by_border: f64,
}

impl PointScore {
    /// Returns the score of a position for a cell.
    ///
    /// ```
    /// use tolman_arena::gngslam::PointScore;
    /// use tolman_geom::Point;
    /// use tolman_maze::Cell;
    ///
    /// let inside = PointScore::of(Cell::new(2, 3), Point::new(2.9, 3.1));
    /// assert_eq!((inside.by_centre, inside.by_border), (1.0, 1.0));
    /// // One cell to the right of its border.
    /// let beside = PointScore::of(Cell::new(2, 3), Point::new(4.0, 3.5));
    /// assert!((beside.by_centre - 0.5 / 1.5).abs() < 1e-12);
    /// assert!((beside.by_border - 0.5 / 1.5).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn of(cell: Cell, at: Point) -> Self {
        let middle = middle(cell);
        let from_middle = at - middle;
        let beyond = Vector::new(
            (from_middle.x.abs() - 0.5).max(0.0),
            (from_middle.y.abs() - 0.5).max(0.0),
        );
        let distance = libm::hypot(beyond.x, beyond.y);
        let is_inside = distance <= 0.0;
        let radius = libm::hypot(from_middle.x, from_middle.y);
        Self {
            by_centre: if is_inside { 1.0 } else { 0.5 / radius },
            by_border: 0.5 / (0.5 + distance),
        }
    }

    /// Returns the score of a guess: a position anywhere on the field against a cell anywhere, both
    /// uniform. The baseline of the paper; the mean over many is 0.175 by the centre and 0.184 by
    /// the border.
    #[must_use]
    pub fn random(rng: &mut impl Rng) -> Self {
        let side = u32::from(CellGrid::SIDE);
        let cell = Cell::new(
            rng.random_range(0..side) as u16,
            rng.random_range(0..side) as u16,
        );
        let mut along = || rng.random_range(0.0..f64::from(CellGrid::SIDE));
        Self::of(cell, Point::new(along(), along()))
    }
}

/// Returns the middle of a cell, in cells.
pub(super) fn middle(cell: Cell) -> Point {
    Point::new(f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn distance_decides_outside() {
        let cell = Cell::new(7, 0);
        for (x, y, by_centre, by_border) in [
            (7.0, 1.0, 1.0, 1.0),
            (7.5, 2.5, 0.25, 0.25),
            // 3 and 4 cells from the corner.
            (4.0, 5.0, 0.5 / libm::hypot(3.5, 4.5), 0.5 / 5.5),
            // As far as it goes on the field: "the minimum score is 0.047".
            (
                0.0,
                8.0,
                0.5 / libm::sqrt(112.5),
                0.5 / (0.5 + libm::sqrt(98.0)),
            ),
        ] {
            let score = PointScore::of(cell, Point::new(x, y));
            assert!((score.by_centre - by_centre).abs() < 1e-12, "{x} {y}");
            assert!((score.by_border - by_border).abs() < 1e-12, "{x} {y}");
        }
    }

    /// Compares with the paper's figures of ten million guesses: mean 0.18 (0.175 in Table 4.1),
    /// median 0.12, standard deviation 0.16, 1.56 % inside.
    #[test]
    fn guesses_score_as_in_the_paper() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let count = 1_000_000_u32;
        let mut scores: Vec<PointScore> =
            (0..count).map(|_| PointScore::random(&mut rng)).collect();
        let mean = |value: fn(&PointScore) -> f64| {
            scores.iter().map(value).sum::<f64>() / f64::from(count)
        };
        let centre = mean(|score| score.by_centre);
        assert!((centre - 0.175).abs() < 0.0005, "{centre}");
        let border = mean(|score| score.by_border);
        assert!((border - 0.1835).abs() < 0.0005, "{border}");
        let square = mean(|score| score.by_centre * score.by_centre);
        let sd = libm::sqrt(square - centre * centre);
        assert!((sd - 0.16).abs() < 0.005, "{sd}");
        let inside = mean(|score| f64::from(u8::from(score.by_border >= 1.0)));
        assert!((100.0 * inside - 1.56).abs() < 0.05, "{inside}");
        scores.sort_by(|a, b| a.by_centre.total_cmp(&b.by_centre));
        let median = scores[scores.len() / 2].by_centre;
        assert!((median - 0.12).abs() < 0.01, "{median}");
    }
}
