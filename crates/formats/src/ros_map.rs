//! Occupancy grids of ROS `map_server`, as its page says:
//! <https://wiki.ros.org/map_server> ("Map format", "Value interpretation").

mod grey_map;
mod header;
mod writer;

use std::path::{Path, PathBuf};

use thiserror::Error;
use tolman_geom::{Heading, Point, Vector};

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
    /// The picture is neither a grey PGM nor a PNG.
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
    /// northernmost. A turned picture is drawn again, turned, each cell as the picture has it at
    /// the cell's middle. O(pixels).
    #[must_use]
    pub fn of(header: &RosMapHeader, picture: &GreyMap) -> Self {
        let most = f64::from(picture.most);
        let rows = picture.values.chunks(picture.width.max(1)).rev();
        let values = rows.flatten().map(|value| f64::from(*value) / most);
        let map = Self {
            width: picture.width,
            height: picture.height,
            resolution: header.resolution,
            origin: header.origin,
            cells: values.map(|light| header.cell(light)).collect(),
        };
        match header.yaw.abs() > 1e-9 {
            true => map.turned(Heading::from_radians(header.yaw)),
            false => map,
        }
    }

    /// Returns the map turned about its south-west corner.
    fn turned(&self, by: Heading) -> Self {
        let size = Vector::new(self.width as f64, self.height as f64);
        let corners = [(0.0, 0.0), (size.x, 0.0), (0.0, size.y), (size.x, size.y)];
        let corners = corners.map(|(x, y)| by.rotate(Vector::new(x, y)));
        let low = corners
            .iter()
            .fold(Vector::zeros(), |low, corner| low.inf(corner));
        let high = corners
            .iter()
            .fold(Vector::zeros(), |high, corner| high.sup(corner));
        let low = low.map(|side| libm::floor(side + ROUNDING));
        // The diagonal of a picture is not much longer than its sides.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole and positive"
        )]
        let [width, height] =
            [high.x - low.x, high.y - low.y].map(|side| libm::ceil(side - ROUNDING) as usize);
        let back = Heading::from_radians(-by.radians());
        let cell = |index: usize| {
            let middle = Vector::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            let at = back.rotate(low + middle).map(libm::floor);
            let inside = (0.0..size.x).contains(&at.x) && (0.0..size.y).contains(&at.y);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "inside"
            )]
            let found = inside.then(|| self.cells.get(at.y as usize * self.width + at.x as usize));
            found.flatten().copied().unwrap_or(MapCell::Unknown)
        };
        Self {
            width,
            height,
            resolution: self.resolution,
            origin: self.origin + low * self.resolution,
            cells: (0..width * height).map(cell).collect(),
        }
    }
}

/// Part of a cell that is neglected where a turned map ends.
const ROUNDING: f64 = 1e-6;

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
    fn a_turned_picture_is_turned_about_its_corner() {
        let yaml = "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 1.5707963267948966]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\n";
        let header = RosMapHeader::parse(yaml).unwrap();
        let picture = GreyMap::parse(b"P2\n3 1\n255\n254 0 205\n").unwrap();
        let map = RosMap::of(&header, &picture);
        use MapCell::{Free, Occupied, Unknown};
        assert_eq!((map.width, map.height), (1, 3));
        assert_eq!(map.cells, [Free, Occupied, Unknown]);
        assert_eq!(map.origin, Point::new(0.5, 2.0));
    }

    #[test]
    fn a_file_that_is_not_there_is_named() {
        let error = RosMap::read(Path::new("nowhere/hall.yaml")).unwrap_err();
        assert!(error.to_string().contains("nowhere/hall.yaml"), "{error}");
    }
}
