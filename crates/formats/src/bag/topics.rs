use alloc::collections::BTreeMap;

use super::frames::Frames;
use super::message::{Cut, Fields, Header, Kind, LaserScan, Message, Odometry, Times};
use crate::log::KindCount;

/// What a topic of a bag, or a kind of line of another log, holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogTopic {
    /// Name of the topic, or first word of the lines.
    pub name: String,
    /// Type of the messages; empty for lines.
    pub kind: String,
    /// Number of messages.
    pub count: u64,
    /// Messages a second, from the first to the last received; `None` if they have no times.
    pub rate_hz: Option<f64>,
    /// Frames of the messages: of a scan the laser's, of odometry the robot's in that of the world.
    pub frame: String,
    /// Number of the first message or line, from 1.
    pub first: u64,
    /// Times of the first and last message, s.
    times: Option<(f64, f64)>,
}

impl LogTopic {
    /// Returns a kind of line.
    pub(crate) fn of_lines(kind: &str, met: KindCount) -> Self {
        Self {
            name: kind.to_owned(),
            count: met.count,
            first: met.first_line,
            ..Self::default()
        }
    }
}

/// A message that was kept, with its number in the bag.
pub(super) struct Kept<T> {
    pub(super) number: u64,
    pub(super) times: Times,
    pub(super) message: T,
}

/// What was kept of the messages of all topics.
#[derive(Default)]
pub(super) struct Topics {
    counted: BTreeMap<String, LogTopic>,
    pub(super) scans: BTreeMap<String, Vec<Kept<LaserScan>>>,
    pub(super) odometry: BTreeMap<String, Vec<Kept<Odometry>>>,
    pub(super) frames: Frames,
}

impl Topics {
    /// Takes in a message, and returns whether it is kept.
    pub(super) fn take(&mut self, number: u64, message: &Message<'_>) -> Result<bool, Cut> {
        let new = || LogTopic {
            name: message.topic.to_owned(),
            kind: message.kind.to_owned(),
            first: number,
            ..LogTopic::default()
        };
        let counted = self.counted.entry(message.topic.to_owned());
        let counted = counted.or_insert_with(new);
        let received = message.received;
        counted.count += 1;
        counted.times = Some((counted.times.map_or(received, |times| times.0), received));
        let Some(kind) = Kind::of(message.kind) else {
            return Ok(false);
        };
        let mut fields = Fields::of(message)?;
        let times = |header: &Header| Times {
            header: header.time,
            received,
        };
        let topic = message.topic.to_owned();
        match kind {
            Kind::LaserScan | Kind::MultiEchoLaserScan => {
                let scan = fields.scan(kind)?;
                counted.frame.clone_from(&scan.header.frame);
                self.scans.entry(topic).or_default().push(Kept {
                    number,
                    times: times(&scan.header),
                    message: scan,
                });
            }
            Kind::Odometry => {
                let odometry = fields.odometry()?;
                let Odometry { header, child, .. } = &odometry;
                counted.frame = format!("{child} in {}", header.frame);
                self.odometry.entry(topic).or_default().push(Kept {
                    number,
                    times: times(header),
                    message: odometry,
                });
            }
            Kind::Transforms => {
                for transform in fields.transforms()? {
                    self.frames.add(transform, received);
                }
            }
        }
        Ok(true)
    }

    /// Returns what each topic holds, by name.
    pub(super) fn list(&self) -> Vec<LogTopic> {
        let topics = self.counted.values().cloned().map(|mut topic| {
            let (first, last) = topic.times.unwrap_or_default();
            let is_timed = topic.count > 1 && last > first;
            topic.rate_hz = is_timed.then(|| (topic.count - 1) as f64 / (last - first));
            topic
        });
        topics.collect()
    }
}
