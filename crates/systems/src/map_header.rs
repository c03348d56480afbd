//! The one form of files that hold a learned map: JSON with a header that every system shares.
//!
//! A file begins
//! `{"format":"tolman-map","version":3,"system":"mslst","world":"J","drawing":"5f1…","robot":"laser
//! Pioneer","seed":1,` and continues with the system's own fields. Files of version 2, which
//! had other names of systems, are read; older ones and former formats are refused by name.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::collections::BTreeMap;

use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};
use thiserror::Error;

const FORMAT: &str = "tolman-map";
/// Version of the header and of every system's part. Version 2 had other names of systems.
const VERSION: u32 = 3;
const BEFORE: u32 = 2;

/// Former formats of single systems, each with the system that wrote it.
const FORMER: [(&str, &str); 3] = [
    ("tolman-mslst-map", "mslst"),
    ("tolman-cpm", "cpm"),
    ("tolman-survey", "diktiometry"),
];

/// The map files of one system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapFiles {
    /// Name of the system, as in `tolman learn --system`.
    pub system: &'static str,
}

/// Origin of a map: the maze, the robot and the seed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Name of the maze.
    pub world: String,
    /// Fingerprint that tells the maze's drawing from others with its name; `None` without a
    /// drawing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawing: Option<String>,
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
    #[error("this is not a learned map: make one with `tolman learn`")]
    Header(#[source] serde_json::Error),
    /// The text ends too soon.
    #[error("this map is cut off: copy it again, or make one with `tolman learn`")]
    CutOff(#[source] serde_json::Error),
    /// The format is another kind of file's.
    #[error("its format is {found:?}, expected {FORMAT:?}: give a file that `tolman learn` wrote")]
    Format {
        /// Format that the file names.
        found: String,
    },
    /// This format is no longer read.
    #[error(
        "its format, {found:?}, is no longer read: make a new map with `tolman learn --system {system}`"
    )]
    FormerFormat {
        /// Format that the file names.
        found: &'static str,
        /// System that once wrote this format.
        system: &'static str,
    },
    /// The file was written by a later tolman.
    #[error("its version is {found}, but this program reads only up to {VERSION}: update tolman")]
    LaterVersion {
        /// Version that the file names.
        found: u32,
    },
    /// This version is no longer read, or never existed.
    #[error(
        "its version is {found}, but this program reads only {BEFORE} and {VERSION}: make a new map with `tolman learn`"
    )]
    FormerVersion {
        /// Version that the file names.
        found: u32,
    },
    /// The map is that of another system.
    #[error(
        "this is a map of {found}, expected one of {expected}: make one with `tolman learn --system {expected}`"
    )]
    System {
        /// System that the file names.
        found: String,
        /// System that the caller asked for.
        expected: &'static str,
    },
    /// The header is sound, but the rest is not. The source has line and column.
    #[error("this map of {system} cannot be read: make one with `tolman learn --system {system}`")]
    Body {
        /// System that the file names.
        system: &'static str,
        /// Reader's error, with line and column.
        source: serde_json::Error,
    },
    /// The map cannot be written as JSON.
    #[error("this map of {system} cannot be written as JSON")]
    Unwritable {
        /// System of the map.
        system: &'static str,
        /// Error of the JSON writer.
        source: serde_json::Error,
    },
}

#[derive(Serialize)]
struct File<'a, B> {
    format: &'static str,
    version: u32,
    system: &'static str,
    #[serde(flatten)]
    origin: &'a Origin,
    #[serde(flatten)]
    body: &'a B,
}

/// Beginning of a file of any format and version.
#[derive(Deserialize)]
struct Tag {
    format: String,
    version: u32,
}

/// Beginning of a file of this version.
#[derive(Deserialize)]
struct Header {
    system: String,
    #[serde(flatten)]
    origin: Origin,
}

fn header(text: &str) -> Result<Header, FileError> {
    let Tag { format, version } = serde_json::from_str(text).map_err(|source| {
        let is_whole = text.trim_end().ends_with('}');
        if !is_whole && text.contains(&format!("\"{FORMAT}\"")) {
            FileError::CutOff(source)
        } else {
            FileError::Header(source)
        }
    })?;
    let mut former = FORMER.into_iter();
    if let Some((found, system)) = former.find(|(former, _)| *former == format) {
        return Err(FileError::FormerFormat { found, system });
    }
    if format != FORMAT {
        return Err(FileError::Format { found: format });
    }
    if version > VERSION {
        return Err(FileError::LaterVersion { found: version });
    }
    if version < BEFORE {
        return Err(FileError::FormerVersion { found: version });
    }
    let mut header: Header = serde_json::from_str(text).map_err(FileError::Header)?;
    if version == BEFORE {
        header.system = present_name(header.system, text);
    }
    Ok(header)
}

/// Returns the present name of the system of a file of version 2. What was called `diktiometry` and
/// `gngslam` were the better ones, and `cpm` both.
fn present_name(system: String, text: &str) -> String {
    #[derive(Deserialize)]
    struct Body {
        mode: BTreeMap<String, IgnoredAny>,
    }
    let is_papers = |text| {
        let body: Result<Body, _> = serde_json::from_str(text);
        body.is_ok_and(|body| body.mode.contains_key("paper"))
    };
    match &*system {
        "diktiometry" => "diktiometry-better".to_owned(),
        "gngslam" => "gng-slam-better".to_owned(),
        "cpm" if !is_papers(text) => "cpm-better".to_owned(),
        _ => system,
    }
}

