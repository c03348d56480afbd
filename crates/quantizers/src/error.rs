//! Faults of the arguments that a caller passes.

use alloc::string::String;

use thiserror::Error;

use crate::UnitId;

/// Reason why an input was refused. The network is as it was before.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// The input has another number of features than the network.
    #[error("the input has {found} features; give {expected}, as the network has")]
    WrongDimension {
        /// Number of features of the network.
        expected: usize,
        /// Number of features of the input.
        found: usize,
    },
    /// A feature is NaN or infinite.
    #[error("feature {feature} is {value}: leave such inputs out or repair them before")]
    NotFinite {
        /// Index of the feature, from 0.
        feature: usize,
        /// Value that was given.
        value: f64,
    },
    /// A feature is so large that a squared distance could overflow.
    #[error(
        "feature {feature} is {value:e}, beyond ±{limit:e}, where squared distances overflow: scale the inputs"
    )]
    TooLarge {
        /// Index of the feature, from 0.
        feature: usize,
        /// Value that was given.
        value: f64,
        /// Maximum magnitude of a feature.
        limit: f64,
    },
    /// The mask of a query has another number of features than the network.
    #[error("the mask has {found} features; give {expected}, as the network has")]
    WrongMask {
        /// Number of features of the network.
        expected: usize,
        /// Number of features of the mask.
        found: usize,
    },
    /// The mask of a query leaves no feature to compare.
    #[error("the mask leaves no feature to compare: let at least one through")]
    NothingCompared,
    /// The network has no unit yet that could be the nearest.
    #[error("the network has no units yet: let it observe an input first")]
    NoUnits,
    /// A measure over a set of inputs was asked of an empty set.
    #[error("there are no inputs to measure the error of; give at least one")]
    NoInputs,
}

impl InputError {
    /// Refuses an input of another number of features than expected.
    #[inline]
    pub(crate) fn check_size(expected: usize, found: usize) -> Result<(), Self> {
        if expected == found {
            Ok(())
        } else {
            Err(Self::WrongDimension { expected, found })
        }
    }
}

/// Reason why a quantizer cannot be made as asked for.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum QuantizerConfigError {
    /// Inputs must have features.
    #[error("the inputs have no features; give at least one")]
    NoFeatures,
    /// A field, or a saved number, is outside its range.
    #[error("{field} is {value} but has to be {range}")]
    OutOfRange {
        /// Name of the field or of the quantity.
        field: &'static str,
        /// Value that was given.
        value: f64,
        /// Allowed range, in words.
        range: &'static str,
    },
    /// A weight is negative, NaN or infinite.
    #[error("the weight of feature {feature} is {value}: it has to be finite and not negative")]
    BadWeight {
        /// Index of the feature, from 0.
        feature: usize,
        /// Value of the weight.
        value: f64,
    },
    /// All weights are 0, so all units would be equally near.
    #[error("all weights are zero: at least one feature has to count")]
    NoWeight,
    /// An initial unit of the network is not a valid input.
    #[error("initial unit {unit}: {source}")]
    BadUnit {
        /// Number of the initial unit, from 0.
        unit: usize,
        /// Fault of the unit's prototype.
        source: InputError,
    },
    /// Only one initial unit is given.
    #[error("a network cannot begin with {found} units; give none, or at least two")]
    TooFewUnits {
        /// Number of initial units given.
        found: usize,
    },
}

/// Test of a number's range, and the range in words.
pub(crate) type Range = (fn(f64) -> bool, &'static str);

pub(crate) const SHARE: Range = (|value| (0.0..=1.0).contains(&value), "between 0 and 1");
pub(crate) const AT_LEAST_1: Range = (|value| value >= 1.0, "at least 1");
pub(crate) const NOT_NEGATIVE: Range = (
    |value| value >= 0.0 && value.is_finite(),
    "finite and not negative",
);

/// Range of sums of errors or utilities.
pub(crate) const SUM: Range = (
    |value| (0.0..1e280).contains(&value),
    "not negative and less than 1e280",
);

/// Refuses a number outside of its range.
pub(crate) fn within(
    field: &'static str,
    value: impl Into<f64>,
    (holds, range): Range,
) -> Result<(), QuantizerConfigError> {
    let value = value.into();
    if holds(value) {
        return Ok(());
    }
    Err(QuantizerConfigError::OutOfRange {
        field,
        value,
        range,
    })
}

/// A unit that is not, or no longer, part of the network.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("the network has no unit {0}: give the id of a present unit")]
pub struct UnknownUnit(pub UnitId);

/// Reason why a saved network cannot be resumed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The text is not a saved network of this kind.
    #[error("the format is {found:?}, expected {expected:?}: give a saved network of this kind")]
    WrongFormat {
        /// Format that is read here.
        expected: &'static str,
        /// Format that the text names.
        found: String,
    },
    /// The file was saved in a version that is not known, most likely by a later program.
    #[error(
        "version {found} is newer than {newest}, the newest this program reads: use a newer program"
    )]
    WrongVersion {
        /// Newest version that this program reads.
        newest: u32,
        /// Version of the text.
        found: u32,
    },
    /// A field of the configuration, a weight or another saved number is outside its range.
    #[error(transparent)]
    Config(#[from] QuantizerConfigError),
    /// A prototype is not a valid input.
    #[error("the prototype of unit {id}: {source}")]
    BadPrototype {
        /// Unit with the invalid prototype.
        id: UnitId,
        /// Fault of the prototype.
        source: InputError,
    },
    /// A remembered input is not valid.
    #[error("remembered input {input}: {source}")]
    BadMemory {
        /// Number of the remembered input, from 0.
        input: usize,
        /// Fault of the remembered input.
        source: InputError,
    },
    /// The ids do not ascend, or one is not below the next id.
    #[error("unit {id} is out of order: ids have to ascend and be less than {next_id}")]
    BadId {
        /// Unit whose id is out of order.
        id: UnitId,
        /// Id that the next new unit will get.
        next_id: u32,
    },
    /// An edge has an end that is not a unit, joins a unit to itself, or is given twice.
    #[error("the edge {}–{} has an end that is not a unit, or joins a unit to itself, or comes twice: remove it", .ends.0, .ends.1)]
    BadEdge {
        /// Ids of the units at its ends.
        ends: (UnitId, UnitId),
    },
    /// A list has the wrong length.
    #[error("there are {found} {what}, expected {expected}: save the network again")]
    WrongCount {
        /// Kind of the list's items.
        what: &'static str,
        /// Number of items expected.
        expected: usize,
        /// Number of items found.
        found: usize,
    },
}

/// Refuses a list of the wrong length.
pub(crate) fn check_count(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), SnapshotError> {
    if expected == found {
        return Ok(());
    }
    Err(SnapshotError::WrongCount {
        what,
        expected,
        found,
    })
}

/// Refuses text of another format or of an unknown version.
pub(crate) fn check_header(
    found: &str,
    version: u32,
    expected: &'static str,
    newest: u32,
) -> Result<(), SnapshotError> {
    if found != expected {
        let found = found.into();
        return Err(SnapshotError::WrongFormat { expected, found });
    }
    if version == 0 || version > newest {
        let found = version;
        return Err(SnapshotError::WrongVersion { newest, found });
    }
    Ok(())
}
