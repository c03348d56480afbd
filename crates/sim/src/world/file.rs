//! World files: JSON, version 1.
//!
//! ```json
//! {"format": "tolman-world", "version": 1,
//!  "polylines": [{"points": [[0, 0], [4, 0], [4, 3], [0, 3]], "closed": true}],
//!  "walls": [{"start": [2, 0], "end": [2, 1]}],
//!  "zones": [{"name": "destination", "areas": [{"disc": {"centre": [3, 2], "radius": 0.5}}]}],
//!  "doors": [{"name": "north", "start": [2, 1], "end": [2, 3], "state": "open",
//!             "schedule": [{"time_us": 5000000, "state": "shut"}]}]}
//! ```
//!
//! A world made from a maze or an occupancy grid is written with its grid instead of its walls.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::Point;

use super::{Cells, Lattice, Material, WallSegment, World, WorldError, Zone};
use crate::Door;

const FORMAT: &str = "tolman-world";
const VERSION: u32 = 1;

/// Walls from point to point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Polyline {
    /// The points, m.
    pub points: Vec<Point>,
    /// Whether a last wall leads back to the first point.
    #[serde(default)]
    pub closed: bool,
    /// Material of all walls of this entry.
    #[serde(default)]
    pub material: Material,
}

impl Polyline {
    /// Returns the world's walls.
    pub fn walls(&self) -> impl Iterator<Item = WallSegment> + '_ {
        let closing = self
            .points
            .first()
            .filter(|_| self.closed && self.points.len() > 2);
        let ends = self.points.iter().skip(1).chain(closing);
        let material = self.material;
        self.points
            .iter()
            .zip(ends)
            .map(move |(start, end)| WallSegment {
                start: *start,
                end: *end,
                material,
            })
    }
}

/// The head of any file of ours.
#[derive(Deserialize)]
pub(crate) struct Head {
    #[serde(default)]
    pub(crate) format: String,
    #[serde(default)]
    pub(crate) version: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WorldFile {
    format: String,
    version: u32,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    walls: Vec<WallSegment>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    polylines: Vec<Polyline>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lattice: Option<Lattice>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cells: Option<Cells>,
    #[serde(default)]
    zones: Vec<Zone>,
    #[serde(default)]
    doors: Vec<Door>,
}

impl World {
    /// Reads a world file.
    ///
    /// # Errors
    /// If the text is not JSON, is of another format or version, or describes no world.
    ///
    /// ```
    /// use tolman_sim::World;
    /// let world = World::from_json(
    ///     r#"{"format": "tolman-world", "version": 1,
    ///         "polylines": [{"points": [[0, 0], [4, 0], [4, 3], [0, 3]], "closed": true}]}"#,
    /// )?;
    /// assert_eq!(world.walls().len(), 4);
    /// # Ok::<(), tolman_sim::WorldFileError>(())
    /// ```
    pub fn from_json(text: &str) -> Result<Self, WorldFileError> {
        let head: Head = serde_json::from_str(text)?;
        if head.format != FORMAT {
            return Err(WorldFileError::Format { found: head.format });
        }
        if head.version != VERSION {
            return Err(WorldFileError::Version {
                found: head.version,
            });
        }
        Self::from_file(serde_json::from_str(text)?)
    }

    /// Returns this world as a world file, on one line. Doors have their initial states. A caster
    /// other than the built-in one is not written.
    ///
    /// # Errors
    /// None for a world that was built by this crate.
    pub fn to_json(&self) -> Result<String, WorldFileError> {
        let file = WorldFile {
            format: FORMAT.to_owned(),
            version: VERSION,
            walls: if self.lattice.is_some() {
                Vec::new()
            } else {
                self.walls.clone()
            },
            polylines: Vec::new(),
            lattice: self.lattice.as_deref().cloned(),
            cells: self.cells,
            zones: self.zones.clone(),
            doors: self.doors.clone(),
        };
        Ok(serde_json::to_string(&file)?)
    }

    fn from_file(file: WorldFile) -> Result<Self, WorldFileError> {
        let mut world = match file.lattice {
            Some(lattice) if !lattice.is_sound() => return Err(WorldFileError::Lattice),
            Some(lattice) => Self::from_lattice(lattice, Material::default())?,
            None => {
                let mut walls = file.walls;
                walls.extend(file.polylines.iter().flat_map(Polyline::walls));
                Self::from_segments(walls)?
            }
        };
        world.cells = file.cells;
        if world
            .cells
            .is_some_and(|cells| !(cells.pitch.is_finite() && cells.pitch > 0.0))
        {
            return Err(WorldFileError::Lattice);
        }
        Ok(world.with_zones(file.zones)?.with_doors(file.doors)?)
    }
}

/// Reason why a world file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WorldFileError {
    /// The file is not JSON, or not what a world file holds; the message names line and column.
    #[error("not a world file: {0}")]
    Json(#[from] serde_json::Error),
    /// The file has another format.
    #[error("the format is `{found}`, expected `{FORMAT}`; give a world file")]
    Format {
        /// Format that the file names.
        found: String,
    },
    /// The file has a version that this program does not know.
    #[error(
        "the version is {found}, but this program reads version {VERSION}; write the world again"
    )]
    Version {
        /// Version that the file names.
        found: u32,
    },
    /// The parts of the file's grid contradict each other.
    #[error("the sizes within `lattice` or `cells` contradict each other; write the file again")]
    Lattice,
    /// The file describes no world.
    #[error(transparent)]
    World(#[from] WorldError),
}
