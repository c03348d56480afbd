// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::string::String;
use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::{OutOfRange, POSITIVE, Pose};

use super::{Outline, OutlinePoint, PlaceGraph, PlaceGraphConfig};
use crate::pose_graph::{PoseEdge, PoseGraph, PoseGraphError};

const FORMAT: &str = "tolman-place-graph";
const VERSION: u32 = 1;

/// Contents of a place graph's file; works with any format of serde's. The robot's pose is left
/// out: the map comes back with a robot [put down](PlaceGraph::put_down) anywhere on it, and grows.
///
/// [`PlaceGraph`] itself is serialized in this form. Deserializing refuses invalid contents.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedPlaceGraph {
    format: String,
    version: u32,
    config: PlaceGraphConfig,
    places: Vec<SavedPlace>,
    edges: Vec<PoseEdge>,
    /// Pairs of places between which the robot went, the lower id first.
    links: Vec<(u32, u32)>,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedPlace {
    pose: Pose,
    outline: Outline,
}

/// Reason why a file holds no place graph.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SavedPlaceGraphError {
    /// The file has another format or version.
    #[error(
        "the format is {format:?}, version {version}; expected {FORMAT:?}, version {VERSION}: learn the map again"
    )]
    WrongFormat {
        /// Name of the format in the file.
        format: String,
        /// Version of the format in the file.
        version: u32,
    },
    /// A number of the configuration is invalid.
    #[error(transparent)]
    Config(#[from] OutOfRange),
    /// A place has an invalid number.
    #[error(
        "place {place} has a number that is not finite, or a deviation that is not positive: learn the map again"
    )]
    NotFinite {
        /// Id of the place.
        place: usize,
    },
    /// A link joins a place that does not exist.
    #[error(
        "places {from} and {to} are linked, but the number of places is {places}: learn the map again"
    )]
    Link {
        /// Id of the place at one end of the link.
        from: u32,
        /// Id of the place at the other end.
        to: u32,
        /// Number of places in the file.
        places: usize,
    },
    /// An edge is invalid.
    #[error(transparent)]
    Edge(#[from] PoseGraphError),
}

impl From<PlaceGraph> for SavedPlaceGraph {
    fn from(map: PlaceGraph) -> Self {
        let edges = map.graph.edges().to_vec();
        let places = map.graph.poses().iter().zip(map.places);
        let places = places.map(|(pose, outline)| SavedPlace {
            pose: *pose,
            outline,
        });
        Self {
            format: FORMAT.into(),
            version: VERSION,
            config: map.config,
            places: places.collect(),
            edges,
            links: map.links.into_iter().collect(),
        }
    }
}

impl TryFrom<SavedPlaceGraph> for PlaceGraph {
    type Error = SavedPlaceGraphError;

    fn try_from(saved: SavedPlaceGraph) -> Result<Self, SavedPlaceGraphError> {
        saved.check()?;
        let mut graph = PoseGraph::new();
        for place in &saved.places {
            graph.add_pose(place.pose);
        }
        for edge in saved.edges {
            graph.add_edge(edge)?;
        }
        let places = saved.places.into_iter().map(|place| place.outline);
        let links = saved.links.into_iter().collect();
        Ok(Self::restored(saved.config, places.collect(), graph, links))
    }
}

impl SavedPlaceGraph {
    fn check(&self) -> Result<(), SavedPlaceGraphError> {
        if self.format != FORMAT || self.version != VERSION {
            return Err(SavedPlaceGraphError::WrongFormat {
                format: self.format.clone(),
                version: self.version,
            });
        }
        let PlaceGraphConfig {
            place_distance,
            place_turn,
            scale_deviation,
            curvature_deviation,
            most_doubt,
            ..
        } = self.config;
        let positive = [
            ("place_distance", place_distance),
            ("place_turn", place_turn),
            ("scale_deviation", scale_deviation),
            ("curvature_deviation", curvature_deviation),
            ("most_doubt", most_doubt),
        ];
        for (field, value) in positive {
            OutOfRange::check(field, value, POSITIVE)?;
        }
        let is_sound =
            |place: &SavedPlace| place.pose.is_finite() && is_outline_sound(&place.outline);
        if let Some(place) = self.places.iter().position(|place| !is_sound(place)) {
            return Err(SavedPlaceGraphError::NotFinite { place });
        }
        let places = self.places.len();
        let lost = |(from, to): &&(u32, u32)| (*from).max(*to) as usize >= places;
        match self.links.iter().find(lost) {
            Some((from, to)) => Err(SavedPlaceGraphError::Link {
                from: *from,
                to: *to,
                places,
            }),
            None => Ok(()),
        }
    }
}

fn is_outline_sound(outline: &Outline) -> bool {
    let is_point_sound = |point: &OutlinePoint| {
        let normal = point.normal.unwrap_or_default();
        let colour = point.colour.unwrap_or_default();
        let position = point.position;
        let all = [
            position.x, position.y, normal.x, normal.y, colour[0], colour[1],
        ];
        all.iter().all(|number| number.is_finite())
            && point.deviation.is_finite()
            && point.deviation > 0.0
    };
    let mut points = outline.points.iter().chain(&outline.faced);
    let mut arcs = outline.arcs.iter();
    points.all(is_point_sound)
        && arcs.all(|arc| {
            let numbers = [arc.half_width, arc.range, arc.max_range];
            arc.mount.is_finite() && numbers.iter().all(|number| number.is_finite())
        })
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Point, Vector};
    use tolman_robot::Sounding;

    use super::*;

    fn outline() -> Outline {
        let point = OutlinePoint {
            position: Point::new(1.0, 2.0),
            normal: Some(Vector::x()),
            deviation: 0.1,
            colour: Some([0.3, 0.4]),
        };
        let arc = Sounding {
            mount: Pose::new(Point::new(0.1, 0.0), Heading::NORTH),
            half_width: 0.2,
            range: 1.0,
            max_range: 3.0,
        };
        Outline {
            points: [point].to_vec(),
            arcs: [arc].to_vec(),
            faced: [point].to_vec(),
        }
    }

    #[test]
    fn an_outline_is_sound_if_all_its_numbers_are() {
        assert!(is_outline_sound(&outline()));
        assert!(is_outline_sound(&Outline::default()));
        let mut bare = outline();
        (bare.points[0].normal, bare.points[0].colour) = (None, None);
        assert!(is_outline_sound(&bare));
        let spoil: [fn(&mut Outline, f64); 10] = [
            |outline, bad| outline.points[0].position.x = bad,
            |outline, bad| outline.points[0].position.y = bad,
            |outline, bad| outline.faced[0].normal = Some(Vector::new(0.0, bad)),
            |outline, bad| outline.points[0].colour = Some([0.1, bad]),
            |outline, bad| outline.faced[0].colour = Some([bad, 0.1]),
            |outline, bad| outline.faced[0].deviation = bad,
            |outline, bad| outline.arcs[0].mount.position.x = bad,
            |outline, bad| outline.arcs[0].half_width = bad,
            |outline, bad| outline.arcs[0].range = bad,
            |outline, bad| outline.arcs[0].max_range = bad,
        ];
        for (number, spoil) in spoil.into_iter().enumerate() {
            for bad in [f64::NAN, f64::INFINITY] {
                let mut outline = outline();
                spoil(&mut outline, bad);
                assert!(!is_outline_sound(&outline), "{number} {bad}");
            }
        }
        for deviation in [0.0, -0.1] {
            let mut outline = outline();
            outline.points[0].deviation = deviation;
            assert!(!is_outline_sound(&outline));
        }
    }
}
