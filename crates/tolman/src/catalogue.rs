use tolman_experiment::Entry;

use crate::Family;
use crate::system::SystemEntry;
use crate::systems::{CpmEntry, DiktiometryEntry, GngSlamEntry, MslstBetterEntry, MslstEntry};

/// What the command knows by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Catalogue {
    /// What the program is called, which reports and replays say they were made by.
    pub program: &'static str,
    /// The systems that learn maps.
    pub systems: Vec<&'static dyn SystemEntry>,
    /// The families of worlds.
    pub families: Vec<Family>,
    /// The experiments.
    pub experiments: Vec<Entry>,
}

impl Catalogue {
    /// Returns what is known here.
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
        }
    }

    /// Returns it with another name of the program.
    #[must_use]
    pub fn program(self, program: &'static str) -> Self {
        Self { program, ..self }
    }

    /// Returns it with one more system.
    #[must_use]
    pub fn system(mut self, system: &'static dyn SystemEntry) -> Self {
        self.systems.push(system);
        self
    }

    /// Returns it with one more family of worlds.
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.families.push(family);
        self
    }

    /// Returns it with one more experiment.
    #[must_use]
    pub fn experiment(mut self, experiment: Entry) -> Self {
        self.experiments.push(experiment);
        self
    }
}
