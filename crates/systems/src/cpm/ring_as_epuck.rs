use core::f64::consts::TAU;

use thiserror::Error;
use tolman_control::epuck::RangeCurve;
use tolman_geom::Twist;
use tolman_robot::epuck::{
    BODY_RADIUS, EpuckSensing, PROXIMITY_SENSORS, TRACK, WHEEL_RADIUS, WheelSpeeds, WheelTurns,
    proximity_mounts,
};
use tolman_robot::{
    Clock, Landmark, Odometry, Ranges, Ring, Robot, Rolls, Scan, SensesLandmarks, TurnTranslate,
};

use super::walker_config::WalkerConfig;

/// Makes a robot with a ring of range beams look like an e-puck to CPM, at another scale.
///
/// All lengths are scaled so that its corridors look 0.25 m wide, like the e-puck's. Proximity
/// values come from the ring through the e-puck's response curve, encoder counts from odometry. The
/// ring has to cover a full circle and to reach farther than a corridor is wide.
#[derive(Clone, Debug)]
pub struct RingAsEpuck<R> {
    robot: R,
    measures: RingMeasures,
    curve: RangeCurve,
    sensing: EpuckSensing,
}

/// Measures of a robot with a ring that are needed to make it look like an e-puck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingMeasures {
    /// Width of the robot's corridors from wall to wall, m.
    pub corridor_width: f64,
    /// Radius of the robot's body, m.
    pub body_radius: f64,
    /// Turn made in one time step by the command `turn = 1`, rad.
    pub turn_per_step: f64,
    /// Distance covered in one time step by the command `translate = 1`, m.
    pub translate_per_step: f64,
    /// Length of the robot's time step, µs.
    pub step_us: u64,
    /// Minimum error to which a turn can be controlled, rad: half the motors' smallest turn.
    pub turn_tolerance: f64,
}

/// Width of an e-puck's corridors, m.
const EPUCK_WIDTH: f64 = 0.25;

/// Fastest turn while driving, rad per time step. It is slow enough to see where a bend ends.
const TURN_A_STEP: f64 = 0.05;

/// Clearances between body and wall in the e-puck's scale, m: where driving ahead stops, and how
/// much earlier it slows down.
const LEAST_ROOM: f64 = 0.01;
const SLOW_ROOM: f64 = 0.02;

/// Maximum ratio of the ranges of neighbouring beams that meet the same wall.
const ONE_WALL: f64 = 1.25;

/// Reason why a ring cannot stand in for an e-puck's sensors.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "the ring covers {round:.3} rad and reaches {reach} m: CPM needs a full circle and a reach beyond the width of a corridor, \
     {corridor_width} m"
)]
pub struct UnfitRing {
    /// Angle that the beams cover, rad.
    pub round: f64,
    /// Largest range, m.
    pub reach: f64,
    /// Width of the corridors in the configuration, m.
    pub corridor_width: f64,
}

