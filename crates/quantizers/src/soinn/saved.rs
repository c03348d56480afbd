//! A SOINN as plain data, to be saved and resumed.

use alloc::string::String;
use alloc::vec::Vec;

use super::{Soinn, SoinnConfig, Tally};
use crate::error::check_header;
use crate::{Network, Scalar, Snapshot, SnapshotError};

const FORMAT: &str = "tolman-soinn";
const VERSION: u32 = 1;

/// All there is to know of a [`Soinn`]. To resume it and go on gives the same bits as never to have stopped.
///
/// With the feature `serde`, `Soinn` itself is serialized as this, and refuses to be made of what is invalid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedSoinn<S> {
    /// What this is.
    pub format: String,
    /// The version of the format.
    pub version: u32,
    /// The parameters.
    pub config: SoinnConfig,
    /// The units and edges.
    pub network: Snapshot<S>,
    /// What each unit remembers.
    pub tallies: Vec<SavedTally>,
    /// Inputs learnt.
    pub steps: u64,
}

/// What a unit remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SavedTally {
    /// E: the sum of the distances of the inputs it won.
    pub error: f64,
    /// M: how many those are.
    pub wins: f64,
    /// The step since which it has them, at most the inputs learnt.
    pub since: u64,
    /// R: the mean error after the last insertion that it had part in; none if there was none.
    pub radius: Option<f64>,
}

impl<S: Scalar> From<&Soinn<S>> for SavedSoinn<S> {
    fn from(soinn: &Soinn<S>) -> Self {
        let tallies = soinn.network.slots().map(|slot| {
            let Tally {
                error,
                wins,
                since,
                radius,
            } = soinn.tallies[slot];
            SavedTally {
                error,
                wins,
                since,
                radius: radius.is_finite().then_some(radius),
            }
        });
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

impl<S: Scalar> From<Soinn<S>> for SavedSoinn<S> {
    fn from(soinn: Soinn<S>) -> Self {
        Self::from(&soinn)
    }
}

impl<S: Scalar> TryFrom<SavedSoinn<S>> for Soinn<S> {
    type Error = SnapshotError;

    /// Resumes what was saved. Search and events are as in a new network.
    fn try_from(saved: SavedSoinn<S>) -> Result<Self, SnapshotError> {
        check_header(&saved.format, saved.version, FORMAT, VERSION)?;
        let mut soinn = Self::around(Network::from_snapshot(&saved.network)?, saved.config)?;
        if saved.tallies.len() != soinn.network.len() {
            return Err(SnapshotError::WrongCount {
                what: "tallies",
                expected: soinn.network.len(),
                found: saved.tallies.len(),
            });
        }
        for SavedTally {
            error,
            wins,
            since,
            radius,
        } in saved.tallies
        {
            in_range("the error of a unit", error, 0.0)?;
            in_range("the wins of a unit", wins, f64::MIN_POSITIVE)?;
            if since > saved.steps {
                return Err(SnapshotError::BadNumber {
                    field: "since of a unit",
                    value: since as f64,
                    range: "at most the steps",
                });
            }
            if let Some(radius) = radius {
                in_range("the radius of a unit", radius, 0.0)?;
            }
            soinn.tallies.push(Tally {
                error,
                wins,
                since,
                radius: radius.unwrap_or(f64::INFINITY),
            });
        }
        soinn.steps = saved.steps;
        Ok(soinn)
    }
}

/// No sum can have become larger.
fn in_range(field: &'static str, value: f64, least: f64) -> Result<(), SnapshotError> {
    if (least..1e280).contains(&value) {
        return Ok(());
    }
    Err(SnapshotError::BadNumber {
        field,
        value,
        range: "not negative and less than 1e280; wins above 0",
    })
}
