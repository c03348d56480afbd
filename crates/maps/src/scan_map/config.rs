/// Parameters of a [`ScanMap`](super::ScanMap).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ScanMapConfig {
    /// Distance that the robot keeps from walls, m: its radius, minus the map's resolution.
    pub radius: f64,
    /// Minimum distance of two places, m.
    pub spacing_of_places: f64,
    /// Maximum distance from where the robot was observed, m, at which ground in sight counts as
    /// visited.
    pub reach_of_visit: f64,
    /// Minimum distance of scans from which walls are drawn, m.
    pub spacing_of_scans: f64,
    /// Maximum distance between the expected and the fitted position of a scan, m; 0 keeps the
    /// expected one.
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
