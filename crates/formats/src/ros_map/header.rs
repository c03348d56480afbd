use thiserror::Error;
use tolman_geom::Point;

use super::MapCell;
use crate::input;

/// Contents of a map's YAML file.
#[derive(Clone, Debug, PartialEq)]
pub struct RosMapHeader {
    /// Path of the picture's file, relative to this file's folder unless it is absolute.
    pub image: String,
    /// Size of a cell, m.
    pub resolution: f64,
    /// Position of the picture's lower left corner, m.
    pub origin: Point,
    /// Turn of the picture about that corner, rad counter-clockwise.
    pub yaw: f64,
    /// Whether white means occupied.
    pub negate: bool,
    /// Value above which a cell is occupied, 0 … 1.
    pub occupied_thresh: f64,
    /// Value below which a cell is free, 0 … 1.
    pub free_thresh: f64,
}

/// Reason why a YAML file is not that of a map. Lines are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RosMapHeaderError {
    /// A line is not `key: value`.
    #[error("line {line}: expected `key: value`; write the file as map_server does")]
    Line {
        /// Number of the line.
        line: usize,
    },
    /// A key stands twice.
    #[error("line {line}: `{key}` is given a second time; remove one")]
    Twice {
        /// Number of the line.
        line: usize,
        /// Name of the key.
        key: String,
    },
    /// A value is invalid.
    #[error("line {line}: `{key}` is `{value}`; expected {expected}")]
    Value {
        /// Number of the line.
        line: usize,
        /// Name of the key.
        key: &'static str,
        /// Value that the file gives.
        value: String,
        /// Values that the key may have, in words.
        expected: &'static str,
    },
    /// A key is missing.
    #[error("the key `{key}` is missing; add it as map_server writes it")]
    Missing {
        /// Name of the key.
        key: &'static str,
    },
}

impl RosMapHeader {
    /// Reads the YAML that map_server and map_saver write: flat keys, in lines or in braces, and
    /// lists in brackets or in lines with a dash. Keys that are not of map_server are ignored.
    ///
    /// # Errors
    /// [`RosMapHeaderError`] with the line at fault.
    pub fn parse(text: &str) -> Result<Self, RosMapHeaderError> {
        let entries = Entries::parse(input::without_mark(text))?;
        entries.check_mode()?;
        let (origin, yaw) = entries.origin()?;
        Ok(Self {
            yaw,
            image: entries.image()?,
            resolution: entries.number("resolution", "a positive number of metres", |value| {
                value > 0.0
            })?,
            origin,
            negate: entries.negate()?,
            occupied_thresh: entries.share("occupied_thresh")?,
            free_thresh: entries.free_thresh()?,
        })
    }

    /// Returns the state of a cell whose brightness in the picture is `light`: 0 for black, 1 for
    /// white.
    #[must_use]
    pub fn cell(&self, light: f64) -> MapCell {
        let occupied = if self.negate { light } else { 1.0 - light };
        if occupied > self.occupied_thresh {
            MapCell::Occupied
        } else if occupied < self.free_thresh {
            MapCell::Free
        } else {
            MapCell::Unknown
        }
    }
}

/// A key of the file with its value.
struct Entry {
    line: usize,
    key: String,
    value: String,
}

struct Entries(Vec<Entry>);

impl Entries {
    fn parse(text: &str) -> Result<Self, RosMapHeaderError> {
        let mut entries = Self(Vec::new());
        for (line, text) in (1..).zip(text.lines()) {
            let text = without_comment(text).trim();
            match text
                .strip_prefix('{')
                .and_then(|text| text.strip_suffix('}'))
            {
                Some(inside) => items(inside).try_for_each(|item| entries.take(line, item))?,
                None => entries.take(line, text)?,
            }
        }
        Ok(entries)
    }

