/// What a [`ScanMatching`](super::ScanMatching) reckons with.
///
/// Lengths are in m, angles in rad. Scores are the mean likelihood of beam ends on the map, 0 … 1.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ScanMatchingConfig {
    /// Beams that end farther off are not used.
    pub farthest: f64,
    /// Standard deviation of a beam's end from the surface that it met.
    pub kernel: f64,
    /// Side of a cell of the map that scans are held against.
    pub cell: f64,
    /// How far the robot comes until a scan is matched again.
    pub step: f64,
    /// How far it turns until a scan is matched again.
    pub turn: f64,
    /// How far it comes until a scan becomes a keyframe.
    pub keyframe_step: f64,
    /// How far it turns until a scan becomes a keyframe.
    pub keyframe_turn: f64,
    /// A scan is matched to that many keyframes before it.
    pub local_keyframes: usize,
    /// How far from where the odometry has it a scan is looked for, along each axis.
    pub window: f64,
    /// The same by heading.
    pub window_turn: f64,
    /// What a candidate at the border of the window loses of its score, by position.
    pub prior: f64,
    /// The same by heading.
    pub prior_turn: f64,
    /// Standard deviation of the odometry along each axis, from one matched scan to the next.
    pub odometry_sd: f64,
    /// The same of its heading.
    pub odometry_turn_sd: f64,
    /// A scan that fits worse is left where the odometry has it.
    pub least_score: f64,
    /// How places that are seen again are looked for; `None` to look for none.
    pub closures: Option<ClosureConfig>,
}

/// Where the robot looks round for places that it has seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClosureSites {
    /// All along its way.
    Everywhere,
    /// Where somebody tells it to: see [`ScanMatching::recognize`](super::ScanMatching::recognize).
    Named,
}

/// How places that are seen again are looked for.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ClosureConfig {
    /// Where they are looked for.
    pub sites: ClosureSites,
    /// Way from one search to the next.
    pub every: f64,
    /// A place is seen again after that much way at least.
    pub least_way: f64,
    /// Keyframes whose scans are put together and looked for.
    pub query_keyframes: usize,
    /// Keyframes of the old place that they are held against.
    pub old_keyframes: usize,
    /// How far off an old place is looked for at least, along each axis.
    pub window: f64,
    /// How much that grows by metre of way since the last closure.
    pub window_growth: f64,
    /// How far off an old place is looked for at most.
    pub most_window: f64,
    /// How far off its heading is looked for at least.
    pub window_turn: f64,
    /// How much that grows by metre of way since the last closure, rad/m.
    pub window_turn_growth: f64,
    /// How far off its heading is looked for at most.
    pub most_window_turn: f64,
    /// A worse fit is no closure.
    pub least_score: f64,
    /// Two closures agree if they correct the pose alike to so much.
    pub agreement: f64,
    /// The same by heading.
    pub agreement_turn: f64,
    /// The second of two that agree comes after that much way at most.
    pub agreement_way: f64,
    /// Standard deviation of a closure along each axis at best.
    pub sd: f64,
    /// The same by heading.
    pub turn_sd: f64,
    /// The squared error at which a closure counts a quarter.
    pub doubt: f64,
    /// How often all closures are looked for again at the end at most, each time on the map that
    /// they made.
    pub most_rounds: u32,
}

impl ScanMatchingConfig {
    /// Returns the values for a laser of indoor ranges and wheels of any quality, found on four
    /// buildings; closures are looked for.
    #[must_use]
    pub fn indoor() -> Self {
        Self {
            farthest: 25.0,
            kernel: 0.05,
            cell: 0.05,
            step: 0.1,
            turn: 0.05,
            keyframe_step: 0.3,
            keyframe_turn: 0.3,
            local_keyframes: 30,
            window: 0.5,
            window_turn: 25_f64.to_radians(),
            prior: 0.1,
            prior_turn: 0.05,
            odometry_sd: 0.2,
            odometry_turn_sd: 0.2,
            least_score: 0.15,
            closures: Some(ClosureConfig::indoor()),
        }
    }

    /// Returns it with closures where somebody names places.
    #[must_use]
    pub fn with_places(self) -> Self {
        Self {
            closures: Some(ClosureConfig::places()),
            ..self
        }
    }

    /// Returns it without closures.
    #[must_use]
    pub fn without_closures(self) -> Self {
        Self {
            closures: None,
            ..self
        }
    }
}

impl ClosureConfig {
    /// Returns the values for buildings of corridors and rooms.
    #[must_use]
    pub fn indoor() -> Self {
        Self {
            sites: ClosureSites::Everywhere,
            every: 0.6,
            least_way: 12.0,
            query_keyframes: 8,
            old_keyframes: 24,
            window: 0.4,
            window_growth: 0.02,
            most_window: 2.5,
            window_turn: 4_f64.to_radians(),
            window_turn_growth: 0.1_f64.to_radians(),
            most_window_turn: 20_f64.to_radians(),
            least_score: 0.55,
            agreement: 0.2,
            agreement_turn: 3_f64.to_radians(),
            agreement_way: 4.0,
            sd: 0.03,
            turn_sd: 0.005,
            doubt: 16.0,
            most_rounds: 8,
        }
    }

    /// Returns the values for places that somebody names: a few metres apart, so that matches which
    /// agree are.
    #[must_use]
    pub fn places() -> Self {
        Self {
            sites: ClosureSites::Named,
            agreement_way: 20.0,
            ..Self::indoor()
        }
    }
}
