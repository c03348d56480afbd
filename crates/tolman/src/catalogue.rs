use tolman_experiment::Entry;

use crate::Family;
use crate::replay_format::{self, ReplayFormat};
use crate::system::SystemEntry;
use crate::systems::{CpmEntry, DiktiometryEntry, GngSlamEntry, MslstBetterEntry, MslstEntry};

/// The systems, families of worlds, experiments and formats that the command knows by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Catalogue {
    /// Name of the program, which reports and replays give as their maker.
    pub program: &'static str,
    /// Systems that learn maps.
    pub systems: Vec<&'static dyn SystemEntry>,
    /// Families of worlds.
    pub families: Vec<Family>,
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
            systems: vec![
                &MslstEntry,
                &MslstBetterEntry,
                &CpmEntry,
                &DiktiometryEntry,
                &GngSlamEntry,
            ],
            families: Family::all(),
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
        self.systems.push(system);
        self
    }

    /// Returns the catalogue with one more family of worlds.
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.families.push(family);
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
