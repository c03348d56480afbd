use tolman_quantizers::GngConfig;

use super::FeatureWeights;

/// Parameters by which a place map learns.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PlaceMapConfig {
    /// The parameters of the growing neural gas.
    pub gng: GngConfig,
    /// Weight of each group of features.
    pub weights: FeatureWeights,
    /// Number of times that all records are learned in order (default 3: "which was done three
    /// times each run").
    pub passes: u32,
}

impl PlaceMapConfig {
    /// Returns the middle of the optimal ranges of Table 3.1, in the order of Fritzke's steps, and
    /// three passes.
    ///
    /// ```
    /// use tolman_maps::place_map::PlaceMapConfig;
    ///
    /// let config = PlaceMapConfig::paper();
    /// assert_eq!((config.gng.growth_period, config.passes), (575, 3));
    /// ```
    #[must_use]
    pub fn paper() -> Self {
        let mut gng = GngConfig::fritzke();
        gng.max_age = 103;
        gng.growth_period = 575;
        gng.split_factor = 0.5;
        gng.decay = 0.6;
        gng.max_units = 2125;
        gng.winner_rate = 0.66;
        gng.neighbour_rate = 0.046;
        Self::new(gng, FeatureWeights::paper())
    }

    /// Returns a configuration with three passes.
    #[must_use]
    pub const fn new(gng: GngConfig, weights: FeatureWeights) -> Self {
        Self {
            gng,
            weights,
            passes: 3,
        }
    }
}

impl Default for PlaceMapConfig {
    fn default() -> Self {
        Self::paper()
    }
}
