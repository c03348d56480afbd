use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};
use serde::Deserialize;
use serde_json::{Map, Value};

/// Parameters of the node. What slam_toolbox and nav2 have too is called as there.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Params {
    /// System that drives and maps: a name of `tolman systems`.
    #[serde(default = "system")]
    pub(crate) system: String,
    /// Seed of all random numbers.
    #[serde(default = "one")]
    pub(crate) seed: u64,
    /// Whether it explores as soon as it hears the robot.
    #[serde(default)]
    pub(crate) explore_on_start: bool,

    /// Diameter of the circle that the body covers when it turns in place, m.
    pub(crate) diameter: f64,
    /// Distance between the faces of a corridor's walls, m.
    pub(crate) corridor_width: f64,
    /// Distance from the middle of one corridor to that of the next, m.
    #[serde(default)]
    pub(crate) corridor_spacing: Option<f64>,
    /// Largest error of odometry, as a share of the distance.
    #[serde(default = "odometry_error")]
    pub(crate) odometry_error: f64,
    /// Largest error of the heading in `odom_topic` over the whole run, rad, if it is a compass's.
    /// Without it that is a gyro's, whose zero may be anywhere and which drifts.
    #[serde(default)]
    pub(crate) compass_error: Option<f64>,

    /// Topic of the laser's scans.
    #[serde(default = "scan_topic")]
    pub(crate) scan_topic: String,
    /// Topic of the odometry.
    #[serde(default = "odom_topic")]
    pub(crate) odom_topic: String,
    /// Topic of the velocities.
    #[serde(default = "cmd_vel_topic")]
    pub(crate) cmd_vel_topic: String,
    /// Topic of what the robot stands at: `goal`, `start`, a number, or empty.
    #[serde(default = "landmark_topic")]
    pub(crate) landmark_topic: String,
    /// Whether velocities are `TwistStamped`, as from Jazzy on, or `Twist`.
    #[serde(default)]
    pub(crate) enable_stamped_cmd_vel: bool,
    #[serde(default = "map_frame")]
    pub(crate) map_frame: String,
    #[serde(default = "odom_frame")]
    pub(crate) odom_frame: String,
    #[serde(default = "base_frame")]
    pub(crate) base_frame: String,
    /// How far in the future `map → odom` is stamped, s.
    #[serde(default = "tenth")]
    pub(crate) transform_timeout: f64,
    /// Distance from which a range counts as nothing seen, m; by default the laser's own.
    #[serde(default)]
    pub(crate) max_laser_range: Option<f64>,
    /// Side of a cell of `/map`, m.
    #[serde(default = "resolution")]
    pub(crate) resolution: f64,
    /// Time from one `/map` to the next, s.
    #[serde(default = "map_update_interval")]
    pub(crate) map_update_interval: f64,
    /// Files that `save_map` writes, without their endings.
    #[serde(default = "map_file_name")]
    pub(crate) map_file_name: String,

    /// Fastest motion, m/s and rad/s.
    #[serde(default = "fifth")]
    pub(crate) max_vel_x: f64,
    #[serde(default = "max_vel_theta")]
    pub(crate) max_vel_theta: f64,
    /// Strongest braking, m/s² and rad/s².
    #[serde(default = "half")]
    pub(crate) acc_lim_x: f64,
    #[serde(default = "three")]
    pub(crate) acc_lim_theta: f64,
    /// Time from a command to the report of its effect, s.
    #[serde(default = "tenth")]
    pub(crate) latency: f64,
    /// Longest time without odometry or a scan before the robot is stopped, s.
    #[serde(default = "source_timeout")]
    pub(crate) source_timeout: f64,
    /// Taken and ignored: the node's times are those of the messages.
    #[serde(default, rename = "use_sim_time")]
    pub(crate) _use_sim_time: bool,
}

