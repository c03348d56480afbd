/// Parameters of a [`ScanMatching`](super::ScanMatching).
///
/// Lengths are in m, angles in rad. Scores are the mean likelihood of beam ends on the map, 0 to 1.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ScanMatchingConfig {
    /// Maximum range of the beams that are used.
    pub farthest: f64,
    /// Standard deviation of a beam's end from the surface that it met.
    pub kernel: f64,
    /// Side of a cell of the map that scans are compared with.
    pub cell: f64,
    /// Distance after which a scan is matched again.
    pub step: f64,
    /// Turn after which a scan is matched again.
    pub turn: f64,
    /// Distance after which a scan becomes a keyframe.
    pub keyframe_step: f64,
    /// Turn after which a scan becomes a keyframe.
    pub keyframe_turn: f64,
    /// Number of earlier keyframes that a scan is matched to.
    pub local_keyframes: usize,
    /// Half-width of the window about the odometry's pose, along each axis.
    pub window: f64,
    /// Half-width of the window about the odometry's heading.
    pub window_turn: f64,
    /// Loss of score of a candidate at the border of the window, by position.
    pub prior: f64,
    /// Loss of score of a candidate at the border of the window, by heading.
    pub prior_turn: f64,
    /// Standard deviation of the odometry along each axis, from one matched scan to the next.
    pub odometry_sd: f64,
    /// Standard deviation of the odometry's heading, from one matched scan to the next.
    pub odometry_turn_sd: f64,
    /// Minimum score of a fit; below it a scan keeps its position by odometry.
    pub least_score: f64,
    /// Search for places that are seen again; `None` to find none.
    pub closures: Option<ClosureConfig>,
}

/// Sites where the robot searches for places that it has visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClosureSites {
    /// All along the robot's way.
    Everywhere,
    /// Only at the keyframes that the caller names: see
    /// [`ScanMatching::recognize`](super::ScanMatching::recognize).
    Named,
}

/// Parameters of the search for places that are seen again.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ClosureConfig {
    /// Sites where closures are searched.
    pub sites: ClosureSites,
    /// Way from one search to the next.
    pub every: f64,
    /// Minimum way after which a place counts as seen again.
    pub least_way: f64,
    /// Number of the last keyframes whose scans are put together and searched for.
    pub query_keyframes: usize,
    /// Number of keyframes of the old place with which these scans are compared.
    pub old_keyframes: usize,
    /// Minimum half-width of the window for an old place, along each axis.
    pub window: f64,
    /// Growth of that half-width per metre of way since the last closure.
    pub window_growth: f64,
    /// Maximum half-width of the window for an old place.
    pub most_window: f64,
    /// Minimum half-width of the window for the heading at an old place, rad.
    pub window_turn: f64,
    /// Growth of that half-width per metre of way since the last closure, rad/m.
    pub window_turn_growth: f64,
    /// Maximum half-width of the window for the heading at an old place, rad.
    pub most_window_turn: f64,
    /// Minimum score of a closure.
    pub least_score: f64,
    /// Maximum difference of the corrections of two closures that agree.
    pub agreement: f64,
    /// Maximum difference in heading between the corrections of two closures that agree.
    pub agreement_turn: f64,
    /// Maximum way between two closures that agree.
    pub agreement_way: f64,
    /// Minimum standard deviation of a closure along each axis.
    pub sd: f64,
    /// Minimum standard deviation of a closure's heading.
    pub turn_sd: f64,
    /// Squared error at which a closure weighs a quarter.
    pub doubt: f64,
    /// Maximum number of rounds in which all closures are searched again at the end, each on the
    /// map that the round before made.
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

    /// Returns the values for a robot whose motion is known from its scans alone: each is matched,
    /// in a wider window, and no closures are looked for.
    #[must_use]
    pub fn without_odometry() -> Self {
        Self {
            step: 0.0,
            turn: 0.0,
            window: 1.0,
            window_turn: 45_f64.to_radians(),
            odometry_sd: 0.5,
            odometry_turn_sd: 0.5,
            closures: None,
            ..Self::indoor()
        }
    }

    /// Returns the same values, but with closures only at places that the caller names.
    #[must_use]
    pub fn places() -> Self {
        Self {
            closures: Some(ClosureConfig::places()),
            ..Self::indoor()
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

    /// Returns the values for places that the caller names, which are a few metres apart.
    #[must_use]
    pub fn places() -> Self {
        Self {
            sites: ClosureSites::Named,
            agreement_way: 20.0,
            ..Self::indoor()
        }
    }
}
