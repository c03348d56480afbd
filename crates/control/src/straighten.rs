use tolman_robot::Scan;

/// Numbers of beams on either side of a beam on which a straight wall is looked for, the largest
/// first.
const BESIDE: [usize; 3] = [5, 3, 2];
/// Maximum distance of a beam's end from a straight wall, as a share of its range. It is about two
/// and a half times the noise of a laser that errs by 2 %.
const OFF: f64 = 0.05;

/// Returns a scan whose ranges end on the straight walls that the beams show together. Where the
/// ends of the beams beside a beam lie near one line, its range is that of the fitted line.
/// Elsewhere the range is unchanged. This removes the noise of single beams and keeps corners.
///
/// A line is a · x + b · y = 1, of which the fit is linear in the ends. O(beams).
///
/// ```
/// use tolman_control::straightened;
/// use tolman_robot::{Ring, Scan};
///
/// // A wall half a metre ahead, and one beam that errs.
/// let mut scan = Scan::clear(Ring::full(72, 1.25));
/// for beam in [67, 68, 69, 70, 71, 0, 1, 2, 3, 4, 5] {
///     scan.ranges[beam] = 0.5 / libm::cos(scan.ring.bearing(beam as u32));
/// }
/// scan.ranges[0] = 0.51;
/// assert!((straightened(&scan).ranges[0] - 0.5).abs() < 0.002);
/// ```
#[must_use]
pub fn straightened(scan: &Scan) -> Scan {
    let mut straight = scan.clone();
    for (beam, range) in straight.ranges.iter_mut().enumerate() {
        if *range < scan.ring.max_range {
            let fits = BESIDE.iter();
            *range = fits
                .clone()
                .find_map(|beside| on_a_line(scan, beam, *beside))
                .unwrap_or(*range);
        }
    }
    straight
}

/// Returns the range of a beam to the line through the ends of those beside it, or `None` where
/// they lie on no line.
fn on_a_line(scan: &Scan, beam: usize, beside: usize) -> Option<f64> {
    let beams = scan.ranges.len();
    if beams <= 2 * beside {
        return None;
    }
    let window = (0..=2 * beside).map(|offset| (beam + beams + offset - beside) % beams);
    let ways = window.map(|index| {
        let bearing = scan.ring.bearing(index as u32);
        (libm::cos(bearing), libm::sin(bearing), scan.ranges[index])
    });
    let [mut xx, mut xy, mut yy, mut x, mut y] = [0.0; 5];
    for (cos, sin, range) in ways.clone() {
        if range >= scan.ring.max_range {
            return None;
        }
        // Weighted by the range's own noise, which grows with it: divided by the range.
        xx += cos * cos;
        xy += cos * sin;
        yy += sin * sin;
        x += cos / range;
        y += sin / range;
    }
    let determinant = xx * yy - xy * xy;
    if determinant.abs() < 1e-9 {
        return None;
    }
    let (a, b) = (
        (yy * x - xy * y) / determinant,
        (xx * y - xy * x) / determinant,
    );
    let range_of = |cos: f64, sin: f64| 1.0 / (a * cos + b * sin);
    let fits = ways.clone().all(|(cos, sin, range)| {
        let line = range_of(cos, sin);
        line > 0.0 && (line - range).abs() <= OFF * range
    });
    let bearing = scan.ring.bearing(beam as u32);
    let line = range_of(libm::cos(bearing), libm::sin(bearing));
    (fits && line < scan.ring.max_range).then_some(line)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use tolman_robot::Ring;

    use super::*;

    /// Returns a square room of one metre, seen from off its middle.
    fn room() -> Scan {
        let mut scan = Scan::clear(Ring::full(72, 1.25));
        for (index, range) in scan.ranges.iter_mut().enumerate() {
            let bearing = TAU * index as f64 / 72.0;
            let (cos, sin) = (libm::cos(bearing), libm::sin(bearing));
            let to = |way: f64, at: f64| (0.5 * way.signum() - at) / (way + 1e-12 * way.signum());
            *range = to(cos, 0.1).min(to(sin, -0.05));
        }
        scan
    }

    #[test]
    fn a_scan_without_noise_stays_as_it_was() {
        let scan = room();
        for (straight, sensed) in straightened(&scan).ranges.iter().zip(&scan.ranges) {
            assert!(
                (straight - sensed).abs() < 0.03 * sensed,
                "{straight} {sensed}"
            );
        }
    }

    #[test]
    fn noise_becomes_less() {
        let truth = room();
        let mut noisy = truth.clone();
        for (index, range) in noisy.ranges.iter_mut().enumerate() {
            // Signs in an irregular order.
            let sign = if (index * index / 3) % 2 == 0 {
                1.0
            } else {
                -1.0
            };
            *range *= 1.0 + 0.02 * sign;
        }
        let off = |scan: &Scan| -> f64 {
            let pairs = scan.ranges.iter().zip(&truth.ranges);
            pairs
                .map(|(range, truth)| (range / truth - 1.0).powi(2))
                .sum()
        };
        let (after, before) = (off(&straightened(&noisy)), off(&noisy));
        assert!(after < 0.6 * before, "{after} {before}");
    }

    #[test]
    fn beams_that_met_nothing_stay_so() {
        let clear = Scan::clear(Ring::full(72, 1.25));
        assert_eq!(straightened(&clear), clear);
    }
}
