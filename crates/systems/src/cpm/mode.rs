use super::config::CpmConfig;
use super::walker_config::HeadingBy;

/// Mode in which a robot maps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// The paper's mode, without dead reckoning.
    Paper(CpmConfig),
    /// Uses dead reckoning.
    Reckoned(CpmConfig),
    /// Uses dead reckoning, and only patterns learned on the way.
    Unlearned(CpmConfig),
}

/// Distance from all patterns beyond which an observation becomes a new pattern.
const NOVELTY: f64 = 30.0;

impl Mode {
    /// Returns the configuration of mapping and deciding.
    #[must_use]
    pub const fn config(self) -> CpmConfig {
        match self {
            Self::Paper(config) | Self::Reckoned(config) | Self::Unlearned(config) => config,
        }
    }

    /// Returns the same mode with another `config`.
    #[must_use]
    pub const fn with(self, config: CpmConfig) -> Self {
        match self {
            Self::Paper(_) => Self::Paper(config),
            Self::Reckoned(_) => Self::Reckoned(config),
            Self::Unlearned(_) => Self::Unlearned(config),
        }
    }

    /// Returns the source of dead reckoning's headings.
    #[must_use]
    pub const fn heading(self) -> HeadingBy {
        match self {
            Self::Paper(_) => HeadingBy::Encoders,
            Self::Reckoned(_) | Self::Unlearned(_) => HeadingBy::Walls,
        }
    }

    /// Returns the distance from all patterns beyond which an observation becomes a new pattern;
    /// `None` if no more are learned.
    #[must_use]
    pub const fn novelty(self) -> Option<f64> {
        match self {
            Self::Unlearned(_) => Some(NOVELTY),
            Self::Paper(_) | Self::Reckoned(_) => None,
        }
    }
}
