//! Formats in which replays are written.

use anyhow::Error;
use tolman_replay::Replay;

/// A format of replays, chosen by the ending of the file's name.
#[derive(Clone, Copy, Debug)]
pub struct ReplayFormat {
    /// Ending of the file's name, without the dot.
    pub extension: &'static str,
    /// First bytes of each such file, by which an existing file of the format is recognized.
    pub magic: &'static [u8],
    /// Returns a replay as the bytes of a file.
    pub write: fn(&Replay) -> Result<Vec<u8>, Error>,
}

/// Returns the formats that the features of this build bring.
pub(crate) fn built_in() -> Vec<ReplayFormat> {
    #[cfg(feature = "mcap")]
    let formats = vec![ReplayFormat {
        extension: "mcap",
        magic: b"\x89MCAP0\r\n",
        write: |replay| Ok(tolman_replay::mcap(replay)?),
    }];
    #[cfg(not(feature = "mcap"))]
    let formats = Vec::new();
    formats
}
