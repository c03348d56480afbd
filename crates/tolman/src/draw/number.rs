//! Coordinates as short text.

/// A coordinate rounded to a tenth of a unit, without a needless `.0`. Coordinates that are not
/// finite are drawn at 0.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the cast saturates and NaN becomes 0"
)]
pub(super) fn tenths(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
    match rest {
        0 => format!("{sign}{whole}"),
        rest => format!("{sign}{whole}.{rest}"),
    }
}

#[cfg(test)]
mod tests {
    use super::tenths;

    #[test]
    fn short_and_without_negative_zero() {
        for (value, expect) in [
            (0.0, "0"),
            (-0.04, "0"),
            (-0.06, "-0.1"),
            (12.0, "12"),
            (12.34, "12.3"),
            (-3.96, "-4"),
            (f64::NAN, "0"),
        ] {
            assert_eq!(tenths(value), expect);
        }
    }
}
