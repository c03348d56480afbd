use tolman_geom::floor_index;

/// Returns the brightness change of a surface at a point of the room, −1 to 1. Stains are at fixed
/// places, larger ones with smaller ones on top.
pub(super) fn stain(x: f64, y: f64, height: f64) -> f64 {
    0.6 * patch([x, y, height], 0.43, 1) + 0.4 * patch([x, y, height], 0.11, 2)
}

/// Returns a number for each cube of the room's space, −1 … 1. No wall at a round coordinate lies
/// between two cubes.
fn patch(point: [f64; 3], size: f64, layer: u32) -> f64 {
    let cube = point.map(|along| floor_index((along + 0.0737) / size) as u32);
    let mixed = cube.iter().fold(layer, |hash, index| mix(hash ^ index));
    f64::from(mixed) / f64::from(u32::MAX) * 2.0 - 1.0
}

/// Returns a permutation of all words without a visible pattern (the finalizer of MurmurHash3).
fn mix(mut word: u32) -> u32 {
    word = word.wrapping_add(0x9E37_79B9);
    word = (word ^ (word >> 16)).wrapping_mul(0x85EB_CA6B);
    word = (word ^ (word >> 13)).wrapping_mul(0xC2B2_AE35);
    word ^ (word >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stains_stay_where_they_are_and_average_out() {
        assert!((stain(1.0, 2.0, 0.3) - stain(1.0, 2.0, 0.3)).abs() < 1e-15);
        let along = (0..2000).map(|index| stain(f64::from(index) * 0.1, 0.0, 0.2));
        let values: Vec<f64> = along.collect();
        assert!(values.iter().all(|value| value.abs() <= 1.0));
        let mean = values.iter().sum::<f64>() / 2000.0;
        assert!(mean.abs() < 0.1, "{mean}");
        assert!(values.iter().any(|value| value.abs() > 0.5));
    }
}
