//! Reads corridors by ranges and compass.

use core::f64::consts::{FRAC_PI_2, TAU};

use tolman_geom::Heading;
use tolman_robot::{Compass, Ranges, Scan};

use super::{RoutineConfig, SenseError};

impl RoutineConfig {
    /// Returns half a corridor's width, m: the distance of a wall ahead from the middle of a cell.
    pub(super) const fn half(&self) -> f64 {
        0.5 * self.corridor_width
    }

    /// Returns whether a side with this range is open.
    pub(super) const fn is_open(&self, range: f64) -> bool {
        range > 0.75 * self.corridor_width
    }

    /// Returns whether a wall stands at this range.
    pub(super) const fn is_closed(&self, range: f64) -> bool {
        range < 0.75 * self.corridor_width
    }

    /// Returns whether the walls on both sides are as near to each other as a doorway's jambs.
    pub(super) fn is_narrow(&self, view: View) -> bool {
        let width = view.left + view.right;
        self.doorway_width
            .is_some_and(|doorway| width < 0.5 * (self.corridor_width + doorway))
    }

    /// Returns whether there is an opening on the left, one on the right, and a doorway.
    fn beside(&self, view: View) -> [bool; 3] {
        let [left, right] = [view.left, view.right].map(|range| self.is_open(range));
        [left, right, self.is_narrow(view)]
    }

    /// Returns a lower bound of the length of any opening or doorway, m.
    pub(super) const fn shortest(&self) -> f64 {
        0.25 * self.corridor_width
    }

    /// Returns the distance covered in one time step, m, which is also a jamb's greatest width.
    pub(super) const fn stride(&self) -> f64 {
        0.05 * self.corridor_width
    }
}

/// The laser's view along a corridor.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Range to the left, m.
    pub(super) left: f64,
    /// Range to the right, m.
    pub(super) right: f64,
    /// Range ahead, m.
    pub(super) ahead: f64,
    /// Heading of the robot.
    pub(super) heading: Heading,
}

/// Ranges around a robot, turned by its compass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around<'a> {
    scan: &'a Scan,
    heading: Heading,
}

impl<'a> Around<'a> {
    pub(super) fn of<S: Ranges + Compass>(sensing: &'a S) -> Result<Self, SenseError> {
        let heading = compass(sensing)?;
        let scan = round_scan(sensing)?;
        Ok(Self { scan, heading })
    }

    /// Returns the ranges to the left, to the right and ahead of a robot that looks `ahead`.
    pub(super) fn view(self, ahead: Heading) -> View {
        View {
            left: self.range(ahead.turned(FRAC_PI_2)),
            right: self.range(ahead.turned(-FRAC_PI_2)),
            ahead: self.range(ahead),
            heading: self.heading,
        }
    }

    /// Returns the range of the beam nearest to `direction`, m.
    fn range(self, direction: Heading) -> f64 {
        let bearing = self.heading.turn_to(direction);
        let range = self.scan.range_towards(bearing, 0);
        range.unwrap_or(self.scan.ring.max_range)
    }

    /// Returns the shortest range within `spread`, rad, of `heading`, m.
    pub(super) fn nearest(self, heading: Heading, spread: f64) -> f64 {
        let ring = &self.scan.ring;
        let beams = (0..ring.beams).zip(&self.scan.ranges).filter(|(beam, _)| {
            let looks = self.heading.turned(ring.bearing(*beam));
            looks.turn_to(heading).abs() <= spread
        });
        beams.map(|(_, range)| *range).fold(f64::INFINITY, f64::min)
    }
}

/// Returns the heading by the compass.
pub(super) fn compass<S: Compass>(sensing: &S) -> Result<Heading, SenseError> {
    let heading = sensing.heading();
    heading.ok_or(SenseError::Blind { sensor: "compass" })
}

/// Returns a scan whose beams are spread evenly over the full circle.
pub(super) fn round_scan<S: Ranges>(sensing: &S) -> Result<&Scan, SenseError> {
    let scan = sensing.scan();
    let scan = scan.ok_or(SenseError::Blind { sensor: "laser" })?;
    let (ring, ranges) = (&scan.ring, scan.ranges.len());
    let field = f64::from(ring.beams) * ring.spacing;
    let is_round = (field - TAU).abs() < 1e-6 && ranges == ring.beams as usize;
    if is_round {
        return Ok(scan);
    }
    Err(SenseError::NotRound {
        ranges,
        spacing_deg: ring.spacing.to_degrees(),
    })
}

