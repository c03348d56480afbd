//! Occupancy grids of ROS `map_server`, as its page says:
//! <https://wiki.ros.org/map_server> ("Map format", "Value interpretation").

mod grey_map;
mod header;
mod writer;

use std::path::{Path, PathBuf};

use thiserror::Error;
use tolman_geom::Point;

use crate::input::{self, SourceError};

pub use grey_map::{GreyMap, GreyMapError};
pub use header::{RosMapHeader, RosMapHeaderError};

/// An occupancy grid.
#[derive(Clone, Debug, PartialEq)]
pub struct RosMap {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Size of a cell, m.
    pub resolution: f64,
    /// Position of the south-west corner of the grid, m.
    pub origin: Point,
    /// State of each cell, row by row from the south-west.
    pub cells: Vec<MapCell>,
}

/// State of a cell of an occupancy grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapCell {
    /// The cell is floor.
    Free,
    /// The cell holds a wall or another obstacle.
    Occupied,
    /// The cell is unknown.
    Unknown,
}

/// Reason why an occupancy grid cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RosMapError {
    /// The YAML file or the picture cannot be read.
    #[error("cannot read {}; give a .yaml of map_server with its picture beside it", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Reason why the file cannot be read.
        source: SourceError,
    },
    /// The YAML file is not UTF-8 text.
    #[error("{}: byte {byte} is not UTF-8 text; give the .yaml, not its picture", path.display())]
    Text {
        /// Path of the file.
        path: PathBuf,
        /// Offset of the first byte that is not UTF-8, from 0.
        byte: usize,
    },
    /// The YAML file is not that of a map.
    #[error("{}", path.display())]
    Header {
        /// Path of the file.
        path: PathBuf,
        /// Fault of the file, with its place.
        source: RosMapHeaderError,
    },
    /// The picture is not a grey PGM.
    #[error("{}", path.display())]
    Picture {
        /// Path of the file.
        path: PathBuf,
        /// Fault of the picture, with its place.
        source: GreyMapError,
    },
}

impl RosMap {
    /// Reads the map whose YAML file lies at `path`. A relative path of the picture is relative to
    /// the YAML file's folder.
    ///
    /// # Errors
    /// [`RosMapError`] with the file, and the line or byte at fault.
    pub fn read(path: &Path) -> Result<Self, RosMapError> {
        let (header, path) = Self::header(path)?;
        let picture = GreyMap::parse(&load(&path)?);
        let picture = picture.map_err(|source| RosMapError::Picture { path, source })?;
        Ok(Self::of(&header, &picture))
    }

    /// Reads the YAML file at `path`, and returns it with the path of its picture.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn header(path: &Path) -> Result<(RosMapHeader, PathBuf), RosMapError> {
        let bytes = load(path)?;
        let text = core::str::from_utf8(&bytes).map_err(|error| RosMapError::Text {
            path: path.to_owned(),
            byte: error.valid_up_to(),
        })?;
        let header = RosMapHeader::parse(text).map_err(|source| RosMapError::Header {
            path: path.to_owned(),
            source,
        })?;
        let picture = path.with_file_name(&header.image);
        Ok((header, picture))
    }

    /// Returns the occupancy grid of a `header` and its `picture`, whose first row is the
    /// northernmost. O(pixels).
    #[must_use]
    pub fn of(header: &RosMapHeader, picture: &GreyMap) -> Self {
        let most = f64::from(picture.most);
        let rows = picture.values.chunks(picture.width.max(1)).rev();
        let values = rows.flatten().map(|value| f64::from(*value) / most);
        Self {
            width: picture.width,
            height: picture.height,
            resolution: header.resolution,
            origin: header.origin,
            cells: values.map(|light| header.cell(light)).collect(),
        }
    }
}

fn load(path: &Path) -> Result<Vec<u8>, RosMapError> {
    input::bytes(path).map_err(|source| RosMapError::File {
        path: path.to_owned(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_s_last_row_is_the_southernmost() {
        let yaml = "image: a.pgm\nresolution: 0.1\norigin: [-1, 2, 0]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\n";
        let header = RosMapHeader::parse(yaml).unwrap();
        let picture = GreyMap::parse(b"P2\n2 2\n255\n254 0\n205 254\n").unwrap();
        let map = RosMap::of(&header, &picture);
        use MapCell::{Free, Occupied, Unknown};
        assert_eq!(map.cells, [Unknown, Free, Free, Occupied]);
        assert_eq!(map.origin, Point::new(-1.0, 2.0));
    }

    #[test]
    fn a_file_that_is_not_there_is_named() {
        let error = RosMap::read(Path::new("nowhere/hall.yaml")).unwrap_err();
        assert!(error.to_string().contains("nowhere/hall.yaml"), "{error}");
    }
}
