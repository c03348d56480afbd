// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use thiserror::Error;

use super::{Config, Journal, JournalError, Observer};

/// Contents of an observer's file: the journal, from which everything follows bit for bit. Works
/// with any format of serde's.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MapFile {
    config: Config,
    /// Number of moves in the journal; a truncated journal has fewer.
    moves: usize,
    journal: Journal,
}

/// Reason why a file holds no diktiometry.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MapFileError {
    /// The observer kept no journal.
    #[error("no journal was kept; set `journal` of the configuration to `All`")]
    NoJournal,
    /// Moves are missing.
    #[error("the journal is cut off: it has {found} of {expected} moves; copy the file again")]
    Truncated {
        /// Number of moves that the file promises.
        expected: usize,
        /// Number found.
        found: usize,
    },
    /// The journal cannot be replayed.
    #[error("the journal does not fit the configuration; learn the map again")]
    Replay(#[from] JournalError),
}

impl MapFile {
    /// Returns the saved form of an observer.
    ///
    /// # Errors
    /// [`MapFileError::NoJournal`] if it kept none.
    pub fn of(observer: &Observer) -> Result<Self, MapFileError> {
        let journal = observer.journal().ok_or(MapFileError::NoJournal)?;
        Ok(Self {
            config: observer.config().clone(),
            moves: journal.moves.len(),
            journal: journal.clone(),
        })
    }

    /// Returns the observer as it was saved. O(moves).
    ///
    /// # Errors
    /// [`MapFileError`] if the journal was cut off, or does not fit the configuration.
    pub fn observer(&self) -> Result<Observer, MapFileError> {
        let found = self.journal.moves.len();
        if found != self.moves {
            return Err(MapFileError::Truncated {
                expected: self.moves,
                found,
            });
        }
        Ok(Observer::replay(self.config.clone(), &self.journal)?)
    }
}
