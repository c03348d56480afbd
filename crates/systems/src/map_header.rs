//! The one form of files that hold a learned map: JSON with a header that every system shares.
//!
//! A file begins `{"format":"tolman-map","version":1,"system":"mslst","world":"J","robot":"laser
//! Pioneer","seed":1,` and goes on with what the system keeps. Files of other versions are refused
//! by name, and so are those of the formats that were there before.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

const FORMAT: &str = "tolman-map";
/// Version of the header and of every system's part. No other is read.
const VERSION: u32 = 1;

/// A system that keeps its maps in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MapSystem {
    /// States and a graph of them, of [`mslst`](crate::mslst).
    Mslst,
    /// Fragments and junctions, of [`cpm`](crate::cpm).
    Cpm,
    /// The journal of a survey, of [`diktiometry`](crate::diktiometry).
    Diktiometry,
}

/// Where a map was learned, by which robot and from which seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Name of the maze.
    pub world: String,
    /// Name of the robot, such as "e-puck".
    pub robot: String,
    /// Seed of all random numbers from the first step on.
    pub seed: u64,
}

/// Reason why a text holds no learned map, or a map has no text.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The text is not JSON, or has no header.
    #[error(
        "this is no learned map: make one with `tolman learn`, `tolman cpm learn` or `tolman survey`"
    )]
    Header(#[source] serde_json::Error),
    /// The text ends too soon.
    #[error(
        "this map is cut off: copy it again, or make one with `tolman learn`, `tolman cpm learn` or `tolman survey`"
    )]
    CutOff(#[source] serde_json::Error),
    /// The format is that of another kind of file.
    #[error("its format is {found:?}, expected {FORMAT:?}")]
    Format {
        /// Format that the file names.
        found: String,
    },
    /// The format is one that is no longer read.
    #[error(
        "its format, {:?}, is no longer read: make a new {} with `{}`",
        .system.words().former_format, .system.words().file_name, .system.words().command
    )]
    FormerFormat {
        /// System that once wrote this format.
        system: MapSystem,
    },
    /// The file was written by a later tolman.
    #[error("its version is {found}, and {VERSION} is the latest known here: update tolman")]
    LaterVersion {
        /// Version that the file names.
        found: u32,
    },
    /// The version is one that is no longer read, or that never was.
    #[error(
        "its version is {found}, and only {VERSION} is read here: make a new map with `tolman learn`, `tolman cpm learn` or `tolman survey`"
    )]
    FormerVersion {
        /// Version that the file names.
        found: u32,
    },
    /// The map is that of another system.
    #[error(
        "this is a {}, expected a {}: make one with `{}`",
        .found.words().file_name, .expected.words().file_name, .expected.words().command
    )]
    System {
        /// System that the file names.
        found: MapSystem,
        /// System that the caller asked for.
        expected: MapSystem,
    },
    /// The header is sound, but what follows is not. The source has line and column.
    #[error("this {} cannot be read: make one with `{}`", .system.words().file_name, .system.words().command)]
    Body {
        /// System that the file names.
        system: MapSystem,
        /// Place where it cannot be read.
        source: serde_json::Error,
    },
    /// The map has no JSON form.
    #[error("this {} has no JSON form", .system.words().file_name)]
    Unwritable {
        /// System of the map.
        system: MapSystem,
        /// Reason.
        source: serde_json::Error,
    },
}

#[derive(Serialize)]
struct File<'a, B> {
    format: &'static str,
    version: u32,
    system: MapSystem,
    #[serde(flatten)]
    origin: &'a Origin,
    #[serde(flatten)]
    body: &'a B,
}

/// What a file of any format and version begins with.
#[derive(Deserialize)]
struct Tag {
    format: String,
    version: u32,
}

#[derive(Deserialize)]
struct Named {
    system: MapSystem,
}

impl MapSystem {
    const ALL: [Self; 3] = [Self::Mslst, Self::Cpm, Self::Diktiometry];

    /// Returns the system that a file is of.
    ///
    /// # Errors
    /// [`FileError`] if the text has no header, or one of another format or version.
    pub fn of(text: &str) -> Result<Self, FileError> {
        let Tag { format, version } = serde_json::from_str(text).map_err(|source| {
            if source.is_eof() && text.contains(&format!("\"{FORMAT}\"")) {
                FileError::CutOff(source)
            } else {
                FileError::Header(source)
            }
        })?;
        let mut systems = Self::ALL.into_iter();
        if let Some(system) = systems.find(|system| system.words().former_format == format) {
            return Err(FileError::FormerFormat { system });
        }
        if format != FORMAT {
            return Err(FileError::Format { found: format });
        }
        if version > VERSION {
            return Err(FileError::LaterVersion { found: version });
        }
        if version < VERSION {
            return Err(FileError::FormerVersion { found: version });
        }
        let Named { system } = serde_json::from_str(text).map_err(FileError::Header)?;
        Ok(system)
    }

