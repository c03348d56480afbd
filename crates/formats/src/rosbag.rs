//! Bags of ROS 2 in MCAP files: laser scans, odometry, and where the laser sits.
//!
//! Read are `sensor_msgs/msg/LaserScan`, `nav_msgs/msg/Odometry`, and of `tf2_msgs/msg/TFMessage`
//! the topic `/tf_static`. All else is counted and left out, and so are a second laser and a second
//! odometry.
//!
//! Sources: the format's specification (mcap.dev), and the interface definitions of ROS 2.

mod messages;
mod mounts;

use alloc::collections::BTreeMap;
use std::io::{BufReader, Read};
use std::path::Path;

use mcap::records::op;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, McapResult};
use tolman_geom::Pose;
use tolman_robot::{TimedPose, Trajectory};

use crate::input::{self, MOST_BYTES};
use crate::log::{LogEntry, LogError, LogOdometry, LogReport, LogScan, LogTrouble};
use messages::{LaserScan, Odometry, Transforms, decode};
use mounts::Mounts;

/// Longest record of a bag of scans that is accepted, bytes.
const LONGEST: usize = 1 << 26;

/// Number of bytes of a message before its data: the channel, a number and two times.
const MESSAGE_HEADER: usize = 22;

const SCAN: &str = "sensor_msgs/msg/LaserScan";
const ODOMETRY: &str = "nav_msgs/msg/Odometry";
const TRANSFORMS: &str = "tf2_msgs/msg/TFMessage";

/// Contents of a bag. Entries are in the order of the file; each has the number of its message,
/// from 1, in place of a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RosBag {
    /// Scans and odometry. A scan before the first odometry or after the last is left out.
    pub entries: Vec<LogEntry>,
    /// Report on reading the bag.
    pub report: LogReport,
}

/// A scan whose pose is not known yet.
struct PlacelessScan {
    number: u64,
    topic: String,
    scan: LaserScan,
}

#[derive(Default)]
struct Reader {
    report: LogReport,
    /// Number of bytes that may still be read.
    left: u64,
    /// Type of the messages of each schema, by the schema's id.
    schemas: BTreeMap<u16, String>,
    /// Topic and type of the messages of each channel, by the channel's id.
    channels: BTreeMap<u16, [String; 2]>,
    scans: Vec<PlacelessScan>,
    odometry: Vec<LogOdometry>,
    /// Topics of the scans and of the odometry; `None` before the first message of the kind.
    topics: [Option<String>; 2],
    /// Frame whose pose the odometry gives.
    base: String,
    mounts: Mounts,
}

/// Fields of a record that are still to be read. `mcap::parse_record` is not used: it allocates the
/// length that a text claims, up to 4 GiB, before it checks it.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn bytes(&mut self, count: usize) -> McapResult<&'a [u8]> {
        let split = self.0.split_at_checked(count);
        let (bytes, rest) = split.ok_or(McapError::UnexpectedEof)?;
        self.0 = rest;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self) -> McapResult<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk().ok_or(McapError::UnexpectedEof)?;
        self.0 = rest;
        Ok(*bytes)
    }

    fn number(&mut self) -> McapResult<u16> {
        Ok(u16::from_le_bytes(self.array()?))
    }

    fn text(&mut self) -> McapResult<String> {
        let size = u32::from_le_bytes(self.array()?);
        let bytes = self.bytes(size as usize)?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }
}

impl RosBag {
    /// Reads a file, of which `most` bytes may be read, unpacked; as a rule
    /// [`MOST_BYTES`](crate::input::MOST_BYTES). If there are more, the report has
    /// [`LogTrouble::TooLarge`].
    ///
    /// # Errors
    /// If it cannot be opened, or nothing in it can be used.
    pub fn read(path: &Path, most: u64) -> Result<Self, LogError> {
        let file = input::open(path).map_err(|source| LogError::File {
            path: path.to_owned(),
            source,
        })?;
        let bag = Self::within(BufReader::new(file), most);
        match bag.entries.is_empty() {
            true => Err(bag.report.nothing(path, "no scan with odometry")),
            false => Ok(bag),
        }
    }

    /// Reads from `source` and returns the bag; unusable messages are left out and reported.
    #[must_use]
    pub fn of(source: impl Read) -> Self {
        Self::within(source, MOST_BYTES)
    }

    fn within(source: impl Read, most: u64) -> Self {
        let mut reader = Reader {
            left: most,
            ..Reader::default()
        };
        if let Err(error) = reader.take_all(source) {
            let number = reader.report.lines + 1;
            let what = error.to_string();
            reader
                .report
                .met_trouble(LogTrouble::EndsEarly, number, what);
        }
        reader.finish()
    }
}

impl Reader {
    /// Takes in all messages, up to the end or to the first that cannot be read.
    fn take_all(&mut self, mut source: impl Read) -> McapResult<()> {
        let options = LinearReaderOptions::default()
            .with_record_length_limit(LONGEST)
            .with_validate_chunk_crcs(true)
            .with_skip_end_magic(true);
        let mut reader = LinearReader::new_with_options(options);
        while let Some(event) = reader.next_event() {
            match event? {
                LinearReadEvent::ReadRequest(needed) => {
                    let read = source.read(reader.insert(needed))?;
                    reader.notify_read(read);
                }
                LinearReadEvent::Record { data, opcode } => {
                    let Some(left) = self.left.checked_sub(data.len() as u64) else {
                        let number = self.report.lines + 1;
                        self.report.met_trouble(LogTrouble::TooLarge, number, "");
                        return Ok(());
                    };
                    self.left = left;
                    self.take_record(opcode, data)?;
                }
            }
        }
        Ok(())
    }

