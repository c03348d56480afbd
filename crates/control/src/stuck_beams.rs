use alloc::vec::Vec;

use tolman_robot::Scan;

/// Notices beams that are stuck, and leaves them out.
///
/// Walls lead from beam to beam, so that a beam seldom says much more or much less than both beams
/// beside it. One that does so in most scans is stuck; one that has stopped doing so for long is
/// sound again. The range of a stuck beam is replaced by the smaller one of the sound beams beside
/// it.
///
/// ```
/// use tolman_control::StuckBeams;
/// use tolman_robot::{Ring, Scan};
///
/// // In the open, one beam says that something stands 0.4 m away, whatever the robot does.
/// let mut scan = Scan::clear(Ring::full(72, 1.25));
/// scan.ranges[9] = 0.4;
/// let mut beams = StuckBeams::default();
/// let first = beams.mended(&scan);
/// assert_eq!(first.ranges[9], 0.4);
/// let later = (0..20).map(|_| beams.mended(&scan)).last();
/// assert_eq!(later.map(|scan| scan.ranges[9]), Some(1.25));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StuckBeams {
    /// State of each beam.
    beams: Vec<Beam>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Beam {
    /// Number of recent contradictions between this beam and the beams beside it.
    doubts: u8,
    stuck: bool,
}

/// Ratio, either way, at which a beam's range contradicts the ranges of both its neighbours.
const CONTRADICTS: f64 = 1.25;
/// Increase of the doubts by a contradiction; each scan without one reduces them by one.
const DOUBT: u8 = 2;
/// Doubts at which a beam counts as stuck: eight contradictions in a row at the soonest.
const ENOUGH: u8 = 16;
/// Maximum number of doubts of a beam.
const MOST: u8 = 48;

impl StuckBeams {
    /// Takes in a scan and returns it without the readings of stuck beams. After a change of the
    /// ring's size, only the beams of both sizes keep their state. O(beams).
    #[must_use]
    pub fn mended(&mut self, scan: &Scan) -> Scan {
        let ranges = &scan.ranges;
        self.beams.resize(ranges.len(), Beam::default());
        for (index, beam) in self.beams.iter_mut().enumerate() {
            beam.see(contradicts(ranges, index));
        }
        let mut mended = scan.clone();
        for (index, range) in mended.ranges.iter_mut().enumerate() {
            if self.beams[index].stuck {
                *range = self.beside(ranges, index).unwrap_or(*range);
            }
        }
        mended
    }

    /// Returns the smaller of the ranges of the sound beams on either side of a beam, or `None` if
    /// all are stuck.
    fn beside(&self, ranges: &[f64], beam: usize) -> Option<f64> {
        let count = ranges.len();
        let sound = |index: &usize| !self.beams[*index].stuck;
        let after = (1..count).map(|offset| (beam + offset) % count).find(sound);
        let before = (1..count)
            .map(|offset| (beam + count - offset) % count)
            .find(sound);
        Some(ranges[after?].min(ranges[before?]))
    }
}

impl Beam {
    fn see(&mut self, contradiction: bool) {
        self.doubts = if contradiction {
            (self.doubts + DOUBT).min(MOST)
        } else {
            self.doubts.saturating_sub(1)
        };
        self.stuck = self.doubts >= ENOUGH || (self.stuck && self.doubts > 0);
    }
}

/// Returns whether a beam's range is much larger, or much smaller, than those of both its
/// neighbours.
fn contradicts(ranges: &[f64], beam: usize) -> bool {
    let count = ranges.len();
    let (before, after) = (
        ranges[(beam + count - 1) % count],
        ranges[(beam + 1) % count],
    );
    let range = ranges[beam];
    range * CONTRADICTS < before.min(after) || range > CONTRADICTS * before.max(after)
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use tolman_robot::Ring;

    use super::*;

    /// Returns a scan in a corridor 1 m wide, rotated by `turned` beams.
    fn corridor(turned: usize) -> Scan {
        let mut scan = Scan::clear(Ring::full(72, 1.25));
        for index in 0..72 {
            let across = libm::sin(scan.ring.bearing(index as u32)).abs();
            scan.ranges[(index + turned) % 72] = (0.5 / (across + 1e-9)).min(1.25);
        }
        scan
    }

    #[test]
    fn a_beam_that_contradicts_those_beside_it_is_left_out_and_comes_back() {
        let mut beams = StuckBeams::default();
        let mut stuck = corridor(0);
        stuck.ranges[0] = 0.4;
        let seen: Vec<f64> = (0..10).map(|_| beams.mended(&stuck).ranges[0]).collect();
        assert_eq!(seen, [[0.4; 7].as_slice(), &[1.25; 3]].concat());
        // Turned to the wall it says what those beside it say; so it is not sound yet.
        assert!(beams.beams[0].stuck);
        for _ in 0..40 {
            let _ = beams.mended(&corridor(0));
        }
        assert!(!beams.beams[0].stuck);
    }

    #[test]
    fn sound_beams_are_left_as_they_are() {
        let mut beams = StuckBeams::default();
        for turn in 0..200 {
            let scan = corridor(turn % 18);
            assert_eq!(beams.mended(&scan), scan, "{turn}");
        }
    }

    #[test]
    fn nothing_is_made_up_where_all_beams_are_stuck() {
        let mut beams = StuckBeams::default();
        let ring = Ring::full(4, 1.25);
        let mut scan = Scan::clear(ring);
        scan.ranges = vec![0.1, 1.0, 0.1, 1.0];
        let last = (0..30).map(|_| beams.mended(&scan)).last();
        assert_eq!(last, Some(scan));
    }
}
