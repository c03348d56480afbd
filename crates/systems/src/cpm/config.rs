use tolman_maps::cpm::{Candidates, CpMapperConfig, FragmentMatching, Mapping};

/// Parameters by which CPM maps and decides.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct CpmConfig {
    /// Moments at which the map is compared with a new fragment.
    pub mapping: Mapping,
    /// Method of comparing fragments.
    pub matching: FragmentMatching,
    /// Fragments with which a new one is compared.
    pub candidates: Candidates,
    /// Choice at a junction without unknown ports.
    pub onward: Onward,
    /// Maximum number of fragments walked before the explorer gives up. A robot that recognizes
    /// nothing would explore forever: its map grows with each fragment.
    pub most_traversals: u32,
    /// Number of walks along each fragment since the map last changed, after which a robot that
    /// [checks](super::Aim::Check) its map declares it right. A wrong map shows when it is walked
    /// again. 0 in the paper.
    #[serde(default)]
    pub checks: u32,
    /// Whether a robot begins another map, or localizes on the one it was given, when its sensors
    /// say that it was moved between two fragments. `false` in the paper.
    #[serde(default)]
    pub heeds_lifts: bool,
}

/// Choice of an online robot at a junction that "has no unknown ports left".
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Onward {
    /// The shortest known way to a junction that has one. Theorem 1 needs no more.
    ShortestKnownWay,
    /// A random port, taking the paper literally: "It continues forward until reaching a junction
    /// that has some remaining unknown ports". This can go round in circles and breaks the proof of
    /// Theorem 1.
    GoOn,
}

impl CpmConfig {
    /// Returns the configuration of the mapper.
    #[must_use]
    pub const fn mapper(&self) -> CpMapperConfig {
        let mut config = CpMapperConfig::online();
        config.mapping = self.mapping;
        config.matching = self.matching;
        config.candidates = self.candidates;
        config
    }

    /// Returns the online CPM of section 6: [`CpMapperConfig::online`]. It gives up after 1000
    /// fragments, which is not in the paper. By Theorem 1 a maze of 44 fragments takes at most 990;
    /// in practice a maze of 500 takes about as many.
    #[must_use]
    pub const fn online() -> Self {
        Self::with(CpMapperConfig::online())
    }

    /// Returns the configuration with all our improvements: [`CpMapperConfig::robust`].
    #[must_use]
    pub const fn robust() -> Self {
        Self {
            checks: 1,
            heeds_lifts: true,
            ..Self::with(CpMapperConfig::robust())
        }
    }

    /// Returns the offline CPM of section 4: [`CpMapperConfig::offline`].
    #[must_use]
    pub const fn offline() -> Self {
        Self::with(CpMapperConfig::offline())
    }

    const fn with(mapper: CpMapperConfig) -> Self {
        Self {
            mapping: mapper.mapping,
            matching: mapper.matching,
            candidates: mapper.candidates,
            onward: Onward::ShortestKnownWay,
            most_traversals: 1000,
            checks: 0,
            heeds_lifts: false,
        }
    }
}
