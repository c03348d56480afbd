use core::str::SplitAsciiWhitespace;

use tolman_geom::{Heading, Point, Pose};

use crate::log::LogTrouble;

/// Fault of a line: its kind, and its description.
pub(crate) type Wrong = (LogTrouble, String);

/// The fields of a line, taken one by one.
pub(crate) struct Fields<'a> {
    words: SplitAsciiWhitespace<'a>,
}

impl<'a> Fields<'a> {
    pub(crate) fn of(text: &'a str) -> Self {
        Self {
            words: text.split_ascii_whitespace(),
        }
    }

    /// Returns the next field. `name` is its name in error messages.
    pub(crate) fn word(&mut self, name: &str) -> Result<&'a str, Wrong> {
        let missing = || (LogTrouble::Cut, format!("{name} is missing"));
        self.words.next().ok_or_else(missing)
    }

    /// Returns the next field as a finite number.
    pub(crate) fn number(&mut self, name: &str) -> Result<f64, Wrong> {
        let word = self.word(name)?;
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| no_number(name, word))
    }

    /// Returns the next field as a count.
    pub(crate) fn count(&mut self, name: &str) -> Result<u32, Wrong> {
        let word = self.word(name)?;
        word.parse().map_err(|_| no_number(name, word))
    }

    /// Returns the next three fields as a pose.
    pub(crate) fn pose(&mut self, name: &str) -> Result<Pose, Wrong> {
        let [x, y, heading] = [self.number(name)?, self.number(name)?, self.number(name)?];
        // With larger numbers, `f64` no longer resolves small distances and turns.
        if [x, y, heading].iter().any(|part| part.abs() > FARTHEST) {
            return Err((
                LogTrouble::NoNumber,
                format!("{name} is farther than {FARTHEST:e}"),
            ));
        }
        Ok(Pose::new(Point::new(x, y), Heading::from_radians(heading)))
    }

    /// Returns the next `count` fields as ranges, m: `None` for a field that is not a range, such
    /// as `nan`.
    pub(crate) fn ranges(&mut self, count: u32) -> Result<Vec<Option<f64>>, Wrong> {
        let mut ranges = Vec::new();
        for index in 0..count {
            let missing = || (LogTrouble::Cut, format!("it has {index} of {count} ranges"));
            let range = self.words.next().ok_or_else(missing)?.parse::<f64>();
            ranges.push(range.ok().filter(|range| *range > 0.0));
        }
        Ok(ranges)
    }

    /// Skips `count` fields.
    pub(crate) fn pass(&mut self, count: u32, name: &str) -> Result<(), Wrong> {
        (0..count).try_for_each(|_| self.word(name).map(|_| ()))
    }

    /// Returns the number of fields that are left.
    pub(crate) fn left(&self) -> usize {
        self.words.clone().count()
    }
}

/// Largest coordinate that is accepted, m.
const FARTHEST: f64 = 1e7;

fn no_number(name: &str, word: &str) -> Wrong {
    let word: String = word.chars().take(24).collect();
    let comma = match word.contains(',') && word.replacen(',', ".", 1).parse::<f64>().is_ok() {
        true => ", with a decimal comma; write a point",
        false => "",
    };
    (LogTrouble::NoNumber, format!("{name} is `{word}`{comma}"))
}