/// Returns the name of a file's system, and the origin of its map.
///
/// # Errors
/// [`FileError`] if the text has no header, or one of another format or version.
pub fn origin_of(text: &str) -> Result<(String, Origin), FileError> {
    let Header { system, origin } = header(text)?;
    Ok((system, origin))
}

impl MapFiles {
    /// Returns the text of a file with a line end: the header, then the fields of `body`.
    ///
    /// # Errors
    /// [`FileError::Unwritable`] if `body` cannot be written as JSON.
    pub fn write(self, origin: &Origin, body: &impl Serialize) -> Result<String, FileError> {
        let system = self.system;
        let file = File {
            format: FORMAT,
            version: VERSION,
            system,
            origin,
            body,
        };
        serde_json::to_string(&file)
            .map(|text| text + "\n")
            .map_err(|source| FileError::Unwritable { system, source })
    }

    /// Returns the origin of the map in a file, and the rest of the file's contents.
    ///
    /// # Errors
    /// [`FileError`] if the text has no header, or one of another format or version, or if the map
    /// is another system's or invalid.
    pub fn read<B: DeserializeOwned>(self, text: &str) -> Result<(Origin, B), FileError> {
        let Header { system, origin } = header(text)?;
        if system != self.system {
            return Err(FileError::System {
                found: system,
                expected: self.system,
            });
        }
        let body = serde_json::from_str(text).map_err(|source| FileError::Body {
            system: self.system,
            source,
        })?;
        Ok((origin, body))
    }
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeMap;

    use super::*;

    fn origin() -> Origin {
        Origin {
            world: "J".to_owned(),
            drawing: None,
            robot: "e-puck".to_owned(),
            seed: u64::MAX,
        }
    }

    /// Returns a body of one field.
    fn body() -> BTreeMap<String, f64> {
        BTreeMap::from([("part".to_owned(), 0.1)])
    }

    const CPM: MapFiles = MapFiles { system: "cpm" };

    fn text() -> String {
        CPM.write(&origin(), &body()).unwrap()
    }

    #[test]
    fn a_file_begins_with_its_header_and_is_read_back() {
        #[derive(Deserialize)]
        struct Body {
            part: f64,
        }
        let text = text();
        let start = r#"{"format":"tolman-map","version":3,"system":"cpm","world":"J","robot":"e-puck","seed":18446744073709551615,"part":0.1}"#;
        assert_eq!(text, format!("{start}\n"));
        assert_eq!(origin_of(&text).unwrap(), ("cpm".to_owned(), origin()));
        let (read, body): (_, Body) = CPM.read(&text).unwrap();
        assert_eq!((read, body.part.to_bits()), (origin(), 0.1_f64.to_bits()));
        let other = MapFiles { system: "mslst" }.read::<Body>(&text);
        let other = other.err().unwrap();
        let told = "this is a map of cpm, expected one of mslst: make one with `tolman learn --system mslst`";
        assert_eq!(other.to_string(), told);
    }

    #[test]
    fn what_is_no_map_is_refused_by_name() {
        let text = text();
        let refused = |text: &str, expected: &str| {
            let told = format!("{:?}", origin_of(text).unwrap_err());
            assert!(told.starts_with(expected), "{told} for {expected}");
        };
        let version = |number: &str| text.replace(":3,", number);
        refused("", "Header");
        refused("{}", "Header");
        refused(&text[..text.len() / 2], "CutOff");
        refused(&text.replace("tolman-map", "soup"), "Format");
        refused(&version(":1,"), "FormerVersion { found: 1");
        refused(&version(":4,"), "LaterVersion { found: 4");
        refused(&text.replace("\"system\":", "\"soup\":"), "Header");
    }

    #[test]
    fn a_file_of_version_2_says_what_its_system_is_called_now() {
        for (former, part, now) in [
            ("mslst", r#""part":1"#, "mslst"),
            ("diktiometry", r#""part":1"#, "diktiometry-better"),
            ("gngslam", r#""part":1"#, "gng-slam-better"),
            ("cpm", r#""mode":{"reckoned":{}}"#, "cpm-better"),
            ("cpm", r#""mode":{"unlearned":{}}"#, "cpm-better"),
            ("cpm", r#""mode":{"paper":{}}"#, "cpm"),
        ] {
            let text = format!(
                r#"{{"format":"tolman-map","version":2,"system":"{former}","world":"J","robot":"e-puck","seed":1,{part}}}"#
            );
            assert_eq!(origin_of(&text).unwrap().0, now, "{text}");
        }
    }

    #[test]
    fn files_of_former_formats_say_how_a_new_one_is_made() {
        for (format, system) in FORMER {
            // The former files of CPM had a field `system`, too.
            let text = format!(r#"{{"format":"{format}","version":2,"system":"faithful"}}"#);
            let error = origin_of(&text).unwrap_err().to_string();
            let told = format!("a new map with `tolman learn --system {system}`");
            assert!(error.contains(format) && error.ends_with(&told), "{error}");
        }
    }

    #[test]
    fn what_has_no_json_form_is_not_written() {
        // Keys have to be strings.
        let unwritable = BTreeMap::from([([1, 2], 3)]);
        let error = CPM.write(&origin(), &unwritable).unwrap_err();
        assert!(matches!(error, FileError::Unwritable { .. }), "{error}");
    }
}
