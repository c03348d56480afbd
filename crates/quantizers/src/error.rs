//! What can be wrong with what a caller passes.

use thiserror::Error;

use crate::UnitId;

/// Why an input was refused. The network is as it was before.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// The input has another number of features than the network.
    #[error("the input has {found} features where the network has {expected}")]
    WrongDimension {
        /// Features of the network.
        expected: usize,
        /// Features of the input.
        found: usize,
    },
    /// A feature is NaN or infinite.
    #[error("feature {feature} is {value}: leave such inputs out or repair them before")]
    NotFinite {
        /// Its number, from 0.
        feature: usize,
        /// What it is.
        value: f64,
    },
    /// A feature is so large that a squared distance could overflow.
    #[error(
        "feature {feature} is {value:e}, beyond ±{limit:e}, where squared distances overflow: scale the inputs"
    )]
    TooLarge {
        /// Its number, from 0.
        feature: usize,
        /// What it is.
        value: f64,
        /// The largest magnitude allowed.
        limit: f64,
    },
    /// The mask of a query has another number of features than the network.
    #[error("the mask has {found} features where the network has {expected}")]
    WrongMask {
        /// Features of the network.
        expected: usize,
        /// Features of the mask.
        found: usize,
    },
    /// The mask of a query leaves no feature to compare.
    #[error("the mask leaves no feature to compare: let at least one through")]
    NothingCompared,
    /// The network has no unit yet that could be the nearest.
    #[error("the network has no units yet: let it observe an input first")]
    NoUnits,
    /// A measure over a set of inputs was asked of an empty set.
    #[error("there are no inputs to measure the error of")]
    NoInputs,
}

/// Why a quantizer cannot be made as asked for.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ConfigError {
    /// Inputs must have features.
    #[error("a network needs inputs of at least one feature")]
    NoFeatures,
    /// A field is outside its range.
    #[error("{field} is {value} but has to be {range}")]
    OutOfRange {
        /// The name of the field.
        field: &'static str,
        /// What it is.
        value: f64,
        /// What it may be, in words.
        range: &'static str,
    },
    /// A weight is negative, NaN or infinite.
    #[error("the weight of feature {feature} is {value}: it has to be finite and not negative")]
    BadWeight {
        /// The number of the feature, from 0.
        feature: usize,
        /// What the weight is.
        value: f64,
    },
    /// With no weight above zero all units are equally near.
    #[error("all weights are zero: at least one feature has to count")]
    NoWeight,
    /// A unit the network shall begin with is no valid input.
    #[error("unit {unit} of those to begin with: {source}")]
    BadUnit {
        /// Its number, from 0.
        unit: usize,
        /// What is wrong with it.
        source: InputError,
    },
    /// A network begins with two units or finds its own.
    #[error("a network begins with none or at least two units, not {found}")]
    TooFewUnits {
        /// How many were given.
        found: usize,
    },
}

/// Refuses the value of a field unless a condition holds.
pub(crate) fn within(
    field: &'static str,
    value: f64,
    holds: bool,
    range: &'static str,
) -> Result<(), ConfigError> {
    if holds {
        return Ok(());
    }
    Err(ConfigError::OutOfRange {
        field,
        value,
        range,
    })
}

/// A unit that is not, or no longer, part of the network.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("the network has no unit {0}: it was removed, or never there")]
pub struct UnknownUnit(pub UnitId);