impl RingMeasures {
    /// Returns the number of this robot's metres per metre of the e-puck.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.corridor_width / EPUCK_WIDTH
    }

    /// Returns the paper's parameters of driving and observing. They are limited to the speed that
    /// the time step allows and to the clearance that the body needs.
    #[must_use]
    pub fn walker_config(&self) -> WalkerConfig {
        let mut config = WalkerConfig::paper(RangeCurve::cpm(), self.step_us, EPUCK_WIDTH);
        let fastest = TURN_A_STEP / self.step_s();
        let (forward, keep_off) = (&mut config.pilot.forward, &mut config.pilot.keep_off);
        forward.turn = forward.turn.min(fastest);
        keep_off.turn = keep_off.turn.min(fastest);
        keep_off.least = self.body_radius / self.scale() - BODY_RADIUS + LEAST_ROOM;
        keep_off.margin = keep_off.least + SLOW_ROOM;
        config.pilot.turn_tolerance = self.turn_tolerance;
        config
    }

    fn step_s(&self) -> f64 {
        self.step_us as f64 * 1e-6
    }

    /// Returns the command that moves the robot as these wheel speeds would move an e-puck. If one
    /// motor would exceed its limit, both slow down, so that the path stays the same.
    fn command(&self, speeds: &WheelSpeeds) -> TurnTranslate {
        let rolled = [speeds.left, speeds.right].map(|speed| speed * WHEEL_RADIUS * self.step_s());
        let Twist { linear, angular } = Twist::of_wheels(rolled[0], rolled[1], TRACK);
        let turn = angular / self.turn_per_step;
        let translate = linear * self.scale() / self.translate_per_step;
        let slow = turn.abs().max(translate.abs()).max(1.0);
        TurnTranslate {
            turn: turn / slow,
            translate: translate / slow,
        }
    }

    /// Returns the turns that the e-puck's wheels would have made.
    fn encoders(&self, odometry: Odometry) -> WheelTurns {
        let linear = odometry.distance / self.scale();
        let apart = odometry.turn * TRACK / 2.0;
        WheelTurns {
            left: (linear - apart) / WHEEL_RADIUS,
            right: (linear + apart) / WHEEL_RADIUS,
        }
    }

    /// Returns the values that the e-puck's sensors would read by `curve`; `None` if the ring does
    /// not cover a full circle.
    fn proximity(&self, scan: &Scan, curve: &RangeCurve) -> Option<[f64; PROXIMITY_SENSORS]> {
        if !goes_round(&scan.ring) || scan.ranges.len() != scan.ring.beams as usize {
            return None;
        }
        // The e-puck's sensors look almost straight away from its middle, where the ring's beams
        // begin.
        Some(proximity_mounts().map(|mount| {
            let rim = mount.position.coords.norm();
            let range = range_at(scan, mount.heading.radians());
            let seen = range.map_or(f64::INFINITY, |range| range / self.scale() - rim);
            curve.value(seen)
        }))
    }
}

/// Returns whether a ring covers a full circle.
fn goes_round(ring: &Ring) -> bool {
    (f64::from(ring.beams) * ring.spacing - TAU).abs() < 1e-6
}

/// Returns the distance of the wall at a `bearing`, rad, from a full ring, m; `None` if there is
/// none within reach.
fn range_at(scan: &Scan, bearing: f64) -> Option<f64> {
    let beams = scan.ranges.len();
    let index = (bearing - scan.ring.first_bearing) / scan.ring.spacing;
    let below = libm::floor(index);
    let share = index - below;
    let beam = |index: f64| scan.ranges[index.rem_euclid(beams as f64) as usize % beams];
    let (one, other) = (beam(below), beam(below + 1.0));
    let nearer = if share < 0.5 { one } else { other };
    if nearer >= scan.ring.max_range {
        return None;
    }
    if one.max(other) > ONE_WALL * one.min(other) || one.max(other) >= scan.ring.max_range {
        return Some(nearer);
    }
    // Along a straight wall the inverse of the range is nearly a straight line.
    Some(1.0 / ((1.0 - share) / one + share / other))
}

impl<R> RingAsEpuck<R>
where
    R: Robot<Command = TurnTranslate>,
    R::Sensing: Ranges + Rolls + Clock,
{
    /// Returns `robot` as an e-puck.
    ///
    /// # Errors
    /// [`UnfitRing`] if its scan does not cover a full circle, or reaches no farther than a
    /// corridor is wide.
    pub fn new(robot: R, measures: RingMeasures) -> Result<Self, UnfitRing> {
        if let Some(Scan { ring, .. }) = robot.sensing().scan()
            && !(goes_round(ring) && ring.max_range > measures.corridor_width)
        {
            return Err(UnfitRing {
                round: f64::from(ring.beams) * ring.spacing,
                reach: ring.max_range,
                corridor_width: measures.corridor_width,
            });
        }
        let mut epuck = Self {
            robot,
            measures,
            curve: RangeCurve::cpm(),
            sensing: EpuckSensing::default(),
        };
        epuck.sense();
        Ok(epuck)
    }

    /// Returns the robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, so that it can be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    fn sense(&mut self) {
        let sensing = self.robot.sensing();
        self.sensing = EpuckSensing {
            time_us: sensing.time_us(),
            proximity: sensing
                .scan()
                .and_then(|scan| self.measures.proximity(scan, &self.curve)),
            encoders: sensing
                .odometry()
                .map(|odometry| self.measures.encoders(odometry)),
            bump: None,
        };
    }
}

impl<R> Robot for RingAsEpuck<R>
where
    R: Robot<Command = TurnTranslate>,
    R::Sensing: Ranges + Rolls + Clock,
{
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = R::Error;

    fn sensing(&self) -> &EpuckSensing {
        &self.sensing
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), R::Error> {
        self.robot.step(&self.measures.command(command))?;
        self.sense();
        Ok(())
    }
}

