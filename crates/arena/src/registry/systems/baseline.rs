use crate::cast::Agent;
use crate::registry::{Setup, SystemEntry};
use crate::{BoxError, Outing};

/// A baseline, which learns no map.
#[derive(Clone, Copy, Debug)]
pub(super) struct BaselineEntry(pub(super) Agent);

impl SystemEntry for BaselineEntry {
    fn name(&self) -> &'static str {
        match self.0 {
            Agent::Random => "random",
            Agent::Avoid => "avoid",
            Agent::WallFollow => "wall-follow",
            Agent::Oracle => "oracle",
            Agent::UnlocalizedOracle => "unlocalized-oracle",
        }
    }

    fn title(&self) -> &'static str {
        self.0.name()
    }

    fn about(&self) -> &'static str {
        self.0.description()
    }

    fn is_paper(&self) -> bool {
        true
    }

    fn learns(&self) -> bool {
        false
    }

    fn baseline(&self) -> Option<Agent> {
        Some(self.0)
    }

    fn why_no_log(&self) -> &'static str {
        "it learns no map"
    }

    fn claims(&self) -> bool {
        false
    }

    fn learner(&self, _setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let name = self.name();
        Err(format!("{name} learns no map: see it drive with `tolman run {name}`").into())
    }
}
