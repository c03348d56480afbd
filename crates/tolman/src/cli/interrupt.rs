//! Ctrl-C, and what else asks a program to end.

use alloc::sync::Arc;
use core::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

use super::Failure;

/// The exit code by which shells know a program that Ctrl-C ended.
pub(super) const INTERRUPTED: u8 = 130;

/// Returns a flag that the first Ctrl-C raises, as `kill` does; the second ends the program, and so
/// does the first when the flag is up already.
pub(super) fn flag() -> Result<Arc<AtomicBool>, Failure> {
    let asked = Arc::new(AtomicBool::new(false));
    for (signal, code) in [(SIGINT, INTERRUPTED), (SIGTERM, 143)] {
        // In this order: a signal must not find the flag that it raises itself.
        register_conditional_shutdown(signal, code.into(), Arc::clone(&asked))?;
        register(signal, Arc::clone(&asked))?;
    }
    Ok(asked)
}
