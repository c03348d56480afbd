use serde::Deserialize;
use serde_json::Value;
use tolman_draw::Drawing;
use tolman_robot::MapView;
use tolman_systems::{FileError, Origin, origin_of};

use super::{SystemEntry, because};
use crate::BoxError;
use crate::contest::Evidence;
use crate::course::{Course, Terrain};
use crate::pioneer::body;

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
    /// Evidence of the map for the judge; `None` if the file has none.
    pub truth: Option<Evidence>,
}

/// The part of a map's file that is not the system's.
#[derive(Deserialize)]
struct Judged {
    truth: Option<Evidence>,
}

impl MapText {
    /// Reads the text of a map's file, of any system. `name` is the file's path.
    ///
    /// # Errors
    /// [`FileError`] if the text has no header, or one of another format or version.
    pub fn read(name: String, text: String) -> Result<Self, FileError> {
        let (system, origin) = origin_of(&text)?;
        let judged: Option<Judged> = serde_json::from_str(&text).ok();
        Ok(Self {
            name,
            system,
            origin,
            text,
            truth: judged.and_then(|judged| judged.truth),
        })
    }

    /// Returns the map as `parse` reads it.
    ///
    /// # Errors
    /// If the file is invalid.
    pub(super) fn parsed<T, E: Into<BoxError>>(
        &self,
        parse: fn(&str) -> Result<T, E>,
    ) -> Result<T, BoxError> {
        parse(&self.text).map_err(|error| because(&self.name, error))
    }

    /// Returns the text of a map's file, as its system wrote it, with the judge's evidence.
    ///
    /// # Errors
    /// If the evidence cannot be written.
    pub fn with_truth(text: &str, truth: &Evidence) -> Result<String, serde_json::Error> {
        let truth = serde_json::to_string(truth)?;
        let body = text.trim_end().trim_end_matches('}');
        // Braces that the system's own fields end with stay.
        let closed = text.trim_end().len() - body.len();
        let braces = "}".repeat(closed.saturating_sub(1));
        Ok(format!("{body}{braces},\"truth\":{truth}}}\n"))
    }

    /// Returns why the map is wrong or unfinished as one of `terrain`, in a sentence without a full
    /// stop; `None` if it is right.
    ///
    /// # Errors
    /// If the file has no evidence, or `terrain` does not fit.
    pub fn complaint(
        &self,
        system: &dyn SystemEntry,
        terrain: &Terrain,
    ) -> Result<Option<String>, BoxError> {
        let map = system.map(self)?;
        let course = map.course(&self.origin.world, terrain)?;
        let drawn = self.origin.drawing.as_ref();
        if drawn.is_some_and(|drawn| *drawn != course.drawing()) {
            let why = "it was learned in another world, or this one has been drawn again since";
            return Ok(Some(why.to_owned()));
        }
        if let Some(judged) = map.judged_apart() {
            return Ok(judged);
        }
        let truth = self.truth.as_ref();
        let truth =
            truth.ok_or("the file does not say where the robot truly was: learn it again")?;
        Ok(truth.complaint(&map.view()?, &course, system.facts().places))
    }
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

    /// Returns places and links as the judge reads them.
    ///
    /// # Errors
    /// If such maps cannot be checked.
    fn view(&self) -> Result<MapView, BoxError> {
        Err("such a map cannot be checked".into())
    }

    /// Returns the judgement of a map of a world whose true places are not cells: `Some(None)` if
    /// it
    /// is right, or why not; `None` for all other maps.
    fn judged_apart(&self) -> Option<Option<String>> {
        None
    }

    /// Returns `terrain` as the course on which the map was learned, for a robot like the one that
    /// learned it.
    ///
    /// # Errors
    /// If `terrain` does not fit.
    fn course(&self, world: &str, terrain: &Terrain) -> Result<Course, BoxError> {
        Ok(terrain.course(world, &body())?)
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
