//! What files of maps begin with: their format and its version.

use alloc::string::String;

use thiserror::Error;

/// Why a file is none of its kind.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HeaderError {
    /// It is another kind of file.
    #[error("its format is {found:?}, expected {expected:?}")]
    Format {
        /// What it says.
        found: String,
        /// What it should say.
        expected: &'static str,
    },
    /// It is of a later time.
    #[error("its version is {found}, and {latest} is the latest known here: update tolman")]
    Version {
        /// What it says.
        found: u32,
        /// The latest that is known.
        latest: u32,
    },
}

/// Refuses what is not of the format `expected`, or of a version from 1 to `latest`.
pub(crate) fn check(
    format: &str,
    version: u32,
    expected: &'static str,
    latest: u32,
) -> Result<(), HeaderError> {
    if format != expected {
        let found = format.into();
        return Err(HeaderError::Format { found, expected });
    }
    if version == 0 || version > latest {
        let found = version;
        return Err(HeaderError::Version { found, latest });
    }
    Ok(())
}
