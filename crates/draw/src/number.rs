//! Coordinates and labels as short text.

/// Returns a coordinate rounded to a tenth of a unit, without a needless `.0`. Coordinates that are
/// not finite are drawn at 0.
pub(super) fn tenths(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
    match rest {
        0 => format!("{sign}{whole}"),
        rest => format!("{sign}{whole}.{rest}"),
    }
}

/// Returns path data of a line through `places`; empty if there are none.
pub(super) fn line(places: impl IntoIterator<Item = (f64, f64)>) -> String {
    joined(&places.into_iter().map(place).collect::<Vec<_>>())
}

/// Returns path data of a line through `places`, without those that round to the same point as the
/// one before.
pub(super) fn short_line(places: impl IntoIterator<Item = (f64, f64)>) -> String {
    let mut places: Vec<String> = places.into_iter().map(place).collect();
    places.dedup();
    joined(&places)
}

fn place((x, y): (f64, f64)) -> String {
    format!("{} {}", tenths(x), tenths(y))
}

fn joined(places: &[String]) -> String {
    match places.is_empty() {
        true => String::new(),
        false => format!("M{}", places.join("L")),
    }
}

/// Returns `value` with at most `decimals` decimals and no trailing zeros.
pub(super) fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns the minimum and the maximum of `values` and of `extent`.
pub(super) fn extent(values: impl Iterator<Item = f64>, extent: (f64, f64)) -> (f64, f64) {
    values.fold(extent, |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// Empty range: every value is above its high end and below its low end.
pub(super) const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// Returns the label of a value on an axis whose labels are `step` apart. It has as many decimals
/// as that needs, groups of three digits, and powers of ten for long numbers.
pub(super) fn tick_label(value: f64, step: f64) -> String {
    let exponent = libm::log10(step.abs()).floor();
    if exponent >= 5.0 && value.abs() > 0.0 {
        return power_of_ten(value, libm::log10(value.abs()).floor());
    }
    if exponent < -4.0 {
        return power_of_ten(value, exponent);
    }
    let decimals = (-exponent).clamp(0.0, 4.0) as usize;
    grouped(&format!("{value:.decimals$}"))
}

/// Returns a power of ten in the form `2·10⁵`, `10⁻⁶`, `0`.
pub(super) fn power_of_ten(value: f64, exponent: f64) -> String {
    let factor = value / libm::pow(10.0, exponent);
    let digits = exponent.abs().to_string();
    let superscript = digits.chars().map(|digit| match digit {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        // The other superscript digits are consecutive.
        digit => char::from_u32(0x2070 + u32::from(digit) - u32::from('0')).unwrap_or(digit),
    });
    let sign = if exponent < 0.0 { "⁻" } else { "" };
    let power = format!("10{sign}{}", superscript.collect::<String>());
    match factor {
        factor if factor.abs() < 1e-9 => "0".to_owned(),
        factor if (factor - 1.0).abs() < 1e-9 => power,
        factor => format!("{}·{power}", tenths(factor)),
    }
}

/// Returns a number with thin spaces between the groups of three digits of a long whole part.
fn grouped(number: &str) -> String {
    let whole = number.find('.').unwrap_or(number.len());
    let digits = number[..whole].trim_start_matches('-').len();
    if digits < 5 {
        return number.to_owned();
    }
    let mut text = String::new();
    for (i, c) in number.char_indices() {
        let left = whole.saturating_sub(i);
        if i > whole - digits && left > 0 && left.is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(c);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn labels_have_the_decimals_of_their_step() {
        for (value, step, expect) in [
            (150.0, 50.0, "150"),
            (0.25, 0.05, "0.25"),
            (1.0, 0.2, "1.0"),
            (-0.2, 0.2, "-0.2"),
            (20000.0, 5000.0, "20\u{202f}000"),
            (-1_500_000.0, 50_000.0, "-1\u{202f}500\u{202f}000"),
            (2e6, 1e6, "2·10⁶"),
            (0.0, 1e6, "0"),
            (3e-6, 1e-6, "3·10⁻⁶"),
            (1e12, 1e12, "10¹²"),
        ] {
            assert_eq!(tick_label(value, step), expect);
        }
    }
}
