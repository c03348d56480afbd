//! Writes and reads data sets as text: a line of JSON for the facts common to all records, then one
//! for each record.
//!
//! A file begins
//! `{"format":"tolman-place-records","version":1,"arena":"pitch","seed":1,"records":1006,"cells":…,"goals":…,"sensors":…,
//! "picture":…}`. The pictures of the other lines are compressed (zlib) and written in base64; all
//! numbers come back to the bit.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use std::io::{Read, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use tolman_geom::Pose;
use tolman_maps::place_map::PlaceRecord;
use tolman_maze::Cell;
use tolman_robot::{Picture, PinholeCamera, Snapshot, Sounding};

use super::{CellGrid, DataSet, Goals, LabelledRecord};
use crate::BoxError;

const FORMAT: &str = "tolman-place-records";
const VERSION: u32 = 1;

/// Maximum size of a picture, pixels; none of ours is larger.
const MOST_PIXELS: usize = 1 << 24;

/// Facts common to all records.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    version: u32,
    arena: String,
    seed: u64,
    records: usize,
    cells: CellGrid,
    goals: Goals<usize>,
    /// The range sensors, each with the range of the first record.
    sensors: Vec<Sounding>,
    picture: Option<PictureShape>,
}

/// Beginning of a file of any version.
#[derive(Deserialize)]
struct Tag {
    #[serde(default)]
    format: String,
    #[serde(default)]
    version: u32,
}

/// Shape common to all pictures.
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PictureShape {
    width: u32,
    height: u32,
    camera: PinholeCamera,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    odometry: Pose,
    truth: Pose,
    cell: Cell,
    label: Cell,
    ranges: Vec<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    picture: Option<String>,
}

/// A line that is not the JSON it ought to be.
#[derive(Debug, Error)]
#[error("line {line} cannot be read; copy the file again, or gather the data again")]
struct UnreadableLine {
    line: usize,
    source: serde_json::Error,
}

impl DataSet {
    /// Returns the text of a file. All records must come from the same sensors.
    ///
    /// # Errors
    /// If they do not.
    pub fn to_text(&self) -> Result<String, BoxError> {
        let header = self.header();
        let mut text = json(1, &header)?;
        for (line, labelled) in (2..).zip(&self.records) {
            text.push_str(&json(line, &header.line(line, labelled)?)?);
        }
        Ok(text)
    }

    fn header(&self) -> Header {
        let first = self.records.first().map(|first| &first.record.snapshot);
        let picture = first.and_then(|snapshot| snapshot.picture.as_ref());
        Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            arena: self.arena.clone(),
            seed: self.seed,
            records: self.records.len(),
            cells: self.cells,
            goals: self.goals,
            sensors: first.map_or_else(Vec::new, |snapshot| snapshot.soundings.clone()),
            picture: picture.map(PictureShape::of),
        }
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// If it is damaged: with the line and the repair.
    pub fn from_text(text: &str) -> Result<Self, BoxError> {
        let mut lines = text.lines();
        let header = Header::read(
            lines
                .next()
                .ok_or("the file is empty; gather the data again")?,
        )?;
        let read = (2..)
            .zip(lines)
            .map(|(line, text)| header.read_line(line, text));
        let records: Vec<LabelledRecord> = read.collect::<Result<_, _>>()?;
        header.check(records.len())?;
        Ok(Self {
            arena: header.arena,
            seed: header.seed,
            cells: header.cells,
            goals: header.goals,
            records,
        })
    }
}

fn json(line: usize, value: &impl Serialize) -> Result<String, BoxError> {
    let written = serde_json::to_string(value);
    Ok(written.map_err(|source| UnreadableLine { line, source })? + "\n")
}

fn read_json<'a, T: Deserialize<'a>>(line: usize, text: &'a str) -> Result<T, BoxError> {
    let read = serde_json::from_str(text);
    Ok(read.map_err(|source| UnreadableLine { line, source })?)
}

fn damaged(line: usize, what: &str) -> BoxError {
    format!("line {line}: {what}; copy the file again, or gather the data again").into()
}

impl Header {
    fn read(text: &str) -> Result<Self, BoxError> {
        let Tag { format, version } = read_json(1, text)?;
        if format != FORMAT {
            return Err(format!(
                "line 1: the format is {format:?}, expected {FORMAT:?}; give a file of gathered records"
            )
            .into());
        }
        if version != VERSION {
            return Err(format!(
                "line 1: the version is {version}, this program reads {VERSION}; update tolman"
            )
            .into());
        }
        read_json(1, text)
    }

    /// Checks that `found` records are as many as the header promises, and that each goal's record
    /// is among them.
    fn check(&self, found: usize) -> Result<(), BoxError> {
        let expected = self.records;
        if found != expected {
            return Err(format!(
                "the file has {found} records, its header says {expected}; copy it again"
            )
            .into());
        }
        let goals = [self.goals.blue, self.goals.yellow];
        match goals.into_iter().find(|index| *index >= found) {
            Some(index) => Err(format!(
                "line 1: `goals` names record {index}, but there are only {found} records; gather the data again"
            )
            .into()),
            None => Ok(()),
        }
    }

    /// Returns the line that is written for one record.
    fn line(&self, line: usize, labelled: &LabelledRecord) -> Result<Line, BoxError> {
        let wrong = |what| damaged(line, what);
        let Snapshot { soundings, picture } = &labelled.record.snapshot;
        let ranges: Vec<f64> = soundings.iter().map(|sounding| sounding.range).collect();
        if self.heard(&ranges).as_ref() != Some(soundings) {
            return Err(wrong("its range sensors are not those of the first record"));
        }
        if picture.as_ref().map(PictureShape::of) != self.picture {
            return Err(wrong(
                "its picture is not of the shape of the first record's",
            ));
        }
        Ok(Line {
            odometry: labelled.record.odometry,
            truth: labelled.truth,
            cell: labelled.cell,
            label: labelled.label,
            ranges,
            picture: picture.as_ref().map(packed),
        })
    }

