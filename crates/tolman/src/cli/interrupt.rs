//! Ctrl-C and other signals that ask a program to end.

use alloc::sync::Arc;
use core::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

use super::Result;

/// Exit code that shells expect of a program ended by Ctrl-C.
pub(super) const INTERRUPTED: u8 = 130;

/// Returns a flag that the first Ctrl-C, or the first `kill`, raises.
///
/// The second one ends the program. So does the first if the flag is already raised.
pub(super) fn flag() -> Result<Arc<AtomicBool>> {
    let asked = Arc::new(AtomicBool::new(false));
    for (signal, code) in [(SIGINT, INTERRUPTED), (SIGTERM, 143)] {
        // The order matters: a signal must not see the flag that it raises itself.
        register_conditional_shutdown(signal, code.into(), Arc::clone(&asked))?;
        register(signal, Arc::clone(&asked))?;
    }
    Ok(asked)
}