    fn take_record(&mut self, opcode: u8, record: &[u8]) -> McapResult<()> {
        let mut fields = Fields(record);
        match opcode {
            op::SCHEMA => {
                let (id, name) = (fields.number()?, fields.text()?);
                self.schemas.insert(id, name);
            }
            op::CHANNEL => {
                let (id, schema, topic) = (fields.number()?, fields.number()?, fields.text()?);
                let kind = self.schemas.get(&schema).cloned();
                let kind = kind.unwrap_or_else(|| "no schema".to_owned());
                self.channels.insert(id, [topic, kind]);
            }
            op::MESSAGE => {
                let channel = self.channels.get(&fields.number()?).cloned();
                let [topic, kind] = channel.unwrap_or_default();
                self.report.lines += 1;
                let message = record.get(MESSAGE_HEADER..).unwrap_or_default();
                self.take(&topic, &kind, message);
            }
            _ => {}
        }
        Ok(())
    }

    fn take(&mut self, topic: &str, kind: &str, data: &[u8]) {
        let number = self.report.lines;
        let taken = match kind {
            SCAN if is_first(&mut self.topics[0], topic) => decode(data).map(|scan| {
                let topic = topic.to_owned();
                self.scans.push(PlacelessScan {
                    number,
                    topic,
                    scan,
                });
            }),
            ODOMETRY if is_first(&mut self.topics[1], topic) => {
                decode(data).map(|odometry| self.moved(number, odometry))
            }
            TRANSFORMS if topic.ends_with("tf_static") => {
                decode(data).map(|Transforms { transforms }| {
                    self.mounts.extend(transforms);
                })
            }
            _ => {
                self.report
                    .met_other_kind(&format!("{topic} ({kind})"), number);
                return;
            }
        };
        if let Err(what) = taken {
            self.report.met_trouble(LogTrouble::Cut, number, what);
        }
    }

    fn moved(&mut self, number: u64, odometry: Odometry) {
        let pose = odometry.pose();
        if !pose.is_finite() {
            let what = "a pose that is not a number";
            self.report.met_trouble(LogTrouble::NoNumber, number, what);
            return;
        }
        self.base = odometry.child_frame_id;
        self.odometry.push(LogOdometry {
            line: number,
            time: odometry.header.stamp.seconds(),
            pose,
        });
    }

    fn finish(mut self) -> RosBag {
        let timed = self.odometry.iter().map(|moved| TimedPose {
            time: moved.time,
            pose: moved.pose,
        });
        let way = Trajectory::new(timed);
        let mut entries: Vec<LogEntry> = Vec::new();
        for placeless in core::mem::take(&mut self.scans) {
            entries.extend(self.placed(placeless, &way).map(LogEntry::Scan));
        }
        self.report.odometry = self.odometry.len() as u64;
        entries.extend(self.odometry.drain(..).map(LogEntry::Odometry));
        entries.sort_by_key(|entry| match entry {
            LogEntry::Odometry(odometry) => odometry.line,
            LogEntry::Scan(scan) => scan.line,
        });
        RosBag {
            entries,
            report: self.report,
        }
    }

    /// Returns a scan with the robot's pose by odometry at that time.
    fn placed(&mut self, placeless: PlacelessScan, way: &Trajectory) -> Option<LogScan> {
        let PlacelessScan {
            number,
            topic,
            scan,
        } = placeless;
        let time = scan.header.stamp.seconds();
        let Some(odometry) = way.at(time) else {
            let what = format!("{topic} at {time:.3} s, for which there is no odometry");
            self.report
                .met_trouble(LogTrouble::NoOdometry, number, what);
            return None;
        };
        let mount = self.mounts.of(&self.base, &scan.header.frame_id);
        let robot_from_laser = mount.unwrap_or_else(|| {
            let what = format!("{topic}: {}", scan.header.frame_id);
            self.report.met_trouble(LogTrouble::NoMount, number, what);
            Pose::IDENTITY
        });
        let Some((scan, bad_ranges)) = scan.scan() else {
            let what = format!("{topic}: angles that are not numbers");
            self.report.met_trouble(LogTrouble::NoNumber, number, what);
            return None;
        };
        if bad_ranges > 0 {
            let what = format!("{bad_ranges} of {}", scan.ranges.len());
            self.report.met_trouble(LogTrouble::NoRange, number, what);
        }
        self.report.scans += 1;
        Some(LogScan {
            line: number,
            time,
            odometry,
            noted: odometry,
            robot_from_laser,
            scan,
        })
    }
}
/// Returns whether a topic is the first of its kind. Only that topic is read.
fn is_first(first: &mut Option<String>, topic: &str) -> bool {
    first.get_or_insert_with(|| topic.to_owned()) == topic
}
