/// Returns the greatest whole number that is not above `value`, as `libm::floor(value) as i32`
/// does: the nearest `i32` beyond their range, 0 for NaN.
///
/// Grids compute the cell of a point with it, so it avoids the call into libm.
///
/// ```
/// use tolman_geom::floor_index;
///
/// assert_eq!([-1.5, -1.0, -0.5, 0.5].map(floor_index), [-2, -1, -1, 0]);
/// ```
#[inline]
#[must_use]
pub fn floor_index(value: f64) -> i32 {
    let cut = value as i32;
    cut.saturating_sub(i32::from(f64::from(cut) > value))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::floor_index;

    /// Returns the reference result, by libm.
    fn floor(value: f64) -> i32 {
        libm::floor(value) as i32
    }

    proptest! {
        #[test]
        fn it_is_the_floor_of_all_that_fits(value in -3e9_f64..3e9, digits in 0..4) {
            let value = libm::round(value) / libm::pow(1000.0, f64::from(digits));
            prop_assert_eq!(floor_index(value), floor(value));
        }

        #[test]
        fn it_is_the_floor_of_any_bits(bits in any::<u64>()) {
            prop_assert_eq!(floor_index(f64::from_bits(bits)), floor(f64::from_bits(bits)));
        }
    }

    #[test]
    fn the_ends_of_the_range_hold() {
        let ends = [f64::from(i32::MIN), f64::from(i32::MAX)];
        let near = ends.map(|end| [end - 1.0, end - 0.5, end, end + 0.5, end + 1.0]);
        let others = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for value in near.into_iter().flatten().chain(others) {
            assert_eq!(floor_index(value), floor(value), "{value}");
        }
    }
}
