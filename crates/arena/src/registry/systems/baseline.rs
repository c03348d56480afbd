use crate::cast::Agent;
use crate::registry::{Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing};

/// A baseline, which learns no map.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaselineEntry(pub(super) Agent, pub(super) &'static str);

impl SystemEntry for BaselineEntry {
    fn facts(&self) -> SystemFacts {
        let Self(agent, name) = *self;
        SystemFacts {
            title: agent.name(),
            about: agent.description(),
            is_paper: true,
            learns: false,
            baseline: Some(agent),
            why_no_log: "it learns no map",
            claims: false,
            ..SystemFacts::new(name)
        }
    }

    fn learner(&self, _setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let name = self.name();
        Err(format!("{name} learns no map: see it drive with `tolman run {name}`").into())
    }
}
