//! The part of the world that a grid of dots shows.

use tolman_geom::Point;
use tolman_sim::Bounds;

/// Minimum number of dots across a cell: with fewer a corridor cannot be made out.
const LEAST_DOTS: f64 = 4.0;

/// Number of hops in the width of a window. A hop is the distance by which the window moves.
const HOPS: f64 = 4.0;

/// A part of the world on a grid of dots.
///
/// A cell is a whole number of dots wide, so that all walls look alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    /// Positions of the leftmost and the rightmost dot, m.
    pub(super) x: [f64; 2],
    /// Positions of the lowest and the uppermost dot, m.
    pub(super) y: [f64; 2],
    /// Distance between two dots, m.
    pub(super) metres_per_dot: f64,
}

impl Window {
    /// Returns the window of `columns` by `rows` dots on a world whose cells are `pitch` metres
    /// wide.
    ///
    /// It shows the whole world. Where corridors would be too narrow to see, it shows the
    /// surroundings of `robot` instead.
    pub(super) fn on(bounds: Bounds, pitch: f64, robot: Point, columns: u32, rows: u32) -> Self {
        let (across, up) = (f64::from(columns) - 1.0, f64::from(rows) - 1.0);
        let metres = (bounds.width() / across).max(bounds.height() / up);
        let dots = (pitch / metres).floor().max(LEAST_DOTS);
        let metres_per_dot = pitch / dots;
        let side = |least: f64, most: f64, robot: f64, dots: f64| {
            let extent = (most - least) / metres_per_dot;
            let before = if extent <= dots + 0.5 {
                -((dots - extent) / 2.0)
            } else {
                // The robot stays near the middle, and nothing beyond the world is shown. The
                // window moves in hops, because a picture that moves with every step is hard to
                // read.
                let hop = (dots / HOPS).floor();
                let middle = ((robot - least) / metres_per_dot / hop).round() * hop;
                (middle - dots / 2.0).clamp(0.0, extent - dots)
            };
            let first = least + before.round() * metres_per_dot;
            [first, first + dots * metres_per_dot]
        };
        Self {
            x: side(bounds.min.x, bounds.max.x, robot.x, across),
            y: side(bounds.min.y, bounds.max.y, robot.y, up),
            metres_per_dot,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f64) -> Bounds {
        Bounds {
            min: Point::origin(),
            max: Point::new(side, side),
        }
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-9
    }

    #[test]
    fn a_small_world_is_seen_whole_and_in_the_middle() {
        let window = Window::on(square(4.0), 1.0, Point::new(3.5, 0.5), 101, 45);
        assert!(near(window.metres_per_dot, 1.0 / 11.0));
        assert!(near(window.x[0], -28.0 / 11.0) && near(window.x[1], 72.0 / 11.0));
        assert!(near(window.y[0], 0.0) && near(window.y[1], 4.0));
    }

    #[test]
    fn the_window_stands_still_while_the_robot_is_about_its_middle() {
        let at = |x| Window::on(square(100.0), 1.0, Point::new(x, 50.0), 81, 41);
        assert_eq!(at(48.0), at(52.0));
        for x in 0..100 {
            let Window {
                x: [left, right], ..
            } = at(f64::from(x));
            assert!(left <= f64::from(x) && f64::from(x) <= right, "{x}");
        }
        let left = |x: i32| at(f64::from(x)).x[0];
        let hops = (1..100).filter(|x| !near(left(*x), left(x - 1))).count();
        assert!(
            (10..=20).contains(&hops),
            "{hops} hops over 80 m of 5 m each"
        );
    }

    #[test]
    fn of_a_large_world_the_robot_is_seen_and_nothing_beyond_the_rim() {
        let at = |x, y| Window::on(square(100.0), 1.0, Point::new(x, y), 81, 41);
        for (x, left) in [(0.5, 0.0), (50.0, 40.0), (99.5, 80.0)] {
            let window = at(x, 50.0);
            assert!(near(window.metres_per_dot, 0.25));
            assert!(near(window.x[0], left), "{window:?}");
            assert!(near(window.x[1] - window.x[0], 20.0));
            assert!(near(window.y[0], 45.0) && near(window.y[1], 55.0));
        }
    }
}
