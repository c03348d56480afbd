//! Views of a laser that looks all round, computed from the scans of one that does not.

use core::f64::consts::{FRAC_PI_2, TAU};
use core::ops::Range;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::{Ring, Scan};

use super::ScanMatching;

/// Number of keyframes before and after that show what is around.
const SHOWN: usize = 14;
/// Number of keyframes before and after whose surfaces show how the heading has drifted.
const ABOUT: usize = 20;

impl ScanMatching {
    /// Returns the view from a keyframe of a `ring` of beams aligned with the map's axes, by the
    /// keyframes before and after. `None` if there is no such keyframe. A beam along which no
    /// keyframe saw anything reads the ring's range. O(points of the keyframes).
    #[must_use]
    pub fn surroundings(&self, keyframe: usize, ring: Ring, ahead: Heading) -> Option<Scan> {
        let here = self.graph.poses().get(keyframe)?.position;
        self.surroundings_of(keyframe, here, ring, ahead)
    }

    /// Returns the view from a point, by the keyframes about `keyframe`; otherwise as
    /// [`surroundings`](Self::surroundings).
    #[must_use]
    pub fn surroundings_of(
        &self,
        keyframe: usize,
        here: Point,
        ring: Ring,
        ahead: Heading,
    ) -> Option<Scan> {
        self.keyframes.get(keyframe)?;
        let mut scan = Scan::clear(ring);
        let end = (keyframe + SHOWN + 1).min(self.keyframes.len());
        let shown = keyframe.saturating_sub(SHOWN)..end;
        for (index, pose) in shown.clone().zip(&self.graph.poses()[shown]) {
            for point in &self.keyframes[index].outline.points {
                let way: Vector = pose.transform(point.at) - here;
                let bearing = Heading::of(way).radians() - ahead.radians() - ring.first_bearing;
                let beam = libm::round(positive(bearing) / ring.spacing) as usize;
                if let Some(range) = scan.ranges.get_mut(beam % ring.beams.max(1) as usize) {
                    *range = range.min(way.norm());
                }
            }
        }
        Some(scan)
    }

    /// Returns the direction in which most surfaces run, up to quarter turns: the axis of the
    /// building. `None` before a surface was seen. O(keyframes).
    #[must_use]
    pub fn axis(&self) -> Option<Heading> {
        self.axis_of(0..self.keyframes.len())
    }

    /// Returns the direction of most surfaces visible near a keyframe, where the map's heading has
    /// drifted. Of the four quarter turns it is the one nearest to the [axis](Self::axis) of the
    /// building. `None` before any surface was seen. O(keyframes).
    #[must_use]
    pub fn axis_about(&self, keyframe: usize) -> Option<Heading> {
        let end = (keyframe + ABOUT + 1).min(self.keyframes.len());
        let here = self.axis_of(keyframe.saturating_sub(ABOUT).min(end)..end)?;
        let all = self.axis()?;
        let off = all.turn_to(here);
        let quarters = libm::round(off / FRAC_PI_2);
        Some(Heading::from_radians(
            all.radians() + off - quarters * FRAC_PI_2,
        ))
    }

    fn axis_of(&self, range: Range<usize>) -> Option<Heading> {
        let keyframes = self.keyframes[range.clone()]
            .iter()
            .zip(&self.graph.poses()[range]);
        let turned = keyframes.map(|(keyframe, pose)| {
            let four_times = Heading::from_radians(4.0 * pose.heading.radians());
            four_times.rotate(keyframe.axis)
        });
        let sum: Vector = turned.sum();
        let is_known = sum.norm() > 0.0;
        is_known.then(|| Heading::from_radians(0.25 * Heading::of(sum).radians()))
    }
}

/// Returns an angle from 0 to a full turn.
fn positive(angle: f64) -> f64 {
    angle - TAU * libm::floor(angle / TAU)
}
