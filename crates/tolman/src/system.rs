//! Systems by name, for `tolman learn`, `tolman drive` and `tolman map`.

use alloc::fmt;

use anyhow::{Context, Error, anyhow};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use tolman_arena::Outing;
use tolman_arena::course::{Course, Terrain};
use tolman_arena::episode::{layers, random_start};
use tolman_arena::pioneer::{CoursePioneer, LASER_PIONEER, body, calibrated};
use tolman_control::Stack;
use tolman_draw::Drawing;
use tolman_experiment::choices;
use tolman_geom::Pose;
use tolman_robot::Body;
use tolman_sim::robots::LaserPioneer;
use tolman_systems::Origin;

use crate::start::Start;

/// A system by its name, with the robots that it can drive.
///
/// An implementation prepares the system and its robot. The command lets it act, watches it, and
/// stores its map. To add one, put it into the [`Catalogue`](crate::Catalogue).
pub trait SystemEntry: Sync {
    /// Returns the name, as in `--system NAME` and in the files of its maps.
    fn name(&self) -> &'static str;

    /// Returns a description in one line.
    fn about(&self) -> &'static str {
        "A system from another crate"
    }

    /// Returns the names of its presets with their descriptions; the first is the default.
    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }

    /// Returns the names of the robots that it can drive; the first is the default.
    fn robots(&self) -> &'static [&'static str] {
        &[]
    }

    /// Returns the system ready to learn a maze.
    ///
    /// # Errors
    /// If maze, start or settings do not fit.
    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error>;

    /// Returns the system ready to drive to the goal by a map. Given several maps, it finds out
    /// which is that of the maze. The default implementation refuses.
    ///
    /// # Errors
    /// If maps, maze, start or settings do not fit.
    fn driver(&self, _maps: &[MapText], _setup: &Setup<'_>) -> Result<Box<dyn Outing>, Error> {
        Err(anyhow!("{} does not drive by a map", self.name()))
    }

    /// Returns the learned map in a file. The default implementation knows only its origin.
    ///
    /// # Errors
    /// If the file is invalid.
    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, Error> {
        Ok(Box::new(map.clone()))
    }
}

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
    fn drawing(&self, _terrain: &Terrain) -> Result<Drawing, Error> {
        Err(anyhow!(
            "there is no picture of such a map: leave --svg out"
        ))
    }

    /// Returns the way between two places, one line per step, or `None` if no way is known.
    ///
    /// `from` defaults to the believed place, or else the maze's start; `to` defaults to the goal.
    ///
    /// # Errors
    /// If there is no such place.
    fn plan(&self, _from: Option<u32>, _to: Option<u32>) -> Result<Option<Vec<String>>, Error> {
        Err(anyhow!("no way can be planned on such a map"))
    }

    /// Returns why the map is wrong or unfinished as a map of `terrain`; `None` if it is right.
    ///
    /// # Errors
    /// If `terrain` does not fit, or such maps cannot be checked.
    fn complaint(&self, _terrain: &Terrain) -> Result<Option<String>, Error> {
        Err(anyhow!("such a map cannot be checked"))
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

/// Everything needed to send out a robot.
#[derive(Clone, Debug)]
pub struct Setup<'a> {
    /// Name of the maze or world.
    pub world: &'a str,
    /// Maze or world into which the robot is sent.
    pub terrain: &'a Terrain,
    /// Seed of all random numbers: the same seed gives the same result.
    pub seed: u64,
    /// Start of the robot; `None` for the system's default.
    pub start: Option<Start>,
    /// Number of time steps after which the task has failed; `None` for the system's default.
    pub steps: Option<u32>,
    /// Name of one of the system's robots; `None` for the first.
    pub robot: Option<&'a str>,
    /// Map to continue learning from; `None` to begin with an empty one.
    pub from: Option<&'a MapText>,
    /// Settings of the system.
    pub settings: Settings<'a>,
}

impl Setup<'_> {
    /// Returns the origin of a map that is learned on this course by this robot.
    #[must_use]
    pub fn origin(&self, course: &Course, robot: &str) -> Origin {
        Origin {
            world: self.world.to_owned(),
            drawing: Some(course.drawing()),
            robot: robot.to_owned(),
            seed: self.seed,
        }
    }

    /// Returns the one of `robots` that the setup names, or the first.
    ///
    /// # Errors
    /// If the setup names another one.
    pub fn robot(&self, robots: &[&'static str]) -> Result<&'static str, Error> {
        choose(
            self.robot,
            robots.iter().map(|name| (*name, *name)),
            "robot",
        )
    }

    /// Returns the start of the robot on `course`: the one that was given, or else `usual`.
    /// `random` is called for a random one.
    ///
    /// # Errors
    /// If the maze marks no start, or no way leads on from there.
    pub fn start(
        &self,
        course: &Course,
        usual: Start,
        random: impl FnOnce() -> Option<Pose>,
    ) -> Result<Pose, Error> {
        self.start.unwrap_or(usual).on(course, random)
    }

    /// Refuses to continue from a map.
    ///
    /// # Errors
    /// If the setup has one.
    pub fn anew(&self, system: &str) -> Result<(), Error> {
        match self.from {
            Some(map) => Err(anyhow!(
                "{system} learns a maze in one go and cannot continue {}: leave --from out",
                map.name
            )),
            None => Ok(()),
        }
    }
}

/// Settings of a system: a preset and changes to it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings<'a> {
    /// Name of the preset; `None` for the first.
    pub preset: Option<&'a str>,
    /// Fields by their path, each with its value as TOML.
    pub set: &'a [(String, String)],
}

