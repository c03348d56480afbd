use core::fmt;

use tolman_maze::Maze;

use super::view_file::ViewFile;
use super::{LearnedMap, MapText, RobotEntry, RobotKind, Setup};
use crate::cast::Agent;
use crate::contest::PlaceRule;
use crate::{BoxError, Outing};

/// A system by its name, with the robots that can carry it.
///
/// An implementation makes the system ready on its robot. Others let it act, watch it, judge its
/// map and store it: the command, the arena, the papers' tables, Python and the playground.
pub trait SystemEntry: Sync {
    /// Returns the name as typed, in kebab case; files of maps name it too.
    fn name(&self) -> &'static str;

    /// Returns the name in tables.
    fn title(&self) -> &'static str {
        self.name()
    }

    /// Returns a description in one line, which begins with a verb.
    fn about(&self) -> &'static str {
        "is a system from another crate"
    }

    /// Returns whether the system is as its paper has it.
    fn is_paper(&self) -> bool {
        false
    }

    /// Returns what the system does with sensors that not every robot has, as in "it needs a
    /// compass".
    fn needs(&self) -> &'static str {
        "needs a laser ring and a compass"
    }

    /// Returns the kinds of robots that sense and move as the system needs it.
    fn kinds(&self) -> &'static [RobotKind] {
        &[RobotKind::Laser]
    }

    /// Returns the name of the robot that the system is made for.
    fn own_robot(&self) -> &'static str {
        RobotEntry::LASER_PIONEER.name
    }

    /// Returns why a robot cannot carry the system, in a sentence without a full stop; `None` if it
    /// can.
    fn why_not(&self, robot: &RobotEntry) -> Option<String> {
        let mut kinds = self.kinds().iter();
        let is_able = kinds.any(|kind| robot.kind().can_be(*kind));
        let why = || format!("it {}, and the {} has none", self.needs(), robot.title);
        (!is_able).then(why)
    }

    /// Returns the names of its presets with their descriptions; the first is the default.
    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }

    /// Returns the preset for contests, where the size of the world limits how far a robot may
    /// drive; `None` for the default.
    fn arena_preset(&self) -> Option<&'static str> {
        None
    }

    /// Returns whether it learns a map of a maze with a robot.
    fn learns(&self) -> bool {
        true
    }

    /// Returns the baseline that this is; `None` for a system.
    fn baseline(&self) -> Option<Agent> {
        None
    }

    /// Returns how the system maps a log; `None` if it cannot.
    fn log_mapper(&self) -> Option<LogMapper> {
        None
    }

    /// Returns why the system cannot map a log, in a sentence without a full stop.
    fn why_no_log(&self) -> &'static str {
        "it learns from actions, which a log does not name"
    }

    /// Returns whether it drives to the goal by a map in a file.
    fn drives(&self) -> bool {
        false
    }

    /// Returns whether being done means that it claims its map is that of the whole world.
    fn claims(&self) -> bool {
        true
    }

    /// Returns the rule for the cells that are places of this system. If it treats another cell
    /// with two ways as a place, that cell counts as part of a way.
    fn places(&self) -> PlaceRule {
        PlaceRule::Landmarks
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

    /// Returns the world and the seed that show the system well.
    fn demo(&self) -> (DemoWorld, u64) {
        (DemoWorld::Large, 1)
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
