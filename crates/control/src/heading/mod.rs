use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use tolman_geom::Heading;
use tolman_robot::Scan;

mod straight_walls;

use straight_walls::{StraightWall, straight_walls};

/// A robot's own heading, from its wheels, the directions of the walls and, if it has one, a
/// compass or a gyro.
///
/// A Kalman filter of the heading and of the compass's error, which wanders as that of a gyro does.
/// Walls are landmarks at infinity: a straight wall is one of the known directions, or a new one.
/// The axes are known from the start, so that walls at right angles lie along them; a robot that
/// knows nothing of its heading takes the nearest. Which direction a wall has is weighed, not
/// decided (Y. Bar-Shalom and E. Tse: *Tracking in a cluttered environment with probabilistic data
/// association*, 1975).
///
/// ```
/// use tolman_control::{HeadingFilter, HeadingReadings};
/// use tolman_geom::Heading;
///
/// // A compass that is off by up to 5°, and wheels that turned by a quarter.
/// let mut filter = HeadingFilter::new(5_f64.to_radians());
/// let readings = |turn, degrees| HeadingReadings {
///     turn: Some(turn),
///     compass: Some(Heading::from_degrees(degrees)),
///     scan: None,
/// };
/// filter.step(&readings(0.0, 2.0));
/// let heading = filter.step(&readings(1.57, 92.5));
/// assert!((heading.radians().to_degrees() - 92.0).abs() < 0.5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingFilter {
    heading: Heading,
    /// Error of the compass, rad.
    bias: f64,
    /// Variances of heading and error, and their covariance, rad².
    variance: [f64; 2],
    covariance: f64,
    walls: Vec<KnownDirection>,
}

/// A direction along which walls lie.
#[derive(Clone, Copy, Debug, PartialEq)]
struct KnownDirection {
    along: f64,
    variance: f64,
}

/// Readings of a time step from which a [`HeadingFilter`] tells the heading.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeadingReadings<'a> {
    /// Turn since the step before by the wheels, rad.
    pub turn: Option<f64>,
    /// Heading by a compass or a gyro, whose zero may be anywhere.
    pub compass: Option<Heading>,
    /// Ranges to the walls.
    pub scan: Option<&'a Scan>,
}

/// Standard deviation of a turn by the wheels: as a share of it, and of every step, rad.
const TURN_SD: [f64; 2] = [0.05, 0.3 * PI / 180.0];
/// Standard deviation of a compass beside its error that wanders, and of that error's way in a time
/// step, rad.
const COMPASS_SD: f64 = 2.0 * PI / 180.0;
const WANDER_SD: f64 = 0.02 * PI / 180.0;
/// Standard deviation of an angle of which nothing is known, rad.
const UNKNOWN: f64 = PI;
/// Number of standard deviations above which a compass says that the robot was turned by others.
const LIFTED: f64 = 5.0;
/// Share of the straight walls that lie along no known direction.
const NEW: f64 = 0.1;

impl HeadingFilter {
    /// Returns the filter of a robot of which nothing is known, with a compass that is off by a
    /// constant of this standard deviation, rad; π where its zero may be anywhere.
    #[must_use]
    pub fn new(compass_sd: f64) -> Self {
        let axis = |along| KnownDirection {
            along,
            variance: 0.0,
        };
        Self {
            heading: Heading::EAST,
            bias: 0.0,
            variance: [UNKNOWN * UNKNOWN, compass_sd * compass_sd],
            covariance: 0.0,
            walls: [0.0, FRAC_PI_2].map(axis).to_vec(),
        }
    }

    /// Returns the heading.
    #[must_use]
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// Notes that the robot was lifted: it may look anywhere now.
    pub const fn put_down(&mut self) {
        self.variance[0] = UNKNOWN * UNKNOWN;
        self.covariance = 0.0;
    }

