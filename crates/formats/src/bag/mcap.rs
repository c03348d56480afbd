//! Bags in MCAP files. Source: the format's specification, mcap.dev.

use alloc::collections::BTreeMap;
use core::str;
use std::io::{self, BufRead, Read};

use flate2::Crc;

use super::message::{Encoding, Message};
use super::{Take, seconds};
use crate::unpack::{invalid, unpack};

pub(super) const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Longest record that is accepted, bytes.
const LONGEST: u64 = 1 << 26;

/// Opcodes of records.
mod op {
    pub(super) const FOOTER: u8 = 2;
    pub(super) const SCHEMA: u8 = 3;
    pub(super) const CHANNEL: u8 = 4;
    pub(super) const MESSAGE: u8 = 5;
    pub(super) const CHUNK: u8 = 6;
    pub(super) const DATA_END: u8 = 15;
}

/// Passes all messages to `take`, up to the end or to the first record that cannot be read.
pub(super) fn read(mut source: impl BufRead, take: &mut Take<'_>) -> io::Result<()> {
    source.read_exact(&mut [0; MAGIC.len()])?;
    let mut known = Known::default();
    let mut record = Vec::new();
    loop {
        let mut head = [0; 9];
        source.read_exact(&mut head)?;
        let [opcode, size @ ..] = head;
        let size = u64::from_le_bytes(size);
        if size > LONGEST {
            return Err(invalid(format!("a record of {size} bytes")));
        }
        record.clear();
        source.by_ref().take(size).read_to_end(&mut record)?;
        if (record.len() as u64) < size {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        match opcode {
            op::FOOTER | op::DATA_END => return Ok(()),
            op::CHUNK => known.take_chunk(Fields(&record), take)?,
            _ => known.take_record(opcode, Fields(&record), take)?,
        }
    }
}

/// What is known of the messages to come.
#[derive(Default)]
struct Known {
    /// Type of the messages of each schema.
    schemas: BTreeMap<u16, String>,
    channels: BTreeMap<u16, Channel>,
}

struct Channel {
    topic: String,
    kind: String,
    encoding: Encoding,
}

impl Known {
    fn take_chunk(&mut self, mut chunk: Fields<'_>, take: &mut Take<'_>) -> io::Result<()> {
        let _times = chunk.bytes(16)?;
        let size = u64::from_le_bytes(chunk.array()?);
        let checksum = u32::from_le_bytes(chunk.array()?);
        let format = chunk.text()?;
        let packed = u64::from_le_bytes(chunk.array()?);
        let packed = chunk.bytes(usize::try_from(packed).unwrap_or(usize::MAX))?;
        let records = unpack(format, packed, size.min(LONGEST))?;
        let mut crc = Crc::new();
        crc.update(&records);
        if checksum != 0 && checksum != crc.sum() {
            return Err(invalid("a chunk whose checksum is wrong"));
        }
        let mut rest = Fields(&records);
        while !rest.0.is_empty() {
            let [opcode] = rest.array()?;
            let size = u64::from_le_bytes(rest.array()?);
            let record = rest.bytes(usize::try_from(size).unwrap_or(usize::MAX))?;
            self.take_record(opcode, Fields(record), take)?;
        }
        Ok(())
    }

    fn take_record(
        &mut self,
        opcode: u8,
        mut fields: Fields<'_>,
        take: &mut Take<'_>,
    ) -> io::Result<()> {
        match opcode {
            op::SCHEMA => {
                let (id, name) = (fields.id()?, fields.text()?);
                self.schemas.insert(id, name.to_owned());
            }
            op::CHANNEL => {
                let (id, schema, topic) = (fields.id()?, fields.id()?, fields.text()?);
                let kind = self
                    .schemas
                    .get(&schema)
                    .map_or("no schema", String::as_str);
                let channel = Channel {
                    topic: topic.to_owned(),
                    kind: kind.to_owned(),
                    encoding: match fields.text()? {
                        "ros1" => Encoding::Ros1,
                        _ => Encoding::Cdr,
                    },
                };
                self.channels.insert(id, channel);
            }
            op::MESSAGE => {
                let channel = self.channels.get(&fields.id()?);
                let channel = channel.ok_or_else(|| invalid("a message of no channel"))?;
                let _sequence = fields.bytes(4)?;
                let received = seconds(i128::from(u64::from_le_bytes(fields.array()?)));
                let _published = fields.bytes(8)?;
                return take(Message {
                    topic: &channel.topic,
                    kind: &channel.kind,
                    encoding: channel.encoding,
                    received,
                    data: fields.0,
                });
            }
            _ => {}
        }
        Ok(())
    }
}

/// Fields of a record that are still to be read.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn bytes(&mut self, count: usize) -> io::Result<&'a [u8]> {
        let split = self.0.split_at_checked(count);
        let (bytes, rest) = split.ok_or(io::ErrorKind::UnexpectedEof)?;
        self.0 = rest;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let (bytes, rest) = (self.0.split_first_chunk()).ok_or(io::ErrorKind::UnexpectedEof)?;
        self.0 = rest;
        Ok(*bytes)
    }

    fn id(&mut self) -> io::Result<u16> {
        Ok(u16::from_le_bytes(self.array()?))
    }

    fn text(&mut self) -> io::Result<&'a str> {
        let size = u32::from_le_bytes(self.array()?);
        let bytes = self.bytes(size as usize)?;
        str::from_utf8(bytes).map_err(|_| invalid("a name that is not UTF-8"))
    }
}