    /// Returns the soundings with these ranges; `None` if the number of ranges differs from that of
    /// the sensors.
    fn heard(&self, ranges: &[f64]) -> Option<Vec<Sounding>> {
        let readings = self.sensors.iter().zip(ranges);
        let readings = readings.map(|(sensor, range)| Sounding {
            range: *range,
            ..*sensor
        });
        (ranges.len() == self.sensors.len()).then(|| readings.collect())
    }

    fn read_line(&self, line: usize, text: &str) -> Result<LabelledRecord, BoxError> {
        let wrong = |what| damaged(line, what);
        let read: Line = read_json(line, text)?;
        if !(read.odometry.is_finite() && read.truth.is_finite()) {
            return Err(wrong("a pose has a number that is not finite"));
        }
        let on_grid = |cell: Cell| cell.x < CellGrid::SIDE && cell.y < CellGrid::SIDE;
        if !(on_grid(read.cell) && on_grid(read.label)) {
            return Err(wrong("a cell lies outside the 8 × 8"));
        }
        let soundings = self.heard(&read.ranges);
        let picture = match (&self.picture, &read.picture) {
            (None, None) => None,
            (Some(shape), Some(text)) => {
                let picture = shape.unpacked(text);
                Some(picture.ok_or_else(|| wrong("its picture is damaged"))?)
            }
            _ => return Err(wrong("it lacks a picture, or has one that others lack")),
        };
        Ok(LabelledRecord {
            record: PlaceRecord {
                odometry: read.odometry,
                snapshot: Snapshot {
                    soundings: soundings
                        .ok_or_else(|| wrong("it has too many ranges or too few"))?,
                    picture,
                },
            },
            truth: read.truth,
            cell: read.cell,
            label: read.label,
        })
    }
}

fn packed(picture: &Picture) -> String {
    STANDARD.encode(compressed(picture.pixels.as_flattened()))
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // A vector takes all that is written.
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.unwrap_or_default()
}

impl PictureShape {
    const fn of(picture: &Picture) -> Self {
        Self {
            width: picture.width,
            height: picture.height,
            camera: picture.camera,
        }
    }

    /// Returns the picture of a text; `None` if it is damaged or of another size.
    fn unpacked(&self, text: &str) -> Option<Picture> {
        let pixels = self.width as usize * self.height as usize;
        if pixels == 0 || pixels > MOST_PIXELS {
            return None;
        }
        let packed = STANDARD.decode(text).ok()?;
        let mut bytes = Vec::with_capacity(3 * pixels);
        // A byte more than there may be is enough to know.
        let mut decoder = ZlibDecoder::new(packed.as_slice()).take(3 * pixels as u64 + 1);
        decoder.read_to_end(&mut bytes).ok()?;
        if bytes.len() != 3 * pixels {
            return None;
        }
        let mut picture = Picture::black(self.width, self.height, self.camera);
        picture.pixels.as_flattened_mut().copy_from_slice(&bytes);
        Some(picture)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Pitch, gather};
    use super::*;

    fn data() -> DataSet {
        let pitch = Pitch::named("pitch").unwrap();
        gather(&pitch, pitch.robot(1, 0.03).unwrap(), 1, 6).unwrap()
    }

    #[test]
    fn a_data_set_comes_back_to_the_bit() {
        let data = data();
        let text = data.to_text().unwrap();
        assert_eq!(text.lines().count(), 7);
        let read = DataSet::from_text(&text).unwrap();
        assert_eq!(read, data);
        assert_eq!(read.to_text().unwrap(), text);
    }

    #[test]
    fn what_is_damaged_is_refused_by_its_line() {
        let text = data().to_text().unwrap();
        let check = |changed: &str, expect: &str| {
            let told = DataSet::from_text(changed).unwrap_err().to_string();
            assert!(told.starts_with(expect), "{told}");
        };
        let lines: Vec<&str> = text.lines().collect();
        check("", "the file is empty");
        check("no", "line 1 cannot be read");
        check(
            r#"{"format":"tolman-map"}"#,
            "line 1: the format is \"tolman-map\"",
        );
        check(
            &text.replacen("\"version\":1", "\"version\":9", 1),
            "line 1: the version is 9",
        );
        check(
            &text.replacen("\"arena\"", "\"area\"", 1),
            "line 1 cannot be read",
        );
        check(
            &lines[..4].join("\n"),
            "the file has 3 records, its header says 6",
        );
        check(&text[..text.len() - 20], "line 7 cannot be read");
        check(
            &text.replacen("\"blue\":", "\"blue\":9", 1),
            "line 1: `goals` names record 9",
        );
        check(
            &text.replacen("\"ranges\":[", "\"ranges\":[1.0,", 1),
            "line 2: it has too many ranges",
        );
        check(
            &text.replacen("\"label\":{\"x\":", "\"label\":{\"x\":8", 1),
            "line 2: a cell lies outside",
        );
        check(
            &text.replacen("\"width\":80", "\"width\":81", 1),
            "line 2: its picture is damaged",
        );
        let middle = lines[3].len() / 2;
        let mut broken = lines[3].to_owned();
        let other = if &broken[middle..=middle] == "A" {
            "B"
        } else {
            "A"
        };
        broken.replace_range(middle..=middle, other);
        check(
            &text.replacen(lines[3], &broken, 1),
            "line 4: its picture is damaged",
        );
    }
}
