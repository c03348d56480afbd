use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::bufread::MultiGzDecoder;
use thiserror::Error;

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
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut first));
    read.is_ok() && first == MCAP
}

/// Opens a file, plain or gzipped.
pub(crate) fn open(path: &Path) -> Result<Box<dyn BufRead + Send>, LogError> {
    let wrong = |source| LogError::File {
        path: path.to_owned(),
        source,
    };
    let mut file = BufReader::new(File::open(path).map_err(wrong)?);
    let is_packed = file.fill_buf().map_err(wrong)?.starts_with(&GZIP);
    Ok(if is_packed {
        Box::new(BufReader::new(MultiGzDecoder::new(file)))
    } else {
        Box::new(file)
    })
}
