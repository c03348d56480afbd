use super::rays::{RANGE_UNIT, UNKNOWN};

/// Best explanation of a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Explanation {
    /// The known walls, seen from near the believed position.
    AsKnown,
    /// Walls that were built after the map was learned.
    NewWalls,
    /// A lift of the robot.
    Lifted,
}

/// Probability of a scan by each [`Explanation`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    pub(super) as_known: f64,
    pub(super) new_walls: f64,
    pub(super) lifted: f64,
    /// Smallest misfit of all standpoints.
    least: f64,
}

/// Difference of a scan from a standpoint's view: mean squares, in standard deviations of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Misfit {
    /// Mean square over all beams; `None` if the map knows too little of the view.
    all: Option<f64>,
    /// Mean square over the beams that do not end on new walls; `None` if no new wall is in sight.
    but_for_new_walls: Option<f64>,
}

/// Standard deviation of a range from the range at the nearest standpoint, m.
const RANGE_SD: f64 = 0.075;
/// Number of standard deviations above which a beam has met something else. Larger differences add
/// no evidence.
const OUTLIER: f64 = 3.0;
/// Weight of all beams together, in independent beams: beams that see the same walls are
/// correlated.
const INDEPENDENT_BEAMS: f64 = 8.0;
/// Misfit below which a better fit adds no evidence: the map's own errors are as large, and occur
/// in every look.
const GOOD: f64 = 0.6;
/// Misfit that is assumed where the map knows too little of the view, mean square. A wrong place
/// with a similar view fits about as badly.
const UNSHOWN: f64 = 2.0;
/// Mean square misfit above which a scan fits nowhere.
const SURPRISE: f64 = 3.0;
/// Misfit below which a scan fits well, mean square.
const WELL: f64 = 1.5;
/// Minimum number of adjacent beams that end on a new wall.
pub(super) const BEAMS_OF_A_WALL: u32 = 8;

impl Default for Evidence {
    fn default() -> Self {
        Self {
            as_known: 0.0,
            new_walls: 0.0,
            lifted: 0.0,
            least: f64::INFINITY,
        }
    }
}

impl Evidence {
    pub(super) fn see(&mut self, misfit: Misfit) {
        self.least = self.least.min(misfit.all.unwrap_or(f64::INFINITY));
    }

    /// Returns whether the scan fits the map's view at any standpoint.
    pub(super) fn fits_somewhere(&self) -> bool {
        self.least <= SURPRISE
    }

    pub(super) fn explanation(&self) -> Explanation {
        if self.as_known >= self.new_walls.max(self.lifted) {
            Explanation::AsKnown
        } else if self.new_walls >= self.lifted {
            Explanation::NewWalls
        } else {
            Explanation::Lifted
        }
    }
}

/// Returns whether a beam ends long before the map's wall.
pub(super) fn ends_before(seen: f64, shown: u8) -> bool {
    shown != UNKNOWN && seen < f64::from(shown) * RANGE_UNIT - OUTLIER * RANGE_SD
}

impl Misfit {
    /// Compares ranges with the map's ranges, beam by beam, in [`RANGE_UNIT`]s. O(beams).
    pub(super) fn of(seen: &[f64], shown: impl Iterator<Item = u8>) -> Self {
        let (mut all, mut old) = (Sum::default(), Sum::default());
        let mut new = Run::default();
        for (seen, shown) in seen.iter().zip(shown) {
            if shown == UNKNOWN {
                continue;
            }
            let off = (seen - f64::from(shown) * RANGE_UNIT) / RANGE_SD;
            let capped = off.abs().min(OUTLIER);
            all.add(capped * capped);
            let ends_before = ends_before(*seen, shown);
            new.add(ends_before);
            if !ends_before {
                old.add(capped * capped);
            }
        }
        let has_new_wall = new.longest() >= BEAMS_OF_A_WALL;
        let beams = seen.len() as u32;
        Self {
            all: all.mean(beams.div_ceil(2)),
            but_for_new_walls: old.mean(beams / 3).filter(|_| has_new_wall),
        }
    }

    /// Returns whether a scan fits apart from new walls, of which some are in sight.
    pub(super) fn fits_but_for_new_walls(self) -> bool {
        self.but_for_new_walls.is_some_and(|misfit| misfit < WELL)
    }

    /// Returns the likelihood of the scan without new walls.
    pub(super) fn likelihood(self) -> f64 {
        likelihood(self.all.unwrap_or(UNSHOWN))
    }

    /// Returns the likelihood of the scan if beams that end early end on new walls.
    pub(super) fn likelihood_with_new_walls(self) -> f64 {
        self.but_for_new_walls.map_or(0.0, likelihood)
    }
}

#[derive(Default)]
struct Sum {
    sum: f64,
    count: u32,
}

impl Sum {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    /// Returns the mean; `None` for fewer than `least` values.
    fn mean(&self, least: u32) -> Option<f64> {
        (self.count > 0 && self.count >= least).then(|| self.sum / f64::from(self.count))
    }
}

/// Lengths of runs of adjacent beams with something in common, round the circle.
#[derive(Default)]
struct Run {
    /// Length of the run that begins at the first beam.
    first: u32,
    has_ended: bool,
    last: u32,
    most: u32,
}

impl Run {
    fn add(&mut self, has: bool) {
        if has {
            self.last += 1;
            self.most = self.most.max(self.last);
        } else {
            if !self.has_ended {
                self.first = self.last;
            }
            self.has_ended = true;
            self.last = 0;
        }
    }

    fn longest(&self) -> u32 {
        self.most.max(self.last + self.first)
    }
}

fn likelihood(misfit: f64) -> f64 {
    libm::exp(-0.5 * INDEPENDENT_BEAMS * misfit.max(GOOD))
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use proptest::prelude::*;

    use super::Run;

    proptest! {
        /// From every beam on, as far round as all have it.
        #[test]
        fn the_longest_run_goes_round_the_circle(beams in prop::collection::vec(prop::bool::weighted(0.7), 1..12)) {
            let mut run = Run::default();
            for has in &beams {
                run.add(*has);
            }
            let twice: Vec<bool> = beams.iter().chain(&beams).copied().collect();
            let from = |first: usize| twice[first..first + beams.len()].iter().take_while(|has| **has).count();
            let longest = (0..beams.len()).map(from).max();
            prop_assert_eq!(Some(run.longest() as usize), longest);
        }
    }
}
