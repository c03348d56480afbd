use crate::registry::{LogMapper, Setup, SystemEntry, SystemFacts};
use crate::{BoxError, Outing};

/// A mapper that only watches: it maps logs.
#[derive(Clone, Copy, Debug)]
pub(super) struct LogEntry {
    name: &'static str,
    about: &'static str,
    mapper: LogMapper,
}

pub(super) const SCAN_MATCHING: LogEntry = LogEntry {
    name: "scan-matching",
    about: "matches scans to earlier ones, and to places seen before: the dense baseline",
    mapper: LogMapper::ScanMatching,
};

pub(super) const PLACES: LogEntry = LogEntry {
    name: "places",
    about: "matches scans to earlier ones; junctions, bends, dead ends and rooms are places, which it recognizes again",
    mapper: LogMapper::Places,
};

pub(super) const MATCHING: LogEntry = LogEntry {
    name: "matching",
    about: "matches scans only to those shortly before",
    mapper: LogMapper::Matching,
};

pub(super) const ODOMETRY: LogEntry = LogEntry {
    name: "odometry",
    about: "uses the wheels only",
    mapper: LogMapper::Odometry,
};

impl SystemEntry for LogEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            about: self.about,
            needs: "needs a log",
            kinds: &[],
            learns: false,
            log_mapper: Some(self.mapper),
            claims: false,
            ..SystemFacts::new(self.name)
        }
    }

    fn learner(&self, _setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        let name = self.name;
        Err(format!(
            "{name} drives no robot: map a log with `tolman map --log FILE --system {name}`"
        )
        .into())
    }
}
