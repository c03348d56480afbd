//! Compares the stated covariances with the errors of the graph.

use alloc::vec::Vec;

use super::chain::Chain;
use super::link::links;
use super::{AuditConfig, AuditError};
use crate::pose_graph::PoseGraph;

/// Maximum distance between the ends of two closures whose cycle is measured, poses.
const APART: u32 = 10;

/// Median of χ² with 3 degrees of freedom.
const MEDIAN: f64 = 2.366;
const TAIL: f64 = 11.345;

/// Ratio of the tail to a Gaussian's above which the scale bears it.
const HEAVY: f64 = 2.0;

/// Multiple of the median above which a cycle is that of a false closure, not of the tail.
const FALSE: f64 = 300.0;

/// Minimum number of cycles for a scale.
const FEWEST: usize = 20;

/// Factor between the stated standard deviations and those of the graph's short cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SigmaScale {
    /// Scale at which the median of χ² is that of a Gaussian.
    pub estimate: f64,
    /// The 99th percentile of χ² over its median, without cycles 300 times the median: those are of
    /// false closures. A Gaussian's is 4.8.
    pub tail: f64,
    /// Number of cycles from which the scale is computed.
    pub cycles: usize,
}

impl SigmaScale {
    /// Estimates the scale from cycles of two closures that begin and end within 10 poses; `None`
    /// if there are fewer than 20.
    ///
    /// # Errors
    /// [`AuditError`] as [`audit`](super::audit()).
    ///
    /// # Complexity
    /// O(closures · m · log) where m closures begin within 10 poses.
    pub fn estimate(graph: &PoseGraph) -> Result<Option<Self>, AuditError> {
        let config = AuditConfig::standard();
        let chain = Chain::of(graph, &config)?;
        let links = links(graph, &chain, &config);
        let mut measured: Vec<f64> = Vec::new();
        for (index, link) in links.iter().enumerate() {
            let next = links[index + 1..].iter();
            let near = next.take_while(|next| next.first - link.first <= APART);
            let near = near.filter(|next| {
                let apart = (next.first - link.first, next.second.abs_diff(link.second));
                apart != (0, 0) && apart.1 <= APART
            });
            let nearest =
                near.min_by_key(|next| next.first - link.first + next.second.abs_diff(link.second));
            let gap = nearest.and_then(|next| link.gap_to(next, &chain));
            measured.extend(gap.map(|gap| gap.chi2));
        }
        measured.retain(|chi2| chi2.is_finite());
        measured.sort_by(f64::total_cmp);
        Ok(Self::of(&measured))
    }

    fn of(sorted: &[f64]) -> Option<Self> {
        let cycles = sorted.len();
        if cycles < FEWEST {
            return None;
        }
        let at = |share: f64, of: usize| sorted[((of - 1) as f64 * share) as usize];
        let median = at(0.5, cycles);
        let right = sorted
            .partition_point(|chi2| *chi2 <= FALSE * median)
            .max(1);
        (median > 0.0).then(|| Self {
            estimate: libm::sqrt(median / MEDIAN),
            tail: at(0.99, right) / median,
            cycles,
        })
    }

    /// Returns whether the tail is so heavy that the estimate alone would refute right closures.
    #[must_use]
    pub fn is_heavy(&self) -> bool {
        self.tail > HEAVY * TAIL / MEDIAN
    }

    /// Returns the scale to audit with: the estimate, raised where the tail is heavy so that this
    /// lies as far out as a Gaussian's.
    #[must_use]
    pub fn scale(&self) -> f64 {
        match self.is_heavy() {
            true => self.estimate * libm::sqrt(self.tail * MEDIAN / TAIL),
            false => self.estimate,
        }
    }
}
