//! Values that are made once and kept, because several runs need them.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Returns the value in a cell. The first caller makes it; if two threads make it at once, they
/// make the same.
pub(crate) fn once<T, E>(cell: &OnceLock<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(made) = cell.get() {
        return Ok(made);
    }
    let made = make()?;
    Ok(cell.get_or_init(|| made))
}

/// Values by key.
#[derive(Debug)]
pub(crate) struct Kept<K, V>(Mutex<BTreeMap<K, Shared<V>>>);

/// A value that the first caller makes while the others wait.
type Shared<V> = Arc<Mutex<Option<Arc<V>>>>;

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Ord, V> Kept<K, V> {
    /// Returns the value of a key. The first caller makes it.
    pub(crate) fn get<E>(&self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<Arc<V>, E> {
        let shared = {
            let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(kept.entry(key).or_default())
        };
        let mut made = shared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(value) = &*made {
            return Ok(Arc::clone(value));
        }
        let value = Arc::new(make()?);
        *made = Some(Arc::clone(&value));
        Ok(value)
    }
}
