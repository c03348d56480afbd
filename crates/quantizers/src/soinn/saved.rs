//! A SOINN as plain data, to be saved and resumed.

use alloc::string::String;
use alloc::vec::Vec;

use super::{Soinn, SoinnConfig, Tally};
use crate::error::{SUM, check_count, check_header, within};
use crate::{Network, NetworkSnapshot, QuantizerConfigError, Scalar, SnapshotError};

const FORMAT: &str = "tolman-soinn";
const VERSION: u32 = 1;

/// Complete state of a [`Soinn`]. Resuming it gives the same bits as never having stopped.
///
/// With the feature `serde`, `Soinn` itself is serialized in this form. Deserializing refuses
/// invalid values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedSoinn<S> {
    /// Name of the format.
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// Parameters of the layer.
    pub config: SoinnConfig,
    /// Units and edges of the layer.
    pub network: NetworkSnapshot<S>,
    /// Tally of each unit, in the order of the units.
    pub tallies: Vec<Tally>,
    /// Number of inputs learnt.
    pub steps: u64,
}

impl<S: Scalar> From<Soinn<S>> for SavedSoinn<S> {
    fn from(soinn: Soinn<S>) -> Self {
        let tallies = soinn.network.slots().map(|slot| soinn.tallies[slot]);
        Self {
            format: FORMAT.into(),
            version: VERSION,
            config: soinn.config,
            network: soinn.network.snapshot(),
            tallies: tallies.collect(),
            steps: soinn.steps,
        }
    }
}

impl<S: Scalar> TryFrom<SavedSoinn<S>> for Soinn<S> {
    type Error = SnapshotError;

    /// Resumes a saved network. Search and events are as in a new network.
    fn try_from(saved: SavedSoinn<S>) -> Result<Self, SnapshotError> {
        check_header(&saved.format, saved.version, FORMAT, VERSION)?;
        let mut soinn = Self::around(Network::from_snapshot(&saved.network)?, saved.config)?;
        check_count("tallies", soinn.network.len(), saved.tallies.len())?;
        for tally in &saved.tallies {
            tally.check(saved.steps)?;
        }
        soinn.tallies = saved.tallies;
        soinn.steps = saved.steps;
        Ok(soinn)
    }
}

impl Tally {
    /// Checks that a unit can have this tally after `steps` inputs.
    fn check(&self, steps: u64) -> Result<(), QuantizerConfigError> {
        let wins = |wins| (f64::MIN_POSITIVE..1e280).contains(&wins);
        within("the error of a unit", self.error, SUM)?;
        within(
            "the wins of a unit",
            self.wins,
            (wins, "above 0 and less than 1e280"),
        )?;
        within("the radius of a unit", self.radius.unwrap_or_default(), SUM)?;
        if self.since <= steps {
            return Ok(());
        }
        Err(QuantizerConfigError::OutOfRange {
            field: "since of a unit",
            value: self.since as f64,
            range: "at most the steps",
        })
    }
}