impl Settings<'_> {
    /// Returns the one of `presets` that is chosen, or the first.
    ///
    /// # Errors
    /// If another one is chosen.
    pub fn preset<T>(
        &self,
        presets: impl IntoIterator<Item = (&'static str, T)>,
    ) -> Result<T, Error> {
        choose(self.preset, presets, "preset")
    }

    /// Returns `preset` with the changes made.
    ///
    /// # Errors
    /// If there is no such field, or it cannot have that value.
    pub fn over<C: Serialize + DeserializeOwned>(&self, preset: &C) -> Result<C, Error> {
        let mut table = toml::Table::try_from(preset).context("the preset has no TOML form")?;
        for (path, value) in self.set {
            set(&mut table, path, value)?;
        }
        table.try_into().map_err(|error: toml::de::Error| {
            let set = self
                .set
                .iter()
                .map(|(path, value)| format!("{path}={value}"));
            let set = set.collect::<Vec<_>>().join(" --set ");
            anyhow!("--set {set}: {}", in_plain_words(error.message()))
        })
    }
}

/// Returns the TOML reader's message, with words in place of the names of Rust's types.
fn in_plain_words(message: &str) -> String {
    let message = message.trim_end();
    let Some((before, wanted)) = message.rsplit_once("expected ") else {
        return message.to_owned();
    };
    let wanted = match wanted {
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "f32" | "f64" => "a number",
        other => other,
    };
    format!("{before}expected {wanted}")
}

/// Sets the field at `path` of a table to `value`.
fn set(table: &mut toml::Table, path: &str, value: &str) -> Result<(), Error> {
    let (name, rest) = path.split_once('.').unwrap_or((path, ""));
    let Some(field) = table.get_mut(name) else {
        return Err(anyhow!(
            "--set {path}={value}: there is no setting {name}; {}",
            choices(name, table.keys().map(String::as_str))
        ));
    };
    if let (false, Some(inner)) = (rest.is_empty(), field.as_table_mut()) {
        return set(inner, rest, value);
    }
    let whole: Result<toml::Table, _> = toml::from_str(&format!("value = {value}"));
    let read = whole.ok().and_then(|mut whole| whole.remove("value"));
    let read = read.unwrap_or_else(|| toml::Value::String(value.to_owned()));
    // A whole number may stand for a real one.
    *field = match (&field, &read) {
        (toml::Value::Float(_), toml::Value::Integer(number)) => toml::Value::Float(*number as f64),
        _ => read,
    };
    Ok(())
}

/// Returns the known entry called `name`, or the first without a name.
fn choose<T>(
    name: Option<&str>,
    known: impl IntoIterator<Item = (&'static str, T)>,
    what: &str,
) -> Result<T, Error> {
    let mut names = Vec::new();
    for (known, thing) in known {
        // Names compare as they are typed: "laser-pioneer" is the laser Pioneer.
        if name.is_none_or(|name| slug(name) == slug(known)) {
            return Ok(thing);
        }
        names.push(slug(known));
    }
    let name = name.unwrap_or_default();
    Err(anyhow!(
        "there is no {what} {name}; {}",
        choices(name, names.iter().map(String::as_str))
    ))
}

/// Puts the calibrated laser Pioneer on the course of the maze, and returns both with the layers
/// that drive it. Without a given start, its pose is random.
///
/// # Errors
/// If maze, robot or start do not fit.
pub fn laser_pioneer(setup: &Setup<'_>) -> Result<(Course, CoursePioneer, Stack), Error> {
    setup.robot(&[LASER_PIONEER])?;
    let course = setup.terrain.course(setup.world, &body())?;
    let start = start_anywhere(setup, &course, &body())?;
    let robot = pioneer_at(&course, start, setup.seed)?;
    let layers = layers(&course, &calibrated())?;
    Ok((course, robot, layers))
}

/// Returns the calibrated laser Pioneer at `start`; `seed` seeds all of its noise.
///
/// # Errors
/// If it cannot stand there.
pub(crate) fn pioneer_at(course: &Course, start: Pose, seed: u64) -> Result<CoursePioneer, Error> {
    Ok(course.robot_at(start, LaserPioneer::new(calibrated())?, seed)?)
}

/// Returns the start of a robot with this body on `course`: the given one, or a random one.
///
/// # Errors
/// As [`Setup::start`].
pub fn start_anywhere(setup: &Setup<'_>, course: &Course, body: &Body) -> Result<Pose, Error> {
    let random = || Some(random_start(course, body, setup.seed));
    setup.start(course, Start::Random, random)
}

/// Returns a name as it is typed on the command line.
pub(crate) fn slug(name: &str) -> String {
    name.to_lowercase().replace(' ', "-")
}

impl fmt::Debug for dyn SystemEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
