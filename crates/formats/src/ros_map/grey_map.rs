use std::io::Cursor;

use png::{Decoder, DecodingError, Limits, Transformations};
use thiserror::Error;

use crate::input::MOST_BYTES;

/// A grey picture in the portable grey map format (PGM), binary (`P5`) or plain (`P2`), or a PNG,
/// of which each pixel has the mean of its colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GreyMap {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Value of white, 1 … 65535.
    pub most: u16,
    /// Values of the pixels, row by row from the top, 0 … `most`.
    pub values: Vec<u16>,
}

/// Reason why a picture cannot be read. Bytes are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum GreyMapError {
    /// The file does not begin as a grey picture.
    #[error("byte 0: expected P5 or P2; save the picture as a grey PGM or a PNG")]
    Magic,
    /// The PNG cannot be decoded.
    #[error("the PNG cannot be read: {why}; save the picture again")]
    Png {
        /// Error of the decoder.
        why: String,
    },
    /// A number is expected.
    #[error("byte {byte}: expected {what}; save the picture again as a PGM")]
    Number {
        /// Offset in the file, bytes.
        byte: usize,
        /// Meaning of the number.
        what: &'static str,
    },
    /// A number is out of its range.
    #[error("byte {byte}: {what} is {value}, and may be 1 to {most}; save the picture again")]
    Range {
        /// Offset in the file, bytes.
        byte: usize,
        /// Meaning of the number.
        what: &'static str,
        /// Value that was given.
        value: u64,
        /// Maximum value of the number.
        most: u64,
    },
    /// A value is brighter than white.
    #[error("byte {byte}: value {value} is above the picture's white, {most}; correct one of them")]
    TooBright {
        /// Offset in the file, bytes.
        byte: usize,
        /// Value that is too bright.
        value: u64,
        /// Maximum value, that of white.
        most: u16,
    },
    /// The picture ends too early.
    #[error("byte {byte}: the picture ends, with {found} of {wanted} values; copy it again")]
    TooShort {
        /// Offset of the file's end, bytes.
        byte: usize,
        /// Number of values found.
        found: usize,
        /// Number of values expected.
        wanted: usize,
    },
}

