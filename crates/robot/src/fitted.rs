use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::Heading;

use crate::{
    Landmark, LaserMeasures, LaserSensing, MeasuresError, Odometry, Ring, Robot, RobotMeasures,
    Scan, SensesLandmarks, TurnTranslate,
};

/// A robot of any size that looks to a system like the one that the system is made for.
///
/// All lengths are multiplied by one number, such that corridors have the width that the system
/// knows. So a system needs no other number for another robot: in a world twice as large, a robot
/// twice as large makes the same run. The laser's beams become the system's: seen from the middle
/// of the axle, counter-clockwise from ahead. A gap in a wall that is narrower than one of the
/// system's beams counts as beams that were lost.
#[derive(Clone, Debug)]
pub struct Fitted<R> {
    robot: R,
    measures: RobotMeasures,
    made_for: MadeFor,
    sensing: LaserSensing,
}

/// Robot and corridors for which a system is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MadeFor {
    /// Width of its corridors from wall to wall, m.
    pub corridor_width: f64,
    /// Beams of its laser, all round.
    pub ring: Ring,
    /// Turn of the command `turn: 1.0` in a time step, rad.
    pub turn_per_step: f64,
    /// Distance of the command `translate: 1.0` in a time step, m.
    pub translate_per_step: f64,
    /// Duration of a time step, µs.
    pub step_us: u64,
}

/// Reason why a [`Fitted`] robot makes no step.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FittedError<E> {
    /// The robot failed.
    #[error(transparent)]
    Robot(#[from] E),
    /// The laser has another number of beams than its measures say.
    #[error("the laser gave {given} ranges, and its measures say {beams}; correct `laser.beams`")]
    Beams {
        /// Number of ranges in the reading.
        given: usize,
        /// Number of beams by the measures.
        beams: u32,
    },
    /// A reading is not a number.
    #[error("the robot's {sense} is not a finite number; leave out what it did not sense")]
    NotANumber {
        /// The sense.
        sense: &'static str,
    },
}

impl<R> Fitted<R>
where
    R: Robot<Command = TurnTranslate, Sensing: AsRef<LaserSensing>>,
{
    /// Returns `robot`, of these measures, as one that a system is made for. It senses nothing
    /// before its first step.
    ///
    /// # Errors
    /// If the measures contradict each other.
    pub fn new(
        robot: R,
        measures: RobotMeasures,
        made_for: MadeFor,
    ) -> Result<Self, MeasuresError> {
        measures.check()?;
        Ok(Self {
            robot,
            measures,
            made_for,
            sensing: LaserSensing::silent(made_for.ring),
        })
    }

    /// Returns the robot for which the system is made.
    #[must_use]
    pub const fn made_for(&self) -> MadeFor {
        self.made_for
    }

    /// Returns the length of the system's metre, m of the robot.
    #[must_use]
    pub fn metre(&self) -> f64 {
        self.measures.corridor_width / self.made_for.corridor_width
    }

    /// Returns the robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    /// Returns the robot's command for a command of the system. If one motion is longer than the
    /// robot can make in a step, both are shortened alike.
    fn command(&self, command: &TurnTranslate) -> TurnTranslate {
        let step = self.measures.step();
        let turn = command.turn * self.made_for.turn_per_step / step.turn;
        let way = command.translate * self.made_for.translate_per_step * self.metre();
        let translate = way / step.distance;
        let most = turn.abs().max(translate.abs()).max(1.0);
        TurnTranslate {
            turn: turn / most,
            translate: translate / most,
        }
    }

    fn sense(&mut self) -> Result<(), FittedError<R::Error>> {
        let sensed = self.robot.sensing().as_ref();
        let units = 1.0 / self.metre();
        let finite = |sense, is_finite| match is_finite {
            true => Ok(()),
            false => Err(FittedError::NotANumber { sense }),
        };
        if let Some(scan) = &sensed.scan {
            let (given, beams) = (scan.ranges.len(), self.measures.laser.beams);
            if given != beams as usize {
                return Err(FittedError::Beams { given, beams });
            }
            finite("laser", !scan.ranges.iter().any(|range| range.is_nan()))?;
        }
        finite("compass", sensed.compass.is_none_or(Heading::is_finite))?;
        let rolled = sensed.odometry;
        let is_finite = |rolled: Odometry| rolled.distance.is_finite() && rolled.turn.is_finite();
        finite("odometry", rolled.is_none_or(is_finite))?;
        let scan = sensed.scan.as_ref();
        self.sensing = LaserSensing {
            time_us: self.sensing.time_us + self.made_for.step_us,
            scan: scan.map(|scan| {
                around(
                    &scan.ranges,
                    &self.measures.laser,
                    units,
                    self.made_for.ring,
                )
            }),
            compass: sensed.compass,
            odometry: rolled.map(|rolled| Odometry {
                distance: rolled.distance * units,
                turn: rolled.turn,
            }),
            bump: sensed.bump,
        };
        Ok(())
    }
}

