//! Files packed by gzip, bzip2, xz or zstd, recognized by their first bytes, and the packed parts
//! of bags. All codecs are Rust, so no C compiler is needed.

mod xz;
mod zstd;

use std::io::{self, BufRead, BufReader, Cursor, Read};

use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::MultiGzDecoder;
use lz4_flex::frame::FrameDecoder;

use xz::Xz;
use zstd::Zstd;

/// First bytes by which a kind of file is known.
const FIRST_BYTES: usize = 16;

/// Maximum number of packings around a file.
const MOST_LAYERS: usize = 3;

/// An open file, unpacked.
pub(crate) type Unpacked = Box<dyn BufRead + Send>;

/// Returns the contents of `file`, unpacked, and their first bytes.
pub(crate) fn unpacked(file: impl Read + Send + 'static) -> io::Result<(Vec<u8>, Unpacked)> {
    let mut source: Unpacked = Box::new(BufReader::new(file));
    for _ in 0..MOST_LAYERS {
        let (first, whole) = first_bytes(source)?;
        source = match *first.as_slice() {
            [0x1f, 0x8b, ..] => Box::new(BufReader::new(MultiGzDecoder::new(whole))),
            [b'B', b'Z', b'h', b'1'..=b'9', 0x31 | 0x17, ..] => {
                Box::new(BufReader::new(MultiBzDecoder::new(whole)))
            }
            [0xfd, b'7', b'z', b'X', b'Z', 0, ..] => Box::new(BufReader::new(Xz::new(whole))),
            [0x28, 0xb5, 0x2f, 0xfd, ..] => Box::new(BufReader::new(Zstd::new(whole))),
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => {
                return Err(invalid("it is text of UTF-16; save it as UTF-8"));
            }
            _ => return Ok((first, whole)),
        };
    }
    first_bytes(source)
}

/// Returns the first bytes of a source, and a source that still has them.
fn first_bytes(mut source: Unpacked) -> io::Result<(Vec<u8>, Unpacked)> {
    let mut first = Vec::new();
    // What cannot be read now is met again, by who reads on.
    let _ = source
        .by_ref()
        .take(FIRST_BYTES as u64)
        .read_to_end(&mut first);
    let whole = Cursor::new(first.clone()).chain(source);
    Ok((first, Box::new(whole)))
}

/// Unpacks a part of a bag, packed as `format` names, and returns at most `most` bytes.
pub(crate) fn unpack(format: &str, packed: &[u8], most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let source: Box<dyn Read + '_> = match format {
        "" | "none" => Box::new(packed),
        "lz4" => Box::new(FrameDecoder::new(packed)),
        "zstd" => Box::new(Zstd::new(packed)),
        "bz2" => Box::new(MultiBzDecoder::new(packed)),
        _ => return Err(invalid(format!("a part packed by `{format}`"))),
    };
    source.take(most + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > most {
        true => Err(invalid(format!("a part of more than {most} bytes"))),
        false => Ok(bytes),
    }
}

/// Returns the error of contents that are not as their format has them.
pub(crate) fn invalid(what: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what.into())
}