    /// Takes in one line: an entry, or an item of the list of the last one.
    fn take(&mut self, line: usize, text: &str) -> Result<(), RosMapHeaderError> {
        let text = text.trim();
        if text.is_empty() || text == "---" {
            return Ok(());
        }
        if let (Some(item), Some(last)) = (text.strip_prefix("- "), self.0.last_mut()) {
            last.value = format!("{}, {}", last.value, item.trim());
            return Ok(());
        }
        let (key, value) = text
            .split_once(':')
            .ok_or(RosMapHeaderError::Line { line })?;
        let key = key.trim().to_owned();
        if self.0.iter().any(|entry| entry.key == key) {
            return Err(RosMapHeaderError::Twice { line, key });
        }
        let value = value.trim().trim_matches(['"', '\'']).to_owned();
        self.0.push(Entry { line, key, value });
        Ok(())
    }

    fn find(&self, key: &'static str) -> Result<&Entry, RosMapHeaderError> {
        let mut entries = self.0.iter();
        let entry = entries.find(|entry| entry.key == key);
        entry.ok_or(RosMapHeaderError::Missing { key })
    }

    fn image(&self) -> Result<String, RosMapHeaderError> {
        let entry = self.find("image")?;
        match entry.value.is_empty() {
            true => Err(entry.wrong("image", "the name of a picture")),
            false => Ok(entry.value.clone()),
        }
    }

    fn number(
        &self,
        key: &'static str,
        expected: &'static str,
        fits: impl Fn(f64) -> bool,
    ) -> Result<f64, RosMapHeaderError> {
        let entry = self.find(key)?;
        let number = number(&entry.value).filter(|number| fits(*number));
        number.ok_or_else(|| entry.wrong(key, expected))
    }

    fn share(&self, key: &'static str) -> Result<f64, RosMapHeaderError> {
        self.number(key, "a number from 0 to 1", |value| {
            (0.0..=1.0).contains(&value)
        })
    }

    fn free_thresh(&self) -> Result<f64, RosMapHeaderError> {
        let occupied = self.share("occupied_thresh")?;
        let free = self.share("free_thresh")?;
        match free < occupied {
            true => Ok(free),
            false => {
                let entry = self.find("free_thresh")?;
                Err(entry.wrong("free_thresh", "a number below `occupied_thresh`"))
            }
        }
    }

    fn origin(&self) -> Result<(Point, f64), RosMapHeaderError> {
        let entry = self.find("origin")?;
        let items = entry.value.trim_matches(['[', ']', ',', ' ']).split(',');
        let numbers: Option<Vec<f64>> = items.map(number).collect();
        match numbers.as_deref() {
            Some([x, y, yaw]) => Ok((Point::new(*x, *y), *yaw)),
            _ => Err(entry.wrong("origin", "[x, y, yaw] in metres and radians")),
        }
    }

    fn negate(&self) -> Result<bool, RosMapHeaderError> {
        let entry = self.find("negate")?;
        match entry.value.to_ascii_lowercase().as_str() {
            "0" | "false" | "no" | "off" => Ok(false),
            "1" | "true" | "yes" | "on" => Ok(true),
            _ => Err(entry.wrong("negate", "0 or 1")),
        }
    }

    /// Refuses a `mode` in which the thresholds mean something else: all but `trinary` and `scale`.
    fn check_mode(&self) -> Result<(), RosMapHeaderError> {
        match self.find("mode") {
            Ok(entry)
                if !["trinary", "scale"].contains(&entry.value.to_ascii_lowercase().as_str()) =>
            {
                Err(entry.wrong("mode", "trinary or scale"))
            }
            _ => Ok(()),
        }
    }
}

impl Entry {
    fn wrong(&self, key: &'static str, expected: &'static str) -> RosMapHeaderError {
        RosMapHeaderError::Value {
            line: self.line,
            key,
            value: self.value.clone(),
            expected,
        }
    }
}

/// Returns the items between the commas of braces. Commas within brackets separate none.
fn items(text: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0;
    text.split(move |letter| {
        match letter {
            '[' => depth += 1,
            ']' => depth -= 1,
            _ => {}
        }
        letter == ',' && depth == 0
    })
}