    /// Takes in a time step and returns the heading at its end. O(beams · log beams).
    pub fn step(&mut self, readings: &HeadingReadings<'_>) -> Heading {
        let turned = readings.turn;
        self.heading = self.heading.turned(turned.unwrap_or(0.0));
        let [share, each] = TURN_SD;
        let sd = turned.map_or(UNKNOWN, |turned| share * turned);
        self.variance[0] += sd * sd + each * each;
        self.variance[1] += WANDER_SD * WANDER_SD;
        if let Some(compass) = readings.compass {
            self.hear(compass);
        }
        if let Some(scan) = readings.scan {
            let mut walls = straight_walls(scan);
            walls.sort_by(|a, b| a.variance.total_cmp(&b.variance));
            for wall in walls {
                self.see(wall);
            }
        }
        self.heading
    }

    /// Corrects heading and error by a compass.
    fn hear(&mut self, compass: Heading) {
        let off = self.heading.turned(self.bias).turn_to(compass);
        let spread = |filter: &Self| {
            filter.variance[0]
                + 2.0 * filter.covariance
                + filter.variance[1]
                + COMPASS_SD * COMPASS_SD
        };
        if off * off > LIFTED * LIFTED * spread(self) {
            self.put_down();
        }
        let gains = [
            (self.variance[0] + self.covariance) / spread(self),
            (self.variance[1] + self.covariance) / spread(self),
        ];
        self.correct(gains, [1.0, 1.0], off, 1.0);
    }

    /// Corrects heading and error by the direction of a wall, which becomes known.
    fn see(&mut self, wall: StraightWall) {
        let along = self.heading.radians() + wall.along;
        let off = |known: &KnownDirection| libm::remainder(known.along - along, PI);
        if self.variance[0] > FRAC_PI_4 * FRAC_PI_4 {
            // Any of four headings is as good: the nearest.
            let nearest = self
                .walls
                .iter()
                .map(off)
                .min_by(|a, b| a.abs().total_cmp(&b.abs()));
            self.heading = self.heading.turned(nearest.unwrap_or(0.0));
            self.put_down();
            self.variance[0] = wall.variance;
            return;
        }
        let spread = |known: &KnownDirection| self.variance[0] + wall.variance + known.variance;
        let likelihood = |known: &KnownDirection| {
            let (off, spread) = (off(known), spread(known));
            libm::exp(-0.5 * off * off / spread) / libm::sqrt(2.0 * PI * spread)
        };
        let share = (1.0 - NEW) / self.walls.len() as f64;
        let all: f64 = self.walls.iter().map(likelihood).sum::<f64>() * share + NEW / PI;
        let likeliest = self
            .walls
            .iter()
            .max_by(|a, b| likelihood(a).total_cmp(&likelihood(b)));
        let Some(known) = likeliest.copied() else {
            return;
        };
        let weight = share * likelihood(&known) / all;
        if weight < NEW {
            self.walls.push(KnownDirection {
                along,
                variance: self.variance[0] + wall.variance,
            });
            return;
        }
        let gains = [self.variance[0], self.covariance].map(|part| part / spread(&known));
        self.correct(gains, [1.0, 0.0], off(&known), weight);
    }

    /// Applies a measurement of the sum of those parts that are `of`, which is `off`, with a
    /// probability of `weight` that it is one.
    fn correct(&mut self, gains: [f64; 2], of: [f64; 2], off: f64, weight: f64) {
        let [[a, c], [_, b]] = [
            [self.variance[0], self.covariance],
            [self.covariance, self.variance[1]],
        ];
        let seen = [of[0] * a + of[1] * c, of[0] * c + of[1] * b];
        // What the measurement takes from the variance, if it is one, and what not knowing adds.
        let doubt = weight * (1.0 - weight) * off * off;
        let change = |i: usize, j: usize| gains[i] * (gains[j] * doubt - weight * seen[j]);
        self.heading = self.heading.turned(weight * gains[0] * off);
        self.bias += weight * gains[1] * off;
        self.variance = [(a + change(0, 0)).max(0.0), (b + change(1, 1)).max(0.0)];
        self.covariance = c + change(0, 1);
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Point, Pose, Vector};
    use tolman_robot::Ring;

