use crate::pose_graph::OptimizerConfig;

/// Parameters by which places are kept and recognized.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PlaceGraphConfig {
    /// Minimum distance of a new place from all other places, m.
    pub place_distance: f64,
    /// Minimum turn of a new place from all nearer ones, rad: a place is also new if no near one
    /// looks in the same direction.
    pub place_turn: f64,
    /// Standard deviation of the scale error of a robot's wheels.
    pub scale_deviation: f64,
    /// Standard deviation of the wheels' curvature, rad/m.
    pub curvature_deviation: f64,
    /// Minimum share of an outline's points that must lie on surfaces of the map for a fit to be
    /// believed, 0 … 1.
    pub least_share: f64,
    /// Share of the robot's last looks that contradict the map, above which the robot counts as
    /// lost, 0 … 1.
    pub most_doubt: f64,
    /// Maximum number of hypotheses of a lost robot's pose.
    pub most_hypotheses: usize,
    /// Number of new places between two optimizations of the graph.
    pub optimize_every: u32,
    /// Parameters of the graph's optimizations.
    pub optimizer: OptimizerConfig,
}

impl PlaceGraphConfig {
    /// Returns our values for rooms and robots of some metres. They were tried in arenas of 3 to 7
    /// m, with wheels 0.32 m apart and 3 % out of calibration.
    #[must_use]
    pub const fn indoors() -> Self {
        Self {
            place_distance: 0.6,
            place_turn: 0.6,
            scale_deviation: 0.03,
            curvature_deviation: 0.15,
            least_share: 0.5,
            most_doubt: 2.0,
            most_hypotheses: 200,
            optimize_every: 5,
            optimizer: OptimizerConfig {
                most_steps: 5,
                most_iterations: 100,
                tolerance: 1e-4,
                doubt: Some(16.0),
            },
        }
    }

    /// Returns the same values for wheels that stand `track` apart, m, each out of calibration by
    /// up to `share`, 0 … 1.
    #[must_use]
    pub const fn for_wheels(mut self, share: f64, track: f64) -> Self {
        self.scale_deviation = share;
        self.curvature_deviation = CURVATURE * share / track;
        self
    }
}

/// Standard deviation of the curvature caused by an error of the wheels, as a share of the error of
/// one wheel. The two wheels err in opposite ways. So 3 % on a track of 0.32 m are 0.15 rad/m.
const CURVATURE: f64 = 1.6;