impl<R> Robot for Fitted<R>
where
    R: Robot<Command = TurnTranslate, Sensing: AsRef<LaserSensing>>,
{
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = FittedError<R::Error>;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
        self.robot.step(&self.command(command))?;
        let sensed = self.sense();
        if sensed.is_err() {
            self.robot.stop()?;
        }
        sensed
    }
}

impl<R> SensesLandmarks for Fitted<R>
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing: AsRef<LaserSensing>>,
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

/// Maximum ratio of the ranges of neighbouring beams that meet the same wall.
const ONE_WALL: f64 = 1.25;

/// A beam of a laser, seen from the middle of the axle.
#[derive(Clone, Copy)]
struct Beam {
    bearing: f64,
    /// Distance of what it met; `None` if it met nothing.
    range: Option<f64>,
}

/// Returns the reading of a `ring` in the middle of the axle, in the system's metres, from the
/// ranges of the robot's laser. There are `units` of these to a metre. O(beams).
fn around(ranges: &[f64], laser: &LaserMeasures, units: f64, ring: Ring) -> Scan {
    let mut scan = Scan::clear(ring);
    let mut beams: Vec<Beam> = beams(ranges, laser, units);
    if laser.ring().spacing < 0.0 {
        beams.reverse();
    }
    let count = beams.len();
    let met = |index: usize| beams.get(index % count).and_then(|beam| beam.range);
    // No more can lie within one of the system's beams.
    let most = libm::ceil(ring.spacing / laser.ring().spacing.abs()) as usize;
    for (index, one) in beams.iter().enumerate() {
        // Beams that were lost between two that met one wall.
        let others = 1..count.min(most + 1);
        let lost = others
            .take_while(|next| met(index + next).is_none())
            .count();
        let beyond = beams.get((index + lost + 1) % count).copied();
        let bridged = beyond.filter(|other| {
            let gap =
                Heading::from_radians(one.bearing).turn_to(Heading::from_radians(other.bearing));
            lost > 0 && gap <= ring.spacing && is_one_wall(*one, *other)
        });
        let next = beams.get((index + 1) % count).copied();
        if let Some(other) = bridged.or(next) {
            draw(&mut scan, *one, other);
        }
    }
    scan
}

/// Returns the beams in the laser's order.
fn beams(ranges: &[f64], laser: &LaserMeasures, units: f64) -> Vec<Beam> {
    let seen_by = laser.ring();
    let (x, y) = (laser.x * units, laser.y * units);
    let is_central = laser.x == 0.0 && laser.y == 0.0;
    let beam = |(index, range): (u32, &f64)| {
        let bearing = seen_by.bearing(index);
        let is_met = *range > 0.0 && *range >= laser.least_range && *range < laser.max_range;
        let range = range * units;
        if !is_met || is_central {
            return Beam {
                bearing,
                range: is_met.then_some(range),
            };
        }
        let (sin, cos) = libm::sincos(bearing);
        let (x, y) = (x + range * cos, y + range * sin);
        Beam {
            bearing: libm::atan2(y, x),
            range: Some(libm::hypot(x, y)),
        }
    };
    (0..).zip(ranges).map(beam).collect()
}

fn is_one_wall(one: Beam, other: Beam) -> bool {
    let (Some(one), Some(other)) = (one.range, other.range) else {
        return false;
    };
    one.max(other) <= ONE_WALL * one.min(other)
}

/// Draws what two neighbouring beams met into all beams of the scan between them.
fn draw(scan: &mut Scan, one: Beam, other: Beam) {
    let Ring {
        first_bearing,
        spacing,
        max_range,
        ..
    } = scan.ring;
    let [from, to] = [one, other].map(|beam| Heading::from_radians(beam.bearing));
    let between = from.turn_to(to);
    let count = scan.ranges.len() as f64;
    let first = libm::ceil((from.radians() - first_bearing) / spacing);
    let mut index = first;
    loop {
        let on = index * spacing - (from.radians() - first_bearing);
        if on > between {
            return;
        }
        let nearer = if 2.0 * on < between { one } else { other };
        let range = match (one.range, other.range) {
            (Some(a), Some(b)) if between > 0.0 && is_one_wall(one, other) => {
                // Where the ray meets the straight line from one to the other.
                let (sin_on, sin_rest) = (libm::sin(on), libm::sin(between - on));
                Some(a * b * libm::sin(between) / (a * sin_on + b * sin_rest))
            }
            _ => nearer.range,
        };
        let range = range.unwrap_or(max_range).min(max_range);
        if let Some(drawn) = scan
            .ranges
            .get_mut(libm::fmod(index + count, count) as usize)
        {
            *drawn = drawn.min(range);
        }
        index += 1.0;
    }
}