/// Openings and doorways beside the way, which locate the next place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside([Span; 3]);

impl Beside {
    /// Returns the spans beside the robot at the start. They belong to the place just left.
    pub(super) fn at_start(view: View, gauge: &RoutineConfig) -> Self {
        Self(gauge.beside(view).map(Span::at_start))
    }

    /// Takes in that the robot turns back: what began now belongs to the place that it leaves.
    /// Returns whether the place to which it turns back is still beside it.
    pub(super) fn turn_back(&mut self) -> bool {
        let is_beside = self.0.contains(&Span::Left);
        for span in &mut self.0 {
            *span = Span::at_start(matches!(span, Span::Since(_)));
        }
        is_beside
    }

    /// Takes in `view` from `along` the way, m. Once the cause of a place has ended, returns the
    /// position of the place's middle along the way, m.
    pub(super) fn see(&mut self, view: View, along: f64, gauge: &RoutineConfig) -> Option<f64> {
        let spans = self.0.iter_mut().zip(gauge.beside(view));
        let middles = spans.map(|(span, there)| span.see(there, along, gauge.shortest()));
        middles.fold(None, Option::or)
    }
}

/// Something beside the way that begins and ends: an opening, a doorway.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Span {
    /// The opening was there from the start: it belongs to the place just left.
    Left,
    /// The opening is not there.
    Absent,
    /// The opening began at this distance along the way, m.
    Since(f64),
}

impl Span {
    /// Returns the middle of the span along the way, m, once it has ended.
    fn see(&mut self, there: bool, along: f64, shortest: f64) -> Option<f64> {
        match (*self, there) {
            (Self::Absent, true) => *self = Self::Since(along),
            (Self::Left | Self::Absent, false) => *self = Self::Absent,
            (Self::Since(start), false) => {
                *self = Self::Absent;
                // A beam that misses an edge for a moment makes no place.
                return (along - start > shortest).then_some(0.5 * (start + along));
            }
            (Self::Left | Self::Since(_), true) => {}
        }
        None
    }

    const fn at_start(there: bool) -> Self {
        if there { Self::Left } else { Self::Absent }
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::{LaserSensing, Ring};

    use super::*;

    #[test]
    fn a_fan_is_refused_and_a_ring_may_begin_anywhere() {
        let mut sensing = LaserSensing::silent(Ring::fan(181, 3.0, 8.0));
        sensing.compass = Some(Heading::NORTH);
        assert!(matches!(
            Around::of(&sensing),
            Err(SenseError::NotRound { ranges: 181, .. })
        ));
        let ring = Ring {
            first_bearing: FRAC_PI_2,
            ..Ring::full(4, 2.0)
        };
        let ranges = vec![0.1, 0.2, 0.3, 0.4];
        sensing.scan = Some(Scan { ring, ranges });
        let view = Around::of(&sensing).unwrap().view(Heading::NORTH);
        let seen = [view.left, view.right, view.ahead].map(|range| (10.0 * range) as u32);
        assert_eq!(seen, [1, 3, 4]);
    }

    #[test]
    fn what_began_ahead_is_left_behind_by_who_turns_back() {
        let mut ahead = Beside([Span::Since(1.0), Span::Absent, Span::Absent]);
        assert!(!ahead.turn_back());
        assert_eq!(ahead.0[0], Span::Left);
        let mut behind = Beside([Span::Left, Span::Absent, Span::Absent]);
        assert!(behind.turn_back());
    }

    #[test]
    fn a_span_has_a_middle_once_it_has_ended_and_was_long_enough() {
        let mut span = Span::at_start(true);
        assert_eq!(span.see(true, 0.1, 0.3), None);
        assert_eq!(span.see(false, 0.2, 0.3), None);
        assert_eq!(span.see(true, 1.0, 0.3), None);
        assert_eq!(span.see(false, 1.2, 0.3), None, "too short");
        assert_eq!(span.see(true, 2.0, 0.3), None);
        assert_eq!(span.see(false, 3.0, 0.3), Some(2.5));
    }
}
