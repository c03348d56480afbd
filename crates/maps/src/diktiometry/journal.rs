//! Keeps the journal: all input of the observer, so that its consequences can be undone and
//! repeated.

use alloc::vec::Vec;

use thiserror::Error;

use super::{
    Config, FirstPlace, JournalLength, ObservedMove, ObservedMoveError, Observer, PlaceId,
    StartError,
};

/// All input of an observer, in order. Replaying it repeats all decisions bit for bit.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Journal {
    /// The first place.
    pub start: FirstPlace,
    /// Moves, in order.
    pub moves: Vec<ObservedMove>,
    /// Pairs of places that are known to be different.
    pub distinctions: Vec<Distinction>,
}

/// Two places known to be different, whatever the restructurers propose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Distinction {
    /// One place.
    pub one: PlaceId,
    /// The other place.
    pub other: PlaceId,
}

/// Reason why nothing was undone. The observer is as it was before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UndoError {
    /// The observer keeps no journal.
    #[error("no journal is kept; set `journal` of the configuration to `All`")]
    NoJournal,
    /// The journal has fewer moves.
    #[error("{asked} moves cannot be undone; the journal has only {moves}; undo fewer")]
    TooFar {
        /// Number of moves that should be undone.
        asked: u64,
        /// Number of moves in the journal.
        moves: u64,
    },
    /// One of the places was never made.
    #[error("there is no place {}; name one of the map", .0.0)]
    NoSuchPlace(PlaceId),
}

/// Reason why a journal cannot be replayed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum JournalError {
    /// The observer cannot be made.
    #[error("the journal's first view does not fit its configuration; learn the map again")]
    Start(#[from] StartError),
    /// A move is invalid.
    #[error("move {number} of the journal is refused; learn the map again")]
    Move {
        /// Number of the move, from 1.
        number: usize,
        /// The underlying error.
        source: ObservedMoveError,
    },
}

impl Observer {
    /// Returns all input so far, or `None` if no journal is kept.
    #[must_use]
    pub fn journal(&self) -> Option<&Journal> {
        (self.config.journal == JournalLength::All).then_some(&self.journal)
    }

    /// Returns an observer with all input of a journal. O(moves).
    ///
    /// # Errors
    /// [`JournalError`] if the journal does not fit the configuration.
    pub fn replay(config: Config, journal: &Journal) -> Result<Self, JournalError> {
        let mut observer = Self::new(config, journal.start.clone())?;
        observer.journal.distinctions = journal.distinctions.clone();
        for (number, step) in (1..).zip(&journal.moves) {
            let told = observer.step(step);
            told.map_err(|source| JournalError::Move { number, source })?;
        }
        Ok(observer)
    }

    /// Undoes the last moves: everything is as it was before them, bit for bit. O(moves), since the
    /// earlier ones are replayed.
    ///
    /// # Errors
    /// [`UndoError`] if no journal is kept or it does not have that many moves.
    pub fn undo(&mut self, moves: u64) -> Result<(), UndoError> {
        let mut journal = self.journal().ok_or(UndoError::NoJournal)?.clone();
        let length = journal.moves.len() as u64;
        let Some(left) = length.checked_sub(moves) else {
            return Err(UndoError::TooFar {
                asked: moves,
                moves: length,
            });
        };
        journal.moves.truncate(left as usize);
        self.rebuild(&journal);
        Ok(())
    }

    /// Undoes the merge of two places: replays all moves, knowing that the two are different. For
    /// `merged` of a [`Restructured::Merged`](super::Restructured::Merged) it undoes that one
    /// decision. Places made later may get other ids. O(moves).
    ///
    /// # Errors
    /// [`UndoError`] if no journal is kept or a place was never made.
    pub fn tell_apart(&mut self, one: PlaceId, other: PlaceId) -> Result<(), UndoError> {
        let paths = &self.map().paths;
        let mut places = [one, other].into_iter();
        if let Some(place) = places.find(|place| paths.place(*place).is_none()) {
            return Err(UndoError::NoSuchPlace(place));
        }
        let mut journal = self.journal().ok_or(UndoError::NoJournal)?.clone();
        journal.distinctions.push(Distinction { one, other });
        self.rebuild(&journal);
        Ok(())
    }

    fn rebuild(&mut self, journal: &Journal) {
        // What was taken in once is taken in again.
        if let Ok(past) = Self::replay(self.config.clone(), journal) {
            *self = past;
        }
    }
}
