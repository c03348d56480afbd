use alloc::collections::BTreeMap;

use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;
use tolman_control::Stack;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction};
use tolman_robot::{Body, Mapper, Robot, SensesLandmarks, System};
use tolman_sim::robots::{LaserPioneerConfig, Pioneer2dx, Pioneer2dxConfig};
use tolman_systems::Origin;

use super::{LaserLike, MapText, RobotEntry, Schooling, Start};
use crate::contest::{Condition, with_doors};
use crate::course::{Course, Terrain};
use crate::episode::{layers, random_start};
use crate::run::Limited;
use crate::{BoxError, HasSimulated, Outing, Sent, Simulated};

/// Everything needed to send out a robot.
#[derive(Clone, Debug)]
pub struct Setup<'a> {
    /// Name of the maze or world.
    pub world: &'a str,
    /// Maze or world into which the robot is sent.
    pub terrain: &'a Terrain,
    /// Seed of all random numbers: the same seed gives the same result.
    pub seed: u64,
    /// Start of the robot; `None` for the [usual](Start::usual) one.
    pub start: Option<Start>,
    /// Number of time steps after which the task has failed; `None` for the system's default.
    pub steps: Option<u32>,
    /// Robot that carries the system.
    pub robot: RobotEntry,
    /// Map to continue learning from; `None` to begin with an empty one.
    pub from: Option<&'a MapText>,
    /// Settings of the system.
    pub settings: Settings<'a>,
    /// Change of the robot and the world.
    pub condition: Condition,
    /// Openings that are doors besides those of the condition, each as a cell and the way out of
    /// it. They come first, and stand open.
    pub doors: &'a [(Cell, Direction)],
    /// What systems learn once, before they are sent out.
    pub schooling: &'a Schooling,
}

impl Setup<'_> {
    /// Returns the origin of a map that is learned on this course by this robot.
    #[must_use]
    pub fn origin(&self, course: &Course) -> Origin {
        Origin {
            world: self.world.to_owned(),
            drawing: Some(course.drawing()),
            robot: self.robot.title.to_owned(),
            seed: self.seed,
        }
    }

    /// Returns the course for a robot of this body, with its doors and those of its
    /// [condition](Condition::Doors). In a maze whose file gives no width, corridors are
    /// `usual_width` m wide.
    ///
    /// # Errors
    /// As [`Terrain::course`].
    pub fn course(&self, body: &Body, usual_width: f64) -> Result<Course, BoxError> {
        let course = self.terrain.course_with(self.world, body, usual_width)?;
        self.with_doors(course)
    }

    /// Returns a course with its doors and those of its condition, if there are any.
    ///
    /// # Errors
    /// If a door does not fit the world.
    pub fn with_doors(&self, course: Course) -> Result<Course, BoxError> {
        let mut doors = self.doors.to_vec();
        if !course.is_free() {
            doors.extend(self.condition.doors(&course.maze, self.seed));
        }
        Ok(with_doors(course, &doors)?)
    }

    /// Returns the start of the robot on `course`: the one that was given, or else the
    /// [usual](Start::usual) one. `random` is called for a random one.
    ///
    /// # Errors
    /// If the maze marks no start, or no way leads on from there.
    pub fn start(
        &self,
        course: &Course,
        random: impl FnOnce() -> Option<Pose>,
    ) -> Result<Pose, BoxError> {
        let start = self.start.unwrap_or_else(|| Start::usual(course));
        start.on(course, random)
    }

    /// Returns the start of a robot with this body on `course`. A random one is not in the middle
    /// of its cell.
    ///
    /// # Errors
    /// As [`start`](Self::start).
    pub fn start_off_centre(&self, course: &Course, body: &Body) -> Result<Pose, BoxError> {
        self.start(course, || Some(random_start(course, body, self.seed)))
    }

    /// Returns the robot at `start`, a laser robot that is configured so before the condition
    /// changes it.
    ///
    /// # Errors
    /// If it cannot be built, or cannot stand there.
    pub fn laser_at(
        &self,
        course: &Course,
        start: Pose,
        config: LaserPioneerConfig,
    ) -> Result<Simulated<LaserLike>, BoxError> {
        let config = self.condition.laser_pioneer(config, self.seed);
        let model = self.robot.laser_model(config)?;
        Ok(course.robot_at(start, model, self.seed)?)
    }

    /// Returns the paper's Pioneer 2-DX at `start`, as the condition changes it.
    ///
    /// # Errors
    /// If it cannot be built, or cannot stand there.
    pub fn pioneer_2dx_at(
        &self,
        course: &Course,
        start: Pose,
    ) -> Result<Simulated<Pioneer2dx>, BoxError> {
        let config = Pioneer2dxConfig::paper();
        let config = self.condition.pioneer_2dx(config, self.seed);
        Ok(course.robot_at(start, Pioneer2dx::new(config)?, self.seed)?)
    }

    /// Puts the laser robot on the course of the maze, and returns both with the layers that drive
    /// it.
    ///
    /// # Errors
    /// If maze, robot or start do not fit.
    pub fn laser_robot(&self) -> Result<(Course, Simulated<LaserLike>, Stack), BoxError> {
        let config = self.robot.laser_config();
        let body = Body::Circle {
            radius: config.radius,
        };
        let course = self.course(&body, crate::pioneer::CORRIDOR_WIDTH)?;
        let start = self.start_off_centre(&course, &body)?;
        let stack = layers(&course, &config)?;
        let robot = self.laser_at(&course, start, config)?;
        Ok((course, robot, stack))
    }

    /// Sends out `system` with `robot`, which stands on `course`, and keeps the places and links of
    /// its map in the files of the system `name`.
    pub fn send<R, S>(
        &self,
        name: &'static str,
        course: Course,
        robot: R,
        system: S,
    ) -> Box<dyn Outing>
    where
        R: SensesLandmarks + HasSimulated + 'static,
        S: System<Limited<R>, Failure: Into<BoxError>> + 'static,
    {
        Box::new(self.sent(name, course, robot, system))
    }

    /// As [`send`](Self::send), for an outing that has more to say.
    pub fn sent<R, S>(&self, name: &'static str, course: Course, robot: R, system: S) -> Sent<R, S>
    where
        R: Robot,
        S: Mapper,
    {
        let origin = self.origin(&course);
        let steps = self.steps.unwrap_or(u32::MAX);
        Sent::new(course, robot, steps, system).keeping_its_view(name, origin)
    }

    /// Refuses to continue from a map.
    ///
    /// # Errors
    /// If the setup has one.
    pub fn anew(&self, system: &str) -> Result<(), BoxError> {
        match self.from {
            Some(map) => Err(format!(
                "{system} learns a maze in one go and cannot continue {}: leave --from out",
                map.name
            )
            .into()),
            None => Ok(()),
        }
    }
}

