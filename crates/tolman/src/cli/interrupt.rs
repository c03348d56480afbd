//! Ctrl-C and other signals that ask a program to end.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicBool, Ordering};
use std::io;
use std::sync::OnceLock;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

use super::Result;

/// Exit code that shells expect of a program ended by Ctrl-C.
pub(super) const INTERRUPTED: u8 = 130;

/// The signals, and the exit codes of a program that they end.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, INTERRUPTED), (SIGTERM, 143)];

/// Whether a signal ends the program, because no verb waits for one.
static ENDS: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Lets a signal end the program with its exit code, until a verb asks for a [`flag`].
///
/// # Errors
/// If the system refuses.
pub(super) fn ends_the_program() -> io::Result<()> {
    let ends = ENDS.get_or_init(|| Arc::new(AtomicBool::new(true)));
    for (signal, code) in SIGNALS {
        register_conditional_shutdown(signal, code.into(), Arc::clone(ends))?;
    }
    Ok(())
}

/// Returns a flag that the first Ctrl-C, or the first `kill`, raises.
///
/// The second one ends the program. So does the first if the flag is already raised.
pub(super) fn flag() -> Result<Arc<AtomicBool>> {
    if let Some(ends) = ENDS.get() {
        ends.store(false, Ordering::SeqCst);
    }
    let asked = Arc::new(AtomicBool::new(false));
    for (signal, code) in SIGNALS {
        // The order matters: a signal must not see the flag that it raises itself.
        register_conditional_shutdown(signal, code.into(), Arc::clone(&asked))?;
        register(signal, Arc::clone(&asked))?;
    }
    Ok(asked)
}
