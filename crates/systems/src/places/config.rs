use tolman_maps::scan_matching::ScanMatchingConfig;

/// Parameters of a [`PlacesMapper`](super::PlacesMapper).
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct PlacesConfig {
    /// Matching of scans and comparison of places.
    pub matching: ScanMatchingConfig,
    /// Width of corridors, m.
    pub corridor_width: f64,
    /// Number of later keyframes before one is judged, so that the ground ahead has been seen.
    pub lag: usize,
    /// Minimum length of a way without a corridor that makes a place, m.
    pub least_way: f64,
    /// Length of a way without a corridor after which another place begins, m.
    pub most_way: f64,
    /// Minimum length of the way before a place can be recognized again, m.
    pub least_absence: f64,
    /// Maximum distance of places that may be one, m, in addition to the uncertainty of the way.
    pub apart: f64,
    /// Maximum number of places that one is compared with, the nearest first.
    pub most_compared: usize,
}

impl PlacesConfig {
    /// Returns the values for corridors of offices.
    #[must_use]
    pub fn indoor() -> Self {
        Self {
            matching: ScanMatchingConfig::places(),
            corridor_width: 2.0,
            lag: 6,
            least_way: 0.5,
            most_way: 3.0,
            least_absence: 8.0,
            apart: 1.5,
            most_compared: 3,
        }
    }

    /// Returns the same configuration for a mapper that leaves the recognition of places to another
    /// mapper.
    #[must_use]
    pub const fn unrecognized(mut self) -> Self {
        self.most_compared = 0;
        self
    }
}
