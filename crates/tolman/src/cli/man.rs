//! `tolman man`: the manual page.

use std::io::Write;

use clap::CommandFactory;

use super::Failure;

pub(super) fn carry_out(out: &mut dyn Write) -> Result<(), Failure> {
    Ok(clap_mangen::Man::new(super::Arguments::command()).render(out)?)
}
