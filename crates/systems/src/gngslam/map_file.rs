// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::Point;
use tolman_maps::place_graph::PlaceGraph;

use super::{LandmarkSighting, OnlineSlamConfig};
use crate::{FileError, MapFiles, Origin};

const FILES: MapFiles = MapFiles {
    system: "gng-slam-better",
};

/// Contents of a learned map's file: JSON, read back bit for bit, without the robot's pose.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MapFile {
    /// Maze, robot and seed of its origin.
    #[serde(skip)]
    pub origin: Origin,
    /// Configuration with which the map was learned.
    pub config: OnlineSlamConfig,
    /// The map, on which a robot may stand anywhere.
    pub graph: PlaceGraph,
    /// Positions where landmarks were sensed.
    pub sightings: Vec<LandmarkSighting>,
    /// True position of the robot when each place was made, m, for pictures and for checks of the
    /// map alone; empty if unknown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sites: Vec<Point>,
}

/// Reason why a file holds no map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The header or the JSON is invalid, names another system, or the map cannot be written as
    /// JSON.
    #[error(transparent)]
    File(#[from] FileError),
    /// A landmark was sensed at a place that does not exist.
    #[error(
        "a landmark was sensed at place {place}, which does not exist; the number of places is {places}: learn the map again"
    )]
    Sighting {
        /// Number of the place.
        place: u32,
        /// Number of places.
        places: usize,
    },
    /// The number of true positions differs from that of places.
    #[error(
        "the number of true positions is {found}, but that of places is {places}: learn the map again"
    )]
    Sites {
        /// Number of true positions.
        found: usize,
        /// Number of places.
        places: usize,
    },
}

impl MapFile {
    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// [`MapFileError::File`] if it cannot be written.
    pub fn to_json(&self) -> Result<String, MapFileError> {
        Ok(FILES.write(&self.origin, self)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MapFileError`] with the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, MapFileError> {
        let (origin, file): (_, Self) = FILES.read(text)?;
        let places = file.graph.places().len();
        let lost = |sighting: &&LandmarkSighting| sighting.place as usize >= places;
        if let Some(LandmarkSighting { place, .. }) = file.sightings.iter().find(lost) {
            let place = *place;
            return Err(MapFileError::Sighting { place, places });
        }
        let found = file.sites.len();
        if found != 0 && found != places {
            return Err(MapFileError::Sites { found, places });
        }
        Ok(Self { origin, ..file })
    }
}

#[cfg(test)]
mod tests {
    use tolman_maps::place_graph::SeenThere;
    use tolman_robot::{Landmark, Mapper};

    use super::*;

    fn file(place: u32, sites: usize) -> MapFile {
        let config = OnlineSlamConfig::pioneer_2dx();
        let mut graph = PlaceGraph::new(config.map);
        graph.observe(&SeenThere::default()).unwrap();
        let sighting = LandmarkSighting {
            landmark: Landmark::Goal,
            place,
            at: Point::new(0.1, 0.2),
        };
        MapFile {
            origin: Origin {
                world: "room".to_owned(),
                drawing: None,
                robot: "Pioneer 2-DX".to_owned(),
                seed: 3,
            },
            config,
            graph,
            sightings: vec![sighting],
            sites: vec![Point::new(1.0, 2.0); sites],
        }
    }

    #[test]
    fn a_file_comes_back() {
        for sites in [0, 1] {
            let file = file(0, sites);
            let text = file.to_json().unwrap();
            let read = MapFile::from_json(&text).unwrap();
            assert_eq!(read.origin, file.origin);
            assert_eq!(read.config, file.config);
            assert_eq!(read.sightings, file.sightings);
            assert_eq!(read.sites, file.sites);
            assert_eq!(read.graph.poses(), file.graph.poses());
            assert_eq!(read.to_json().unwrap(), text);
        }
    }

    #[test]
    fn places_that_are_not_there_are_refused() {
        for (file, expect) in [
            (
                file(7, 1),
                "sensed at place 7, which does not exist; the number of places is 1",
            ),
            (
                file(0, 2),
                "the number of true positions is 2, but that of places is 1",
            ),
        ] {
            let text = file.to_json().unwrap();
            let told = MapFile::from_json(&text).unwrap_err().to_string();
            assert!(told.contains(expect), "{told}");
        }
    }
}