fn system() -> String {
    "mslst-better".into()
}
const fn one() -> u64 {
    1
}
const fn odometry_error() -> f64 {
    0.05
}
fn scan_topic() -> String {
    "/scan".into()
}
fn odom_topic() -> String {
    "/odom".into()
}
fn cmd_vel_topic() -> String {
    "/cmd_vel".into()
}
fn landmark_topic() -> String {
    "/landmark".into()
}
fn map_frame() -> String {
    "map".into()
}
fn odom_frame() -> String {
    "odom".into()
}
fn base_frame() -> String {
    "base_footprint".into()
}
fn map_file_name() -> String {
    "tolman_map".into()
}
const fn tenth() -> f64 {
    0.1
}
const fn fifth() -> f64 {
    0.2
}
const fn half() -> f64 {
    0.5
}
const fn three() -> f64 {
    3.0
}
const fn max_vel_theta() -> f64 {
    1.5
}
const fn resolution() -> f64 {
    0.05
}
const fn map_update_interval() -> f64 {
    5.0
}
const fn source_timeout() -> f64 {
    2.0
}

/// What ROS gives on the command line: files of parameters, parameters, and new names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RosArguments {
    files: Vec<String>,
    settings: Vec<(String, String)>,
    /// New names of topics, services and of the node, by the old ones.
    renamed: BTreeMap<String, String>,
}

impl RosArguments {
    /// Reads the words of a command line, as `ros2 run` and a launch file write them.
    ///
    /// # Errors
    /// If a word is unknown, or lacks what follows.
    pub(crate) fn parse(words: impl IntoIterator<Item = String>) -> Result<Self> {
        let mut arguments = Self::default();
        let mut words = words.into_iter();
        while let Some(word) = words.next() {
            let mut next = || {
                words
                    .next()
                    .with_context(|| format!("{word} needs a value"))
            };
            match word.as_str() {
                "--ros-args" | "--" => {}
                "--params-file" => arguments.files.push(next()?),
                "-p" | "--param" => {
                    let (name, value) = halves(&next()?, &word)?;
                    arguments.settings.push((name, value));
                }
                "-r" | "--remap" => {
                    let (from, to) = halves(&next()?, &word)?;
                    arguments.renamed.insert(from, to);
                }
                "--log-level" => drop(next()?),
                _ => {
                    bail!("{word} is unknown: give --params-file FILE, -p NAME:=VALUE, -r FROM:=TO")
                }
            }
        }
        Ok(arguments)
    }

    /// Returns the name of the node.
    pub(crate) fn node(&self) -> &str {
        self.renamed.get("__node").map_or("tolman", String::as_str)
    }

    /// Returns the namespace of the node.
    pub(crate) fn namespace(&self) -> &str {
        self.renamed.get("__ns").map_or("/", String::as_str)
    }

    /// Returns the name that a topic or a service has after renaming.
    pub(crate) fn renamed<'a>(&'a self, name: &'a str) -> &'a str {
        let bare = name.trim_start_matches('/');
        let by = |from: &str| self.renamed.get(from).map(String::as_str);
        by(name).or_else(|| by(bare)).unwrap_or(name)
    }

    /// Reads the files, and sets the parameters that follow them.
    ///
    /// # Errors
    /// If a file cannot be read or is no file of parameters, or if a parameter is unknown, missing
    /// or of another type.
    pub(crate) fn params(&self) -> Result<Params> {
        let mut all = Map::new();
        for file in &self.files {
            let text = fs::read_to_string(file).with_context(|| format!("cannot read {file}"))?;
            let read = settings_of(self.node(), &text);
            all.extend(read.with_context(|| format!("{file} is no file of parameters"))?);
        }
        for (name, value) in &self.settings {
            let value = serde_saphyr::from_str(value);
            let value = value.with_context(|| format!("-p {name}: this is no value"))?;
            all.insert(name.clone(), value);
        }
        let params: Params = serde_json::from_value(Value::Object(all))
            .context("the parameters are not those of this node")?;
        params.check()?;
        Ok(params)
    }
}

