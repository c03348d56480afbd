//! A growing neural gas as plain data, to be saved and resumed.

use alloc::string::String;
use alloc::vec::Vec;

use super::{Decay, Gng, GngConfig, Sums};
use crate::error::{SUM, check_count, check_header, within};
use crate::{Network, NetworkSnapshot, Scalar, SnapshotError};

const FORMAT: &str = "tolman-gng";
const VERSION: u32 = 1;

/// Complete state of a [`Gng`]. Resuming it gives the same bits as never having stopped.
///
/// With the feature `serde`, `Gng` itself is serialized in this form. Deserializing refuses invalid
/// values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedGng<S> {
    /// Name of the format.
    pub format: String,
    /// Version of the format.
    pub version: u32,
    /// Parameters of the network.
    pub config: GngConfig,
    /// Units and edges of the network.
    pub network: NetworkSnapshot<S>,
    /// Error and utility of each unit, to be multiplied by `factor`.
    pub sums: Vec<(f64, f64)>,
    /// Factor by which errors have decayed since all of them were last brought up to date; above 0,
    /// at most 1.
    pub factor: f64,
    /// Number of inputs learnt.
    pub steps: u64,
}

impl<S: Scalar> From<Gng<S>> for SavedGng<S> {
    fn from(gng: Gng<S>) -> Self {
        let sums = gng.network.slots().map(|slot| {
            let sums = gng.sums[slot];
            (sums.error, sums.utility)
        });
        Self {
            format: FORMAT.into(),
            version: VERSION,
            config: gng.config,
            network: gng.network.snapshot(),
            sums: sums.collect(),
            factor: gng.decay.factor(),
            steps: gng.steps,
        }
    }
}

impl<S: Scalar> TryFrom<SavedGng<S>> for Gng<S> {
    type Error = SnapshotError;

    /// Resumes a saved network. Search and events are as in a new network.
    fn try_from(saved: SavedGng<S>) -> Result<Self, SnapshotError> {
        check_header(&saved.format, saved.version, FORMAT, VERSION)?;
        let network = Network::from_snapshot(&saved.network)?;
        let mut gng = Self::around(network, saved.config)?;
        check_count("sums", gng.network.len(), saved.sums.len())?;
        for (error, utility) in saved.sums {
            within("the error of a unit", error, SUM)?;
            within("the utility of a unit", utility, SUM)?;
            gng.sums.push(Sums { error, utility });
        }
        gng.decay = Decay::with_factor(saved.factor)?;
        gng.steps = saved.steps;
        Ok(gng)
    }
}
