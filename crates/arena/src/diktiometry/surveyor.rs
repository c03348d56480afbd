//! The robot of the paper's simulations: control routines that end at corners and doorways, and what it measures on the way.

use core::f64::consts::FRAC_PI_2;

use tolman_control::heading_of;
use tolman_geom::{Heading, IntervalError, Point, Pose};
use tolman_maps::diktiometry::{Signature, SignatureError};
use tolman_maze::Direction;
use tolman_robot::{CameraSensing, Odometry, Ring, Robot, TurnTranslate};
use tolman_sim::noise::{Bounded, Fault, Gaussian};
use tolman_sim::robots::{
    CameraPioneer, CameraPioneerConfig, CameraPioneerError, LaserPioneerConfig, MotorNoise,
};
use tolman_sim::{Contact, DoorError, DoorState, PlaceError, Solo, StepError};

use thiserror::Error;

use super::office::Office;
use super::rover::{Arrival, Odometer, RoutineOutcome, Rover};
use crate::pioneer::calibrated;

/// The robot and the bounds of its errors. Where the paper names no number, ours stand in [`SurveyorConfig::paper`].
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurveyorConfig {
    /// Body, laser and motors. Errors of compass and odometry are added to its own.
    pub pioneer: LaserPioneerConfig,
    /// What it tells places apart by.
    pub sight: Sight,
    /// The largest error of odometry as a share of the distance, 0 … 0.5. Paper: "about 10% of distance travelled".
    pub odometry_share: f64,
    /// The largest error of the compass, rad.
    pub compass_bound: f64,
    /// How many time steps an error of odometry or compass stays the same, at least 1. The longer, the less errors
    /// average out within a move; the worst case is the largest number there is: a calibration wrong all along.
    pub hold_steps: u32,
    /// How far from the middle of a place a control routine may stop, m.
    pub place_radius: f64,
}

/// What a robot tells places apart by.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Sight {
    /// The colours that a camera sees all round.
    Camera {
        /// Columns of the image.
        columns: u32,
        /// The standard deviation of each of its measurements, as a share of full light.
        colour_sd: f64,
    },
    /// The ranges of its laser, as shares of its reach.
    Laser {
        /// Columns that the beams are averaged to.
        columns: u32,
    },
}

impl SurveyorConfig {
    /// Odometry of 10 % and a compass of ± 4°, as the figures have them; an error lasts about as long as a move.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            pioneer: LaserPioneerConfig {
                ring: Ring::full(180, 4.0),
                motor_noise: MotorNoise {
                    turn: Gaussian::relative(0.1),
                    translate: Gaussian::relative(0.1),
                    drift_sd: 0.02,
                },
                contact: Contact::Slide,
                ..LaserPioneerConfig::noiseless()
            },
            sight: Sight::Camera {
                columns: 24,
                colour_sd: 0.02,
            },
            odometry_share: 0.1,
            compass_bound: 4_f64.to_radians(),
            hold_steps: 50,
            place_radius: 0.07,
        }
    }

    /// The robot of MSLST, with its motors and its ring of 72 beams, and the same bounds on odometry and compass.
    #[must_use]
    pub fn mslst() -> Self {
        Self {
            pioneer: calibrated(),
            sight: Sight::Laser { columns: 24 },
            place_radius: 0.1,
            ..Self::paper()
        }
    }

    fn robot(&self) -> CameraPioneerConfig {
        let bounded = |share: f64, offset: f64| {
            Fault::Bounded(Bounded {
                share,
                offset,
                steps: self.hold_steps,
            })
        };
        let mut pioneer = self.pioneer.clone();
        pioneer
            .faults
            .compass
            .push(bounded(0.0, self.compass_bound));
        let distance = &mut pioneer.faults.odometry_distance;
        distance.push(bounded(self.odometry_share, 0.0));
        let (columns, colour_sd) = match self.sight {
            Sight::Camera { columns, colour_sd } => (columns, colour_sd),
            // Nobody looks at it.
            Sight::Laser { .. } => (1, 0.0),
        };
        CameraPioneerConfig {
            columns,
            reach: 20.0,
            image: vec![Fault::Gaussian(Gaussian::absolute(colour_sd))],
            pioneer,
        }
    }
}

