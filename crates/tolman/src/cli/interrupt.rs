//! Ctrl-C.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicBool, Ordering};

use super::Failure;

/// The exit code by which shells know a program that Ctrl-C ended.
pub(super) const INTERRUPTED: i32 = 130;

/// A flag that the first Ctrl-C raises; the second ends the program, and so does the first when the flag
/// is up already.
pub(super) fn flag() -> Result<Arc<AtomicBool>, Failure> {
    let asked = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&asked);
    ctrlc::set_handler(move || {
        if asked.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    })?;
    Ok(flag)
}
