use tolman_geom::{Heading, Interval, IntervalError, PointBox};

/// Sums up the odometry and the headings of a routine, within their bounds: the paper's "reasonable
/// bounds on relative position".
#[derive(Clone, Copy, Debug)]
pub struct Odometer {
    share: f64,
    heading_bound: f64,
    gone: PointBox,
}

impl Odometer {
    /// Returns an odometer. The wheels' error is at most `share` of the distance, 0 to 0.5; the
    /// compass's is at most `heading_bound`, rad.
    #[must_use]
    pub const fn new(share: f64, heading_bound: f64) -> Self {
        Self {
            share,
            heading_bound,
            gone: PointBox::ORIGIN,
        }
    }

    /// Begins a routine with no displacement.
    pub const fn begin(&mut self) {
        self.gone = PointBox::ORIGIN;
    }

    /// Takes in that the wheels rolled `distance`, m, while the heading turned from `before` to
    /// `after`, the short way round.
    ///
    /// # Errors
    /// [`IntervalError`] if a reading is not a number.
    pub fn roll(
        &mut self,
        distance: f64,
        before: Heading,
        after: Heading,
    ) -> Result<(), IntervalError> {
        if distance.abs() <= 0.0 {
            return Ok(());
        }
        let [near, far] = [1.0 + self.share, 1.0 - self.share].map(|scale| distance.abs() / scale);
        let way = Interval::new(near, far)?;
        self.add(if distance < 0.0 { -way } else { way }, before, after)
    }

    /// Takes in a time step without odometry: the robot was commanded `asked`, m, and went at most
    /// twice as far.
    ///
    /// # Errors
    /// [`IntervalError`] if `asked` is not a number.
    pub fn roll_unseen(
        &mut self,
        asked: f64,
        before: Heading,
        after: Heading,
    ) -> Result<(), IntervalError> {
        let way = Interval::new(0.0, 2.0 * asked.abs())?;
        self.add(if asked < 0.0 { -way } else { way }, before, after)
    }

    /// Adds an arc whose length lies within `way`.
    fn add(&mut self, way: Interval, before: Heading, after: Heading) -> Result<(), IntervalError> {
        let turned = before.turn_to(after);
        // The chord of an arc is a little shorter than the arc.
        let chord = (1.0 - turned * turned / 20.0).clamp(0.0, 1.0);
        let way = match way.low() < 0.0 {
            true => Interval::new(way.low(), way.high() * chord)?,
            false => Interval::new(way.low() * chord, way.high())?,
        };
        let start = before.radians();
        let headings = Interval::new(start.min(start + turned), start.max(start + turned))?;
        let headings = headings.widened(self.heading_bound)?;
        self.gone = self.gone + PointBox::new(way, Interval::ZERO).rotated(headings);
        Ok(())
    }

    /// Returns the displacement since the routine began, east and north, m.
    #[must_use]
    pub const fn moved(&self) -> PointBox {
        self.gone
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::{Point, Vector};

    use super::*;

    proptest! {
        /// The box holds the robot's position for all errors of wheels and compass within their
        /// bounds.
        #[test]
        fn the_true_way_is_inside_the_box(
            steps in prop::collection::vec((-0.1..0.1_f64, -0.2..0.2_f64, -1.0..1.0_f64, -1.0..1.0_f64, 0.0..1.0_f64), 1..60),
            start in -3.2..3.2_f64,
        ) {
            let (share, bound) = (0.1, 0.07);
            let mut odometer = Odometer::new(share, bound);
            odometer.begin();
            let (mut at, mut heading) = (Point::origin(), start);
            for (distance, turn, wrong, off, seen) in steps {
                let radius = if turn.abs() > 1e-9 { distance / turn } else { 0.0 };
                let chord = if radius.abs() > 0.0 { 2.0 * radius * (0.5 * turn).sin() } else { distance };
                let middle = heading + 0.5 * turn;
                at += Vector::new(chord * middle.cos(), chord * middle.sin());
                // One error of the compass for both ends of a step.
                let told = |heading: f64| Heading::from_radians(heading + off * bound);
                let (before, after) = (told(heading), told(heading + turn));
                // Some readings do not come, and then it went farther or less far than it was to.
                if seen < 0.1 {
                    odometer.roll_unseen(distance / (1.0 + wrong), before, after).unwrap();
                } else {
                    odometer.roll(distance * (1.0 + wrong * share), before, after).unwrap();
                }
                heading += turn;
            }
            prop_assert!(odometer.moved().contains(at), "{:?} {:?}", odometer.moved(), at);
        }
    }

    #[test]
    fn a_routine_begins_at_its_origin_and_no_number_is_refused() {
        let mut odometer = Odometer::new(0.1, 0.0);
        odometer.roll(1.0, Heading::EAST, Heading::EAST).unwrap();
        let moved = odometer.moved();
        assert!(moved.x.low() > 0.9 && moved.x.high() < 1.12, "{moved:?}");
        odometer.begin();
        assert_eq!(odometer.moved(), PointBox::ORIGIN);
        assert!(
            odometer
                .roll(f64::NAN, Heading::EAST, Heading::EAST)
                .is_err()
        );
    }
}