/// A robot that goes from place to place.
#[derive(Debug)]
pub struct Surveyor {
    config: SurveyorConfig,
    gauge: Gauge,
    solo: Solo<CameraPioneer>,
    /// Of the action under way.
    odometer: Odometer,
    /// Where it truly was at every step.
    path: Vec<Pose>,
}

/// Why a control routine cannot be carried out.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// The configuration has no sense.
    #[error("the surveyor's `{field}` is {value}; give {expected}")]
    Config {
        /// Which field.
        field: &'static str,
        /// What it says.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// The robot cannot be built.
    #[error("the robot cannot be built")]
    Robot(#[from] CameraPioneerError),
    /// The robot cannot stand where it is put.
    #[error("the robot cannot stand there")]
    Place(#[from] PlaceError),
    /// The simulator refuses a command.
    #[error("the simulator refuses a command")]
    Step(#[from] StepError),
    /// There is no such door.
    #[error("there is no such door")]
    Door(#[from] DoorError),
    /// A reading is no number.
    #[error("odometry is no number")]
    Reading(#[from] IntervalError),
    /// The camera's image is no signature.
    #[error("the image is no signature")]
    Signature(#[from] SignatureError),
    /// A sensor that the routines live on gave nothing.
    #[error("the {sensor} gave nothing; take a robot without drop-outs")]
    Blind {
        /// Which sensor.
        sensor: &'static str,
    },
    /// No place came in sight.
    #[error(
        "after {steps} time steps the way {direction} has led to no place; the robot stands at ({}, {}) m: lower the noise",
        at.x, at.y
    )]
    Lost {
        /// The way.
        direction: Direction,
        /// How long it took so far.
        steps: u32,
        /// Where the robot stands.
        at: Point,
    },
}

/// What the robot knows of the corridors, all in metres.
#[derive(Clone, Copy, Debug)]
struct Gauge {
    /// From wall to wall of a corridor.
    corridor: f64,
    /// From jamb to jamb of a doorway.
    doorway: f64,
}

impl Gauge {
    /// Half a corridor: how far from a wall ahead a robot in the middle of a cell stands.
    const fn half(self) -> f64 {
        0.5 * self.corridor
    }

    /// A corridor's side is open where nothing stands within this.
    const fn open(self) -> f64 {
        0.75 * self.corridor
    }

    /// Walls on both sides that are nearer to each other than this make a doorway.
    const fn narrow(self) -> f64 {
        0.5 * (self.corridor + self.doorway)
    }

    /// No opening and no doorway is shorter than this.
    const fn shortest(self) -> f64 {
        0.25 * self.corridor
    }

    /// Way covered in one time step, and the most that a jamb may be taken for.
    const fn stride(self) -> f64 {
        0.05 * self.corridor
    }
}

/// What a turn may miss, rad.
const ALIGNED: f64 = 0.02;
/// What need not be mended of where the robot stopped, m.
const SETTLED: f64 = 0.01;
/// How far to both sides of a direction a wall across it is looked for, rad.
const WALL: f64 = 0.4;
/// Time steps after which a routine is lost: the longest corridor of 60 cells.
const PATIENCE: u32 = 2000;

/// What the laser says of a corridor, seen along it.
#[derive(Clone, Copy, Debug)]
struct View {
    left: f64,
    right: f64,
    ahead: f64,
    heading: Heading,
}

/// How far the robot stands from the middle of a place, m.
#[derive(Clone, Copy, Debug)]
struct Offset {
    /// Too far ahead.
    along: f64,
    /// Too far to the left.
    aside: f64,
}

/// Something beside the way that begins and ends: an opening, a doorway.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Span {
    /// It was there from the start: it belongs to the place just left.
    Left,
    /// It is not there.
    Absent,
    /// It began so far along the way, m.
    Since(f64),
}

impl Span {
    /// Where the middle of the span is, once it has ended.
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

impl Surveyor {
    /// A robot at a place of an office. `seed` is that of all noise.
    ///
    /// # Errors
    /// [`SurveyError`] if the configuration has no sense or the robot cannot stand there.
    pub fn new(
        office: &Office,
        config: SurveyorConfig,
        at: Point,
        seed: u64,
    ) -> Result<Self, SurveyError> {
        let share = config.odometry_share;
        if !(0.0..=0.5).contains(&share) {
            return Err(SurveyError::Config {
                field: "odometry_share",
                value: share,
                expected: "a share from 0 to 0.5",
            });
        }
        let pose = Pose::new(at, Heading::NORTH);
        let furniture = office.config();
        let gauge = Gauge {
            corridor: furniture.corridor_width,
            doorway: furniture.doorway_width(),
        };
        let robot = CameraPioneer::new(config.robot())?;
        let solo = Solo::new(office.world().clone(), robot, pose, seed)?;
        Ok(Self {
            odometer: Odometer::new(share, config.compass_bound),
            config,
            gauge,
            solo,
            path: vec![pose],
        })
    }

    /// Where the robot truly was after each time step, for scoring and pictures.
    #[must_use]
    pub fn path(&self) -> &[Pose] {
        &self.path
    }

    /// Opens or shuts both leaves of a doorway.
    ///
    /// # Errors
    /// [`SurveyError::Door`] if there is none of that number.
    pub fn set_doorway(&mut self, number: usize, state: DoorState) -> Result<(), SurveyError> {
        for leaf in ["a", "b"] {
            let simulation = self.solo.simulation_mut();
            simulation.set_door(&format!("{number} {leaf}"), state)?;
        }
        Ok(())
    }

    /// Where the robot truly is, for scoring.
    #[must_use]
    pub fn position(&self) -> Point {
        self.solo.truth().pose.position
    }

    /// Turns in place.
    fn turn_to(&mut self, ahead: Heading) -> Result<(), SurveyError> {
        for _ in 0..PATIENCE {
            let turn = self.compass()?.turn_to(ahead);
            if turn.abs() < ALIGNED {
                break;
            }
            self.command(turn, 0.0)?;
        }
        Ok(())
    }

    /// Drives so far, keeping to the middle between the walls, and tells how far odometry says it went.
    fn drive(&mut self, ahead: Heading, view: View, distance: f64) -> Result<f64, SurveyError> {
        let gauge = self.gauge;
        let closed = |range: f64| range < gauge.open();
        // Metres to the right of the middle.
        let aside = match (closed(view.left), closed(view.right)) {
            (true, true) => 0.5 * (view.left - view.right),
            // It may be a jamb: little is made of one side alone.
            (true, false) => (view.left - gauge.half()).clamp(-gauge.stride(), gauge.stride()),
            (false, true) => (gauge.half() - view.right).clamp(-gauge.stride(), gauge.stride()),
            (false, false) => 0.0,
        };
        let lean = (4.0 * aside).clamp(-0.4, 0.4) * distance.signum();
        let turn = view.heading.turn_to(ahead.turned(lean));
        self.command(turn.clamp(-0.2, 0.2), distance)
    }

    /// One time step. Adds what odometry and compass say of it to the box of this action.
    fn command(&mut self, turn: f64, distance: f64) -> Result<f64, SurveyError> {
        let before = self.compass()?;
        let full = &self.config.pioneer;
        self.solo.step(&TurnTranslate {
            turn: turn / full.turn_per_step,
            translate: distance / full.translate_per_step,
        })?;
        self.path.push(self.solo.truth().pose);
        let after = self.compass()?;
        let Some(Odometry { distance, .. }) = self.solo.sensing().laser.odometry else {
            return Err(SurveyError::Blind { sensor: "odometry" });
        };
        self.odometer.roll(distance, before, after)?;
        Ok(distance)
    }

    /// Moves to the middle of the place, as far as walls and corners around it tell where that is.
    fn settle(&mut self, ahead: Heading) -> Result<(), SurveyError> {
        let Offset { along, .. } = self.offset(ahead)?;
        if along.abs() > SETTLED {
            let view = self.view(ahead)?;
            self.drive(ahead, view, -along)?;
        }
        let Offset { aside, .. } = self.offset(ahead)?;
        if aside.abs() > SETTLED {
            let left = ahead.turned(FRAC_PI_2);
            self.turn_to(left)?;
            self.command(0.0, -aside)?;
        }
        Ok(())
    }

    /// How far the robot stands from the middle of a place. Only distances to walls and corners are used, which no error of the
    /// compass changes: two corners that are equally far say that one stands between them.
    fn offset(&self, ahead: Heading) -> Result<Offset, SurveyError> {
        let nearest =
            |quarters: f64, spread: f64| self.nearest(ahead.turned(quarters * FRAC_PI_2), spread);
        let walls = [0.0, 1.0, 2.0, 3.0].map(|quarter| nearest(quarter, WALL));
        let corners = [0.5, 1.5, 2.5, 3.5].map(|quarter| nearest(quarter, 0.5 * FRAC_PI_2));
        let mut known = [0.0; 4];
        let mut edges = [0.0; 4];
        for (known, wall) in known.iter_mut().zip(walls) {
            *known = wall?;
        }
        for (edge, corner) in edges.iter_mut().zip(corners) {
            *edge = corner?;
        }
        let [front, left, back, right] = known;
        let [front_left, back_left, back_right, front_right] = edges;
        let half = self.gauge.half();
        let gauge = self.gauge;
        let closed = |range: f64| range < gauge.open();
        // Where both ends of an axis are open, the corners beside an open side tell; a doorway has none.
        let between = |far: f64, near: f64| (far * far - near * near) / (4.0 * half);
        let axis = |plus: f64, minus: f64, sides: [(f64, f64, f64); 2]| match (
            closed(plus),
            closed(minus),
        ) {
            (true, true) => 0.5 * (minus - plus),
            (true, false) => half - plus,
            (false, true) => minus - half,
            (false, false) => {
                let open = sides.into_iter().filter(|(side, ..)| !closed(*side));
                let open: Vec<f64> = open.map(|(_, far, near)| between(far, near)).collect();
                open.iter().sum::<f64>() / open.len().max(1) as f64
            }
        };
        let limit = |offset: f64| offset.clamp(-0.5 * half, 0.5 * half);
        Ok(Offset {
            along: limit(axis(
                front,
                back,
                [
                    (left, back_left, front_left),
                    (right, back_right, front_right),
                ],
            )),
            aside: limit(axis(
                left,
                right,
                [
                    (front, front_right, front_left),
                    (back, back_right, back_left),
                ],
            )),
        })
    }

    /// The shortest range within so many radians of a heading.
    fn nearest(&self, heading: Heading, spread: f64) -> Result<f64, SurveyError> {
        let compass = self.compass()?;
        let scan = self.solo.sensing().laser.scan.as_ref();
        let scan = scan.ok_or(SurveyError::Blind { sensor: "laser" })?;
        let beams = (0..scan.ring.beams).zip(&scan.ranges).filter(|(beam, _)| {
            let looks = compass.turned(scan.ring.bearing(*beam));
            looks.turn_to(heading).abs() <= spread
        });
        Ok(beams.map(|(_, range)| *range).fold(f64::INFINITY, f64::min))
    }

    /// What the routine ended with: a picture is taken standing still.
    fn arrive(&mut self, outcome: RoutineOutcome) -> Result<Arrival, SurveyError> {
        self.solo.step(&TurnTranslate::STOP)?;
        self.path.push(self.solo.truth().pose);
        let exits = self.exits()?;
        Ok(Arrival {
            outcome,
            moved: self.odometer.moved(),
            look: Some(self.sight()?),
            exits,
        })
    }

    /// What the place looks like: column 0 looks east.
    fn sight(&self) -> Result<Signature, SurveyError> {
        let heading = self.compass()?;
        let sensing = self.solo.sensing();
        let mut columns: Vec<Vec<f64>> = match self.config.sight {
            Sight::Camera { .. } => {
                let image = sensing.image.as_ref();
                let image = image.ok_or(SurveyError::Blind { sensor: "camera" })?;
                image.columns.iter().map(|column| column.to_vec()).collect()
            }
            Sight::Laser { columns } => {
                let scan = sensing.laser.scan.as_ref();
                let scan = scan.ok_or(SurveyError::Blind { sensor: "laser" })?;
                let beams = scan.ranges.len() / columns.max(1) as usize;
                let mean = |beams: &[f64]| {
                    let sum: f64 = beams.iter().sum();
                    vec![sum / (beams.len() as f64 * scan.ring.max_range)]
                };
                scan.ranges.chunks(beams.max(1)).map(mean).collect()
            }
        };
        let count = columns.len().max(1);
        let width = core::f64::consts::TAU / count as f64;
        let turn = libm::round(heading.radians() / width) as i64;
        columns.rotate_right(turn.rem_euclid(count as i64) as usize);
        let rows = columns.first().map_or(0, Vec::len);
        Ok(Signature::new(rows, columns.concat())?)
    }

    fn exits(&self) -> Result<[bool; 4], SurveyError> {
        let mut exits = [false; 4];
        for direction in Direction::ALL {
            let view = self.view(heading_of(direction))?;
            exits[direction.index()] = view.ahead > self.gauge.open();
        }
        Ok(exits)
    }

    fn compass(&self) -> Result<Heading, SurveyError> {
        let CameraSensing { laser, .. } = self.solo.sensing();
        laser
            .compass
            .ok_or(SurveyError::Blind { sensor: "compass" })
    }

    /// What stands ahead and to both sides of someone who looks `ahead`.
    fn view(&self, ahead: Heading) -> Result<View, SurveyError> {
        let heading = self.compass()?;
        let scan = self.solo.sensing().laser.scan.as_ref();
        let scan = scan.ok_or(SurveyError::Blind { sensor: "laser" })?;
        let beams = scan.ranges.len() as f64;
        let range = |direction: Heading| {
            let beam = libm::round(heading.turn_to(direction) / scan.ring.spacing);
            scan.ranges[beam.rem_euclid(beams) as usize]
        };
        Ok(View {
            left: range(ahead.turned(FRAC_PI_2)),
            right: range(ahead.turned(-FRAC_PI_2)),
            ahead: range(ahead),
            heading,
        })
    }
}

impl Rover for Surveyor {
    type Error = SurveyError;

    fn look(&mut self) -> Result<Arrival, SurveyError> {
        self.odometer.begin();
        self.arrive(RoutineOutcome::Completed)
    }

    /// Follows the corridor in a direction to the next corner or doorway: turns there, drives between the walls, and stops
    /// in the middle of whatever opens or narrows beside the way, or before a wall.
    fn go(&mut self, direction: Direction) -> Result<Arrival, SurveyError> {
        self.odometer.begin();
        let gauge = self.gauge;
        let ahead = heading_of(direction);
        self.turn_to(ahead)?;
        let view = self.view(ahead)?;
        if view.ahead < gauge.open() {
            return self.arrive(RoutineOutcome::Blocked);
        }
        let mut left = Span::at_start(view.left > gauge.open());
        let mut right = Span::at_start(view.right > gauge.open());
        let mut narrow = Span::at_start(view.left + view.right < gauge.narrow());
        let mut along = 0.0;
        let begun = self.path.len();
        loop {
            let view = self.view(ahead)?;
            let middles = [
                left.see(view.left > gauge.open(), along, gauge.shortest()),
                right.see(view.right > gauge.open(), along, gauge.shortest()),
                narrow.see(
                    view.left + view.right < gauge.narrow(),
                    along,
                    gauge.shortest(),
                ),
            ];
            if let Some(middle) = middles.into_iter().flatten().next() {
                // Beginning and end are noticed half a stride late.
                let middle = middle - 0.5 * gauge.stride();
                while along - middle > 0.2 * gauge.stride() {
                    along += self.drive(
                        ahead,
                        self.view(ahead)?,
                        -gauge.stride().min(along - middle),
                    )?;
                }
                self.settle(ahead)?;
                return self.arrive(RoutineOutcome::Completed);
            }
            let room = view.ahead - gauge.half();
            if room < 0.2 * gauge.stride() {
                self.settle(ahead)?;
                return self.arrive(RoutineOutcome::Completed);
            }
            along += self.drive(ahead, view, gauge.stride().min(room))?;
            let steps = (self.path.len() - begun) as u32;
            if steps > PATIENCE {
                return Err(SurveyError::Lost {
                    direction,
                    steps,
                    at: self.position(),
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use tolman_sim::abstract_world::{AbstractRobot, AbstractWorld, MoveError};

    use super::super::office::{OfficeConfig, TruePlace, blocks};
    use super::*;

    fn office(seed: u64, doorway_share: f64) -> Office {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let maze = blocks(6, 0.4, &mut rng);
        let config = OfficeConfig {
            doorway_share,
            colours: 5,
            seed,
            ..OfficeConfig::bare()
        };
        Office::new(&maze, &config).unwrap()
    }

    /// Walks at random, and at every arrival hands over the places left and reached, the arrival and the robot.
    fn walk(
        office: &Office,
        shut: &[usize],
        moves: u32,
        seed: u64,
        mut see: impl FnMut(&TruePlace, &TruePlace, &Arrival, &Surveyor),
    ) {
        let places = office.places(shut);
        let mut at = *places.first_key_value().unwrap().0;
        let config = SurveyorConfig::paper();
        let mut robot = Surveyor::new(office, config, places[&at].position, seed).unwrap();
        for number in shut {
            robot.set_doorway(*number, DoorState::Shut).unwrap();
        }
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        for _ in 0..moves {
            let direction = Direction::ALL[rng.random_range(0_u32..4) as usize];
            let arrival = robot.go(direction).unwrap();
            let way = places[&at].ways[direction.index()];
            let expected = match way {
                Some(_) => RoutineOutcome::Completed,
                None => RoutineOutcome::Blocked,
            };
            assert_eq!(
                arrival.outcome, expected,
                "{direction} of {:?}",
                places[&at]
            );
            let from = at;
            at = way.unwrap_or(at);
            see(&places[&from], &places[&at], &arrival, &robot);
        }
    }

    #[test]
    fn routines_end_at_the_true_places() {
        for (seed, doorways) in [(1, 0.0), (2, 0.3), (3, 1.0)] {
            let office = office(seed, doorways);
            walk(&office, &[], 300, seed, |_, to, arrival, robot| {
                let miss = (robot.position() - to.position).abs().max();
                assert!(miss < robot.config.place_radius, "{miss} m from {to:?}");
                assert_eq!(arrival.exits, to.ways.map(|way| way.is_some()), "{to:?}");
            });
        }
    }

    #[test]
    fn the_true_way_is_inside_the_box() {
        let office = office(4, 0.3);
        let mut widths = Vec::new();
        let places = office.places(&[]);
        let mut before = places.first_key_value().unwrap().1.position;
        walk(&office, &[], 300, 4, |from, to, arrival, robot| {
            let here = robot.position();
            let moved = here - before;
            before = here;
            assert!(
                arrival.moved.contains(Point::origin() + moved),
                "{moved:?} {arrival:?}"
            );
            let way = (to.position - from.position).norm();
            if way > 0.0 {
                widths.push(arrival.moved.width() / way);
            }
        });
        assert!(
            widths.iter().all(|width| *width < 0.45),
            "boxes say something: {widths:?}"
        );
    }

    /// The abstract world in which mappers are tried by the million offers them the same as the robot does.
    #[test]
    fn the_abstract_world_offers_the_same_statistics() {
        let office = office(8, 0.2);
        let config = SurveyorConfig::paper();
        let truth = office.places(&[]);
        let number: Vec<u32> = truth.keys().copied().collect();
        let place = |site: u32| number.binary_search(&site).unwrap() as u32;
        let positions = truth.values().map(|place| place.position).collect();
        let ways = truth
            .values()
            .map(|there| there.ways.map(|way| way.map(place)));
        let world = AbstractWorld::of_places(positions, ways.collect()).unwrap();
        let errors = MoveError {
            distance: config.odometry_share,
            compass: config.compass_bound,
            stop: 0.03,
            ..MoveError::NONE
        };
        let mut ghost = AbstractRobot::new(world.into(), 0, errors, 8).unwrap();

        // Of each move: how wide the box is and how wrong its middle, a metre of way.
        let (mut real, mut ghostly) = (Vec::new(), Vec::new());
        let mut before = truth.values().next().unwrap().position;
        walk(&office, &[], 600, 8, |from, to, arrival, robot| {
            let moved = robot.position() - before;
            before = robot.position();
            if from.site != to.site {
                let miss = arrival.moved.middle().coords - moved;
                real.push([arrival.moved.width(), miss.norm()].map(|x| x / moved.norm()));
            }
        });
        for _ in 0..real.len() {
            let direction = ghost.wander().unwrap();
            let gone = ghost.go(direction).unwrap();
            let told = gone.odometry.position;
            let miss = told.middle().coords - gone.truth;
            ghostly.push([told.width(), miss.norm()].map(|x| x / gone.truth.norm()));
        }
        let means = |all: &[[f64; 2]]| {
            [0, 1].map(|i| all.iter().map(|one| one[i]).sum::<f64>() / all.len() as f64)
        };
        let (real, ghostly) = (means(&real), means(&ghostly));
        for (real, ghostly) in real.into_iter().zip(ghostly) {
            let ratio = real / ghostly;
            assert!((0.75..1.33).contains(&ratio), "{real} and {ghostly}");
        }
    }

    #[test]
    fn a_shut_doorway_is_a_wall() {
        let office = office(5, 0.4);
        let shut: Vec<usize> = (0..office.doorways()).step_by(3).collect();
        walk(&office, &shut, 200, 5, |_, to, arrival, _| {
            assert_eq!(arrival.exits, to.ways.map(|way| way.is_some()));
        });
    }

    #[test]
    fn a_place_looks_the_same_from_wherever_one_comes() {
        let office = office(6, 0.2);
        let mut seen: Vec<(Point, Signature)> = Vec::new();
        walk(&office, &[], 300, 6, |_, to, arrival, _| {
            seen.push((to.position, arrival.look.clone().unwrap()));
        });
        let alike = |a: &Signature, b: &Signature| {
            let same = |column: &usize| {
                let mut pairs = a.column(*column).iter().zip(b.column(*column));
                pairs.all(|(a, b)| (a - b).abs() < 0.15)
            };
            (0..a.columns()).filter(same).count() as f64 / a.columns() as f64
        };
        let (mut same, mut other) = (Vec::new(), Vec::new());
        for (i, (here, a)) in seen.iter().enumerate() {
            for (there, b) in &seen[..i] {
                let near = (here - there).norm() < 1e-9;
                if near { &mut same } else { &mut other }.push(alike(a, b));
            }
        }
        let mean = |shares: &[f64]| shares.iter().sum::<f64>() / shares.len() as f64;
        assert!(mean(&same) > 0.8, "{}", mean(&same));
        assert!(mean(&other) < 0.45, "{}", mean(&other));
    }
}
