use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::place_graph::PlaceGraph;

/// A place graph laid over the world by the robot's true positions when each place was made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaidOver {
    /// Pose of the map's origin in the world.
    pub world_from_map: Pose,
    /// Root-mean-square distance of the places from their true positions, m.
    pub error_m: f64,
}

impl LaidOver {
    /// Lays a map over the world with the least squared distances of its places from `sites`, their
    /// true positions. `None` for an empty map, or if there are not as many sites as places.
    /// O(places).
    #[must_use]
    pub fn of(map: &PlaceGraph, sites: &[Point]) -> Option<Self> {
        let places = map.poses().poses().iter();
        Self::of_places(places.map(|pose| pose.position), sites)
    }

    /// Lays any map over the world by the positions of its places, in order of id.
    #[must_use]
    pub fn of_places(
        places: impl ExactSizeIterator<Item = Point>,
        sites: &[Point],
    ) -> Option<Self> {
        if places.len() == 0 || places.len() != sites.len() {
            return None;
        }
        let pairs: Vec<(Point, Point)> = places.zip(sites.iter().copied()).collect();
        let world_from_map = rigid_motion(&pairs);
        let off = |(place, site): &(Point, Point)| {
            (world_from_map.transform(*place) - site).norm_squared()
        };
        let sum: f64 = pairs.iter().map(off).sum();
        Some(Self {
            world_from_map,
            error_m: libm::sqrt(sum / pairs.len() as f64),
        })
    }
}

/// Returns the rigid motion that brings the first points of all pairs nearest to the second.
///
/// Source: S. Umeyama: Least-Squares Estimation of Transformation Parameters, 1991, in the plane
/// and without scale.
pub(crate) fn rigid_motion(pairs: &[(Point, Point)]) -> Pose {
    let count = pairs.len().max(1) as f64;
    let sum = |sum: (Vector, Vector), (from, to): &(Point, Point)| {
        (sum.0 + from.coords, sum.1 + to.coords)
    };
    let (from, to) = pairs.iter().fold((Vector::zeros(), Vector::zeros()), sum);
    let (from, to) = (from / count, to / count);
    let (mut along, mut across) = (0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a.coords - from, b.coords - to);
        along += a.dot(&b);
        across += a.perp(&b);
    }
    let heading = Heading::from_radians(libm::atan2(across, along));
    Pose::new(Point::from(to - heading.rotate(from)), heading)
}
