use serde_json::Value;
use tolman_draw::Drawing;
use tolman_systems::Origin;

use crate::BoxError;
use crate::course::Terrain;

/// A file that holds a learned map.
#[derive(Clone, Debug)]
pub struct MapText {
    /// Path of the file, for messages.
    pub name: String,
    /// Name of the system that learned the map.
    pub system: String,
    /// Maze, robot and seed with which the map was learned.
    pub origin: Origin,
    /// Text of the whole file.
    pub text: String,
}

/// A learned map, as the command shows it.
pub trait LearnedMap {
    /// Returns a description of the map, line by line.
    fn lines(&self) -> Vec<String>;

    /// Returns the same description as JSON.
    fn json(&self) -> Value;

    /// Returns a drawing over the maze or world in which the map was learned, for a robot like the
    /// one that learned it.
    ///
    /// # Errors
    /// If `terrain` does not fit, or such maps cannot be drawn.
    fn drawing(&self, _terrain: &Terrain) -> Result<Drawing, BoxError> {
        Err("there is no picture of such a map: leave --svg out".into())
    }

    /// Returns the way between two places, one line per step, or `None` if no way is known.
    ///
    /// `from` defaults to the believed place, or else the maze's start; `to` defaults to the goal.
    ///
    /// # Errors
    /// If there is no such place.
    fn plan(&self, _from: Option<u32>, _to: Option<u32>) -> Result<Option<Vec<String>>, BoxError> {
        Err("no way can be planned on such a map".into())
    }

    /// Returns why the map is wrong or unfinished as a map of `terrain`; `None` if it is right.
    ///
    /// # Errors
    /// If `terrain` does not fit, or such maps cannot be checked.
    fn complaint(&self, _terrain: &Terrain) -> Result<Option<String>, BoxError> {
        Err("such a map cannot be checked".into())
    }
}

impl LearnedMap for MapText {
    fn lines(&self) -> Vec<String> {
        let Origin {
            world, robot, seed, ..
        } = &self.origin;
        vec![format!(
            "a map of {} of {world}, learned by the {robot}, seed {seed}",
            self.system
        )]
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.text).unwrap_or_default()
    }
}
