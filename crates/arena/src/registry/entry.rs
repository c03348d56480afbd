use core::fmt;

use tolman_maze::Maze;

use super::view_file::ViewFile;
use super::{ForRobot, LearnedMap, MapText, RobotEntry, RobotKind, Setup};
use crate::cast::Agent;
use crate::contest::PlaceRule;
use crate::{BoxError, Outing};

/// Facts about a system, which the command, the arena, the papers' tables, Python and the
/// playground look up.
#[derive(Clone, Copy, Debug)]
pub struct SystemFacts {
    /// Name as typed, in kebab case; files of maps name it too.
    pub name: &'static str,
    /// Name in tables.
    pub title: &'static str,
    /// Description in one line, which begins with a verb.
    pub about: &'static str,
    /// Whether the system is as its paper has it.
    pub is_paper: bool,
    /// What the system does with sensors that not every robot has, as in "it needs a compass".
    pub needs: &'static str,
    /// Kinds of robots that sense and move as the system needs it.
    pub kinds: &'static [RobotKind],
    /// Name of the robot that the system is made for.
    pub own_robot: &'static str,
    /// Names of its presets with their descriptions; the first is the default.
    pub presets: &'static [(&'static str, &'static str)],
    /// Preset for contests, where the size of the world limits how far a robot may drive; `None`
    /// for the default.
    pub arena_preset: Option<&'static str>,
    /// Whether it learns a map of a maze with a robot.
    pub learns: bool,
    /// The baseline that this is; `None` for a system.
    pub baseline: Option<Agent>,
    /// How the system maps a log; `None` if it cannot.
    pub log_mapper: Option<LogMapper>,
    /// Reason why the system cannot map a log, in a sentence without a full stop.
    pub why_no_log: &'static str,
    /// Puts it on any robot with a laser, by its measures alone; or the reason why it cannot be, in
    /// a sentence without a full stop.
    pub for_robot: Result<ForRobot, &'static str>,
    /// Whether it runs errands: goes to any landmark, and looks for it while it is not on its map.
    pub delivers: bool,
    /// Maps by which it drives to the goal.
    pub drives: DrivesBy,
    /// Whether being done means that it claims its map is that of the whole world.
    pub claims: bool,
    /// Whether a drive by its map has to arrive before the map counts as learned, for a system that
    /// cannot judge its map.
    pub tried: bool,
    /// Whether it only watches while another system drives, so that the way to the goal would not
    /// be its own.
    pub watches: bool,
    /// Rule for the cells that are places of this system. If it treats another cell with two ways
    /// as a place, that cell counts as part of a way.
    pub places: PlaceRule,
    /// World and seed that show the system well.
    pub demo: (DemoWorld, u64),
}

impl SystemFacts {
    /// Returns the facts of a system of this name that learns a map on the laser Pioneer and claims
    /// to have it when it is done.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self {
            name,
            title: name,
            about: "is a system from another crate",
            is_paper: false,
            needs: "needs a laser ring and a compass",
            kinds: &[RobotKind::Laser],
            own_robot: RobotEntry::LASER_PIONEER.name,
            presets: &[],
            arena_preset: None,
            learns: true,
            baseline: None,
            log_mapper: None,
            why_no_log: "it learns from actions, which a log does not name",
            for_robot: Err("it is not made for any robot with a laser"),
            delivers: false,
            drives: DrivesBy::OwnMap,
            claims: true,
            tried: false,
            watches: false,
            places: PlaceRule::Landmarks,
            demo: (DemoWorld::Large, 1),
        }
    }
}

/// A system by its name, with the robots that can carry it.
///
/// An implementation states its facts and makes the system ready on its robot. Others let it act,
/// watch it, judge its map and store it.
pub trait SystemEntry: Sync {
    /// Returns the facts about the system.
    fn facts(&self) -> SystemFacts;

    /// Returns the name as typed.
    fn name(&self) -> &'static str {
        self.facts().name
    }

    /// Returns the name in tables.
    fn title(&self) -> &'static str {
        self.facts().title
    }

    /// Returns whether it learns a map of a maze with a robot.
    fn learns(&self) -> bool {
        self.facts().learns
    }

    /// Returns the baseline that this is.
    fn baseline(&self) -> Option<Agent> {
        self.facts().baseline
    }

    /// Returns why a robot cannot carry the system, in a sentence without a full stop; `None` if it
    /// can.
    fn why_not(&self, robot: &RobotEntry) -> Option<String> {
        let mut kinds = self.facts().kinds.iter();
        let is_able = kinds.any(|kind| robot.kind().can_be(*kind));
        let why = || {
            format!(
                "it {}, and the {} has none",
                self.facts().needs,
                robot.title
            )
        };
        (!is_able).then(why)
    }

    /// Returns the maximum number of cells that it sees straight on through an opening with a robot
    /// of this kind.
    fn sees_cells(&self, kind: RobotKind) -> u32 {
        match kind {
            RobotKind::Pioneer2dx => 3,
            RobotKind::Camera => 5,
            RobotKind::Epuck | RobotKind::Laser => 1,
        }
    }

    /// Returns the reason why it cannot work in a drawing, in a sentence without a full stop;
    /// `None` if it can. It decides by its own features alone. O(cells).
    fn abstains(&self, _maze: &Maze) -> Option<String> {
        None
    }

    /// Returns the system ready to learn a maze.
    ///
    /// # Errors
    /// If maze, start or settings do not fit.
    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError>;

    /// Returns the system ready to drive to the goal by a map. Given several maps, it finds out
    /// which is that of the maze. The default implementation refuses.
    ///
    /// # Errors
    /// If maps, maze, start or settings do not fit.
    fn driver(&self, _maps: &[MapText], _setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        Err(format!("{} does not drive by a map", self.name()).into())
    }

    /// Returns the learned map in a file. The default implementation reads places and links, as
    /// [`Sent::keeping_its_view`](crate::Sent::keeping_its_view) writes them, and of other files
    /// only the origin.
    ///
    /// # Errors
    /// If the file is invalid.
    fn map(&self, map: &MapText) -> Result<Box<dyn LearnedMap>, BoxError> {
        Ok(match ViewFile::read(self.name(), &map.text) {
            Some(file) => Box::new(file),
            None => Box::new(map.clone()),
        })
    }
}

impl fmt::Debug for dyn SystemEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for dyn SystemEntry {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for dyn SystemEntry {}

/// Maps by which a system drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivesBy {
    /// The map of a file, or the one that it has just learned.
    AnyMap,
    /// Only the map that it has just learned.
    OwnMap,
    /// It does not drive by maps.
    NoMap,
}

/// World of a demonstration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DemoWorld {
    /// The star: for systems that map a larger maze slowly, or do not localize in it.
    Small,
    /// The maze of the demonstration.
    Large,
}

/// A way to estimate the trajectory of a robot from its log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogMapper {
    /// The odometry alone.
    Odometry,
    /// Scans matched to earlier ones.
    Matching,
    /// Scans matched to earlier ones, and to places seen before.
    ScanMatching,
    /// Scans matched to earlier ones; junctions, bends, dead ends and rooms recognized.
    Places,
    /// The same places, mapped by the diktiometry.
    Diktiometry,
    /// The same places, mapped by CPM.
    Cpm,
    /// The same places, mapped by the place graph of GNG-SLAM.
    PlaceGraph,
}
