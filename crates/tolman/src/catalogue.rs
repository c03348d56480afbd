use tolman_arena::registry::{Registry, RobotEntry, SystemEntry};
use tolman_experiment::Entry;

use crate::Family;
use crate::replay_format::{self, ReplayFormat};

/// The systems, robots, families of worlds, experiments and formats that the command knows by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Catalogue {
    /// Name of the program, which reports and replays give as their maker.
    pub program: &'static str,
    /// Systems, robots and families of worlds, which the experiments look up too.
    pub registry: Registry,
    /// Experiments, in the order in which they are listed.
    pub experiments: Vec<Entry>,
    /// Formats of replays in addition to HTML.
    pub replay_formats: Vec<ReplayFormat>,
}

impl Catalogue {
    /// Returns the catalogue of the command `tolman`: all its systems, families and experiments.
    #[must_use]
    pub fn tolman() -> Self {
        Self {
            program: "tolman",
            registry: Registry::tolman(),
            experiments: tolman_papers::catalogue().to_vec(),
            replay_formats: replay_format::built_in(),
        }
    }

    /// Returns the catalogue with `program` as the program's name.
    #[must_use]
    pub fn program(self, program: &'static str) -> Self {
        Self { program, ..self }
    }

    /// Returns the catalogue with one more system.
    #[must_use]
    pub fn system(mut self, system: &'static dyn SystemEntry) -> Self {
        self.registry.systems.push(system);
        self
    }

    /// Returns the catalogue with one more robot.
    #[must_use]
    pub fn robot(mut self, robot: RobotEntry) -> Self {
        self.registry.robots.push(robot);
        self
    }

    /// Returns the catalogue with one more family of worlds.
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.registry.families.push(family);
        self
    }

    /// Returns the catalogue with one more experiment.
    #[must_use]
    pub fn experiment(mut self, experiment: Entry) -> Self {
        self.experiments.push(experiment);
        self
    }

    /// Returns the catalogue with one more format of replays.
    #[must_use]
    pub fn replay_format(mut self, format: ReplayFormat) -> Self {
        self.replay_formats.push(format);
        self
    }
}
