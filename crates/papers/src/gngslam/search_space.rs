//! Table 3.1: the parameters of a place map and their search spaces.

use rand::{Rng, RngExt};
use tolman_maps::place_map::{FeatureWeights, PlaceMapConfig};
use tolman_quantizers::GngConfig;

/// A parameter of a place map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parameter {
    /// Name of the parameter in the paper.
    pub(super) name: &'static str,
    /// Minimum and maximum of the parameter's search space.
    pub(super) space: (f64, f64),
    /// Minimum and maximum of the range that the paper calls optimal.
    pub(super) optimal: (f64, f64),
}

const fn parameter(name: &'static str, optimal: (f64, f64), space: (f64, f64)) -> Parameter {
    Parameter {
        name,
        space,
        optimal,
    }
}

/// Number of parameters.
pub(super) const COUNT: usize = 10;

/// Parameters of Table 3.1, row by row.
pub(super) const TABLE_3_1: [Parameter; COUNT] = [
    parameter("a_max", (95.0, 110.0), (1.0, 1000.0)),
    parameter("λ", (450.0, 700.0), (1.0, 1000.0)),
    parameter("α", (0.4, 0.6), (0.0, 0.9)),
    parameter("d", (0.57, 0.63), (0.1, 0.9)),
    parameter("n_max", (1250.0, 3000.0), (5.0, 10_000.0)),
    parameter("ε_b", (0.64, 0.68), (0.001, 0.9)),
    parameter("ε_n", (0.045, 0.047), (0.001, 0.9)),
    parameter("w_image", (0.62, 0.64), (0.0, 1.0)),
    parameter("w_odo", (0.3, 0.355), (0.0, 1.0)),
    parameter("w_sonar", (0.0, 0.5), (0.0, 1.0)),
];

/// Indices of λ and ε_b among the parameters.
pub(super) const LAMBDA: usize = 1;
pub(super) const WINNER_RATE: usize = 5;

/// A value for each parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters(pub(super) [f64; COUNT]);

impl Parameters {
    /// Draws values from the whole search space.
    pub(super) fn anywhere(rng: &mut impl Rng) -> Self {
        Self(TABLE_3_1.map(|parameter| {
            let (low, high) = parameter.space;
            rng.random_range(low..=high)
        }))
    }

    /// Draws values from a window around these. Its width is `share` of the search space, and it is
    /// cut off at the ends.
    pub(super) fn near(&self, share: f64, rng: &mut impl Rng) -> Self {
        let mut drawn = *self;
        for (value, parameter) in drawn.0.iter_mut().zip(TABLE_3_1) {
            let (low, high) = parameter.space;
            let reach = 0.5 * share * (high - low);
            *value = rng.random_range((*value - reach).max(low)..=(*value + reach).min(high));
        }
        drawn
    }

    /// Returns the same values, except that `parameter` has the value `value`.
    pub(super) fn with(mut self, parameter: usize, value: f64) -> Self {
        self.0[parameter] = value;
        self
    }

    /// Returns the map's configuration, with rounded counts. The sonar has weight 0 if it is not a
    /// feature.
    pub(super) fn config(&self, with_sonar: bool) -> PlaceMapConfig {
        let [
            age,
            lambda,
            alpha,
            decay,
            units,
            winner,
            neighbour,
            image,
            odometry,
            sonar,
        ] = self.0;
        let count = |value: f64| libm::round(value) as u32;
        let mut gng = GngConfig::fritzke();
        gng.max_age = count(age);
        gng.growth_period = count(lambda);
        gng.split_factor = alpha;
        gng.decay = decay;
        gng.max_units = count(units) as usize;
        gng.winner_rate = winner;
        gng.neighbour_rate = neighbour;
        let weights = FeatureWeights {
            image,
            odometry,
            sonar: if with_sonar { sonar } else { 0.0 },
        };
        PlaceMapConfig::new(gng, weights)
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    #[test]
    fn the_paper_s_configuration_is_the_middle_of_its_ranges() {
        let middle = TABLE_3_1.map(|parameter| 0.5 * (parameter.optimal.0 + parameter.optimal.1));
        assert_eq!(Parameters(middle).config(true), PlaceMapConfig::paper());
    }

    #[test]
    fn windows_shrink_and_stay_in_the_search_space() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for share in [1.0, 0.1, 0.009] {
            for _ in 0..1000 {
                let from = Parameters::anywhere(&mut rng);
                let near = from.near(share, &mut rng);
                for ((a, b), parameter) in from.0.iter().zip(near.0).zip(TABLE_3_1) {
                    let (low, high) = parameter.space;
                    assert!((low..=high).contains(&b));
                    assert!((a - b).abs() <= 0.5 * share * (high - low) + 1e-9);
                }
            }
        }
    }
}