/// A setting or preset that a system does not have.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{told}; choose one of: {}", known.join(", "))]
pub struct UnknownName {
    /// What is wrong, as a sentence without a full stop.
    pub told: String,
    /// Name that was given.
    pub name: String,
    /// Names that the system knows.
    pub known: Vec<String>,
}

/// Answer to [`Settings::HELP`]: all settings, with their values.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the settings are: {}", .0.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(", "))]
pub struct AllSettings(pub BTreeMap<String, toml::Value>);

/// Settings of a system: a preset and changes to it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings<'a> {
    /// Name of the preset; `None` for the first.
    pub preset: Option<&'a str>,
    /// Fields by their path, each with its value as TOML.
    pub set: &'a [(String, String)],
}

impl Settings<'_> {
    /// Name in place of a setting's that asks for [all settings](AllSettings).
    pub const HELP: &'static str = "help";

    /// Refuses presets and settings, for a system that has none.
    ///
    /// # Errors
    /// If one is given.
    pub fn none(&self) -> Result<(), BoxError> {
        match (self.preset, self.set) {
            (Some(preset), _) => {
                Err(format!("there are no presets: leave --preset {preset} out").into())
            }
            (None, [(name, _), ..]) => {
                Err(format!("there are no settings: leave --set {name} out").into())
            }
            (None, []) => Ok(()),
        }
    }

    /// Returns the value of the one of `presets` that is chosen, or of the first.
    ///
    /// # Errors
    /// If another one is chosen.
    pub fn preset<T, const N: usize>(
        &self,
        presets: &[(&'static str, &'static str); N],
        values: [T; N],
    ) -> Result<T, BoxError> {
        let is_chosen = |name: &str| self.preset.is_none_or(|chosen| chosen == name);
        let mut all = presets.iter().zip(values);
        if let Some((_, value)) = all.find(|((name, _), _)| is_chosen(name)) {
            return Ok(value);
        }
        let name = self.preset.unwrap_or_default();
        Err(UnknownName {
            told: format!("there is no preset {name}"),
            name: name.to_owned(),
            known: presets.map(|(name, _)| name.to_owned()).into(),
        }
        .into())
    }

    /// Returns `preset` with the changes made.
    ///
    /// # Errors
    /// If there is no such field, or it cannot have that value.
    pub fn over<C: Serialize + DeserializeOwned>(&self, preset: &C) -> Result<C, BoxError> {
        let mut table = toml::Table::try_from(preset)?;
        for (path, value) in self.set {
            if path == Self::HELP {
                let mut all = BTreeMap::new();
                list(&table, "", &mut all);
                return Err(AllSettings(all).into());
            }
            set(&mut table, path, value)?;
        }
        table.try_into().map_err(|error: toml::de::Error| {
            let set = self
                .set
                .iter()
                .map(|(path, value)| format!("{path}={value}"));
            let set = set.collect::<Vec<_>>().join(" --set ");
            format!("--set {set}: {}", in_plain_words(error.message())).into()
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

/// Adds the fields of a table to `all`, each by its path, which begins with `before`.
fn list(table: &toml::Table, before: &str, all: &mut BTreeMap<String, toml::Value>) {
    for (name, value) in table {
        let path = format!("{before}{name}");
        match value {
            toml::Value::Table(inner) => list(inner, &format!("{path}."), all),
            value => drop(all.insert(path, value.clone())),
        }
    }
}

/// Sets the field at `path` of a table to `value`.
fn set(table: &mut toml::Table, path: &str, value: &str) -> Result<(), BoxError> {
    let (name, rest) = path.split_once('.').unwrap_or((path, ""));
    let Some(field) = table.get_mut(name) else {
        return Err(UnknownName {
            told: format!("--set {path}={value}: there is no setting {name}"),
            name: name.to_owned(),
            known: table.keys().cloned().collect(),
        }
        .into());
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
