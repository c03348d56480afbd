//! Bags in SQLite files, of which only the tables `topics` and `messages` are read. Source:
//! Database File Format, sqlite.org.

use alloc::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use super::message::{Encoding, Message};
use super::{Take, seconds};
use crate::unpack::{invalid, unpack};

pub(super) const MAGIC: &[u8] = b"SQLite format 3\0";

/// Longest row that is accepted, bytes.
const LONGEST: usize = 1 << 26;

/// Maximum depth of a table's tree.
const DEEPEST: u32 = 20;

/// Kinds of pages.
const LEAF: u8 = 13;
const INNER: u8 = 5;

/// A value of a row.
#[derive(Clone, Copy, Debug)]
enum Value<'a> {
    Null,
    Number(i64),
    Bytes(&'a [u8]),
}

impl Value<'_> {
    fn number(self) -> io::Result<i64> {
        match self {
            Self::Number(number) => Ok(number),
            _ => Err(invalid("a column that is no whole number")),
        }
    }

    fn text(self) -> String {
        match self {
            Self::Bytes(bytes) => String::from_utf8_lossy(bytes).into_owned(),
            _ => String::new(),
        }
    }
}

/// Passes all messages to `take`; `packed` is how each is packed.
pub(super) fn read(source: impl Read + Seek, packed: &str, take: &mut Take<'_>) -> io::Result<()> {
    let mut file = Database::open(source)?;
    let mut tables = BTreeMap::new();
    file.rows(1, &mut |_, row| {
        if let [_, name, _, Value::Number(root), sql] = row {
            tables.insert(name.text(), (*root, columns(&sql.text())));
        }
        Ok(())
    })?;
    let table = |name: &str| {
        let found = tables.get(name);
        found.ok_or_else(|| invalid(format!("a database without the table `{name}` of rosbag2")))
    };
    let (topics, names) = table("topics")?;
    let [id, name, kind] = places(names, ["id", "name", "type"])?;
    let mut by_id = BTreeMap::new();
    file.rows(root(*topics)?, &mut |row_id, row| {
        let text = |place: usize| row.get(place).map_or_else(String::new, |it| it.text());
        by_id.insert(key(row, id, row_id), [text(name), text(kind)]);
        Ok(())
    })?;
    let (messages, names) = table("messages")?;
    let [topic, time, data] = places(names, ["topic_id", "timestamp", "data"])?;
    file.rows(root(*messages)?, &mut |_, row| {
        let column = |place: usize| row.get(place).copied().unwrap_or(Value::Null);
        let [topic, kind] = (by_id.get(&column(topic).number()?))
            .ok_or_else(|| invalid("a message of no topic"))?;
        let Value::Bytes(data) = column(data) else {
            return Ok(());
        };
        let unpacked;
        let data = match packed {
            "" => data,
            format => {
                unpacked = unpack(format, data, LONGEST as u64)?;
                &unpacked
            }
        };
        take(Message {
            topic,
            kind,
            encoding: Encoding::Cdr,
            received: seconds(column(time).number()?.into()),
            data,
        })
    })
}

fn root(page: i64) -> io::Result<u32> {
    u32::try_from(page).map_err(|_| invalid("a table without a page"))
}

/// Returns the key of a row: a column that is null stands for the row's own number.
fn key(row: &[Value<'_>], place: usize, row_id: i64) -> i64 {
    match row.get(place) {
        Some(Value::Number(id)) => *id,
        _ => row_id,
    }
}

/// Returns the names of a table's columns, by the statement that made it.
fn columns(sql: &str) -> Vec<String> {
    let (_, inside) = sql.split_once('(').unwrap_or_default();
    let names = inside.split(',').map(|column| {
        let name = column.split_whitespace().next().unwrap_or_default();
        name.trim_matches(['"', '`', '[', ']']).to_owned()
    });
    names.collect()
}

fn places<const N: usize>(columns: &[String], names: [&str; N]) -> io::Result<[usize; N]> {
    let mut places = [0; N];
    for (place, name) in places.iter_mut().zip(names) {
        let found = columns.iter().position(|column| column == name);
        *place = found.ok_or_else(|| invalid(format!("a table without the column `{name}`")))?;
    }
    Ok(places)
}

struct Database<R> {
    source: R,
    page: u64,
    /// Bytes of a page that are in use.
    usable: usize,
    pages: u64,
}

/// Takes a row: its number and its values.
type TakeRow<'a> = dyn FnMut(i64, &[Value<'_>]) -> io::Result<()> + 'a;

impl<R: Read + Seek> Database<R> {
    fn open(mut source: R) -> io::Result<Self> {
        let size = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let mut head = [0; 100];
        source.read_exact(&mut head)?;
        let page = match u16::from_be_bytes([head[16], head[17]]) {
            1 => 65536,
            size => u64::from(size),
        };
        if !(512..=65536).contains(&page) || !page.is_power_of_two() {
            return Err(invalid("a database whose pages have no size"));
        }
        if u32::from_be_bytes([head[56], head[57], head[58], head[59]]) > 1 {
            return Err(invalid("a database whose text is not UTF-8"));
        }
        Ok(Self {
            source,
            page,
            usable: usize::try_from(page)
                .unwrap_or(0)
                .saturating_sub(usize::from(head[20])),
            pages: size.div_ceil(page),
        })
    }

