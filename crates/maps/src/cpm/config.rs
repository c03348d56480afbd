use super::alignment::Alignment;
use super::mapper::Comparison;
use super::pattern::Dictionary;
use super::scores::Scores;
use super::similarity::{FragmentMatching, Similarity};

/// How a [`CpMapper`](super::CpMapper) maps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CpMapperConfig {
    /// When the map is optimized.
    pub mapping: Mapping,
    /// How fragments are compared.
    pub matching: FragmentMatching,
    /// Which fragments are compared.
    pub candidates: Candidates,
}

/// Which fragments of the map a new one is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Candidates {
    /// Each.
    All,
    /// The number of fragments compared: those that have the most patterns in common with it,
    /// counted the more the rarer they are (tf-idf, section 8); on smaller maps that is each.
    Best(u32),
}

/// When the map is optimized and looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Mapping {
    /// *Offline CPM*: the robot takes ports at random and keeps all it has walked; the map is
    /// optimized once the goal is found.
    Offline {
        /// Number of fragments without the goal after which it goes on *online*, so that no loop
        /// can hold it forever; with `u32::MAX` it does as the paper, whose robot "might be locked
        /// in infinite loops of duplicated path-fragments".
        patience: u32,
    },
    /// *Online CPM*, section 6: the map is optimized, and looked at, before each decision.
    Online,
    /// Online, and for mazes with fragments that look alike or symmetrical, which the paper
    /// excludes: several maps are kept, each one way to understand all that was met, and the most
    /// likely of them is looked at. Ours, in the manner of the lazily searched trees of topological
    /// maps (Johnson, Kuipers 2012).
    ///
    /// Bounds of dead reckoning tell alike fragments apart and close loops on arrival; without
    /// them, fragments are told apart by their neighbours alone.
    Hypotheses {
        /// How many maps are kept at most, at least 1.
        width: u32,
    },
}

impl Mapping {
    /// Returns whether a robot that has walked `traversals` fragments looks at its map.
    pub(super) const fn looks_at_map(self, traversals: u32) -> bool {
        match self {
            Self::Offline { patience } => traversals >= patience,
            Self::Online | Self::Hypotheses { .. } => true,
        }
    }
}

impl CpMapperConfig {
    pub(super) fn comparison<'a>(&'a self, dictionary: &'a Dictionary) -> Comparison<'a> {
        Comparison {
            matching: &self.matching,
            candidates: self.candidates,
            dictionary,
            scores: Scores::default(),
        }
    }

    /// Section 6, online CPM: positions compared with μ = 0.9.
    #[must_use]
    pub const fn online() -> Self {
        Self {
            mapping: Mapping::Online,
            matching: FragmentMatching::Positions(Similarity::paper()),
            candidates: Candidates::All,
        }
    }

    /// Returns all that we know better than the paper: alignment, hypotheses.
    #[must_use]
    pub const fn robust() -> Self {
        Self {
            mapping: Mapping::Hypotheses { width: 16 },
            matching: FragmentMatching::Alignment(Alignment::tuned()),
            candidates: Candidates::Best(64),
        }
    }

    /// Section 4, offline CPM; the rest as [`online`](Self::online).
    #[must_use]
    pub const fn offline() -> Self {
        Self {
            mapping: Mapping::Offline { patience: u32::MAX },
            ..Self::online()
        }
    }
}