    /// Returns the text of a file with a line end: the header, then the fields of `body`.
    ///
    /// # Errors
    /// [`FileError::Unwritable`] if `body` has no JSON form.
    pub fn write(self, origin: &Origin, body: &impl Serialize) -> Result<String, FileError> {
        let file = File {
            format: FORMAT,
            version: VERSION,
            system: self,
            origin,
            body,
        };
        serde_json::to_string(&file)
            .map(|text| text + "\n")
            .map_err(|source| FileError::Unwritable {
                system: self,
                source,
            })
    }

    /// Returns where the map of a file was learned, and what the file keeps besides.
    ///
    /// # Errors
    /// [`FileError`] as of [`of`](Self::of), or if the map is another system's or not sound.
    pub fn read<B: DeserializeOwned>(self, text: &str) -> Result<(Origin, B), FileError> {
        let found = Self::of(text)?;
        if found != self {
            let expected = self;
            return Err(FileError::System { found, expected });
        }
        let origin = serde_json::from_str(text).map_err(FileError::Header)?;
        let body = serde_json::from_str(text).map_err(|source| FileError::Body {
            system: self,
            source,
        })?;
        Ok((origin, body))
    }

    const fn words(self) -> Words {
        let (file_name, command, former_format) = match self {
            Self::Mslst => ("map of MSLST", "tolman learn", "tolman-mslst-map"),
            Self::Cpm => ("map of CPM", "tolman cpm learn", "tolman-cpm"),
            Self::Diktiometry => ("survey", "tolman survey", "tolman-survey"),
        };
        Words {
            file_name,
            command,
            former_format,
        }
    }
}

/// How messages speak of a system's files.
struct Words {
    file_name: &'static str,
    /// Writes one.
    command: &'static str,
    /// What `format` said when every system had a format of its own.
    former_format: &'static str,
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeMap;

    use super::*;

    fn origin() -> Origin {
        Origin {
            world: "J".to_owned(),
            robot: "e-puck".to_owned(),
            seed: u64::MAX,
        }
    }

    /// A body of one field.
    fn body() -> BTreeMap<String, f64> {
        BTreeMap::from([("part".to_owned(), 0.1)])
    }

    fn text() -> String {
        MapSystem::Cpm.write(&origin(), &body()).unwrap()
    }

    #[test]
    fn a_file_begins_with_its_header_and_is_read_back() {
        #[derive(Deserialize)]
        struct Body {
            part: f64,
        }
        let text = text();
        let start = r#"{"format":"tolman-map","version":1,"system":"cpm","world":"J","robot":"e-puck","seed":18446744073709551615,"part":0.1}"#;
        assert_eq!(text, format!("{start}\n"));
        assert_eq!(MapSystem::of(&text).unwrap(), MapSystem::Cpm);
        let (read, body): (_, Body) = MapSystem::Cpm.read(&text).unwrap();
        assert_eq!((read, body.part.to_bits()), (origin(), 0.1_f64.to_bits()));
        let other = MapSystem::Mslst.read::<Body>(&text).err().unwrap();
        let told = "this is a map of CPM, expected a map of MSLST: make one with `tolman learn`";
        assert_eq!(other.to_string(), told);
    }

    #[test]
    fn what_is_no_map_is_refused_by_name() {
        let text = text();
        let refused = |text: &str, expected: &str| {
            let told = format!("{:?}", MapSystem::of(text).unwrap_err());
            assert!(told.starts_with(expected), "{told} for {expected}");
        };
        let version = |number: &str| text.replace(":1,", number);
        refused("", "Header");
        refused("{}", "Header");
        refused(&text[..text.len() / 2], "CutOff");
        refused(&text.replace("tolman-map", "soup"), "Format");
        refused(&version(":0,"), "FormerVersion { found: 0");
        refused(&version(":2,"), "LaterVersion { found: 2");
        refused(&text.replace("\"cpm\"", "\"soup\""), "Header");
    }

    #[test]
    fn files_of_former_formats_say_how_a_new_one_is_made() {
        for (format, told) in [
            ("tolman-mslst-map", "a new map of MSLST with `tolman learn`"),
            ("tolman-cpm", "a new map of CPM with `tolman cpm learn`"),
            ("tolman-survey", "a new survey with `tolman survey`"),
        ] {
            // The former files of CPM had a field `system`, too.
            let text = format!(r#"{{"format":"{format}","version":2,"system":"faithful"}}"#);
            let error = MapSystem::of(&text).unwrap_err().to_string();
            assert!(error.contains(format) && error.ends_with(told), "{error}");
        }
    }

    #[test]
    fn what_has_no_json_form_is_not_written() {
        // Keys have to be strings.
        let unwritable = BTreeMap::from([([1, 2], 3)]);
        let error = MapSystem::Cpm.write(&origin(), &unwritable).unwrap_err();
        assert!(matches!(error, FileError::Unwritable { .. }), "{error}");
    }
}