impl Params {
    fn check(&self) -> Result<()> {
        for (name, value) in [
            ("resolution", self.resolution),
            ("map_update_interval", self.map_update_interval),
            ("source_timeout", self.source_timeout),
        ] {
            ensure!(
                value.is_finite() && value > 0.0,
                "`{name}` is {value}: give a number above 0"
            );
        }
        for (name, value) in [
            ("latency", self.latency),
            ("transform_timeout", self.transform_timeout),
        ] {
            ensure!(
                (0.0..=10.0).contains(&value),
                "`{name}` is {value}: give 0 to 10 s"
            );
        }
        let folder = Path::new(&self.map_file_name).parent();
        let is_there = folder.is_none_or(|folder| folder.as_os_str().is_empty() || folder.is_dir());
        ensure!(
            is_there,
            "`map_file_name`: there is no folder for {}",
            self.map_file_name
        );
        Ok(())
    }
}

/// Returns the parameters for a node in the text of a file: those for all nodes, then its own.
fn settings_of(node: &str, text: &str) -> Result<Map<String, Value>> {
    let file: BTreeMap<String, Value> = serde_saphyr::from_str(text)?;
    let mut all = Map::new();
    let own = [node.to_owned(), format!("/{node}")];
    let keys = ["/**", "/*"].map(str::to_owned);
    for key in keys.iter().chain(&own) {
        if let Some(of_node) = file.get(key) {
            let settings = of_node.get("ros__parameters").and_then(Value::as_object);
            let settings = settings.with_context(|| format!("{key} has no ros__parameters"))?;
            all.extend(settings.clone());
        }
    }
    let nodes: Vec<&String> = file.keys().collect();
    ensure!(
        !all.is_empty(),
        "it has parameters for {nodes:?}, and none for {node}"
    );
    Ok(all)
}

/// Returns both sides of `FROM:=TO`.
fn halves(text: &str, word: &str) -> Result<(String, String)> {
    let halves = text.split_once(":=");
    let (from, to) = halves.with_context(|| format!("{word} {text}: write NAME:=VALUE"))?;
    Ok((from.to_owned(), to.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "/**:\n  ros__parameters:\n    diameter: 0.3\n    corridor_width: 0.5\n\
                        tolman:\n  ros__parameters:\n    diameter: 0.25\n    system: diktiometry-better\n";

    fn words(line: &str) -> Result<RosArguments> {
        RosArguments::parse(line.split_whitespace().map(str::to_owned))
    }

    #[test]
    fn a_launch_file_s_command_line_is_understood() -> Result<()> {
        let arguments = words(
            "--ros-args -r __node:=mapper -r /scan:=/front/scan --params-file a.yaml -p seed:=7",
        )?;
        assert_eq!(arguments.node(), "mapper");
        assert_eq!(arguments.renamed("/scan"), "/front/scan");
        assert_eq!(arguments.renamed("/odom"), "/odom");
        assert_eq!(arguments.settings, [("seed".to_owned(), "7".to_owned())]);
        Ok(())
    }

    #[test]
    fn a_file_s_own_part_wins() -> Result<()> {
        let settings = settings_of("tolman", FILE)?;
        assert_eq!(settings["diameter"], 0.25);
        assert_eq!(settings["corridor_width"], 0.5);
        assert_eq!(settings_of("other", FILE)?["diameter"], 0.3);
        Ok(())
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (line, expected) in [
            ("--params-file", "needs a value"),
            ("-p seed=7", "NAME:=VALUE"),
            ("--verbose", "--verbose is unknown"),
        ] {
            let told = words(line).map_or_else(|error| error.to_string(), |_| String::new());
            assert!(told.contains(expected), "{line}: {told}");
        }
        for (line, expected) in [
            ("-p diameter:=0.2", "corridor_width"),
            ("-p diameter:=wide -p corridor_width:=0.4", "expected f64"),
            (
                "-p diameter:=0.2 -p corridor_width:=0.4 -p resolution:=0",
                "`resolution` is 0",
            ),
            ("-p diametre:=0.2", "diametre"),
        ] {
            let params = words(line).and_then(|arguments| arguments.params());
            let told = params.map_or_else(|error| format!("{error:#}"), |_| String::new());
            assert!(told.contains(expected), "{line}: {told}");
        }
    }
}
