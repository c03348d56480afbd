//! The searches by name.

use core::fmt;
use core::str::FromStr;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig, WorthConfig};

use super::{
    Brief, Certify, CounterSearch, Driver, MouseError, RandomSearch, RunTwo, Search, TargetSearch,
};

/// A search that a mouse can be given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Searcher {
    /// Ours, until the best run is proven.
    Certify,
    /// As [`Certify`](Self::Certify), but only until the rest of the proof no longer pays.
    CertifyWorth,
    /// Like [`Searcher::Certify`], without rollouts.
    CertifyPlain,
    /// The paper's target search.
    Target,
    /// The paper's counter search, at least 50 %.
    Counter50,
    /// The paper's counter search, at least 75 %.
    Counter75,
    /// The paper's random exploration.
    Random,
}

impl Searcher {
    /// All searches.
    pub const ALL: [Self; 7] = [
        Self::Certify,
        Self::CertifyWorth,
        Self::CertifyPlain,
        Self::Target,
        Self::Counter50,
        Self::Counter75,
        Self::Random,
    ];

    /// Returns the name as typed on a command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Certify => "certify",
            Self::CertifyWorth => "certify-worth",
            Self::CertifyPlain => "certify-plain",
            Self::Target => "target",
            Self::Counter50 => "counter-50",
            Self::Counter75 => "counter-75",
            Self::Random => "random",
        }
    }

    /// Returns whether the search is deterministic: makes the same run each time.
    #[must_use]
    pub const fn is_deterministic(self) -> bool {
        matches!(
            self,
            Self::Certify | Self::CertifyWorth | Self::CertifyPlain | Self::Target
        )
    }

    /// Returns a mouse with this search at the start of the maze that `brief` describes.
    ///
    /// # Errors
    /// If the maze is too large.
    pub fn mouse(self, brief: &Brief, seed: u64) -> Result<Driver<Box<dyn Search>>, MouseError> {
        let rng = ChaCha8Rng::seed_from_u64(seed);
        let certify = |rollouts, worth| {
            let explorer = MoveExplorerConfig::tuned();
            Certify::new(explorer, rollouts, worth, brief.grid, brief.start)
        };
        let (search, run_two): (Box<dyn Search>, _) = match self {
            Self::Certify => {
                let search = Certify::tuned(brief.grid, brief.start)?;
                (Box::new(search), RunTwo::FewestMoves)
            }
            Self::CertifyWorth => {
                let search = certify(Some(RolloutConfig::tuned()), Some(WorthConfig::tuned()))?;
                (Box::new(search), RunTwo::FewestMoves)
            }
            Self::CertifyPlain => (Box::new(certify(None, None)?), RunTwo::FewestMoves),
            Self::Target => (Box::new(TargetSearch::new()), RunTwo::FewestCells),
            Self::Counter50 => (Box::new(CounterSearch::new(50, rng)), RunTwo::FewestCells),
            Self::Counter75 => (Box::new(CounterSearch::new(75, rng)), RunTwo::FewestCells),
            Self::Random => (Box::new(RandomSearch::new(rng)), RunTwo::FewestCells),
        };
        Driver::new(brief.clone(), search, run_two)
    }
}

impl fmt::Display for Searcher {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

/// No search has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "there is no search {name:?}: choose certify, certify-worth, certify-plain, target, counter-50, counter-75 or random"
)]
pub struct UnknownSearcher {
    /// The name as given.
    pub name: String,
}

impl FromStr for Searcher {
    type Err = UnknownSearcher;

    fn from_str(name: &str) -> Result<Self, UnknownSearcher> {
        let found = Self::ALL
            .into_iter()
            .find(|searcher| searcher.name() == name);
        found.ok_or_else(|| UnknownSearcher {
            name: name.to_owned(),
        })
    }
}
