//! Records the changes of the graph, for structures that depend on it.

use alloc::vec::Vec;

use crate::UnitId;

/// A change of the graph. Replayed in order onto an empty graph, the events since the network was
/// empty give the network's graph; the motion of units is not recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Event {
    /// A unit was inserted, without edges so far.
    Inserted {
        /// The unit.
        id: UnitId,
        /// Units between which it was put; `None` if it was made of an input.
        between: Option<(UnitId, UnitId)>,
    },
    /// A unit went. Its edges went just before.
    Removed {
        /// The unit.
        id: UnitId,
    },
    /// A unit became part of another. Its edges were taken away or taken over just before.
    Merged {
        /// The removed unit.
        gone: UnitId,
        /// The unit that stands for both.
        into: UnitId,
    },
    /// An edge was added. (Renewing one is not an event.)
    Linked(UnitId, UnitId),
    /// An edge went.
    Unlinked(UnitId, UnitId),
}

/// The events of a network, recorded from the moment that they are asked for.
#[derive(Clone, Debug, Default)]
pub struct Events {
    listening: bool,
    kept: Vec<Event>,
}

impl Events {
    /// Keeps events from now on. Without it, none are kept and nothing is allocated.
    pub fn listen(&mut self) {
        self.listening = true;
    }

    /// Returns the events since [`listen`](Self::listen) or the last call, oldest first.
    pub fn drain(&mut self) -> impl ExactSizeIterator<Item = Event> + '_ {
        self.kept.drain(..)
    }

    #[inline]
    pub(crate) fn push(&mut self, event: Event) {
        if self.listening {
            self.kept.push(event);
        }
    }
}
