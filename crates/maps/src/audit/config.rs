use core::f64::consts::PI;

/// Parameters of an audit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct AuditConfig {
    /// Factor of every stated standard deviation: below 1 if the graph overstates its errors, above
    /// 1 if it understates them. Positive; default 1.
    pub sigma_scale: f64,
    /// Maximum error of a cycle, k, in standard deviations (default 5; with Gaussian errors 2 in
    /// 100,000 right cycles exceed it).
    pub bound: f64,
    /// Maximum share of all nearby poses that the region of k standard deviations of a tight cycle
    /// fills (default 0.003).
    pub tight_share: f64,
    /// Radius of the region of nearby poses, m (default 5), at any heading.
    pub near: f64,
    /// Maximum distance of two neighbouring closures of one run, at both ends, poses (default 3).
    pub run_gap: u32,
    /// Maximum way between two neighbouring closures of one run, at both ends, m (default 20).
    pub run_way: f64,
    /// Way over which the odometry's errors count as independent of each other, m (default 1000).
    /// Over longer ways the bound by odometry alone grows in proportion.
    pub white_way: f64,
    /// Maximum distance, at both ends, of two closures that are compared, poses (default 60).
    pub pair_gap: u32,
    /// Weight of a radian in the search for the surest way, m (default 3).
    pub lever: f64,
    /// Maximum number of witnesses of a supported closure that are looked for, at least 1 (default
    /// 5).
    pub most_witnesses: usize,
}

impl AuditConfig {
    /// Returns the values that all figures of this project use.
    #[must_use]
    pub const fn standard() -> Self {
        Self {
            sigma_scale: 1.0,
            bound: 5.0,
            tight_share: 3e-3,
            near: 5.0,
            run_gap: 3,
            run_way: 20.0,
            white_way: 1000.0,
            pair_gap: 60,
            lever: 3.0,
            most_witnesses: 5,
        }
    }

    /// Returns the greatest χ² within the bound: k².
    pub(super) const fn most_chi2(&self) -> f64 {
        self.bound * self.bound
    }

    /// Returns the greatest determinant of a tight covariance: that of the ellipsoid 4/3 π k³ √det
    /// that fills the share of π near² · 2π.
    pub(super) fn most_det(&self) -> f64 {
        let near_by = PI * self.near * self.near * 2.0 * PI;
        let ball = 4.0 / 3.0 * PI * self.bound * self.bound * self.bound;
        let root = self.tight_share * near_by / ball;
        root * root
    }
}
