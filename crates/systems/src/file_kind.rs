//! Files that hold what a system has learned: JSON that begins with its format and version.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A kind of files that hold what an agent has learned: JSON that begins with its format and version.
#[derive(Clone, Copy, Debug)]
pub struct FileKind {
    /// What `format` says.
    pub format: &'static str,
    /// The version that is written; all versions up to it are read.
    pub version: u32,
    /// Such as "survey".
    pub name: &'static str,
    /// What makes one.
    pub command: &'static str,
}

/// How such a file begins, whatever its version.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FileHeader {
    format: String,
    version: u32,
}

/// Why a file is none of its kind, or cannot be read or written.
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
    /// It says version 0; versions begin with 1.
    #[error("its version is 0, which no {name} ever had: make one with `{command}`")]
    NoVersion {
        /// What it should be.
        name: &'static str,
        /// What makes one.
        command: &'static str,
    },
    /// What it should hold has no JSON form.
    #[error("this {name} has no JSON form")]
    Unwritable {
        /// What it should be.
        name: &'static str,
        /// Why.
        source: serde_json::Error,
    },
}

impl FileKind {
    /// Returns what a file of this kind begins with.
    #[must_use]
    pub fn header(&self) -> FileHeader {
        FileHeader {
            format: self.format.to_owned(),
            version: self.version,
        }
    }

    /// Returns whether a text says that it is of this kind: of whatever version, sound, broken or cut off.
    #[must_use]
    pub fn claims(&self, text: &str) -> bool {
        let header: Result<FileHeader, _> = serde_json::from_str(text);
        header.map_or_else(
            |_| text.contains(&format!("\"{}\"", self.format)),
            |header| header.format == self.format,
        )
    }

    /// Returns the text of a file, with a line end. `body` has the header.
    ///
    /// # Errors
    /// [`FileError::Unwritable`].
    pub fn write(&self, body: &impl Serialize) -> Result<String, FileError> {
        let name = self.name;
        serde_json::to_string(body)
            .map(|text| text + "\n")
            .map_err(|source| FileError::Unwritable { name, source })
    }

    /// Returns what a file holds, its header besides.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn parse<T: DeserializeOwned>(&self, text: &str) -> Result<T, FileError> {
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
        if header.version == 0 {
            return Err(FileError::NoVersion { name, command });
        }
        if header.version > version {
            return Err(FileError::Version {
                found: header.version,
                latest: version,
            });
        }
        serde_json::from_str(text).map_err(json)
    }
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeMap;

    use super::*;

    const KIND: FileKind = FileKind {
        format: "tolman-test",
        version: 2,
        name: "test",
        command: "tolman test",
    };

    #[test]
    fn version_0_is_not_of_a_later_time() {
        let read = |version: u32| {
            let text = format!("{{\"format\":\"tolman-test\",\"version\":{version}}}");
            KIND.parse::<FileHeader>(&text)
        };
        assert!(matches!(read(0), Err(FileError::NoVersion { .. })));
        assert!(read(1).is_ok() && read(2).is_ok());
        assert!(matches!(
            read(3),
            Err(FileError::Version {
                found: 3,
                latest: 2
            })
        ));
    }

    #[test]
    fn what_has_no_json_form_is_not_written() {
        assert_eq!(KIND.write(&[1, 2]).unwrap(), "[1,2]\n");
        // Keys have to be strings.
        let unwritable = BTreeMap::from([([1, 2], 3)]);
        let error = KIND.write(&unwritable).unwrap_err();
        assert!(matches!(error, FileError::Unwritable { .. }), "{error}");
    }
}
