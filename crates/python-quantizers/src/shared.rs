//! A quantizer that one thread teaches while others read it.

use std::sync::{Mutex, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// A lock in which nobody waits longer than for the piece of work under way.
///
/// A writer that asks again at once would keep readers out of a plain lock. Here each has to hold
/// `turn` while it waits, so a writer between two pieces comes after a reader that is waiting.
pub(crate) struct Shared<T> {
    turn: Mutex<()>,
    value: RwLock<T>,
}

impl<T> Shared<T> {
    pub(crate) const fn new(value: T) -> Self {
        Self {
            turn: Mutex::new(()),
            value: RwLock::new(value),
        }
    }

    /// Waits until the value can be read.
    pub(crate) fn read(&self) -> RwLockReadGuard<'_, T> {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.value.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the value can be changed.
    pub(crate) fn write(&self) -> RwLockWriteGuard<'_, T> {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.value.write().unwrap_or_else(PoisonError::into_inner)
    }
}
