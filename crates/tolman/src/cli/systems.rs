//! `tolman systems`: lists the systems.

use std::io::Write;

use super::{App, Failure};
use crate::system::slug;

/// Lists the systems, with their presets and their robots
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman systems")]
pub(super) struct Arguments;

pub(super) fn carry_out(app: &App<'_>, out: &mut dyn Write) -> Result<(), Failure> {
    for system in &app.catalogue.systems {
        writeln!(out, "{}: {}", system.name(), system.about())?;
        for (name, about) in system.presets() {
            writeln!(out, "    --preset {name:<12} {about}")?;
        }
        for robot in system.robots() {
            writeln!(out, "    --robot {}", slug(robot))?;
        }
    }
    Ok(())
}
