use alloc::sync::Arc;
use core::convert::Infallible;

use rand::Rng;
use tolman_control::{Outcome, unit_of};
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::Direction;
use tolman_robot::{Guess, Mapper, Position, Robot, TurnTranslate};
use tolman_sim::robots::LaserPioneerConfig;
use tolman_systems::mslst::{ROBOT_UNIT, heading_free};
use tolman_systems::{Brain, Doing, TimeStep};

use super::{Oracle, Policy, perfect_robot};
use crate::course::Course;
use crate::episode_error::{EpisodeError, step_failed};

/// The ceiling for robots that do not know where they start. It has the true map, and finds its
/// place by a Bayes filter over all positions. Then it does what the [`Oracle`] would do at the
/// most likely one. Not in the paper.
///
/// The filter is exact on the positions of the policy's lattice. The heading is the compass's. A
/// completed action moves each position as the policy's noise-free robot moved, spread along the
/// direction of travel. If an action ends otherwise than that robot's, that is unlikely, but not
/// impossible.
#[derive(Clone, Debug)]
pub struct UnlocalizedOracle {
    chart: Arc<PlaceViews>,
    oracle: Oracle,
    /// The probability of each place of the chart.
    belief: Vec<f64>,
    heading: Heading,
    /// The previous action and its outcome; `None` before the first.
    last: Option<(Direction, Outcome)>,
}

/// Prior knowledge of the filter: every place of a course, and the view from it.
#[derive(Clone, Debug)]
pub struct PlaceViews {
    policy: Arc<Policy>,
    /// Positions where the robot can stand and from which a way leads to the destination.
    places: Vec<Standpoint>,
    /// The number of the place of each position of the policy's lattice.
    numbers: Vec<Option<u32>>,
    /// Standard deviation of a completed action's way, m.
    scatter: f64,
}

#[derive(Clone, Debug)]
struct Standpoint {
    position: Point,
    /// Ranges in robot units, beam 0 to the north.
    scan: Vec<f64>,
}

/// Factor on the probability of an action that ended otherwise than the noise-free robot's.
const SURPRISE: f64 = 0.02;

/// Standard deviation of a range from that at the nearest place, robot units. It is about half a
/// spacing of the lattice across, and half a beam beside.
const RANGE_SD: f64 = 0.15;

/// Number of standard deviations above which a beam has met another wall. A larger difference tells
/// nothing more.
const OUTLIER: f64 = 3.0;

/// Weight of all beams together, in independent beams: beams that see the same walls are
/// correlated.
const INDEPENDENT_BEAMS: f64 = 12.0;

impl PlaceViews {
    /// Looks round from every place of a course. A scan for each: about 2 µs per place.
    ///
    /// # Errors
    /// If the robot cannot be built for the course.
    pub fn new(
        course: &Course,
        robot: &LaserPioneerConfig,
        policy: Arc<Policy>,
    ) -> Result<Self, EpisodeError> {
        let mut solo = perfect_robot(course, robot)?;
        let mut places = Vec::new();
        let mut numbers = Vec::new();
        for position in policy.positions() {
            let stands = course.leads_on(position)
                && solo.place(Pose::new(position, Heading::NORTH)).is_ok();
            if !stands {
                numbers.push(None);
                continue;
            }
            // It was lifted here: one step at rest and it sees where it is.
            let rest = solo.step(&TurnTranslate::STOP);
            rest.map_err(|source| step_failed(0, source))?;
            let scan = solo.sensing().scan.as_ref();
            numbers.push(Some(places.len() as u32));
            places.push(Standpoint {
                position,
                scan: scan.map_or_else(Vec::new, |scan| heading_free(scan, Heading::NORTH)),
            });
        }
        let noise = robot.motor_noise.translate.relative_sd;
        Ok(Self {
            policy,
            places,
            numbers,
            // An action is two steps of half its way, each with noise of its own.
            scatter: noise * ACTION_WAY / core::f64::consts::SQRT_2,
        })
    }

    /// Returns the probability of seeing `scan` at a place, up to a constant factor.
    fn likelihood(&self, place: &Standpoint, scan: &[f64]) -> f64 {
        if scan.is_empty() || scan.len() != place.scan.len() {
            return 1.0;
        }
        let squares = scan.iter().zip(&place.scan).map(|(seen, expected)| {
            let deviation = ((seen - expected).abs() / RANGE_SD).min(OUTLIER);
            deviation * deviation
        });
        let mean = squares.sum::<f64>() / scan.len() as f64;
        libm::exp(-0.5 * INDEPENDENT_BEAMS * mean)
    }

