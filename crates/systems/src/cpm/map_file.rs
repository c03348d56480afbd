// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_maps::cpm::{self, CpMap};

use super::common_patterns::CommonPatterns;
use super::mode::Mode;
use crate::{FileError, MapFiles, Origin, origin_of};

/// The files of the paper's system, and of the better one.
const PAPERS: MapFiles = MapFiles { system: "cpm" };
const BETTER: MapFiles = MapFiles {
    system: "cpm-better",
};

/// Contents of a learned map's file, with the patterns that the map uses. It is JSON and reads back
/// bit for bit.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// Maze, robot and seed of its origin.
    pub origin: Origin,
    /// Mode in which the robot mapped.
    pub mode: Mode,
    /// Patterns that the robot knew.
    pub patterns: CommonPatterns,
    /// The learned map.
    pub map: CpMap,
}

/// Reason why a file is not a map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The header or the JSON is invalid, names another system, or the map cannot be written as
    /// JSON.
    #[error(transparent)]
    File(#[from] FileError),
    /// The map is of another kind or incomplete.
    #[error("its map cannot be read; learn the map again")]
    Map(#[from] cpm::MapFileError),
}

#[derive(Serialize, Deserialize)]
struct Body {
    mode: Mode,
    /// Number of SOINN's units.
    units: u32,
    clusters: u32,
    #[serde(flatten)]
    map: cpm::MapFile,
}

impl MapFile {
    /// Returns the name of the system that learned the map.
    #[must_use]
    pub const fn system(&self) -> &'static str {
        self.files().system
    }

    const fn files(&self) -> MapFiles {
        match self.mode {
            Mode::Paper(_) => PAPERS,
            Mode::Reckoned(_) | Mode::Unlearned(_) => BETTER,
        }
    }

    /// Returns the text of the file, with a line end.
    ///
    /// # Errors
    /// If the map was learned with other patterns, or cannot be written.
    pub fn to_json(&self) -> Result<String, MapFileError> {
        let body = Body {
            mode: self.mode,
            units: self.patterns.unit_count,
            clusters: self.patterns.cluster_count,
            map: cpm::MapFile::of(&self.map, self.patterns.dictionary())?,
        };
        Ok(self.files().write(&self.origin, &body)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MapFileError`], with the place and the repair.
    pub fn from_json(text: &str) -> Result<Self, MapFileError> {
        let (system, _) = origin_of(text)?;
        let files = match system == PAPERS.system {
            true => PAPERS,
            false => BETTER,
        };
        let (origin, body): (_, Body) = files.read(text)?;
        let dictionary = body.map.dictionary()?;
        let map = body.map.map(&dictionary)?;
        Ok(Self {
            origin,
            mode: body.mode,
            patterns: CommonPatterns::restored(dictionary, body.units, body.clusters),
            map,
        })
    }
}
