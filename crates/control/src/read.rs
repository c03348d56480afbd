//! Reads the numbers of a configuration and refuses invalid ones: files cannot be trusted.

use serde::de::{Deserialize, Deserializer, Error, Unexpected};

/// Maximum number of beams that a layer may watch, as many as a ring may have.
const MOST_BEAMS: u64 = 1_000_000;

fn number<'de, D: Deserializer<'de>>(
    deserializer: D,
    holds: impl FnOnce(f64) -> bool,
    expected: &'static str,
) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if holds(value) {
        Ok(value)
    } else {
        Err(Error::invalid_value(Unexpected::Float(value), &expected))
    }
}

pub(crate) fn finite<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    number(deserializer, f64::is_finite, "a finite number")
}

pub(crate) fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let holds = |value: f64| value.is_finite() && value > 0.0;
    number(deserializer, holds, "a finite number above 0")
}

pub(crate) fn at_least_zero<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let holds = |value: f64| value.is_finite() && value >= 0.0;
    number(deserializer, holds, "a finite number of at least 0")
}

/// Returns a number above 0. JSON knows no infinity and writes `null` for it.
pub(crate) fn positive_or_infinite<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<f64, D::Error> {
    match Option::<f64>::deserialize(deserializer)? {
        None => Ok(f64::INFINITY),
        Some(value) if value > 0.0 => Ok(value),
        Some(value) => Err(Error::invalid_value(
            Unexpected::Float(value),
            &"a number above 0, or null for none",
        )),
    }
}

pub(crate) fn beams<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    let value = u64::deserialize(deserializer)?;
    let beams = usize::try_from(value.min(MOST_BEAMS)).unwrap_or(usize::MAX);
    if value <= MOST_BEAMS {
        Ok(beams)
    } else {
        Err(Error::invalid_value(
            Unexpected::Unsigned(value),
            &"at most 1,000,000 beams",
        ))
    }
}

macro_rules! at_least_one {
    ($($name:ident: $type:ty),*) => {$(
        pub(crate) fn $name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<$type, D::Error> {
            let value = <$type>::deserialize(deserializer)?;
            if value > 0 {
                Ok(value)
            } else {
                Err(Error::invalid_value(Unexpected::Unsigned(0), &"a whole number of at least 1"))
            }
        }
    )*};
}

at_least_one!(at_least_one: u32, at_least_one_long: u64);