impl<R> SensesLandmarks for RingAsEpuck<R>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate>,
    R::Sensing: Ranges + Rolls + Clock,
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::epuck::MOST_WHEEL_SPEED;

    use super::*;

    fn measures() -> RingMeasures {
        RingMeasures {
            corridor_width: 1.0,
            body_radius: 0.25,
            turn_per_step: 0.5,
            translate_per_step: 0.2,
            step_us: 100_000,
            turn_tolerance: 0.01,
        }
    }

    /// Returns the scan of a wall straight across, `ahead` m in front of a robot that has turned by
    /// `turned` rad.
    fn wall(ahead: f64, turned: f64) -> Scan {
        let mut scan = Scan::clear(Ring::full(72, 2.0));
        for beam in 0..scan.ring.beams {
            let cos = (scan.ring.bearing(beam) + turned).cos();
            if cos > 0.0 && ahead / cos < 2.0 {
                scan.ranges[beam as usize] = ahead / cos;
            }
        }
        scan
    }

    #[test]
    fn what_it_would_roll_as_an_epuck_it_rolls_at_its_scale() {
        let measures = measures();
        let twist = Twist {
            linear: 0.05,
            angular: 0.3,
        };
        let speeds = WheelSpeeds::of_twist(twist, MOST_WHEEL_SPEED);
        let command = measures.command(&speeds);
        // 0.05 m/s at 4 times the size, for 0.1 s.
        assert!((command.translate * measures.translate_per_step - 0.02).abs() < 1e-12);
        assert!((command.turn * measures.turn_per_step - 0.03).abs() < 1e-12);
        let turns = measures.encoders(Odometry {
            distance: 0.02,
            turn: 0.03,
        });
        assert!((turns.left - speeds.left * 0.1).abs() < 1e-12);
        assert!((turns.right - speeds.right * 0.1).abs() < 1e-12);
        // Too fast for its motors: slower, on the same path.
        let fast = measures.command(&WheelSpeeds {
            left: 100.0,
            right: 120.0,
        });
        assert!((fast.translate - 1.0).abs() < 1e-12 && fast.turn > 0.0);
    }

    #[test]
    fn walls_read_as_the_epuck_would_read_them() {
        let measures = measures();
        let curve = RangeCurve::new(vec![(0.0, 1000.0), (0.25, 0.0)]).unwrap();
        for turned in [0.0, 0.02, 0.05, 0.3] {
            let values = measures.proximity(&wall(0.6, turned), &curve).unwrap();
            for (mount, value) in proximity_mounts().iter().zip(values) {
                let cos = (mount.heading.radians() + turned).cos();
                let range = 0.15 / cos - mount.position.coords.norm();
                let expected = if cos > 0.0 && 0.15 / cos < 0.5 {
                    curve.value(range)
                } else {
                    0.0
                };
                assert!((value - expected).abs() < 8.0, "{value} {expected}");
            }
        }
    }

    #[test]
    fn a_ring_that_is_too_short_or_has_a_gap_is_refused() {
        struct Still(tolman_robot::LaserSensing);
        impl Robot for Still {
            type Command = TurnTranslate;
            type Sensing = tolman_robot::LaserSensing;
            type Error = core::convert::Infallible;
            fn sensing(&self) -> &tolman_robot::LaserSensing {
                &self.0
            }
            fn step(&mut self, _command: &TurnTranslate) -> Result<(), Self::Error> {
                Ok(())
            }
        }
        for (ring, is_fit) in [
            (Ring::full(72, 1.1), true),
            (Ring::full(72, 0.9), false),
            (Ring::fan(181, core::f64::consts::PI, 8.0), false),
        ] {
            let still = Still(tolman_robot::LaserSensing::silent(ring));
            let epuck = RingAsEpuck::new(still, measures());
            assert_eq!(epuck.is_ok(), is_fit, "{ring:?}");
        }
    }

    #[test]
    fn a_ring_with_a_gap_reads_nothing() {
        let scan = Scan::clear(Ring::fan(181, core::f64::consts::PI, 8.0));
        assert_eq!(measures().proximity(&scan, &RangeCurve::cpm()), None);
    }
}