    use super::*;

    /// Walls as pairs of ends.
    type Walls = Vec<[Point; 2]>;

    /// Returns a room of a metre by 1.4 m, its middle at the origin.
    pub(super) fn room() -> Walls {
        turned_room(0.0)
    }

    fn turned_room(degrees: f64) -> Walls {
        let turn = Heading::from_degrees(degrees);
        let corners = [(0.5, 0.7), (-0.5, 0.7), (-0.5, -0.7), (0.5, -0.7)]
            .map(|(x, y)| Point::from(turn.rotate(Vector::new(x, y))));
        (0..4)
            .map(|at| [corners[at], corners[(at + 1) % 4]])
            .collect()
    }

    /// Returns what 72 beams see of walls.
    pub(super) fn scan(walls: &Walls, pose: Pose) -> Scan {
        let mut scan = Scan::clear(Ring::full(72, 1.25));
        let ring = scan.ring;
        for (beam, range) in (0..).zip(&mut scan.ranges) {
            let way = pose.heading.turned(ring.bearing(beam)).unit();
            for [from, to] in walls {
                let (wall, off) = (to - from, from - pose.position);
                let across = way.perp(&wall);
                let (far, on) = (off.perp(&wall) / across, off.perp(&way) / across);
                if far > 0.0 && (0.0..=1.0).contains(&on) {
                    *range = range.min(far);
                }
            }
        }
        scan
    }

    /// Returns the errors of the filter, degrees, of a robot that turns by `turn` a step in a room,
    /// with wheels that are off by 3 % and a compass that drifts by 0.02° a step from `off`.
    fn errors(walls: &Walls, compass_off: Option<f64>, turn: f64, compass_sd: f64) -> Vec<f64> {
        let mut filter = HeadingFilter::new(compass_sd);
        let mut truth = Heading::from_degrees(10.0);
        let step = |step: u32| {
            truth = truth.turned(if step == 0 { 0.0 } else { turn });
            let drift = f64::from(step) * 0.02;
            let scan = scan(walls, Pose::new(Point::new(0.05, 0.1), truth));
            let heading = filter.step(&HeadingReadings {
                turn: (step > 0).then_some(1.03 * turn),
                compass: compass_off.map(|off| truth.turned((off + drift).to_radians())),
                scan: Some(&scan),
            });
            truth.turn_to(heading).to_degrees()
        };
        (0..200).map(step).collect()
    }

    #[test]
    fn walls_keep_the_heading_of_a_gyro_that_drifts() {
        for error in errors(&room(), Some(3.0), 0.4, 0.1) {
            assert!(error.abs() < 1.5, "{error}");
        }
    }

    #[test]
    fn without_a_compass_a_heading_along_the_walls_is_kept() {
        for error in errors(&room(), None, 0.4, UNKNOWN) {
            assert!(error.abs() < 1.5, "{error}");
        }
    }

    #[test]
    fn a_zero_anywhere_is_one_of_four_headings() {
        let errors = errors(&room(), Some(123.0), 0.3, UNKNOWN);
        let quarter = (errors[0] / 90.0).round() * 90.0;
        for error in errors {
            assert!((error - quarter).abs() < 1.5, "{error} {quarter}");
        }
    }

    #[test]
    fn walls_askew_are_directions_of_their_own() {
        for error in errors(&turned_room(30.0), Some(0.0), 0.4, 0.05) {
            assert!(error.abs() < 5.0, "{error}");
        }
    }

    #[test]
    fn who_is_turned_by_others_believes_the_compass() {
        let mut filter = HeadingFilter::new(0.05);
        let readings = |degrees| HeadingReadings {
            turn: Some(0.0),
            compass: Some(Heading::from_degrees(degrees)),
            scan: None,
        };
        for _ in 0..20 {
            filter.step(&readings(5.0));
        }
        let heading = filter.step(&readings(140.0));
        assert!(
            (heading.radians().to_degrees() - 140.0).abs() < 4.0,
            "{heading:?}"
        );
    }
}
