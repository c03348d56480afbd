use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_maps::cpm::{self, CpMap, CpmConfig};

use super::common_patterns::CommonPatterns;
use super::trial::Mode;

/// A learned map as it lies in a file, with the patterns it is written in: JSON, read back to the bit.
#[derive(Clone, Debug)]
pub struct MapFile {
    /// The maze it was learned in.
    pub maze: String,
    /// The seed it was learned from.
    pub seed: u64,
    /// How the robot mapped.
    pub system: System,
    /// What it knew of patterns.
    pub patterns: CommonPatterns,
    /// The map.
    pub map: CpMap,
}

/// The ways of mapping that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum System {
    /// The paper's, online.
    Faithful,
    /// Ours: with dead reckoning, for fragments that look alike too.
    Better,
}

impl System {
    /// How it maps.
    #[must_use]
    pub const fn mode(self) -> Mode {
        match self {
            Self::Faithful => Mode::Paper(CpmConfig::online()),
            Self::Better => Mode::Reckoned(CpmConfig::robust()),
        }
    }
}

/// Why a file holds no map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// It is no JSON of the right form. The message has line and column.
    #[error("this is no map of CPM: make one with `tolman cpm learn`")]
    Json(#[from] serde_json::Error),
    /// It ends amid the map. The message has line and column.
    #[error("this map of CPM is cut off: copy it again, or make one with `tolman cpm learn`")]
    CutOff(#[source] serde_json::Error),
    /// It holds another thing, or not all of it.
    #[error("its map cannot be read")]
    Map(#[from] cpm::MapFileError),
}

#[derive(Serialize, Deserialize)]
struct Body {
    maze: String,
    seed: u64,
    system: System,
    /// Of SOINN.
    units: u32,
    clusters: u32,
    #[serde(flatten)]
    map: cpm::MapFile,
}

impl MapFile {
    /// The text of the file, with a line end.
    ///
    /// # Errors
    /// If the map was learned with other patterns.
    pub fn to_json(&self) -> Result<String, MapFileError> {
        let body = Body {
            maze: self.maze.clone(),
            seed: self.seed,
            system: self.system,
            units: self.patterns.unit_count(),
            clusters: self.patterns.cluster_count(),
            map: cpm::MapFile::of(&self.map, self.patterns.dictionary())?,
        };
        Ok(serde_json::to_string(&body)? + "\n")
    }

    /// Whether a text says that it is such a file, of whatever version, whole or cut off.
    #[must_use]
    pub fn is_one(text: &str) -> bool {
        let header: Result<cpm::MapFileHeader, _> = serde_json::from_str(text);
        header.map_or_else(
            |_| cpm::MapFileHeader::is_named_in(text),
            |header| header.is_ours(),
        )
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MapFileError`] with the place and what to do about it.
    pub fn from_json(text: &str) -> Result<Self, MapFileError> {
        let header: Result<cpm::MapFileHeader, _> = serde_json::from_str(text);
        match header {
            Ok(header) => header.check()?,
            Err(error) if error.is_eof() && cpm::MapFileHeader::is_named_in(text) => {
                return Err(MapFileError::CutOff(error));
            }
            Err(error) => return Err(error.into()),
        }
        let body: Body = serde_json::from_str(text)?;
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
