//! Sums, products, quotients and roots rounded outwards without touching the processor's rounding
//! mode.
//!
//! A result rounded to nearest lies within half a unit in the last place of the exact one, so its
//! neighbour bounds it. Sums that are exact are kept: what adds up grows by no more than it must.
//!
//! An infinite operand stands for a missing bound, that is for finite numbers of any size. So 0
//! times it is 0.

/// Returns at most a + b.
#[inline]
pub(super) fn sum_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    // What rounding lost (Knuth's TwoSum); NaN where something overflowed or is infinite.
    let b_part = sum - a;
    let lost = (a - (sum - b_part)) + (b - b_part);
    if lost.is_nan() {
        return sum.next_down();
    }
    // Half of all sums are rounded up, at random, so a branch would cost more than the sum. A sum
    // that was rounded is not 0.
    let step = i64::from(lost < 0.0);
    let bits = sum.to_bits().cast_signed();
    let sign = (bits >> 63) | 1;
    f64::from_bits((bits - sign * step).cast_unsigned())
}

/// Returns at least a + b.
#[inline]
pub(super) fn sum_up(a: f64, b: f64) -> f64 {
    -sum_down(-a, -b)
}

/// Returns at most a · b.
pub(super) fn product_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        0.0
    } else {
        below(a * b, (a > 0.0) == (b > 0.0))
    }
}

/// Returns at least a · b.
pub(super) fn product_up(a: f64, b: f64) -> f64 {
    -product_down(-a, b)
}

/// Returns at most a / b, for b ≠ 0.
pub(super) fn quotient_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || (b.is_infinite() && a.is_finite()) {
        0.0
    } else if b.is_infinite() {
        a * b.signum()
    } else {
        below(a / b, (a > 0.0) == (b > 0.0))
    }
}

/// Returns the next lower neighbour of a rounded result, but at least 0 for a positive one.
fn below(rounded: f64, positive: bool) -> f64 {
    if positive {
        rounded.next_down().max(0.0)
    } else {
        rounded.next_down()
    }
}

/// Returns at least a / b, for b ≠ 0.
pub(super) fn quotient_up(a: f64, b: f64) -> f64 {
    -quotient_down(-a, b)
}

/// Returns √a for a ≥ 0, rounded by `towards` to the next double unless it is 0. libm's root is
/// correctly rounded.
pub(super) fn root(a: f64, towards: fn(f64) -> f64) -> f64 {
    if a == 0.0 {
        0.0
    } else {
        towards(libm::sqrt(a))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const LARGE: f64 = f64::INFINITY;

    #[test]
    fn a_missing_bound_stays_missing_or_bounds_nothing() {
        for round in [quotient_down, quotient_up] {
            for (a, b, expect) in [
                (LARGE, LARGE, LARGE),
                (LARGE, -LARGE, -LARGE),
                (-LARGE, LARGE, -LARGE),
                (-LARGE, -LARGE, LARGE),
                (3.0, LARGE, 0.0),
                (-3.0, LARGE, 0.0),
                (0.0, LARGE, 0.0),
                (0.0, -2.0, 0.0),
            ] {
                // Either zero will do.
                let found = round(a, b) + 0.0;
                assert!(found.total_cmp(&expect).is_eq(), "{a} / {b} = {found}");
            }
        }
        for round in [product_down, product_up] {
            assert!(round(0.0, LARGE) == 0.0 && round(-LARGE, 0.0) == 0.0);
        }
    }

    proptest! {
        /// Each bound is the next double or the result itself, on the right side of it.
        #[test]
        fn bounds_lie_one_step_round_the_result(a in -1e9..1e9_f64, b in -1e9..1e9_f64) {
            prop_assume!(a != 0.0 && b != 0.0);
            let bounds = [
                (product_down(a, b), a * b, product_up(a, b)),
                (quotient_down(a, b), a / b, quotient_up(a, b)),
                (root(a.abs(), f64::next_down), libm::sqrt(a.abs()), root(a.abs(), f64::next_up)),
            ];
            for (low, nearest, high) in bounds {
                prop_assert_eq!(low.to_bits(), nearest.next_down().to_bits());
                prop_assert_eq!(high.to_bits(), nearest.next_up().to_bits());
            }
            // Of a sum it is known which side was lost.
            let (low, high) = (sum_down(a, b), sum_up(a, b));
            prop_assert!(low <= a + b && a + b <= high);
            prop_assert!(low >= (a + b).next_down() && high <= (a + b).next_up());
            prop_assert!([low, high].map(f64::to_bits).contains(&(a + b).to_bits()));
        }
    }

    #[test]
    fn a_product_too_small_for_a_double_keeps_its_sign() {
        let tiny = f64::MIN_POSITIVE;
        assert!(product_down(tiny, tiny) == 0.0 && product_up(tiny, tiny) > 0.0);
        assert!(product_up(-tiny, tiny) == 0.0 && product_down(-tiny, tiny) < 0.0);
        assert!(quotient_down(tiny, 1e300) == 0.0 && quotient_up(-tiny, 1e300) == 0.0);
        assert!(root(0.0, f64::next_down) == 0.0);
    }
}
