use serde::{Deserialize, Serialize};

use super::config::CpmConfig;
use super::mode::Mode;

/// The ways of mapping that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// The paper's, online.
    Faithful,
    /// Ours: with dead reckoning, for fragments that look alike too.
    Better,
    /// The same without a learning maze.
    Unlearned,
}

impl Preset {
    /// How it maps.
    #[must_use]
    pub const fn mode(self) -> Mode {
        match self {
            Self::Faithful => Mode::Paper(CpmConfig::online()),
            Self::Better => Mode::Reckoned(CpmConfig::robust()),
            Self::Unlearned => Mode::Unlearned(CpmConfig::robust()),
        }
    }
}
