/// What a [`ScanMap`](super::ScanMap) reckons with.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ScanMapConfig {
    /// The robot stands clear of walls by so much, m: its radius, less what the map's cells are
    /// coarse.
    pub radius: f64,
    /// Places lie at least so far apart, m.
    pub spacing_of_places: f64,
    /// Ground so near to where the robot has been, and in sight of there, needs no visit, m.
    pub reach_of_visit: f64,
    /// Scans that walls are drawn from lie at least so far apart, m.
    pub spacing_of_scans: f64,
    /// How far from where it is expected a scan is fitted to the walls at most, m; 0 leaves it
    /// where it is expected.
    pub farthest_fit: f64,
}

impl ScanMapConfig {
    /// Returns the values for a round robot of this diameter, m: places are a diameter apart.
    #[must_use]
    pub fn for_robot(diameter: f64) -> Self {
        Self {
            radius: 0.45 * diameter,
            spacing_of_places: diameter,
            reach_of_visit: 0.9 * diameter,
            spacing_of_scans: 0.4 * diameter,
            farthest_fit: 0.7 * diameter,
        }
    }
}
