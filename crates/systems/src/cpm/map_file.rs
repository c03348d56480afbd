use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_maps::cpm::{self, CpMap};

use super::common_patterns::CommonPatterns;
use super::preset::Preset;
use crate::{FileError, FileKind};

/// A learned map as it lies in a file, with the patterns it is written in: JSON, read back to the bit.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// The maze it was learned in.
    pub maze: String,
    /// The seed it was learned from.
    pub seed: u64,
    /// How the robot mapped.
    pub system: Preset,
    /// What it knew of patterns.
    pub patterns: CommonPatterns,
    /// The map.
    pub map: CpMap,
}

const KIND: FileKind = FileKind {
    format: cpm::MapFile::FORMAT,
    version: cpm::MapFile::VERSION,
    name: "map of CPM",
    command: "tolman cpm learn",
};

/// Why a file holds no map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// It is another kind of file, of a later time, or cut off; or it cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It holds another thing, or not all of it.
    #[error("its map cannot be read")]
    Map(#[from] cpm::MapFileError),
}

#[derive(Serialize, Deserialize)]
struct Body {
    /// It has the header.
    #[serde(flatten)]
    map: cpm::MapFile,
    maze: String,
    seed: u64,
    system: Preset,
    /// Of SOINN.
    units: u32,
    clusters: u32,
}

impl MapFile {
    /// The text of the file, with a line end.
    ///
    /// # Errors
    /// If the map was learned with other patterns, or cannot be written.
    pub fn to_json(&self) -> Result<String, MapFileError> {
        let body = Body {
            map: cpm::MapFile::of(&self.map, self.patterns.dictionary())?,
            maze: self.maze.clone(),
            seed: self.seed,
            system: self.system,
            units: self.patterns.unit_count(),
            clusters: self.patterns.cluster_count(),
        };
        Ok(KIND.write(&body)?)
    }

    /// Whether a text says that it is such a file, of whatever version, whole or cut off.
    #[must_use]
    pub fn is_one(text: &str) -> bool {
        KIND.claims(text)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MapFileError`] with the place and what to do about it.
    pub fn from_json(text: &str) -> Result<Self, MapFileError> {
        let body: Body = KIND.parse(text)?;
        let dictionary = body.map.dictionary()?;
        let map = body.map.map(&dictionary)?;
        Ok(Self {
            maze: body.maze,
            seed: body.seed,
            system: body.system,
            patterns: CommonPatterns::restored(dictionary, body.units, body.clusters),
            map,
        })
    }
}
