//! The journal: what the robot told, so that all that followed from it can be undone and done again.

use alloc::vec::Vec;

use thiserror::Error;

use super::config::{Config, JournalLength};
use super::error::{StartError, StepError};
use super::ids::PlaceId;
use super::observation::{Move, Start};
use super::observer::Observer;

/// Moves between two checkpoints.
const STRIDE: usize = 64;
/// Checkpoints kept, the newest.
const CHECKPOINTS: usize = 8;

/// All that an observer was told, in order. What it decided follows from that, to the bit: to replay the journal is to decide
/// again.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Journal {
    /// How it began.
    pub start: Start,
    /// The moves.
    pub moves: Vec<Move>,
    /// Pairs of places that were told to be different.
    pub distinctions: Vec<Distinction>,
}

/// Somebody knows that two places are different, whatever the restructurers propose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Distinction {
    /// One place.
    pub one: PlaceId,
    /// The other.
    pub other: PlaceId,
}

/// The journal and some states on the way.
#[derive(Clone, Debug)]
pub(super) struct Recorder {
    pub(super) journal: Journal,
    /// The observer after some of the moves, without its recorder.
    checkpoints: Vec<Observer>,
}

/// Two recorders are alike if they were told the same.
impl PartialEq for Recorder {
    fn eq(&self, other: &Self) -> bool {
        self.journal == other.journal
    }
}

/// Why nothing was undone. The observer is as it was before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UndoError {
    /// The journal is off.
    #[error("no journal is kept; set `journal` of the configuration to `All`")]
    NoJournal,
    /// There are not that many moves.
    #[error("{asked} moves cannot be undone, there are only {moves}")]
    TooFar {
        /// How many were to be undone.
        asked: u64,
        /// How many there are.
        moves: u64,
    },
    /// One of the places was never made.
    #[error("there is no place {}", .0.0)]
    NoSuchPlace(PlaceId),
}

/// Why a journal cannot be replayed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// There is no observer to begin with.
    #[error("the journal's beginning fits no observer")]
    Start(#[from] StartError),
    /// A move is none.
    #[error("move {number} of the journal is none")]
    Move {
        /// Which, from 1.
        number: usize,
        /// Why.
        source: StepError,
    },
}

impl Recorder {
    pub(super) fn new(config: &Config, start: &Start) -> Option<Self> {
        (config.journal == JournalLength::All).then(|| Self {
            journal: Journal {
                start: start.clone(),
                moves: Vec::new(),
                distinctions: Vec::new(),
            },
            checkpoints: Vec::new(),
        })
    }
}

impl Observer {
    /// What the observer was told so far; none if no journal is kept.
    #[must_use]
    pub fn journal(&self) -> Option<&Journal> {
        self.recorder.as_ref().map(|recorder| &recorder.journal)
    }

    /// An observer that was told all that a journal holds. O(moves).
    ///
    /// # Errors
    /// [`ReplayError`] if the journal does not fit the configuration.
    pub fn replay(config: Config, journal: &Journal) -> Result<Self, ReplayError> {
        let mut observer = Self::new(config, journal.start.clone())?;
        observer.distinguish(&journal.distinctions);
        for (number, step) in (1..).zip(&journal.moves) {
            let source = observer.step(step).err();
            if let Some(source) = source {
                return Err(ReplayError::Move { number, source });
            }
        }
        Ok(observer)
    }

    /// Takes the last moves back: everything is as it was before them, to the bit. O(moves since the last checkpoint before),
    /// where checkpoints are some dozens of moves apart and the newest few are kept.
    ///
    /// # Errors
    /// [`UndoError`] if no journal is kept or it has not that many moves.
    pub fn undo(&mut self, moves: u64) -> Result<(), UndoError> {
        let recorder = self.recorder.as_ref().ok_or(UndoError::NoJournal)?;
        let length = recorder.journal.moves.len() as u64;
        let Some(left) = length.checked_sub(moves) else {
            return Err(UndoError::TooFar {
                asked: moves,
                moves: length,
            });
        };
        self.rebuild(left as usize);
        Ok(())
    }

    /// Takes back that two places were taken for one: all moves are gone through again, with the knowledge that the two are different.
    /// Of `merged` in a [`Restructured::Merged`](super::Restructured::Merged) this is the undoing of that one decision.
    /// Places made later may get other ids. O(moves).
    ///
    /// # Errors
    /// [`UndoError`] if no journal is kept or a place was never made.
    pub fn tell_apart(&mut self, one: PlaceId, other: PlaceId) -> Result<(), UndoError> {
        for place in [one, other] {
            if self.map().paths.place(place).is_none() {
                return Err(UndoError::NoSuchPlace(place));
            }
        }
        let recorder = self.recorder.as_mut().ok_or(UndoError::NoJournal)?;
        recorder
            .journal
            .distinctions
            .push(Distinction { one, other });
        recorder.checkpoints.clear();
        let moves = recorder.journal.moves.len();
        self.rebuild(moves);
        Ok(())
    }

    /// Goes back to after the first `moves` moves of the journal.
    fn rebuild(&mut self, moves: usize) {
        let Some(mut recorder) = self.recorder.take() else {
            return;
        };
        let after = |checkpoint: &Self| checkpoint.moves() as usize;
        recorder.checkpoints.retain(|one| after(one) <= moves);
        recorder.journal.moves.truncate(moves);
        let checkpoint = recorder.checkpoints.last().cloned();
        let begin = || {
            let first = Self::new(self.config().clone(), recorder.journal.start.clone());
            first.map(|mut first| {
                first.recorder = None;
                first.distinguish(&recorder.journal.distinctions);
                first
            })
        };
        // What was taken in once is taken in again.
        let Some(mut past) = checkpoint.or_else(|| begin().ok()) else {
            self.recorder = Some(recorder);
            return;
        };
        for step in recorder.journal.moves.iter().skip(after(&past)) {
            let _ = past.step(step);
        }
        *self = past;
        self.recorder = Some(recorder);
    }

    /// Notes a move that was taken in.
    pub(super) fn record(&mut self, step: &Move) {
        let Some(mut recorder) = self.recorder.take() else {
            return;
        };
        recorder.journal.moves.push(step.clone());
        if recorder.journal.moves.len().is_multiple_of(STRIDE) {
            recorder.checkpoints.push(self.clone());
            let surplus = recorder.checkpoints.len().saturating_sub(CHECKPOINTS);
            recorder.checkpoints.drain(..surplus);
        }
        self.recorder = Some(recorder);
    }
}
