//! Bags of ROS 1. Source: wiki.ros.org/Bags/Format/2.0.

use alloc::collections::BTreeMap;
use core::str;
use std::io::{self, BufRead, Read};

use super::message::{Encoding, Message};
use super::{Take, seconds};
use crate::unpack::{invalid, unpack};

pub(super) const MAGIC: &[u8] = b"#ROSBAG V2.0\n";

/// Longest header or contents of a record that are accepted, bytes.
const LONGEST: u32 = 1 << 26;

mod op {
    pub(super) const MESSAGE: u8 = 2;
    pub(super) const CHUNK: u8 = 5;
    pub(super) const CONNECTION: u8 = 7;
}

/// Topic and type of a connection's messages.
type Connections = BTreeMap<u32, [String; 2]>;

/// Passes all messages to `take`, up to the end or to the first record that cannot be read.
pub(super) fn read(mut source: impl BufRead, take: &mut Take<'_>) -> io::Result<()> {
    source.read_exact(&mut [0; MAGIC.len()])?;
    take_records(&mut source, &mut Connections::new(), take)
}

fn take_records(
    source: &mut dyn BufRead,
    connections: &mut Connections,
    take: &mut Take<'_>,
) -> io::Result<()> {
    while !source.fill_buf()?.is_empty() {
        let header = block(source)?;
        let data = block(source)?;
        let fields = fields(&header)?;
        let field = |name: &str| fields.get(name).copied().unwrap_or_default();
        match field("op") {
            [op::CHUNK] => {
                let size = u64::from(number(field("size"))?.min(LONGEST));
                let format = str::from_utf8(field("compression")).unwrap_or("?");
                let records = unpack(format, &data, size)?;
                // A chunk has no chunks.
                if is_within(&records)? {
                    take_records(&mut records.as_slice(), connections, take)?;
                }
            }
            [op::CONNECTION] => {
                let about = self::fields(&data)?;
                let kind = about.get("type").copied().unwrap_or_default();
                let names = [field("topic"), kind];
                let names = names.map(|name| String::from_utf8_lossy(name).into_owned());
                connections.insert(number(field("conn"))?, names);
            }
            [op::MESSAGE] => {
                let connection = connections.get(&number(field("conn"))?);
                let connection = connection.ok_or_else(|| invalid("a message of no connection"))?;
                let [topic, kind] = connection;
                let time = field("time");
                let (whole, part) = time.split_at_checked(4).unwrap_or_default();
                let nanoseconds = i128::from(number(whole)?) * 1_000_000_000;
                take(Message {
                    topic,
                    kind,
                    encoding: Encoding::Ros1,
                    received: seconds(nanoseconds + i128::from(number(part)?)),
                    data: &data,
                })?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// Returns whether the records of a chunk hold no further chunk, which would make reading endless.
fn is_within(mut records: &[u8]) -> io::Result<bool> {
    while !records.is_empty() {
        let header = block(&mut records)?;
        block(&mut records)?;
        if fields(&header)?.get("op").copied() == Some(&[op::CHUNK][..]) {
            return Err(invalid("a chunk within a chunk"));
        }
    }
    Ok(true)
}

/// Reads bytes that begin with their number.
fn block(source: &mut dyn BufRead) -> io::Result<Vec<u8>> {
    let mut size = [0; 4];
    source.read_exact(&mut size)?;
    let size = u32::from_le_bytes(size);
    if size > LONGEST {
        return Err(invalid(format!("a record of {size} bytes")));
    }
    let mut bytes = Vec::new();
    source.take(size.into()).read_to_end(&mut bytes)?;
    match bytes.len() == size as usize {
        true => Ok(bytes),
        false => Err(io::ErrorKind::UnexpectedEof.into()),
    }
}

/// Returns the fields `name=value` of a header.
fn fields(mut header: &[u8]) -> io::Result<BTreeMap<&str, &[u8]>> {
    let mut fields = BTreeMap::new();
    let cut = || io::Error::from(io::ErrorKind::UnexpectedEof);
    while let Some((size, rest)) = header.split_first_chunk() {
        let size = u32::from_le_bytes(*size) as usize;
        let (field, rest) = rest.split_at_checked(size).ok_or_else(cut)?;
        let mut parts = field.splitn(2, |byte| *byte == b'=');
        if let (Some(name), Some(value)) = (parts.next(), parts.next()) {
            let name = str::from_utf8(name).map_err(|_| invalid("a field's name"))?;
            fields.insert(name, value);
        }
        header = rest;
    }
    Ok(fields)
}

fn number(bytes: &[u8]) -> io::Result<u32> {
    let bytes = bytes.try_into();
    let bytes = bytes.map_err(|_| invalid("a number that is not of four bytes"))?;
    Ok(u32::from_le_bytes(bytes))
}
