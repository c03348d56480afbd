use std::sync::OnceLock;

use super::systems;
use super::{Family, RobotEntry, SystemEntry};
use crate::contest::Condition;

/// Systems, robots and families of worlds that a program knows by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Registry {
    /// Systems in the order of the tables: those that drive, the baselines, those that map logs
    /// alone.
    pub systems: Vec<&'static dyn SystemEntry>,
    /// Robots.
    pub robots: Vec<RobotEntry>,
    /// Families of worlds; the arena's come first.
    pub families: Vec<Family>,
    /// Conditions under which contests are held.
    pub conditions: Vec<Condition>,
}

/// Former names of systems, with the present ones.
const FORMER: [(&str, &str); 1] = [("gngslam", "gng-slam-better")];

static PROGRAM: OnceLock<Registry> = OnceLock::new();

impl Registry {
    /// Returns the systems, robots and families of this project.
    #[must_use]
    pub fn tolman() -> Self {
        Self {
            systems: systems::ALL.to_vec(),
            robots: RobotEntry::ALL.to_vec(),
            families: Family::all(),
            conditions: Condition::ALL.to_vec(),
        }
    }

    /// Returns the registry of this program: the one that was [installed](Self::install), or else
    /// that of this project.
    pub fn current() -> &'static Self {
        PROGRAM.get_or_init(Self::tolman)
    }

    /// Makes this the registry of the program.
    ///
    /// # Errors
    /// The registry itself if the program has already looked something up, or installed another.
    pub fn install(self) -> Result<(), Box<Self>> {
        PROGRAM.set(self).map_err(Box::new)
    }

    /// Returns the system of this name, as typed or as in tables; `None` if there is none.
    #[must_use]
    pub fn system(&self, name: &str) -> Option<&'static dyn SystemEntry> {
        let named = |system: &&&'static dyn SystemEntry| {
            system.name() == slug(name) || system.title() == name
        };
        self.systems.iter().find(named).copied()
    }

    /// Returns the robot of this name, as typed or as in the files of maps; `None` if there is
    /// none. O(robots).
    #[must_use]
    pub fn robot(&self, name: &str) -> Option<RobotEntry> {
        let mut robots = self.robots.iter();
        robots.find(|robot| robot.name == slug(name)).copied()
    }

    /// Returns the present name of a system that was called `name` before; `None` if it never was.
    #[must_use]
    pub fn former_name(name: &str) -> Option<&'static str> {
        let mut former = FORMER.into_iter();
        former.find(|(former, _)| *former == name).map(|two| two.1)
    }

    /// Returns the systems that learn a map of a maze with a robot.
    pub fn learners(&self) -> impl Iterator<Item = &'static dyn SystemEntry> {
        let systems = self.systems.iter().copied();
        systems.filter(|system| system.learns())
    }

    /// Returns the contestants of the arena: the systems that learn, then the baselines.
    pub fn contestants(&self) -> impl Iterator<Item = &'static dyn SystemEntry> {
        let baselines = self.systems.iter().copied();
        self.learners()
            .chain(baselines.filter(|system| system.baseline().is_some()))
    }

    /// Returns the families in which every system is tested: those of the arena, and those that are
    /// not this project's.
    pub fn arena_families(&self) -> impl Iterator<Item = Family> {
        let known = Family::all();
        let is_extra = move |family: &Family| {
            let is = |other: &Family| other.name == family.name;
            known.iter().any(is) && !Family::ARENA.iter().any(is)
        };
        self.families
            .iter()
            .copied()
            .filter(move |family| !is_extra(family))
    }

    /// Returns the robots that can carry a system, its own first. O(robots).
    #[must_use]
    pub fn robots_of(&self, system: &dyn SystemEntry) -> Vec<RobotEntry> {
        let mut robots: Vec<RobotEntry> = self.robots.clone();
        robots.retain(|robot| system.why_not(robot).is_none());
        // The sort keeps the order of the others.
        robots.sort_by_key(|robot| robot.name != system.facts().own_robot);
        robots
    }
}

/// Returns a name as it is typed: `braided rooms` is `braided-rooms`.
#[must_use]
pub fn slug(name: &str) -> String {
    name.to_lowercase().replace(' ', "-")
}