/// Returns the picture of a PNG.
fn png(bytes: &[u8]) -> Result<GreyMap, GreyMapError> {
    let wrong = |error: DecodingError| GreyMapError::Png {
        why: error.to_string(),
    };
    let limits = Limits {
        bytes: usize::try_from(MOST_BYTES).unwrap_or(usize::MAX),
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(wrong)?;
    let size = reader
        .output_buffer_size()
        .filter(|size| *size as u64 <= MOST_BYTES);
    let size = size.ok_or_else(|| GreyMapError::Png {
        why: "it is too large".to_owned(),
    })?;
    let mut pixels = vec![0; size];
    let frame = reader.next_frame(&mut pixels).map_err(wrong)?;
    let samples = frame.color_type.samples();
    let colours = if samples < 3 { 1 } else { 3 };
    let values = pixels.chunks_exact(samples).map(|pixel| {
        let sum: u16 = pixel
            .iter()
            .take(colours.into())
            .map(|part| u16::from(*part))
            .sum();
        sum / colours
    });
    let (width, height) = (frame.width as usize, frame.height as usize);
    Ok(GreyMap {
        width,
        height,
        most: 255,
        values: values.take(width * height).collect(),
    })
}

/// Maximum side of a picture, pixels; a longer one is a damaged header, not a map.
const MOST_SIDE: u32 = 100_000;

impl GreyMap {
    /// Reads a picture and returns it. Bytes after the last value are ignored, as other programs
    /// do. O(bytes).
    ///
    /// # Errors
    /// [`GreyMapError`] with the byte at fault.
    pub fn parse(bytes: &[u8]) -> Result<Self, GreyMapError> {
        let plain = match bytes.get(..2) {
            Some(b"\x89P") => return png(bytes),
            Some(b"P2") => true,
            Some(b"P5") => false,
            _ => return Err(GreyMapError::Magic),
        };
        let mut reader = Reader { bytes, at: 2 };
        let width = reader.size("its width", MOST_SIDE)? as usize;
        let height = reader.size("its height", MOST_SIDE)? as usize;
        let most = reader.size("the value of white", u16::MAX)?;
        let wanted = width * height;
        let values = match plain {
            true => reader.plain(wanted, most)?,
            false => reader.binary(wanted, most)?,
        };
        Ok(Self {
            width,
            height,
            most,
            values,
        })
    }
}

/// Reader of a picture, with its position in the bytes.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    /// Passes over blanks and comments, which run from # to the end of their line.
    fn skip_blanks(&mut self) {
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => self.skip_line(),
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => return,
            }
        }
    }

    fn skip_line(&mut self) {
        let rest = self.rest().iter();
        self.at += rest.take_while(|byte| !b"\r\n".contains(byte)).count();
    }

    fn rest(&self) -> &[u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Returns the next number, or `None` if there is none. A number too large to hold becomes the
    /// largest.
    fn number(&mut self) -> Option<u64> {
        self.skip_blanks();
        let digits = self.rest().iter().take_while(|byte| byte.is_ascii_digit());
        let digits: Vec<u64> = digits.map(|digit| u64::from(digit - b'0')).collect();
        self.at += digits.len();
        let value = digits.iter().fold(0_u64, |value, digit| {
            value.saturating_mul(10).saturating_add(*digit)
        });
        (!digits.is_empty()).then_some(value)
    }

    /// Returns the next number, which must lie within 1 … `most`.
    fn size<T: Copy + TryFrom<u64> + Into<u64>>(
        &mut self,
        what: &'static str,
        most: T,
    ) -> Result<T, GreyMapError> {
        self.skip_blanks();
        let (byte, most) = (self.at, most.into());
        let value = self.number().ok_or(GreyMapError::Number { byte, what })?;
        let in_range = (1..=most).contains(&value).then_some(value);
        in_range
            .and_then(|value| T::try_from(value).ok())
            .ok_or(GreyMapError::Range {
                byte,
                what,
                value,
                most,
            })
    }

    /// Returns the values, which are written as text. A value takes two bytes or more, so that no
    /// header requests more memory than its file.
    fn plain(&mut self, wanted: usize, most: u16) -> Result<Vec<u16>, GreyMapError> {
        let mut values = Vec::new();
        while values.len() < wanted {
            self.skip_blanks();
            let byte = self.at;
            match self.number() {
                Some(value) => values.push(shade(byte, value, most)?),
                None => return Err(self.ended(byte, values.len(), wanted)),
            }
        }
        Ok(values)
    }

    /// Returns the error for a byte that should begin a value.
    fn ended(&self, byte: usize, found: usize, wanted: usize) -> GreyMapError {
        if byte == self.bytes.len() {
            return GreyMapError::TooShort {
                byte,
                found,
                wanted,
            };
        }
        let what = "a value";
        GreyMapError::Number { byte, what }
    }

    /// Returns the values, which are written as bytes. If white is above 255, a value is two bytes,
    /// the higher one first.
    fn binary(&mut self, wanted: usize, most: u16) -> Result<Vec<u16>, GreyMapError> {
        // Only one blank is skipped: the next byte may be a value that looks like a blank.
        let first = self.at + 1;
        let rest = self.bytes.get(first..).unwrap_or_default();
        let wide = if most > 255 { 2 } else { 1 };
        if rest.len() / wide < wanted {
            return Err(GreyMapError::TooShort {
                byte: self.bytes.len(),
                found: rest.len() / wide,
                wanted,
            });
        }
        let values = rest.chunks_exact(wide).take(wanted).enumerate();
        let value = |(index, bytes): (usize, &[u8])| {
            let value = bytes
                .iter()
                .fold(0, |value, byte| 256 * value + u64::from(*byte));
            shade(first + wide * index, value, most)
        };
        values.map(value).collect()
    }
}

