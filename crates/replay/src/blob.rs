//! Numbers as base64 of little-endian bytes.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Returns bytes as base64.
pub(super) fn bytes(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}

/// Returns numbers in single precision, four bytes each, as base64.
pub(super) fn floats(numbers: impl IntoIterator<Item = f64>) -> String {
    let all: Vec<u8> = numbers
        .into_iter()
        .flat_map(|number| (number as f32).to_le_bytes())
        .collect();
    bytes(&all)
}

/// Returns whole numbers as LEB128: groups of seven bits from the lowest, with the top bit set in
/// each byte but a number's last. A number below 128 takes one byte.
pub(super) fn numbers(numbers: impl IntoIterator<Item = u32>) -> String {
    let mut all = Vec::new();
    for mut number in numbers {
        while number >= 0x80 {
            all.push(number as u8 | 0x80);
            number >>= 7;
        }
        all.push(number as u8);
    }
    bytes(&all)
}

/// Returns ascending steps as [`numbers`], each minus the previous one.
pub(super) fn steps(steps: impl IntoIterator<Item = u32>) -> String {
    let mut before = 0;
    numbers(steps.into_iter().map(move |step| {
        let since = step - before;
        before = step;
        since
    }))
}

/// Returns whole numbers as [`numbers`], each minus the previous one, with the sign in the lowest
/// bit. A change by less than 64 takes one byte.
pub(super) fn changes(all: impl IntoIterator<Item = i32>) -> String {
    let mut before = 0_i32;
    numbers(all.into_iter().map(move |number| {
        let change = number.wrapping_sub(before);
        before = number;
        ((change << 1) ^ (change >> 31)) as u32
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_numbers_take_a_byte_and_large_ones_all_their_bits() {
        let decoded = |text: &str| STANDARD.decode(text).unwrap();
        assert_eq!(decoded(&numbers([0, 127])), [0, 127]);
        assert_eq!(decoded(&numbers([128, 300])), [0x80, 1, 0xac, 2]);
        assert_eq!(
            decoded(&numbers([u32::MAX])),
            [0xff, 0xff, 0xff, 0xff, 0x0f]
        );
        assert_eq!(decoded(&changes([3, 2, 2, 66])), [6, 1, 0, 0x80, 1]);
        assert_eq!(decoded(&changes([-64, -64])), [127, 0]);
        assert_eq!(decoded(&steps([5, 5, 7, 300])), [5, 0, 2, 0xa5, 2]);
    }
}
