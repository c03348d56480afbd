//! `--caster`: the ray caster of all simulated worlds.

use tolman_sim::casters::CasterChoice;

use super::words::words;
use super::{OrBadInput, Result};

#[derive(clap::Args)]
pub(super) struct Caster {
    /// Ray caster of simulated worlds. They agree to 10⁻⁹ m, so results match and bits may differ
    #[arg(long, global = true, value_name = "NAME", default_value = CasterChoice::BuiltIn.name(), value_parser = words(CASTERS))]
    caster: CasterChoice,
}

/// Values of `--caster`.
const CASTERS: [(&str, &str, CasterChoice); 2] = [
    (
        CasterChoice::BuiltIn.name(),
        "From grid line to grid line in mazes, by a depth buffer elsewhere",
        CasterChoice::BuiltIn,
    ),
    (
        CasterChoice::Parry2d.name(),
        "By parry2d's bounding volume hierarchy, which is slower",
        CasterChoice::Parry2d,
    ),
];

impl Caster {
    /// Makes it the caster of all worlds. The usual one leaves the choice to results that are
    /// merged, which say what they were made with.
    pub(super) fn install(&self) -> Result {
        match self.caster {
            CasterChoice::BuiltIn => Ok(()),
            other => other.install().or_bad_input(),
        }
    }
}

/// Returns the name of the ray caster, if it is not the usual one.
pub(super) fn unusual() -> Option<&'static str> {
    let chosen = CasterChoice::current();
    (chosen != CasterChoice::default()).then_some(chosen.name())
}
