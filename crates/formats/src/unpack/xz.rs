//! The container of xz around LZMA2. Source: The .xz File Format 1.2.1.

use std::io::{self, BufRead, Read};

use lzma_rust2::Lzma2Reader;

use super::invalid;

/// Filter of LZMA2, the only one that `xz` uses unless it is told otherwise.
const LZMA2: u64 = 0x21;

/// Maximum memory of a decoder, KiB; `xz -9` needs 64 MiB.
const MOST_MEMORY: u32 = 300 << 10;

/// Size of the stream's header behind its magic bytes, and of the footer.
const MAGIC: usize = 6;

/// All blocks of an xz file, unpacked. Checksums are not compared.
pub(super) struct Xz<R: BufRead> {
    state: Option<State<R>>,
    /// Size of the checksum behind each block.
    check: u64,
}

enum State<R: BufRead> {
    /// Before a stream.
    Stream(R),
    /// Before a block, or the index.
    Block(R),
    /// Within a block.
    Inside(Box<Lzma2Reader<Counted<R>>>),
}

/// A source that counts what was read of it.
struct Counted<R> {
    source: R,
    read: u64,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        self.read += read as u64;
        Ok(read)
    }
}

impl<R: BufRead> Xz<R> {
    pub(super) fn new(source: R) -> Self {
        Self {
            state: Some(State::Stream(source)),
            check: 0,
        }
    }

    /// Reads the header of a stream; `None` at the end of the file.
    fn stream(&mut self, mut source: R) -> io::Result<Option<State<R>>> {
        // Streams are padded by zeros.
        while source.fill_buf()?.first() == Some(&0) {
            source.consume(1);
        }
        if source.fill_buf()?.is_empty() {
            return Ok(None);
        }
        let [.., _, flags, _, _, _, _] = array::<12>(&mut source)?;
        self.check = match flags & 0x0f {
            0 => 0,
            kind => 4 << ((kind - 1) / 3),
        };
        Ok(Some(State::Block(source)))
    }

    /// Reads the header of a block, or the index and the footer.
    fn block(mut source: R) -> io::Result<State<R>> {
        let [size] = array(&mut source)?;
        if size == 0 {
            skip_index(&mut source)?;
            return Ok(State::Stream(source));
        }
        let mut header = vec![0; usize::from(size) * 4 + 3];
        source.read_exact(&mut header)?;
        let mut header = header.as_slice();
        let [flags] = array(&mut header)?;
        for given in [0x40, 0x80] {
            if flags & given != 0 {
                number(&mut header)?;
            }
        }
        let (filter, size) = (number(&mut header)?, number(&mut header)?);
        if flags & 3 != 0 || filter != LZMA2 || size != 1 {
            return Err(invalid("a filter of xz other than LZMA2"));
        }
        let [dictionary] = array(&mut header)?;
        let bits = u32::from(dictionary & 0x3f);
        let size = (2 | bits & 1).checked_shl(bits / 2 + 11).unwrap_or(0);
        let source = Counted { source, read: 0 };
        let inside = Lzma2Reader::new_mem_limit(source, size, MOST_MEMORY, None);
        let inside = inside.map_err(io::Error::other)?;
        Ok(State::Inside(Box::new(inside)))
    }
}

impl<R: BufRead> Read for Xz<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        while let Some(state) = self.state.take() {
            self.state = match state {
                State::Stream(source) => self.stream(source)?,
                State::Block(source) => Some(Self::block(source)?),
                State::Inside(mut inside) => {
                    let read = inside.read(buffer).map_err(io::Error::other)?;
                    if read > 0 {
                        self.state = Some(State::Inside(inside));
                        return Ok(read);
                    }
                    let Counted { mut source, read } = inside.into_inner();
                    let padding = read.wrapping_neg() % 4;
                    skip(&mut source, padding + self.check)?;
                    Some(State::Block(source))
                }
            };
        }
        Ok(0)
    }
}

/// Skips the index, from behind its first byte, and the footer of a stream.
fn skip_index(source: &mut impl Read) -> io::Result<()> {
    let mut index = Counted { source, read: 1 };
    let records = number(&mut index)?;
    for _ in 0..records {
        number(&mut index)?;
        number(&mut index)?;
    }
    let padding = index.read.wrapping_neg() % 4;
    skip(index.source, padding + 4 + 6 + MAGIC as u64)
}

fn skip(source: &mut impl Read, count: u64) -> io::Result<()> {
    let skipped = io::copy(&mut source.take(count), &mut io::sink())?;
    match skipped == count {
        true => Ok(()),
        false => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

fn array<const N: usize>(source: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    source.read_exact(&mut bytes)?;
    Ok(bytes)
}

/// Reads a number of variable length, seven bits a byte, the lowest first.
fn number(source: &mut impl Read) -> io::Result<u64> {
    let mut number = 0;
    for shift in (0..63).step_by(7) {
        let [byte] = array(source)?;
        number |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Ok(number);
        }
    }
    Err(invalid("a number of xz that does not end"))
}
