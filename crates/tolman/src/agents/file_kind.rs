use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A kind of files that hold what an agent has learned: JSON that begins with its format and version.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileKind {
    /// What `format` says.
    pub(super) format: &'static str,
    /// The version that is written; all versions up to it are read.
    pub(super) version: u32,
    /// Such as "survey".
    pub(super) name: &'static str,
    /// What makes one.
    pub(super) command: &'static str,
}

/// How such a file begins, whatever its version.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct FileHeader {
    format: String,
    version: u32,
}

/// Why a file is none of its kind, or cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// It is no JSON of the right form. The source has line and column.
    #[error("this is no {name}: make one with `{command}`")]
    Json {
        /// What it should be.
        name: &'static str,
        /// What makes one.
        command: &'static str,
        /// Where it is none.
        source: serde_json::Error,
    },
    /// It ends too soon. The source has line and column.
    #[error("this {name} is cut off: copy it again, or make one with `{command}`")]
    CutOff {
        /// What it is.
        name: &'static str,
        /// What makes one.
        command: &'static str,
        /// Where it ends.
        source: serde_json::Error,
    },
    /// It is of another kind.
    #[error("its format is {found:?}, expected {expected:?}: make a {name} with `{command}`")]
    Format {
        /// What it says.
        found: String,
        /// What it should say.
        expected: &'static str,
        /// What it should be.
        name: &'static str,
        /// What makes one.
        command: &'static str,
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

impl FileKind {
    pub(super) fn header(&self) -> FileHeader {
        FileHeader {
            format: self.format.to_owned(),
            version: self.version,
        }
    }

    /// Whether a text says that it is of this kind: of whatever version, sound, broken or cut off.
    pub(super) fn claims(&self, text: &str) -> bool {
        let header: Result<FileHeader, _> = serde_json::from_str(text);
        header.map_or_else(
            |_| text.contains(&format!("\"{}\"", self.format)),
            |header| header.format == self.format,
        )
    }

    /// What a file holds, its header besides.
    ///
    /// # Errors
    /// [`FileError`].
    pub(super) fn parse<T: DeserializeOwned>(&self, text: &str) -> Result<T, FileError> {
        let Self {
            format,
            version,
            name,
            command,
        } = *self;
        let json = |source: serde_json::Error| {
            if source.is_eof() && self.claims(text) {
                FileError::CutOff {
                    name,
                    command,
                    source,
                }
            } else {
                FileError::Json {
                    name,
                    command,
                    source,
                }
            }
        };
        let header: FileHeader = serde_json::from_str(text).map_err(json)?;
        if header.format != format {
            return Err(FileError::Format {
                found: header.format,
                expected: format,
                name,
                command,
            });
        }
        if header.version == 0 || header.version > version {
            return Err(FileError::Version {
                found: header.version,
                latest: version,
            });
        }
        serde_json::from_str(text).map_err(json)
    }
}
