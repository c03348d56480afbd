//! Files read whole, within a budget of bytes.
//!
//! Every reader of a whole file uses this module. So none grows without bound on a device or a pipe
//! that never ends, and each reports non-text in the same way.

use core::str;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use thiserror::Error;

/// Maximum number of bytes read of one file, 256 MiB. Maps, worlds and traces are far smaller, and
/// the memory of any machine is larger.
pub const MOST_BYTES: u64 = 256 << 20;

/// Reason why a file cannot be read whole. It does not name the file; the caller adds that.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SourceError {
    /// The operating system cannot read the file.
    #[error(transparent)]
    System(#[from] io::Error),
    /// The file is too large.
    #[error("it has more than {most} bytes; give a smaller file")]
    TooLong {
        /// Maximum number of bytes that are read.
        most: u64,
    },
    /// The file is UTF-16 text.
    #[error("it begins with a byte order mark of UTF-16; save it as UTF-8 text")]
    Utf16,
    /// The file is compressed by gzip.
    #[error("it is packed by gzip; unpack it with `gunzip`")]
    Packed,
    /// The file is not UTF-8 text.
    #[error("line {line}: byte {byte} of the file is not UTF-8; save it as UTF-8 text")]
    NoText {
        /// Number of the line, from 1.
        line: usize,
        /// Offset of the faulty byte in the file, from 0.
        byte: usize,
    },
}

/// Folders of names that stand for streams which are open already.
const STREAMS: [&str; 3] = ["/dev/fd", "/dev/stdin", "/proc/self/fd"];

/// Opens a file. Pipes and devices are refused, because they may never end or begin, unless a
/// shell's `<(COMMAND)` made them.
///
/// # Errors
/// The system's error, or [`io::ErrorKind::InvalidInput`] if it is no file.
pub fn open(path: &Path) -> io::Result<File> {
    let is_stream = STREAMS.iter().any(|stream| path.starts_with(stream));
    let kind = fs::metadata(path)?.file_type();
    if kind.is_file() || kind.is_dir() || is_stream {
        return File::open(path);
    }
    let told = "it is a pipe or a device; give a file, /dev/stdin, or <(COMMAND) in a shell";
    Err(io::Error::new(io::ErrorKind::InvalidInput, told))
}

/// Byte order mark of UTF-8, with which some editors begin a file.
const MARK: char = '\u{feff}';

/// Returns a text without a byte order mark at its beginning.
pub(crate) fn without_mark(text: &str) -> &str {
    text.strip_prefix(MARK).unwrap_or(text)
}

/// Returns the bytes of a file.
///
/// # Errors
/// [`SourceError::System`] and [`SourceError::TooLong`].
pub fn bytes(path: &Path) -> Result<Vec<u8>, SourceError> {
    bytes_of(open(path)?)
}

/// Returns the text of a file.
///
/// # Errors
/// [`SourceError`] if it cannot be read or is not text.
pub fn text(path: &Path) -> Result<String, SourceError> {
    text_of(open(path)?)
}

/// Returns all bytes that `source` gives.
///
/// # Errors
/// [`SourceError::System`] and [`SourceError::TooLong`].
pub fn bytes_of(source: impl Read) -> Result<Vec<u8>, SourceError> {
    let mut bytes = Vec::new();
    source.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > MOST_BYTES {
        true => Err(SourceError::TooLong { most: MOST_BYTES }),
        false => Ok(bytes),
    }
}

/// Returns the text that `source` gives.
///
/// # Errors
/// [`SourceError`] if it cannot be read or is not text.
pub fn text_of(source: impl Read) -> Result<String, SourceError> {
    let bytes = bytes_of(source)?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(SourceError::Utf16);
    }
    if bytes.starts_with(b"\x1f\x8b") {
        return Err(SourceError::Packed);
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let before = error.as_bytes().iter().take(byte);
        SourceError::NoText {
            line: before.filter(|byte| **byte == b'\n').count() + 1,
            byte,
        }
    })?;
    Ok(match text.strip_prefix(MARK) {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(bytes: &[u8]) -> String {
        text_of(bytes).unwrap_err().to_string()
    }

    #[test]
    fn what_is_no_text_is_told_with_its_place() {
        assert_eq!(text_of(&b"o---o\n"[..]).unwrap(), "o---o\n");
        assert!(told(b"a\nb\n\xe9\n").starts_with("line 3: byte 4 of the file is not UTF-8"));
        assert!(told(b"\x1f\x8b\x08").starts_with("it is packed by gzip"));
        assert_eq!(text_of(&b"\xef\xbb\xbfo---o"[..]).unwrap(), "o---o");
        assert!(told(b"\xff\xfeo\0").contains("byte order mark of UTF-16"));
    }

    #[test]
    fn what_never_ends_is_refused() {
        assert!(matches!(
            bytes_of(io::repeat(0)),
            Err(SourceError::TooLong { most: MOST_BYTES })
        ));
        let whole = bytes_of(io::repeat(b'x').take(MOST_BYTES)).unwrap();
        assert_eq!(whole.len() as u64, MOST_BYTES);
    }
}
