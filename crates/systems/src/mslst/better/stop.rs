use core::f64::consts::FRAC_PI_4;

use tolman_geom::Heading;
use tolman_robot::Scan;

use crate::RolledStep;
use crate::lifts::{CONTRADICTING, contradiction};

/// Readings of the robot at the end of its last action, by which it notices a later lift.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    heading: Heading,
    scan: Scan,
}

/// Difference between a turn by compass and by odometry that is impossible without a lift, rad.
const UNEXPLAINED_TURN: f64 = FRAC_PI_4;

impl Stop {
    /// Returns the stop with these readings, or `None` if one is missing.
    pub(super) fn of(heading: Option<Heading>, scan: Option<&Scan>) -> Option<Self> {
        Some(Self {
            heading: heading?,
            scan: scan?.clone(),
        })
    }

    /// Returns whether the robot was lifted before the time step `seen`, the first since it
    /// stopped. `seen` holds the scan at its end. The compass then contradicts the wheels, or a
    /// scan has walls where the other sees through. In contact the wheels may spin or slip, so they
    /// contradict nothing. O(beams).
    pub(super) fn was_left_by_a_lift(&self, seen: &RolledStep, scan: Option<&Scan>) -> bool {
        let rolled = seen.odometry.filter(|_| seen.bump != Some(true));
        let (Some(heading), Some(odometry)) = (seen.step.heading, rolled) else {
            return false;
        };
        let turned = self.heading.turn_to(heading);
        let unexplained = Heading::from_radians(turned - odometry.turn).radians();
        if unexplained.abs() > UNEXPLAINED_TURN {
            return true;
        }
        let Some(scan) = scan else {
            return false;
        };
        let moved = self.heading.turned(0.5 * turned).unit() * odometry.distance;
        contradiction((scan, heading), (&self.scan, self.heading), moved) > CONTRADICTING
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::{Odometry, Ring};

    use super::*;
    use crate::{Doing, TimeStep};

    /// Distances of the walls around the robot, to the east, north, west and south, m.
    type Walls = [f64; 4];

    const STILL: Odometry = Odometry {
        distance: 0.0,
        turn: 0.0,
    };
    const DEAD_END: Walls = [0.5, 0.5, 4.0, 0.5];

    fn scan([east, north, west, south]: Walls, heading: Heading) -> Scan {
        let ring = Ring::full(72, 1.25);
        let range = |beam| {
            let way = heading.turned(ring.bearing(beam)).unit();
            let along = if way.x > 0.0 { east } else { west } / way.x.abs().max(1e-9);
            let across = if way.y > 0.0 { north } else { south } / way.y.abs().max(1e-9);
            along.min(across).min(ring.max_range)
        };
        let ranges = (0..ring.beams).map(range).collect();
        Scan { ring, ranges }
    }

    /// Returns whether a robot thinks that it was lifted. It stopped between the walls `before`,
    /// looking east. Now it senses `now`, looking `heading`, and has moved by odometry, perhaps
    /// against a wall.
    fn was_lifted(
        before: Walls,
        now: Walls,
        heading: Heading,
        wheels: Odometry,
        bump: bool,
    ) -> bool {
        let stop = Stop::of(Some(Heading::EAST), Some(&scan(before, Heading::EAST))).unwrap();
        let now = scan(now, heading);
        let step = TimeStep {
            scan: Some(now.clone()),
            heading: Some(heading),
            landmark: None,
            doing: Doing::UnderWay(tolman_maze::Direction::East),
        };
        let seen = RolledStep {
            step,
            odometry: Some(wheels),
            bump: Some(bump),
        };
        stop.was_left_by_a_lift(&seen, Some(&now))
    }

    #[test]
    fn what_the_wheels_explain_is_no_lift() {
        let back = Odometry {
            distance: -0.25,
            ..STILL
        };
        let farther = [0.75, 0.5, 3.75, 0.5];
        assert!(!was_lifted(DEAD_END, farther, Heading::EAST, back, false));
        let round = Odometry { turn: 1.6, ..STILL };
        assert!(!was_lifted(
            DEAD_END,
            DEAD_END,
            Heading::NORTH,
            round,
            false
        ));
    }

    #[test]
    fn a_turn_that_the_wheels_do_not_know_of_is_a_lift() {
        assert!(was_lifted(DEAD_END, DEAD_END, Heading::NORTH, STILL, false));
    }

    #[test]
    fn wheels_that_spin_against_a_wall_tell_of_no_lift() {
        let facing = [0.5, 4.0, 4.0, 4.0];
        let back = Odometry {
            distance: -0.9,
            ..STILL
        };
        for bump in [false, true] {
            // By the wheels it left the wall, which is as near as before.
            let is_lift = was_lifted(facing, facing, Heading::EAST, back, bump);
            assert_eq!(is_lift, !bump);
        }
    }

    #[test]
    fn walls_where_none_were_are_a_lift() {
        let elsewhere = [0.5, 4.0, 0.5, 4.0];
        assert!(was_lifted(DEAD_END, elsewhere, Heading::EAST, STILL, false));
        assert!(was_lifted(elsewhere, DEAD_END, Heading::EAST, STILL, false));
    }
}
