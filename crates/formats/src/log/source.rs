use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::bufread::MultiGzDecoder;
use thiserror::Error;

use crate::input;

/// Reason why an outside file cannot be used at all.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be opened.
    #[error("cannot read {}; give a file that is there, plain or packed by gzip", path.display())]
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

/// First bytes of a gzip file.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// First bytes of an MCAP file.
const MCAP: [u8; 8] = *b"\x89MCAP0\r\n";

/// Returns whether a file begins as an MCAP file, the format of ROS 2 bags.
#[must_use]
pub fn is_mcap(path: &Path) -> bool {
    let mut first = [0; MCAP.len()];
    let read = input::open(path).and_then(|mut file| file.read_exact(&mut first));
    read.is_ok() && first == MCAP
}

/// Opens a file, plain or gzipped, of which `most` bytes of text may be read.
pub(crate) fn open(path: &Path, most: u64) -> Result<Box<dyn BufRead + Send>, LogError> {
    let wrong = |source| LogError::File {
        path: path.to_owned(),
        source,
    };
    let mut file = BufReader::new(input::open(path).map_err(wrong)?);
    let is_packed = file.fill_buf().map_err(wrong)?.starts_with(&GZIP);
    let left = most;
    let mut text: Box<dyn BufRead + Send> = if is_packed {
        let source = MultiGzDecoder::new(file);
        Box::new(BufReader::new(Budget { source, left }))
    } else {
        Box::new(BufReader::new(Budget { source: file, left }))
    };
    // A fault of the first bytes is met again, by who reads them.
    if text.fill_buf().is_ok_and(|bytes| bytes.starts_with(MARK)) {
        text.consume(MARK.len());
    }
    Ok(text)
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
