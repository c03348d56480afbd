// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use thiserror::Error;

use super::bearings::{Bearings, BearingsError};
use super::cp_mapper::MOST_PORTS;
use super::map::{CpMap, End, Fragment, FragmentId, Junction, JunctionId, Port, PortState, Sign};
use super::pattern::{Dictionary, DictionaryError, Pattern, PatternId};
use tolman_robot::Landmark;

/// Contents of a map's file: the map, with the dictionary that its sequences need. Works with any
/// format of serde's.
///
/// ```
/// use tolman_maps::cpm::{CpMapperConfig, Dictionary, CpMapper, MapFile, PatternId, Sighting, Traversal, Turn};
///
/// let mut dictionary = Dictionary::new(1);
/// let wall = dictionary.learn(&[1.0], &[1.0], 0.1)?;
/// let mut mapper = CpMapper::new(CpMapperConfig::online(), Sighting::plain(1))?;
/// let walk = Traversal { patterns: vec![wall; 4], motion: None, sighting: Sighting::plain(3), bearings: None };
/// mapper.arrive(Turn::BACK, &walk, &dictionary)?;
///
/// let text = serde_json::to_string(&MapFile::of(mapper.map(), &dictionary)?)?;
/// let read: MapFile = serde_json::from_str(&text)?;
/// assert_eq!(read.dictionary()?, dictionary);
/// assert_eq!(&read.map(&dictionary)?, mapper.map());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MapFile {
    /// Number of entries of each kind; a truncated file has fewer.
    counts: Counts,
    dictionary: SavedDictionary,
    map: SavedMap,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
struct Counts {
    patterns: usize,
    fragments: usize,
    junctions: usize,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct SavedDictionary {
    dimension: usize,
    /// Hexadecimal fingerprint, since readers of JSON may not support integers of 64 bits.
    fingerprint: String,
    patterns: Vec<Pattern>,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct SavedMap {
    /// Number of patterns in the dictionary at the map's last change, or `None` for an empty map.
    patterns: Option<u32>,
    next_fragment: u32,
    next_junction: u32,
    fragments: Vec<SavedFragment>,
    junctions: Vec<SavedJunction>,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct SavedFragment {
    id: u32,
    #[serde(flatten)]
    fragment: Fragment,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct SavedJunction {
    id: u32,
    landmark: Option<Landmark>,
    ports: Vec<SavedPort>,
    /// Bearings of the ports, rad, from port 0 on, or `None` if no robot has looked.
    #[serde(skip_serializing_if = "Option::is_none")]
    bearings: Option<Vec<f64>>,
}

#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
enum SavedPort {
    /// Explored for this number of observations, without reaching the end.
    Open(u32),
    /// End 𝔸⁻ of this fragment.
    Minus(u32),
    /// End 𝔸⁺ of this fragment.
    Plus(u32),
}

/// Reason why a file holds no map.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// Something is missing.
    #[error("it is cut off: it has {found} of {expected} {what}; copy it again")]
    Truncated {
        /// Kind of entry that is missing.
        what: &'static str,
        /// Number that the file promises.
        expected: usize,
        /// Number found.
        found: usize,
    },
    /// The map has fragments but no dictionary version, so their patterns cannot be identified.
    #[error(
        "it has fragments, but not the number of patterns they were written with; learn the map again"
    )]
    Unversioned,
    /// The patterns were changed after the file was written.
    #[error(
        "its patterns have the fingerprint {found}, not {expected}: they were changed; copy the file again"
    )]
    Fingerprint {
        /// Version the file states.
        expected: String,
        /// Version that the file's patterns have.
        found: String,
    },
    /// The patterns are invalid, or the map belongs to another robot.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
    /// A junction has more ports than any junction may have.
    #[error(
        "junction {junction} has {ports} ports, but at most {MOST_PORTS} are allowed; learn the map again"
    )]
    TooManyPorts {
        /// Number of the junction.
        junction: u32,
        /// Number of the junction's ports.
        ports: usize,
    },
    /// The bearings of a junction's ways are invalid.
    #[error("the bearings of junction {junction} are invalid: {source}")]
    Bearings {
        /// Number of the junction.
        junction: u32,
        /// Fault of the bearings.
        source: BearingsError,
    },
    /// A junction has another number of bearings than of ports.
    #[error(
        "junction {junction} has {bearings} bearings for {ports} ports; give one for each port, or none"
    )]
    BearingsOfPorts {
        /// Number of the junction.
        junction: u32,
        /// Number of the junction's bearings.
        bearings: u32,
        /// Number of the junction's ports.
        ports: usize,
    },
    /// Two entries have one id, or an id is larger than any that was given out.
    #[error("{what} {id} appears twice, or was never assigned; learn the map again")]
    BadId {
        /// Kind of entry: a fragment or a junction.
        what: &'static str,
        /// Id of the entry.
        id: u32,
    },
    /// A fragment and a port contradict each other.
    #[error("end {} of fragment {} and port {port} of junction {junction} do not belong to each other; learn the map again", .end.sign, .end.fragment.0)]
    Unjoined {
        /// End of the fragment.
        end: End,
        /// Id of the junction.
        junction: u32,
        /// Number of the port at the junction.
        port: u32,
    },
}

