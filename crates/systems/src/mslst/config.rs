use serde::{Deserialize, Serialize};

/// Parameters of MSLST.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct MslstConfig {
    /// Phase I, the error threshold of the equilibrium GNG: squared robot units, above 0. The paper
    /// has 100 for the J maze, 20 and 50 for the Large one.
    pub threshold: f64,
    /// Phase I, duration of the wandering: time steps, at least 1. "Approximately 4000 time steps,
    /// on the large maze."
    pub scan_steps: u32,
    /// Phase II, duration of the wandering: actions, at least 1. The paper does not say: "chosen
    /// largely based on how much time was available". See `docs/notebook/mslst.md`.
    pub graph_actions: u32,
    /// Number of pairs of state and action that Phase III remembers, at least 1. "The last eight …
    /// when solving the large maze, and six for the J-maze."
    pub memory: u32,
    /// Phase III, number of random actions once it believes that it has arrived. "Eight actions."
    pub doubt: u32,
}

impl MslstConfig {
    /// Returns the values for the J maze: threshold 100, a memory of six.
    #[must_use]
    pub const fn j() -> Self {
        Self {
            memory: 6,
            ..Self::large(100.0)
        }
    }

    /// Returns the values for the Large maze: a memory of eight; its `threshold` is 20 or 50.
    #[must_use]
    pub const fn large(threshold: f64) -> Self {
        Self {
            threshold,
            scan_steps: 4000,
            graph_actions: 8000,
            memory: 8,
            doubt: 8,
        }
    }
}
