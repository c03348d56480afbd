use tolman_geom::{Point, Vector};
use tolman_maps::place_graph::PlaceGraph;
use tolman_robot::Landmark;

use super::route::Target;

/// Position where a landmark was sensed, beside a place of a map.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LandmarkSighting {
    /// Landmark that was sensed.
    pub landmark: Landmark,
    /// Place nearest to the position where the landmark was sensed.
    pub place: u32,
    /// Position at which the landmark was sensed, in the place's frame, m.
    pub at: Point,
}

impl LandmarkSighting {
    /// Returns the point where it was sensed, in the map's frame; `None` if the map has no such
    /// place.
    fn target(&self, map: &PlaceGraph) -> Option<Target> {
        let place = map.poses().poses().get(self.place as usize)?;
        Some(Target {
            place: self.place,
            point: place.transform(self.at),
        })
    }
}

/// Returns the target at which to sense a landmark again: the sighting nearest to the middle of
/// all. Places in `tried`, where the robot came back and did not sense it, are left out. `None` if
/// there are no others. O(sightings).
pub(super) fn amid(
    sightings: &[LandmarkSighting],
    wanted: Landmark,
    tried: &[u32],
    map: &PlaceGraph,
) -> Option<Target> {
    let of_wanted = sightings
        .iter()
        .filter(|sighting| sighting.landmark == wanted && !tried.contains(&sighting.place));
    let targets: Vec<Target> = of_wanted
        .filter_map(|sighting| sighting.target(map))
        .collect();
    let sum = |sum: Vector, target: &Target| sum + target.point.coords;
    let middle = targets.iter().fold(Vector::zeros(), sum) / targets.len().max(1) as f64;
    let off = |target: &Target| (target.point.coords - middle).norm_squared();
    targets.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)))
}
