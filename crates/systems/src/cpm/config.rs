use tolman_maps::cpm::{Candidates, CpMapperConfig, FragmentMatching, Mapping};

/// Parameters by which CPM maps and decides.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct CpmConfig {
    /// When the map is looked at.
    pub mapping: Mapping,
    /// Method of comparing fragments.
    pub matching: FragmentMatching,
    /// Fragments that are compared.
    pub candidates: Candidates,
    /// Choice at a junction without unknown ports.
    pub onward: Onward,
    /// Maximum number of fragments walked before the explorer gives up and says so. A robot that
    /// recognizes nothing lengthens its map with each, and nothing else ends its exploration.
    pub most_traversals: u32,
    /// How often a robot that [checks](super::Aim::Check) its map walks each fragment since the map
    /// was last another, before it says that the map is right. 0 in the paper.
    #[serde(default)]
    pub checks: u32,
    /// Whether a robot whose sensors say that it was moved between two fragments begins another map
    /// there, or finds itself on the one it was given. `false` in the paper.
    #[serde(default)]
    pub heeds_lifts: bool,
}

/// Choice of an online robot at a junction that "has no unknown ports left".
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Onward {
    /// Goes the shortest known way to a junction that has one. Theorem 1 needs no more.
    ShortestKnownWay,
    /// "It continues forward until reaching a junction that has some remaining unknown ports", to
    /// the letter, by a random port. This can go round in circles and breaks the proof of
    /// Theorem 1.
    GoOn,
}

impl CpmConfig {
    /// Returns how the map is made.
    #[must_use]
    pub const fn mapper(&self) -> CpMapperConfig {
        CpMapperConfig {
            mapping: self.mapping,
            matching: self.matching,
            candidates: self.candidates,
        }
    }

    /// Returns online CPM of section 6: [`CpMapperConfig::online`]. It gives up after 1000
    /// fragments, which is not in the paper. By Theorem 1 a maze of 44 fragments takes at most 990;
    /// in practice a maze of 500 takes that many.
    #[must_use]
    pub const fn online() -> Self {
        Self::with(CpMapperConfig::online())
    }

    /// Returns all that we know better than the paper: [`CpMapperConfig::robust`].
    #[must_use]
    pub const fn robust() -> Self {
        Self {
            checks: 1,
            heeds_lifts: true,
            ..Self::with(CpMapperConfig::robust())
        }
    }

    /// Returns section 4's, offline CPM: [`CpMapperConfig::offline`].
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
