use super::alignment::Alignment;
use super::mapper::Comparison;
use super::pattern::Dictionary;
use super::scores::Scores;
use super::similarity::{FragmentMatching, Similarity};

/// Parameters of a [`CpMapper`](super::CpMapper).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct CpMapperConfig {
    /// Moments at which the map is optimized.
    pub mapping: Mapping,
    /// Method of comparing fragments.
    pub matching: FragmentMatching,
    /// Fragments of the map that a new one is compared with.
    pub candidates: Candidates,
}

/// Fragments of the map that a new one is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Candidates {
    /// Each.
    All,
    /// Only this number of fragments: those that share the most patterns with the new one, rare
    /// patterns counting more (tf-idf, section 8). Smaller maps compare all.
    Best(u32),
}

/// Moments at which the map is optimized and looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Mapping {
    /// *Offline CPM*: the robot takes ports at random and keeps all fragments that it walked; the
    /// map is optimized once the goal is found.
    Offline {
        /// Number of fragments without the goal after which the mapper switches to *online*, so
        /// that no loop holds the robot forever. `u32::MAX` never switches, like the paper's robot,
        /// which "might be locked in infinite loops of duplicated path-fragments".
        patience: u32,
    },
    /// *Online CPM*, section 6: the map is optimized, and looked at, before each decision.
    Online,
    /// Online, also for mazes with fragments that look alike or symmetrical, which the paper
    /// excludes. Keeps several maps, each an explanation of all observations, and returns the
    /// likeliest. Ours, after the lazily searched trees of topological maps (Johnson, Kuipers
    /// 2012).
    ///
    /// Bounds of dead reckoning tell similar fragments apart and close loops on arrival. Without
    /// dead reckoning only the neighbours of fragments tell them apart.
    Hypotheses {
        /// Maximum number of maps kept, at least 1.
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

    /// Returns online CPM of section 6: positions compared with μ = 0.9.
    #[must_use]
    pub const fn online() -> Self {
        Self {
            mapping: Mapping::Online,
            matching: FragmentMatching::Positions(Similarity::paper()),
            candidates: Candidates::All,
        }
    }

    /// Returns our best configuration: alignment and hypotheses.
    #[must_use]
    pub const fn robust() -> Self {
        Self {
            mapping: Mapping::Hypotheses { width: 16 },
            matching: FragmentMatching::Alignment(Alignment::tuned()),
            candidates: Candidates::Best(64),
        }
    }

    /// Returns offline CPM of section 4, with everything else as in [`online`](Self::online).
    #[must_use]
    pub const fn offline() -> Self {
        Self {
            mapping: Mapping::Offline { patience: u32::MAX },
            ..Self::online()
        }
    }
}