/// Returns the value that was read at `byte`, if it is not brighter than white.
fn shade(byte: usize, value: u64, most: u16) -> Result<u16, GreyMapError> {
    let shade = u16::try_from(value).ok().filter(|shade| *shade <= most);
    shade.ok_or(GreyMapError::TooBright { byte, value, most })
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_png_has_the_mean_of_its_colours() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Rgba);
        let mut writer = encoder.write_header().unwrap();
        writer
            .write_image_data(&[0, 30, 60, 255, 254, 254, 254, 0])
            .unwrap();
        writer.finish().unwrap();
        let picture = GreyMap::parse(&bytes).unwrap();
        assert_eq!(
            (picture.width, picture.height, picture.values),
            (2, 1, vec![30, 254])
        );
        for end in 0..bytes.len() {
            let _ = GreyMap::parse(&bytes[..end]);
        }
    }

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn both_forms_are_read_with_comments() {
        let plain = GreyMap::parse(b"P2 # made by hand\n3 1\n# white\n15\n0 7\n15").unwrap();
        assert_eq!((plain.width, plain.height, plain.most), (3, 1, 15));
        assert_eq!(plain.values, [0, 7, 15]);
        let binary =
            GreyMap::parse(b"P5\n# CREATOR: map_saver\n2 2\n255\n\x00\x0a\x23\xfe").unwrap();
        assert_eq!(binary.values, [0, 10, 35, 254], "blanks and # are values");
        let wide = GreyMap::parse(b"P5 1 2 1000\n\x03\xe8\x00\x01").unwrap();
        assert_eq!(wide.values, [1000, 1]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_byte() {
        for (bytes, expect) in [
            (&b"P6 1 1 255\n\0"[..], "byte 0: expected P5 or P2"),
            (b"", "byte 0: expected P5 or P2"),
            (b"P5 2", "byte 4: expected its height"),
            (b"P5 0 1 255\n", "byte 3: its width is 0"),
            (b"P5 1 1 70000\n", "byte 7: the value of white is 70000"),
            (
                b"P5 2 2 255\nab",
                "byte 13: the picture ends, with 2 of 4 values",
            ),
            (b"P5 99999 99999 255\na", "with 1 of 9999800001 values"),
            (
                b"P5 2 1 9\n\x03\x0a",
                "byte 10: value 10 is above the picture's white, 9",
            ),
            (b"P2 2 1 9\n3 10", "byte 11: value 10 is above"),
            (b"P2 2 1 9\n3 x", "byte 11: expected a value"),
            (
                b"P2 2 1 9\n3 ",
                "byte 11: the picture ends, with 1 of 2 values",
            ),
            (
                b"P2 99999999999999999999 1 9\n",
                "byte 3: its width is 18446744073709551615",
            ),
        ] {
            let error = GreyMap::parse(bytes).unwrap_err().to_string();
            assert!(error.contains(expect), "{error}");
        }
    }

    proptest! {
        #[test]
        fn no_bytes_are_too_strange(bytes in proptest::collection::vec(any::<u8>(), 0..64), form in 0..2) {
            let magic = [b"P2 ", b"P5 "][form as usize];
            for bytes in [bytes.clone(), [&magic[..], &bytes[..]].concat()] {
                if let Ok(picture) = GreyMap::parse(&bytes) {
                    prop_assert_eq!(picture.values.len(), picture.width * picture.height);
                    prop_assert!(picture.values.iter().all(|value| *value <= picture.most));
                }
            }
        }

        #[test]
        fn what_is_written_is_read(width in 1_usize..6, values in proptest::collection::vec(0_u16..=300, 1..30)) {
            let height = values.len() / width;
            prop_assume!(height > 0);
            let values = &values[..width * height];
            let words: Vec<String> = values.iter().map(u16::to_string).collect();
            let plain = format!("P2\n{width} {height}\n300\n{}\n", words.join(" "));
            let mut binary = format!("P5\n{width} {height}\n300\n").into_bytes();
            binary.extend(values.iter().flat_map(|value| value.to_be_bytes()));
            for bytes in [plain.into_bytes(), binary] {
                let read = GreyMap::parse(&bytes).unwrap();
                prop_assert_eq!((read.width, read.height), (width, height));
                prop_assert_eq!(&read.values[..], values);
            }
        }
    }
}
