use crate::input::MOST_BYTES;

/// What is read of a log.
///
/// ```
/// use tolman_formats::LogOptions;
/// let mut options = LogOptions::whole();
/// options.scan_topics.push("/front/scan".to_owned());
/// assert_eq!(options.odom_topic, None);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LogOptions {
    /// Maximum number of bytes of text or of messages that are kept.
    pub most: u64,
    /// Topics of a bag whose scans are used, all together; the one whose beams met most if empty.
    pub scan_topics: Vec<String>,
    /// Topic of a bag whose odometry is used, or `/tf`; the one that moves during most scans if
    /// `None`.
    pub odom_topic: Option<String>,
    /// Times of the messages; those of the headers if `None`, as long as these can be used.
    pub times: Option<LogTimes>,
}

/// Times of a bag's messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogTimes {
    /// Times in the messages' headers.
    Header,
    /// Times at which the messages were received.
    Receipt,
}

impl LogOptions {
    /// Returns the options with which a log of at most 256 MiB is read, and the topics chosen by
    /// what they hold.
    #[must_use]
    pub const fn whole() -> Self {
        Self {
            most: MOST_BYTES,
            scan_topics: Vec::new(),
            odom_topic: None,
            times: None,
        }
    }
}
