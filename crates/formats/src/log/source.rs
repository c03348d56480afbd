use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::input;
use crate::unpack::{Unpacked, unpacked};

/// Reason why an outside file cannot be used at all.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be opened.
    #[error("cannot read {}; give a file that is there, plain or packed by gzip, bzip2, xz or zstd", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file has no usable contents.
    #[error("{}: {what}", path.display())]
    Nothing {
        /// Path of the file.
        path: PathBuf,
        /// Expected contents, and the contents found instead.
        what: String,
    },
}

/// Opens a file of lines, plain or packed, of which `most` bytes of text may be read.
pub(crate) fn open(path: &Path, most: u64) -> Result<Unpacked, LogError> {
    let opened = input::open(path).and_then(unpacked);
    let (_, whole) = opened.map_err(|source| LogError::File {
        path: path.to_owned(),
        source,
    })?;
    Ok(text(whole, most))
}

/// Returns a source of text without its byte order mark, which fails after `most` bytes.
pub(crate) fn text(source: Unpacked, most: u64) -> Unpacked {
    let left = most;
    let mut text = BufReader::new(Budget { source, left });
    // A fault of the first bytes is met again, by who reads them.
    if text.fill_buf().is_ok_and(|bytes| bytes.starts_with(MARK)) {
        text.consume(MARK.len());
    }
    Box::new(text)
}

/// Byte order mark of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// A source that gives a limited number of bytes, and then fails.
struct Budget<R> {
    source: R,
    left: u64,
}

impl<R: Read> Read for Budget<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        let left = self.left.checked_sub(read as u64);
        self.left = left.ok_or(io::ErrorKind::FileTooLarge)?;
        Ok(read)
    }
}