    /// Returns the belief after an action that ended so.
    fn moved(
        &self,
        belief: &[f64],
        action: Direction,
        outcome: Outcome,
        heading: Heading,
    ) -> Vec<f64> {
        let mut after = vec![0.0; belief.len()];
        for (place, mass) in self.places.iter().zip(belief) {
            if *mass < NEGLIGIBLE {
                continue;
            }
            let from = Pose::new(place.position, heading);
            let expected = self.policy.end(from, action);
            let (end, mass) = match (outcome.moved(), expected) {
                (true, Some(end)) => (end, *mass),
                (true, None) => (
                    place.position + unit_of(action) * ACTION_WAY,
                    mass * SURPRISE,
                ),
                (false, None) => (place.position, *mass),
                (false, Some(_)) => (place.position, mass * SURPRISE),
            };
            if outcome.moved() {
                self.spread(end, action, mass, &mut after);
            } else if let Some(number) = self.number(end) {
                after[number as usize] += mass;
            }
        }
        after
    }

    /// Adds probability around an end, along the direction of travel.
    fn spread(&self, end: Point, action: Direction, mass: f64, after: &mut [f64]) {
        let step = unit_of(action) * SPREAD_STEP;
        for offset in -SPREAD_STEPS..=SPREAD_STEPS {
            let way = f64::from(offset) * SPREAD_STEP / self.scatter.max(SPREAD_STEP);
            if let Some(number) = self.number(end + step * f64::from(offset)) {
                after[number as usize] += mass * libm::exp(-0.5 * way * way);
            }
        }
    }

    fn number(&self, position: Point) -> Option<u32> {
        self.numbers[self.policy.position_index(position)]
    }
}

/// About a robot unit, m.
const ACTION_WAY: f64 = ROBOT_UNIT;

/// Step by which the end of an action is spread, m, and number of such steps.
const SPREAD_STEP: f64 = 0.06;
const SPREAD_STEPS: i32 = 6;

/// Probability below which places are not followed.
const NEGLIGIBLE: f64 = 1e-9;

impl UnlocalizedOracle {
    /// Returns an oracle that does not know its place yet.
    #[must_use]
    pub fn new(chart: Arc<PlaceViews>) -> Self {
        let count = chart.places.len();
        Self {
            oracle: Oracle::new(Arc::clone(&chart.policy)),
            belief: vec![1.0 / count.max(1) as f64; count],
            heading: Heading::NORTH,
            last: None,
            chart,
        }
    }

    /// Returns every place with its probability.
    pub fn probabilities(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        let places = self.chart.places.iter();
        let positions = places.map(|place| place.position);
        positions.zip(self.belief.iter().copied())
    }

    fn update(&mut self, seen: &TimeStep) {
        // Headed as it was when the action began, for what the action led to.
        if let Some((action, outcome)) = self.last {
            self.belief = self
                .chart
                .moved(&self.belief, action, outcome, self.heading);
        }
        self.heading = seen.heading.unwrap_or(self.heading);
        if let (Some(scan), Some(heading)) = (&seen.scan, seen.heading) {
            let scan = heading_free(scan, heading);
            for (place, mass) in self.chart.places.iter().zip(&mut self.belief) {
                if *mass >= NEGLIGIBLE {
                    *mass *= self.chart.likelihood(place, &scan);
                }
            }
        }
        self.normalize();
    }

    fn normalize(&mut self) {
        let sum: f64 = self.belief.iter().sum();
        if sum > 0.0 {
            for mass in &mut self.belief {
                *mass /= sum;
            }
        } else {
            // Nothing it could imagine fits: it begins again.
            let count = self.belief.len().max(1);
            self.belief.fill(1.0 / count as f64);
        }
    }

    /// Returns the most likely place. Of equally likely ones, it is the first.
    fn most_likely(&self) -> Option<Point> {
        let likelier = |best: (Point, f64), next: (Point, f64)| {
            if next.1 > best.1 { next } else { best }
        };
        self.probabilities().reduce(likelier).map(|(at, _)| at)
    }
}

impl Mapper for UnlocalizedOracle {
    type Observation = TimeStep;
    type Error = Infallible;

    fn observe(&mut self, seen: &TimeStep) -> Result<(), Infallible> {
        match seen.doing {
            Doing::UnderWay(_) => return Ok(()),
            Doing::PutDown => *self = Self::new(Arc::clone(&self.chart)),
            Doing::Ended(action, outcome) => self.last = Some((action, outcome)),
        }
        self.update(seen);
        Ok(())
    }

    fn belief(&self) -> Vec<Guess> {
        let guess = |(position, weight)| Guess {
            at: Position::Point(position),
            weight,
        };
        let mut guesses: Vec<Guess> = self.probabilities().map(guess).collect();
        guesses.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        guesses
    }
}

impl Brain for UnlocalizedOracle {
    fn choose(&mut self, _rng: &mut dyn Rng) -> Direction {
        let position = self.most_likely().unwrap_or_else(Point::origin);
        let pose = Pose::new(position, self.heading);
        self.oracle.choose(pose, self.last)
    }
}