fn hexadecimal(fingerprint: u64) -> String {
    format!("{fingerprint:016x}")
}

impl MapFile {
    /// Returns the saved form of a map.
    ///
    /// # Errors
    /// [`MapFileError::Dictionary`] if the map was written with another dictionary.
    pub fn of(map: &CpMap, dictionary: &Dictionary) -> Result<Self, MapFileError> {
        map.check(dictionary)?;
        let fragments = map.fragments().map(|(id, fragment)| SavedFragment {
            id: id.0,
            fragment: fragment.clone(),
        });
        let saved = SavedMap {
            patterns: map.version().map(|version| version.patterns),
            next_fragment: map.next_fragment,
            next_junction: map.next_junction,
            fragments: fragments.collect(),
            junctions: map.junctions().map(saved_junction).collect(),
        };
        Ok(Self {
            counts: Counts {
                patterns: dictionary.len(),
                fragments: saved.fragments.len(),
                junctions: saved.junctions.len(),
            },
            dictionary: SavedDictionary {
                dimension: dictionary.dimension(),
                fingerprint: hexadecimal(dictionary.version().fingerprint),
                patterns: dictionary.patterns.clone(),
            },
            map: saved,
        })
    }

    /// Returns the dictionary as it was.
    ///
    /// # Errors
    /// [`MapFileError`] if it was cut off or changed.
    pub fn dictionary(&self) -> Result<Dictionary, MapFileError> {
        self.check()?;
        let patterns = self.dictionary.patterns.iter();
        let prototypes: Vec<(Vec<f64>, PatternId)> = patterns
            .map(|pattern| (pattern.prototype.clone(), pattern.half_turned))
            .collect();
        let dictionary = Dictionary::from_prototypes(self.dictionary.dimension, &prototypes)?;
        let found = hexadecimal(dictionary.version().fingerprint);
        if found == self.dictionary.fingerprint {
            Ok(dictionary)
        } else {
            Err(MapFileError::Fingerprint {
                expected: self.dictionary.fingerprint.clone(),
                found,
            })
        }
    }

    /// Returns the map as it was, for a robot with this dictionary: that of the file or a later
    /// version of it.
    ///
    /// # Errors
    /// [`MapFileError`] as of [`dictionary`](Self::dictionary), if the robot's is another one, or
    /// if fragments and junctions do not fit together.
    pub fn map(&self, dictionary: &Dictionary) -> Result<CpMap, MapFileError> {
        let own = self.dictionary()?;
        dictionary.check_version(own.version())?;
        let version = match self.map.patterns {
            Some(patterns) => {
                let earlier = own.earlier(patterns).ok_or(MapFileError::Truncated {
                    what: "patterns",
                    expected: patterns as usize,
                    found: self.dictionary.patterns.len(),
                })?;
                Some(earlier)
            }
            None if self.map.fragments.is_empty() => None,
            None => return Err(MapFileError::Unversioned),
        };
        let used = [
            ("fragment", self.map.next_fragment),
            ("junction", self.map.next_junction),
        ];
        if let Some((what, id)) = used.into_iter().find(|(_, next)| *next == u32::MAX) {
            return Err(MapFileError::BadId { what, id });
        }
        let mut map = CpMap {
            next_fragment: self.map.next_fragment,
            next_junction: self.map.next_junction,
            version,
            ..CpMap::default()
        };
        for saved in &self.map.junctions {
            let id = saved.id;
            if saved.ports.len() > MOST_PORTS as usize {
                return Err(MapFileError::TooManyPorts {
                    junction: id,
                    ports: saved.ports.len(),
                });
            }
            let is_new = map.junctions.insert(JunctionId(id), junction(saved)?);
            if !is_new || id >= self.map.next_junction {
                let what = "junction";
                return Err(MapFileError::BadId { what, id });
            }
        }
        for SavedFragment { id, fragment } in &self.map.fragments {
            let id = *id;
            own.check(&fragment.patterns)?;
            map.index.insert(FragmentId(id), &fragment.patterns);
            let is_new = map.fragments.insert(FragmentId(id), fragment.clone());
            if !is_new || id >= self.map.next_fragment {
                let what = "fragment";
                return Err(MapFileError::BadId { what, id });
            }
        }
        check_joints(&map)?;
        Ok(map)
    }