/// Returns the line up to a # that begins it or follows a blank.
fn without_comment(text: &str) -> &str {
    let mut hashes = text.match_indices('#').map(|(at, _)| at);
    let before = |at| text.get(..at).unwrap_or(text);
    let comment = hashes.find(|at| {
        let last = before(*at).chars().next_back();
        last.is_none_or(char::is_whitespace)
    });
    comment.map_or(text, before)
}

/// Returns a finite number.
fn number(text: &str) -> Option<f64> {
    let number = text.trim().parse::<f64>().ok();
    number.filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const YAML: &str = "\
# saved by map_saver
image: \"hall-2.pgm\"
mode: trinary
resolution: 0.050000   # metres
origin: [-10.0, 3.5, 0.000000]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
";

    #[test]
    fn map_savers_file_is_read() {
        let header = RosMapHeader::parse(YAML).unwrap();
        assert_eq!(header.image, "hall-2.pgm");
        assert_eq!(header.origin, Point::new(-10.0, 3.5));
        let cells = [0.0, 205.0, 254.0].map(|value| header.cell(value / 255.0));
        assert_eq!(cells, [MapCell::Occupied, MapCell::Unknown, MapCell::Free]);
        let negated = RosMapHeader {
            negate: true,
            ..header
        };
        assert_eq!(negated.cell(1.0), MapCell::Occupied);
    }

    #[test]
    fn a_list_may_stand_in_lines() {
        let listed = YAML.replace("[-10.0, 3.5, 0.000000]", "\n- -10.0\n- 3.5\n- 0");
        let header = RosMapHeader::parse(&listed).unwrap();
        assert_eq!(header.origin, Point::new(-10.0, 3.5));
    }

    #[test]
    fn what_yaml_means_alike_is_read_alike() {
        let plain = RosMapHeader::parse(YAML).unwrap();
        let again = YAML
            .replace("mode: trinary", "mode: \"Trinary\"")
            .replace("negate: 0", "negate: False");
        assert_eq!(RosMapHeader::parse(&again).unwrap(), plain);
        let braces = "{image: hall-2.pgm, resolution: 0.05, origin: [-10.0, 3.5, 0.0], negate: no, \
                      occupied_thresh: 0.65, free_thresh: 0.196}";
        assert_eq!(RosMapHeader::parse(braces).unwrap(), plain);
        let turned = RosMapHeader::parse(&YAML.replace("0.000000]", "1.57]")).unwrap();
        assert!((turned.yaw - 1.57).abs() < 1e-12);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (from, to, expect) in [
            ("negate: 0", "negate 0", "line 6: expected `key: value`"),
            (
                "negate: 0",
                "image: b",
                "line 6: `image` is given a second time",
            ),
            (
                "negate: 0",
                "negate: maybe",
                "line 6: `negate` is `maybe`; expected 0 or 1",
            ),
            ("negate: 0", "", "the key `negate` is missing"),
            (
                "0.050000",
                "0",
                "line 4: `resolution` is `0`; expected a positive number",
            ),
            ("0.050000", "NaN", "line 4: `resolution` is `NaN`"),
            (
                "0.000000",
                "east",
                "line 5: `origin` is `[-10.0, 3.5, east]`",
            ),
            ("-10.0, 3.5, ", "", "line 5: `origin` is `[0.000000]`"),
            ("0.196", "2", "line 8: `free_thresh` is `2`"),
            (
                "trinary",
                "raw",
                "line 3: `mode` is `raw`; expected trinary or scale",
            ),
            ("\"hall-2.pgm\"", "", "line 2: `image` is ``"),
        ] {
            let error = RosMapHeader::parse(&YAML.replace(from, to)).unwrap_err();
            assert!(error.to_string().contains(expect), "{error}");
        }
    }

    proptest! {
        #[test]
        fn no_text_is_too_strange(text in "(?s).{0,80}", line in 0_usize..9) {
            let _ = RosMapHeader::parse(&text);
            let mut lines: Vec<&str> = YAML.lines().collect();
            lines.insert(line.min(lines.len()), &text);
            let _ = RosMapHeader::parse(&lines.join("\n"));
        }
    }
}