    fn page(&mut self, number: u32) -> io::Result<Vec<u8>> {
        let before = u64::from(number).checked_sub(1);
        let before = before.filter(|before| *before < self.pages);
        let before = before.ok_or(io::ErrorKind::UnexpectedEof)?;
        self.source.seek(SeekFrom::Start(before * self.page))?;
        let mut page = Vec::new();
        let read = (&mut self.source).take(self.page).read_to_end(&mut page)?;
        match read as u64 == self.page {
            true => Ok(page),
            false => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }

    /// Passes all rows of the table with this root to `take`, in order.
    fn rows(&mut self, root: u32, take: &mut TakeRow<'_>) -> io::Result<()> {
        let mut left = self.pages;
        self.tree(root, DEEPEST, &mut left, take)
    }

    fn tree(
        &mut self,
        number: u32,
        depth: u32,
        left: &mut u64,
        take: &mut TakeRow<'_>,
    ) -> io::Result<()> {
        if *left == 0 || depth == 0 {
            return Err(invalid("a table that is no tree"));
        }
        *left -= 1;
        let page = self.page(number)?;
        let start = if number == 1 { 100 } else { 0 };
        let mut head = Bytes::at(&page, start)?;
        let [kind] = head.array()?;
        let _free = head.array::<2>()?;
        let cells = u16::from_be_bytes(head.array()?);
        let _rest = head.array::<3>()?;
        let last = match kind {
            LEAF => None,
            INNER => Some(u32::from_be_bytes(head.array()?)),
            _ => return Err(invalid("a page that is not of a table")),
        };
        for _ in 0..cells {
            let at = u16::from_be_bytes(head.array()?);
            let mut cell = Bytes::at(&page, at.into())?;
            if last.is_some() {
                let child = u32::from_be_bytes(cell.array()?);
                self.tree(child, depth - 1, left, take)?;
                continue;
            }
            let (size, id) = (cell.number()?, cell.number()?);
            let payload = self.payload(size, cell)?;
            take(id, &row(&payload)?)?;
        }
        match last {
            Some(last) => self.tree(last, depth - 1, left, take),
            None => Ok(()),
        }
    }

    /// Returns the whole of a row that may go on in pages of its own.
    fn payload(&mut self, size: i64, mut cell: Bytes<'_>) -> io::Result<Vec<u8>> {
        let size = usize::try_from(size).ok().filter(|size| *size <= LONGEST);
        let size = size.ok_or_else(|| invalid("a row that is too long"))?;
        let most = self.usable.saturating_sub(35);
        let least = (self.usable.saturating_sub(12) * 32 / 255).saturating_sub(23);
        let here = match size <= most {
            true => size,
            false => {
                let over = least + (size - least) % (self.usable - 4);
                if over <= most { over } else { least }
            }
        };
        let mut payload = cell.bytes(here)?.to_vec();
        let mut next = match here < size {
            true => u32::from_be_bytes(cell.array()?),
            false => 0,
        };
        while payload.len() < size {
            let page = self.page(next)?;
            let mut rest = Bytes(&page);
            next = u32::from_be_bytes(rest.array()?);
            let part = (size - payload.len()).min(self.usable - 4);
            payload.extend_from_slice(rest.bytes(part)?);
        }
        Ok(payload)
    }
}

/// Returns the values of a row.
fn row(payload: &[u8]) -> io::Result<Vec<Value<'_>>> {
    let mut head = Bytes(payload);
    let size = usize::try_from(head.number()?).map_err(|_| invalid("a row without a head"))?;
    let mut values = Bytes::at(payload, size)?;
    let left = values.0.len();
    let mut row = Vec::new();
    while head.0.len() > left {
        let kind = head.number()?;
        row.push(match kind {
            0 => Value::Null,
            1 => Value::Number(values.signed(1)?),
            2 => Value::Number(values.signed(2)?),
            3 => Value::Number(values.signed(3)?),
            4 => Value::Number(values.signed(4)?),
            5 => Value::Number(values.signed(6)?),
            6 => Value::Number(values.signed(8)?),
            7 => {
                values.bytes(8)?;
                Value::Null
            }
            8 => Value::Number(0),
            9 => Value::Number(1),
            12.. => {
                let size = usize::try_from((kind - 12) / 2).unwrap_or(usize::MAX);
                Value::Bytes(values.bytes(size)?)
            }
            _ => return Err(invalid("a value of no kind")),
        });
    }
    Ok(row)
}

/// Bytes that are still to be read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn at(bytes: &'a [u8], start: usize) -> io::Result<Self> {
        let rest = bytes.get(start..).ok_or(io::ErrorKind::UnexpectedEof)?;
        Ok(Self(rest))
    }

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

    /// Reads a number of variable length, the highest bits first.
    fn number(&mut self) -> io::Result<i64> {
        let mut number = 0_i64;
        for place in 0..9 {
            let [byte] = self.array()?;
            if place == 8 {
                return Ok(number << 8 | i64::from(byte));
            }
            number = number << 7 | i64::from(byte & 0x7f);
            if byte & 0x80 == 0 {
                break;
            }
        }
        Ok(number)
    }

    /// Reads a signed number of `size` bytes.
    fn signed(&mut self, size: usize) -> io::Result<i64> {
        let bytes = self.bytes(size)?;
        let first = bytes
            .first()
            .map_or(0, |byte| i64::from(byte.cast_signed()));
        let rest = bytes.iter().skip(1);
        Ok(rest.fold(first, |number, byte| number << 8 | i64::from(*byte)))
    }
}
