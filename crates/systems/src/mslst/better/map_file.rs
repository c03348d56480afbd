// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::{OutOfRange, Point};
use tolman_maps::scan_map::{ChartError, ChartParts, ScanChart};

use super::BetterConfig;
use crate::{FileError, MapFiles, Origin};

const FILES: MapFiles = MapFiles {
    system: "mslst-better",
};

/// Contents of the better system's map file: JSON, read back bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct BetterMapFile {
    /// Maze, robot and seed of its origin.
    pub origin: Origin,
    /// Configuration of the system.
    pub config: BetterConfig,
    /// Map that the robot learned.
    pub chart: ScanChart,
    /// True position of the robot when each place was made, m, for pictures and for checks of the
    /// map alone; empty if unknown.
    pub sites: Vec<Point>,
}

/// Reason why a file holds no map of the better system.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BetterMapFileError {
    /// The header or the JSON is invalid, names another system, or the map cannot be written as
    /// JSON.
    #[error(transparent)]
    File(#[from] FileError),
    /// The configuration fits no robot.
    #[error("its configuration is invalid; learn the map again")]
    Config(#[from] OutOfRange),
    /// The map is invalid.
    #[error("its chart is invalid; learn the map again")]
    Chart(#[from] ChartError),
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
    /// A true position is invalid.
    #[error("the true position of place {place}, ({}, {}) m, is invalid: learn the map again", at.x, at.y)]
    Site {
        /// Number of the place.
        place: usize,
        /// The position, m.
        at: Point,
    },
}

#[derive(Serialize, Deserialize)]
struct Body {
    config: BetterConfig,
    chart: ChartParts,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    sites: Vec<Point>,
}

impl BetterMapFile {
    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// [`BetterMapFileError::File`] if it cannot be written.
    pub fn to_json(&self) -> Result<String, BetterMapFileError> {
        let body = Body {
            config: self.config,
            chart: self.chart.to_parts(),
            sites: self.sites.clone(),
        };
        Ok(FILES.write(&self.origin, &body)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`BetterMapFileError`] with the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, BetterMapFileError> {
        let (origin, body): (_, Body) = FILES.read(text)?;
        body.config.check()?;
        let chart = ScanChart::from_parts(body.chart)?;
        check_sites(&body.sites, chart.places().len())?;
        Ok(Self {
            origin,
            config: body.config,
            chart,
            sites: body.sites,
        })
    }
}

/// Refuses sites that are not finite, or not one for each place.
fn check_sites(sites: &[Point], places: usize) -> Result<(), BetterMapFileError> {
    let found = sites.len();
    if found != 0 && found != places {
        return Err(BetterMapFileError::Sites { found, places });
    }
    let is_nowhere = |at: &Point| !at.coords.iter().all(|along| along.is_finite());
    match sites.iter().enumerate().find(|(_, at)| is_nowhere(at)) {
        Some((place, at)) => Err(BetterMapFileError::Site { place, at: *at }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Vector};
    use tolman_maps::scan_map::{Advance, ScanMap, ScanMapConfig};
    use tolman_robot::{Landmark, Ring, Scan};

    use super::*;

    /// Returns a map of two places in a square room.
    fn file() -> BetterMapFile {
        let mut map = ScanMap::new(ScanMapConfig::for_robot(0.5));
        let mut scan = Scan::clear(Ring::full(72, 1.25));
        scan.ranges.fill(0.7);
        for moved in [0.0, 0.6] {
            map.observe(&Advance {
                moved: Vector::new(moved, 0.0),
                sd: Vector::new(0.01, 0.01),
                heading: Heading::EAST,
                scan: &scan,
                landmark: (moved > 0.1).then_some(Landmark::Goal),
                walls_change: false,
            });
        }
        BetterMapFile {
            origin: Origin {
                world: "room".to_owned(),
                drawing: Some("5f1".to_owned()),
                robot: "laser Pioneer".to_owned(),
                seed: 3,
            },
            config: BetterConfig::pioneer(),
            chart: map.chart(),
            sites: vec![Point::new(1.0 / 3.0, 2.0); map.places().len()],
        }
    }

    #[test]
    fn a_file_comes_back() {
        let file = file();
        let nobody_watched = BetterMapFile {
            sites: Vec::new(),
            ..file.clone()
        };
        for file in [file, nobody_watched] {
            let text = file.to_json().unwrap();
            let read = BetterMapFile::from_json(&text).unwrap();
            assert_eq!(read, file);
            assert_eq!(read.to_json().unwrap(), text);
        }
    }

    #[test]
    fn a_file_that_is_not_sound_is_refused() {
        let text = file().to_json().unwrap();
        let cases = [
            (
                "\"corridor_width\":0.95",
                "\"corridor_width\":-1",
                "`corridor_width` is -1",
            ),
            (
                "\"corridor_width\":0.95",
                "\"width\":0.95",
                "unknown field `width`",
            ),
            ("\"cell\":0.05", "\"cell\":0.5", "cells are 0.5 m"),
            ("\"first\":[", "\"first\":[-99999999,", "cannot be read"),
            (
                "\"sites\":[",
                "\"sites\":[[0,0],[0,0],[0,0],",
                "number of true positions",
            ),
            ("mslst-better", "mslst", "this is a map of mslst"),
            ("\"rows\":[\"", "\"rows\":[\"?", "row 0"),
        ];
        for (sound, hostile, expect) in cases {
            let spoiled = text.replacen(sound, hostile, 1);
            assert_ne!(spoiled, text, "{sound}");
            let refused = with_causes(&BetterMapFile::from_json(&spoiled).unwrap_err());
            assert!(refused.contains(expect), "{refused} for {expect}");
        }
        // Cut off anywhere, it is refused.
        for end in (0..text.len()).step_by(97) {
            assert!(BetterMapFile::from_json(&text[..end]).is_err());
        }
    }

    /// Returns an error with all its causes.
    fn with_causes(error: &dyn core::error::Error) -> String {
        let mut told = error.to_string();
        let mut source = error.source();
        while let Some(error) = source {
            told = format!("{told}: {error}");
            source = error.source();
        }
        told
    }
}
