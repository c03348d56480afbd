use crate::Point;

/// Returns the point of the straight line from `from` to `to` that is nearest to `at`.
///
/// ```
/// use tolman_geom::{Point, nearest_on_segment};
///
/// let [from, to] = [Point::new(1.0, 0.0), Point::new(3.0, 0.0)];
/// assert_eq!(nearest_on_segment(Point::new(1.5, 2.0), from, to), Point::new(1.5, 0.0));
/// assert_eq!(nearest_on_segment(Point::new(7.0, 2.0), from, to), to);
/// assert_eq!(nearest_on_segment(Point::new(7.0, 2.0), from, from), from);
/// ```
#[inline]
#[must_use]
pub fn nearest_on_segment(at: Point, from: Point, to: Point) -> Point {
    let along = to - from;
    let share = (at - from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
    from + along * share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = Point> {
        [-9.0..9.0, -9.0..9.0].prop_map(|[x, y]| Point::new(x, y))
    }

    proptest! {
        #[test]
        fn no_other_point_of_the_line_is_nearer(at in point(), from in point(), to in point(), share in 0.0..=1.0) {
            let nearest = (nearest_on_segment(at, from, to) - at).norm();
            let other: Point = from + (to - from) * share;
            prop_assert!(nearest <= (other - at).norm() + 1e-9);
        }
    }
}
