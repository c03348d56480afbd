//! The agents by the names the command line has for them.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use tolman_arena::cast::Agent;

/// Who chooses the actions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brain(pub(super) Agent);

impl Brain {
    pub(super) const fn word(self) -> &'static str {
        match self.0 {
            Agent::Avoid => "avoid",
            Agent::WallFollow => "wall-follow",
            Agent::Random => "random",
            Agent::Oracle => "oracle",
            Agent::UnlocalizedOracle => "unlocalized-oracle",
        }
    }
}

impl ValueEnum for Brain {
    fn value_variants<'a>() -> &'a [Self] {
        const {
            &[
                Brain(Agent::ALL[0]),
                Brain(Agent::ALL[1]),
                Brain(Agent::ALL[2]),
                Brain(Agent::ALL[3]),
                Brain(Agent::ALL[4]),
            ]
        }
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.word()).help(self.0.description()))
    }
}