    fn check(&self) -> Result<(), MapFileError> {
        let counts = &self.counts;
        let parts = [
            ("patterns", counts.patterns, self.dictionary.patterns.len()),
            ("fragments", counts.fragments, self.map.fragments.len()),
            ("junctions", counts.junctions, self.map.junctions.len()),
        ];
        match parts
            .into_iter()
            .find(|(_, expected, found)| expected != found)
        {
            Some((what, expected, found)) => Err(MapFileError::Truncated {
                what,
                expected,
                found,
            }),
            None => Ok(()),
        }
    }
}

/// Checks that every end of a fragment is at a port that names it, and every filled port has such
/// an end.
fn check_joints(map: &CpMap) -> Result<(), MapFileError> {
    let unjoined = |end: End, port: Port| MapFileError::Unjoined {
        end,
        junction: port.junction.0,
        port: port.number,
    };
    for (fragment, node) in map.fragments() {
        for sign in Sign::BOTH {
            let (end, port) = (fragment.end(sign), node.port(sign));
            if map.end_at(port) != Some(end) {
                return Err(unjoined(end, port));
            }
        }
    }
    for (junction, node) in map.junctions() {
        for (number, state) in (0..).zip(&node.ports) {
            let port = junction.port(number);
            if let PortState::Filled(end) = *state
                && map.fragment(end.fragment).map(|node| node.port(end.sign)) != Some(port)
            {
                return Err(unjoined(end, port));
            }
        }
    }
    Ok(())
}

fn saved_junction((id, junction): (JunctionId, &Junction)) -> SavedJunction {
    let port = |state: &PortState| match *state {
        PortState::Open { at_least } => SavedPort::Open(at_least),
        PortState::Filled(End { fragment, sign }) => match sign {
            Sign::Minus => SavedPort::Minus(fragment.0),
            Sign::Plus => SavedPort::Plus(fragment.0),
        },
    };
    SavedJunction {
        id: id.0,
        landmark: junction.landmark,
        ports: junction.ports.iter().map(port).collect(),
        bearings: junction
            .bearings
            .as_ref()
            .map(|bearings| bearings.radians().to_vec()),
    }
}

fn junction(saved: &SavedJunction) -> Result<Junction, MapFileError> {
    let filled = |fragment, sign| PortState::Filled(FragmentId(fragment).end(sign));
    let port = |port: &SavedPort| match *port {
        SavedPort::Open(at_least) => PortState::Open { at_least },
        SavedPort::Minus(fragment) => filled(fragment, Sign::Minus),
        SavedPort::Plus(fragment) => filled(fragment, Sign::Plus),
    };
    Ok(Junction {
        ports: saved.ports.iter().map(port).collect(),
        landmark: saved.landmark,
        bearings: bearings(saved)?,
    })
}

fn bearings(saved: &SavedJunction) -> Result<Option<Bearings>, MapFileError> {
    let Some(radians) = &saved.bearings else {
        return Ok(None);
    };
    let junction = saved.id;
    let bearings = Bearings::of_directions(radians)
        .map_err(|source| MapFileError::Bearings { junction, source })?;
    if bearings.count() as usize == saved.ports.len() {
        return Ok(Some(bearings));
    }
    Err(MapFileError::BearingsOfPorts {
        junction,
        bearings: bearings.count(),
        ports: saved.ports.len(),
    })
}
