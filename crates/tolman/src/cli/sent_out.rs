use anyhow::anyhow;
use tolman_arena::Outing;
use tolman_arena::course::Terrain;

use super::ground::{Ground, required};
use super::unfinished::Call;
use super::{App, Failure, Result};
use tolman_arena::contest::Condition;
use tolman_arena::registry::{RobotEntry, Schooling, Settings, Setup, Start, SystemEntry};

/// Options for sending out a system.
#[derive(clap::Args)]
#[command(group(required()))]
pub(super) struct SentOut {
    #[command(flatten)]
    ground: Ground,
    /// Seed of all random numbers: the same seed gives the same result
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Robot to drive, if the system can drive several; `tolman systems` lists them
    #[arg(long, value_name = "NAME")]
    robot: Option<String>,
    /// Preset of the system's settings [default: the first that `tolman systems` lists]
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Change a setting of the preset; may be given several times. `tolman systems NAME` lists the
    /// settings and their defaults
    #[arg(long, value_name = "SETTING=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,
    #[command(flatten)]
    pub(super) start: StartOption,
    /// Give up after this many time steps
    #[arg(long, value_name = "LIMIT", value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
}

/// Option for where a robot starts.
#[derive(clap::Args)]
pub(super) struct StartOption {
    /// Where the robot starts: marked (the S of the maze, the zone `start` of a world), random,
    /// X,Y or X,Y,DEG. X and Y are in metres from the south-west corner of a maze, or in a world's
    /// own frame; DEG in degrees, counter-clockwise from east [default: marked if there is such a
    /// mark, else random; `drive`: random]
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true)]
    pub(super) start: Option<Start>,
}

impl SentOut {
    /// Returns the maze or the world, with its name.
    ///
    /// # Errors
    /// Bad input if neither is given, or it cannot be read.
    pub(super) fn terrain(&self) -> Result<(String, Terrain)> {
        self.ground.read()
    }

    /// Refuses a preset, because the map already holds the system's settings.
    ///
    /// # Errors
    /// Bad input if a preset is given.
    pub(super) fn refuse_preset(&self) -> Result {
        match &self.preset {
            Some(preset) => Err(Failure::BadInput(anyhow!(
                "--preset {preset}: a map keeps the settings it was learned with; leave --preset out, or change single ones with --set"
            ))),
            None => Ok(()),
        }
    }

    /// Returns the call of this verb with all options on which the run depends.
    pub(super) fn call(&self, verb: &str, system: &str, outing: &dyn Outing) -> Call {
        let set = self
            .set
            .iter()
            .map(|(name, value)| format!("{name}={value}"));
        let set: Vec<String> = set.collect();
        self.ground
            .call(verb, outing.course())
            .with("the system", Some(system))
            .with("--seed", Some(self.seed))
            .with("the robot", Some(outing.robot().name))
            .with("--preset", self.preset.as_ref())
            .with("--set", (!set.is_empty()).then(|| set.join(" ")))
            .with("--start", self.start.start)
            .with("--steps", self.steps)
    }

    /// Returns the robot that carries a system: the one that was named, or else `usual`.
    ///
    /// # Errors
    /// Bad input if there is no such robot, or it cannot carry the system.
    pub(super) fn robot(
        &self,
        app: &App,
        system: &dyn SystemEntry,
        usual: &str,
    ) -> Result<RobotEntry> {
        app.robot_for(system, self.robot.as_deref().unwrap_or(usual))
    }

    /// Returns the setup with which a system is sent out on a robot.
    pub(super) fn setup<'a>(
        &'a self,
        world: &'a (String, Terrain),
        robot: RobotEntry,
        schooling: &'a Schooling,
    ) -> Setup<'a> {
        Setup {
            start: self.start.start,
            steps: self.steps,
            settings: Settings {
                preset: self.preset.as_deref(),
                set: &self.set,
            },
            ..setup_of(world, robot, schooling, self.seed)
        }
    }
}

/// Returns a setup without start, limit, map and settings.
pub(super) fn setup_of<'a>(
    (world, terrain): &'a (String, Terrain),
    robot: RobotEntry,
    schooling: &'a Schooling,
    seed: u64,
) -> Setup<'a> {
    Setup {
        world,
        terrain,
        seed,
        start: None,
        steps: None,
        robot,
        from: None,
        settings: Settings::default(),
        condition: Condition::AsMade,
        doors: &[],
        schooling,
    }
}

fn setting(text: &str) -> Result<(String, String), String> {
    if text == Settings::HELP {
        return Ok((text.to_owned(), String::new()));
    }
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| "expected SETTING=VALUE".to_owned())?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}
