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
        /// Id of the inserted unit.
        id: UnitId,
        /// Units between which the unit was inserted; `None` for a unit made of an input.
        between: Option<(UnitId, UnitId)>,
    },
    /// A unit was removed. Its edges were removed just before.
    Removed {
        /// Id of the removed unit.
        id: UnitId,
    },
    /// A unit was merged into another. Its edges were removed or taken over just before.
    Merged {
        /// Id of the removed unit.
        gone: UnitId,
        /// Unit that now stands for both.
        into: UnitId,
    },
    /// An edge was added. (Renewing one is not an event.)
    Linked(UnitId, UnitId),
    /// An edge was removed.
    Unlinked(UnitId, UnitId),
}

/// Log of a network's events, recorded from the first call of [`listen`](Self::listen) on.
#[derive(Clone, Debug, Default)]
pub struct Events {
    listening: bool,
    kept: Vec<Event>,
}

impl Events {
    /// Records events from now on. Before the first call, none are kept and nothing is allocated.
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
