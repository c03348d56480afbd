use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use thiserror::Error;
use tolman_control::epuck::{
    FEATURES, Forward, Pilot, PilotError, PlaceKind, Profile, ProfileError, SegmentConfig,
    SegmentError, Segments,
};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::cpm::{Bearings, Sighting};
use tolman_robot::epuck::PROXIMITY_SENSORS;
use tolman_robot::{Landmark, Robot, SensesLandmarks};

use super::calibration::{Reading, WheelCalibration};
use super::reckoned::{Calibrated, Reckoned};
use super::robot::CpmRobot;
use super::walker_config::{HeadingBy, WalkerConfig};

/// Walks fragments. This is the work of the lower layers between two decisions of layer 3, until
/// the next junction, dead end or landmark (section 4).
#[derive(Debug)]
pub struct Walker<B: CpmRobot> {
    pilot: Pilot<Reckoned<B>>,
    config: WalkerConfig,
    memory: Memory,
}

/// Memory of a walker between fragments.
#[derive(Clone, Debug, Default)]
struct Memory {
    /// Branches of the robot's present place, rad, counter-clockwise from the port of entry.
    branches: Vec<f64>,
    /// Positions after each stride since the robot set off, m, in the frame in which the walk
    /// began.
    trail: Vec<Point>,
    observations: u32,
    departed_us: u64,
    departed: Pose,
}

/// A [`Walker`] between fragments, without its robot.
#[derive(Clone, Debug)]
pub struct RestingWalker {
    memory: Memory,
    forward: Forward,
    pose: Pose,
    driven: f64,
    wheels: WheelCalibration,
}

/// One observation.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The 11-dimensional feature vector.
    pub feature: [f64; FEATURES],
    /// Feature vector of the same place for a robot that walks the other way.
    pub half_turned: [f64; FEATURES],
}

impl Observation {
    /// Returns the observation of the surroundings, for learning a common pattern; `None` if it has
    /// fewer than two ways.
    ///
    /// # Errors
    /// If the profile cannot be segmented.
    pub fn of(round: &Profile, features: &SegmentConfig) -> Result<Option<Self>, SegmentError> {
        let ahead = round.segments(features)?;
        let back = round.half_turned().segments(features)?;
        let nearest = ahead
            .segments()
            .iter()
            .map(|segment| segment.mean)
            .fold(0.0, f64::max);
        if ahead.ways() != 2 || nearest > TOO_NEAR {
            return Ok(None);
        }
        Ok(Some(Self {
            feature: ahead.feature(0.0)?,
            half_turned: back.feature(0.0)?,
        }))
    }
}

/// A walk to the end of a fragment.
#[derive(Clone, Debug, PartialEq)]
pub struct Walk {
    /// Observations on the way, up to the end or to the point where the robot turned round.
    pub observations: Vec<Observation>,
    /// Ways out of the place at the end, as glimpsed when it came into sight. They are numbered as
    /// if the robot entered it.
    pub glimpse: Option<Bearings>,
    /// Place at the end of the walk; `None` if the robot turned round and is back at its beginning.
    pub sighting: Option<Sighting>,
}

/// Knowledge of a fragment when the place at its end comes into sight.
#[derive(Clone, Debug, PartialEq)]
pub struct Prospect {
    /// Observations on the way.
    pub observations: Vec<Observation>,
    /// Ways out of the place as glimpsed, numbered as if the robot entered it.
    pub glimpse: Option<Bearings>,
    /// Landmark at the place, if any.
    pub landmark: Option<Landmark>,
}

/// Action when a place comes into sight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BeforePlace {
    /// Enter the place.
    Enter,
    /// Turn round, and go to the place at the other end of the fragment.
    TurnRound,
}

/// A walk along a fragment in progress.
struct Course {
    /// Middle of the place where the walk began; `None` in mid-fragment, or if the place was left
    /// long ago.
    origin: Option<Point>,
    /// Distance driven when the walk began, m.
    begun: f64,
    /// Landmark of the place behind, until it is no longer sensed.
    left: Option<Landmark>,
    track: Track,
    strides: u32,
    /// Number of strides still to drive without looking.
    skip: u32,
}

/// Thing that comes into sight ahead.
enum Ahead {
    Landmark {
        landmark: Landmark,
        /// Distance to its middle along the path, m.
        to_middle: f64,
    },
    Junction(View),
    DeadEnd(View),
}

/// View from one position of the robot.
struct View {
    profile: Profile,
    segments: Segments,
}

/// View of a place from its middle.
struct Seen {
    glimpse: Option<Bearings>,
    sighting: Sighting,
}

/// Positions where the robot looked, each with its observation if it saw a path.
type Track = Vec<(Point, Option<Observation>)>;

/// Returns the observations of a track.
///
/// A position without two ways gets the observation nearest to it. Leaving it out would shift all
/// later observations.
fn filled(track: &Track) -> Vec<Observation> {
    let seen = |index: usize| track.get(index).and_then(|(_, seen)| seen.clone());
    (0..track.len())
        .filter_map(|index| {
            let near = (0..track.len()).flat_map(|by| [index.checked_sub(by), Some(index + by)]);
            near.flatten().find_map(seen)
        })
        .collect()
}

/// Rotates `ways`, which are counter-clockwise, so that the one nearest to `direction` comes first.
fn count_from(direction: f64, ways: &mut [f64]) {
    let off = |way: &f64| Heading::from_radians(*way - direction).radians().abs();
    let numbered = ways.iter().enumerate();
    let nearest = numbered.min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b)));
    if let Some((first, _)) = nearest {
        ways.rotate_left(first);
    }
}

/// Returns the rotation of the ways relative to the robot's axes, rad, if they lead along two axes;
/// `None` for fewer than three ways.
///
/// It gives the heading in the middle of a crossing, which has no walls.
fn askew_of(segments: &Segments) -> Option<f64> {
    let (mut sine, mut cosine, mut count) = (0.0, 0.0, 0.0);
    for way in segments.spaces() {
        let (sin, cos) = libm::sincos(4.0 * way);
        (sine, cosine, count) = (sine + sin, cosine + cos, count + 1.0);
    }
    let agreement = libm::hypot(sine, cosine);
    (count >= 3.0 && agreement > 0.8 * count).then(|| libm::atan2(sine, cosine) / 4.0)
}

/// Returns whether two ways lead on, across each other.
fn is_bend(view: &View) -> bool {
    let ways: Vec<f64> = view.segments.spaces().collect();
    let [one, other] = ways[..] else { return false };
    let between = Heading::from_radians(one - other).radians().abs();
    (between - FRAC_PI_2).abs() < FRAC_PI_4
}

/// Standard deviations of a heading from walls, and from the ways out of a crossing, rad.
const BY_WALLS: f64 = 0.02;
const BY_WAYS: f64 = 0.1;

/// Maximum number of rounds to look for a junction's middle.
const ROUNDS: u32 = 4;

/// Radius of a junction, dead end or landmark, in corridor widths. Consecutive sightings of a
/// junction within it are one, and observations within it are not part of a fragment.
const PLACE: f64 = 0.6;

/// Minimum distance of two places, in corridor widths.
const APART: f64 = 0.5;

/// Distance from the first sighting of a landmark to its middle, in corridor widths. It is less
/// than half, because the lower layers turn in the middle before a wall.
const TO_LANDMARK: f64 = 0.4;

/// Maximum time of the drive to a landmark's middle, as a multiple of that of driving straight.
const MOST_TIME: f64 = 10.0;

/// Distance from the middle of a landmark, in corridor widths, beyond which a robot that still
/// senses it is at the next one.
const NEIGHBOUR: f64 = 0.8;

/// Distance in corridor widths within which no fragment leads back to the place where it began.
const ROUND: f64 = 2.0;

/// Distance from the middle of a place beyond which fragments are recorded, in corridor widths.
/// Nearer to it, its posts are in the way.
const TRIMMED: f64 = 0.8;

/// Distance before a junction's middle at which the junction comes into sight, in corridor widths.
const IN_SIGHT: f64 = 0.5;

/// Number of strides on a known way per stride that is not skipped. Two walks along one fragment
/// differ by less.
const SPREAD: u32 = 20;

/// Mean sensor value beyond which a wall is nearer than any beside the middle of a corridor. The
/// robot was then off its path.
const TOO_NEAR: f64 = 220.0;

/// Standard deviation of the wheels' errors, as a share, at which calibration ends.
///
/// A robot that measures its headings by walls turns in place before it sets off, until this is
/// reached or [`MOST_TURNS`] are made.
const CALIBRATED: f64 = 3e-3;
const MOST_TURNS: u32 = 12;

/// Change of a range that noise does not make, m. Several sensors must agree, since one may fail.
const ELSEWHERE: f64 = 0.03;
const LEAST_CHANGED: usize = 2;

/// Distance from the middle of a place within which the robot has reached it, m.
const NEAR: f64 = 0.015;

impl<B: CpmRobot> Walker<B> {
    /// Returns a walker at the pose of its body.
    pub fn new(body: B, config: WalkerConfig) -> Self {
        let resting = RestingWalker {
            memory: Memory::default(),
            forward: Forward::new(config.pilot.forward),
            pose: Pose::IDENTITY,
            driven: 0.0,
            wheels: WheelCalibration::UNKNOWN,
        };
        Self::wake(body, config, resting)
    }

    /// Continues with the robot, which must not have been moved since [`rest`](Self::rest).
    pub fn wake(body: B, config: WalkerConfig, resting: RestingWalker) -> Self {
        let calibrated = match config.heading {
            HeadingBy::Encoders => None,
            HeadingBy::Walls => Some(Calibrated::new(resting.wheels, *body.sensing())),
        };
        let reckoned = Reckoned {
            body,
            pose: resting.pose,
            driven: resting.driven,
            steps: 0,
            calibrated,
        };
        Self {
            pilot: Pilot::resume(reckoned, config.pilot.clone(), resting.forward),
            config,
            memory: resting.memory,
        }
    }

    /// Releases the robot and returns everything else.
    pub fn rest(self) -> RestingWalker {
        RestingWalker {
            forward: *self.pilot.forward(),
            pose: self.pose(),
            driven: self.driven(),
            wheels: self.wheels(),
            memory: self.memory,
        }
    }

    /// Returns the body.
    pub const fn body(&self) -> &B {
        &self.pilot.robot().body
    }

    /// Returns the body, so that it can be lifted.
    pub const fn body_mut(&mut self) -> &mut B {
        &mut self.pilot.robot_mut().body
    }

    /// Returns the believed pose, in the frame of its first pose.
    pub const fn pose(&self) -> Pose {
        self.pilot.robot().pose
    }

    /// Returns the calibration of its wheels.
    fn wheels(&self) -> WheelCalibration {
        let calibrated = &self.pilot.robot().calibrated;
        calibrated.map_or(WheelCalibration::UNKNOWN, |calibrated| calibrated.wheels)
    }

    /// Returns the standard deviation of its driven distance, as a share; 0 if its encoders are
    /// trusted as they are.
    pub fn uncertainty(&self) -> f64 {
        let calibrated = &self.pilot.robot().calibrated;
        calibrated.map_or(0.0, |calibrated| calibrated.wheels.uncertainty())
    }

    /// Returns the time since the robot was switched on, µs.
    pub fn time_us(&self) -> u64 {
        self.pilot.robot().sensing().time_us
    }

    /// Returns the number of time steps made since it was given the robot.
    pub fn steps(&self) -> u32 {
        self.pilot.robot().steps
    }

    /// Returns the number of observations the walker has made.
    pub const fn observations(&self) -> u32 {
        self.memory.observations
    }

    /// Returns the pose at which the robot had turned into its last fragment, in the walker's
    /// frame.
    pub const fn departed(&self) -> Pose {
        self.memory.departed
    }

    /// Returns the pose in `path`, one pose per step, at which the robot had turned into its last
    /// fragment.
    pub fn departed_at(&self, path: &[Pose]) -> Option<Pose> {
        let step = self.memory.departed_us / self.config.pilot.step_us;
        path.get(usize::try_from(step).ok()?).copied()
    }

    /// Returns the branches of its present place relative to its heading, rad, counter-clockwise
    /// from the way it came by.
    pub fn branches(&self) -> &[f64] {
        &self.memory.branches
    }

    /// Returns the distance driven so far, m.
    pub const fn driven(&self) -> f64 {
        self.pilot.robot().driven
    }

    /// Stands still for a time step and returns whether the robot was moved before it. It was if
    /// several sensors' readings are impossible at the same place.
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn was_moved(&mut self) -> WalkResult<bool, B> {
        let before = self.ranges();
        self.pilot.stand()?;
        let (Some(before), Some(after)) = (before, self.ranges()) else {
            return Ok(false);
        };
        let moved = before.iter().zip(after);
        let others = moved.filter(|(before, after)| (*before - after).abs() > ELSEWHERE);
        Ok(others.count() >= LEAST_CHANGED)
    }

    /// Returns the ranges of its sensors, m, at most their reach.
    fn ranges(&self) -> Option<[f64; PROXIMITY_SENSORS]> {
        let curve = &self.config.pilot.curve;
        let values = self.pilot.robot().sensing().proximity?;
        Some(values.map(|value| curve.range(value).unwrap_or(curve.reach())))
    }

    /// Returns a sweep of the present surroundings.
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn look_around(&mut self) -> WalkResult<Profile, B> {
        Ok(self.look()?.profile)
    }

    /// Returns the walker's configuration.
    pub const fn config(&self) -> &WalkerConfig {
        &self.config
    }

    /// Looks round and returns the robot's place. In mid-fragment it first drives to the next
    /// junction, dead end or landmark. "The robot continues moving forward until the first junction
    /// is found" (section 8).
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn begin(&mut self) -> WalkResult<Sighting, B> {
        let walk = self.set_off(|_| BeforePlace::Enter)?;
        walk.sighting.ok_or(WalkError::Lost)
    }

    /// Begins like [`begin`](Self::begin), and also returns the observations on the way; none if it
    /// starts at a place.
    ///
    /// When the place ahead comes into sight, `choose` decides what to do. If the robot turns
    /// round, only observations since then are returned.
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn set_off(
        &mut self,
        mut choose: impl FnMut(&Prospect) -> BeforePlace,
    ) -> WalkResult<Walk, B> {
        // The robot may have been carried here.
        self.pilot.stand()?;
        self.calibrate()?;
        let begun = self.pose().position;
        self.memory.trail.clear();
        self.memory.trail.push(begun);
        let view = self.look()?;
        let landmark = self.pilot.robot().landmark();
        let is_place = match view.segments.place() {
            PlaceKind::Junction => true,
            PlaceKind::DeadEnd => self.is_before_a_wall(&view.segments, 0.75),
            PlaceKind::Path | PlaceKind::Closed => false,
        };
        let seen = self.observation(&view)?;
        if is_place || landmark.is_some() {
            let place = self.settle(view, landmark)?;
            if place.sighting.degree != 2 || landmark.is_some() {
                return Ok(self.arrived(vec![(begun, seen)], place));
            }
            // It was a bend that looked like a junction.
            self.pilot.go_to(self.pose().inverse().transform(begun))?;
        }
        self.depart();
        let mut course = self.course(None, 0);
        course.track.push((begun, seen));
        loop {
            let Some(ahead) = self.stride(&mut course)? else {
                continue;
            };
            let middle = self.middle_ahead(&ahead);
            match choose(&self.prospect(&course, &ahead, middle)) {
                BeforePlace::Enter => {
                    if let Some(seen) = self.enter(&mut course, ahead)? {
                        return Ok(self.arrived(course.track, seen));
                    }
                }
                BeforePlace::TurnRound => {
                    self.pilot.turn(PI)?;
                    self.depart();
                    let back = self.course(Some(middle), 0);
                    return self.follow(back, None);
                }
            }
        }
    }

    /// Leaves by branch `number`, counted counter-clockwise from the port of entry, and follows the
    /// fragment to its end.
    ///
    /// The first `skip` strides are driven without looking. After `give_up_after` observations it
    /// turns round and comes back.
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn walk(
        &mut self,
        number: usize,
        skip: u32,
        give_up_after: Option<u32>,
    ) -> WalkResult<Walk, B> {
        let branch = *self
            .memory
            .branches
            .get(number)
            .ok_or(WalkError::NoBranch {
                number,
                branches: self.memory.branches.len(),
            })?;
        self.pilot.turn(branch)?;
        self.depart();
        let course = self.course(Some(self.pose().position), skip);
        self.follow(course, give_up_after)
    }

    fn depart(&mut self) {
        (self.memory.departed_us, self.memory.departed) = (self.time_us(), self.pose());
    }

    /// Returns a course from the place with its middle at `origin`, or from mid-fragment.
    fn course(&mut self, origin: Option<Point>, skip: u32) -> Course {
        let here = self.pose().position;
        self.memory.trail.clear();
        self.memory.trail.push(here);
        Course {
            origin,
            begun: self.driven() - origin.map_or(0.0, |origin| (here - origin).norm()),
            left: self.pilot.robot().landmark(),
            track: Track::new(),
            strides: 0,
            skip,
        }
    }

    fn follow(&mut self, mut course: Course, give_up_after: Option<u32>) -> WalkResult<Walk, B> {
        loop {
            if let Some(ahead) = self.stride(&mut course)? {
                if let Some(seen) = self.enter(&mut course, ahead)? {
                    return Ok(self.arrived(course.track, seen));
                }
            } else if give_up_after.is_some_and(|most| course.track.len() >= most as usize) {
                self.pilot.turn(PI)?;
                let back = self.course(None, 0);
                self.follow(back, None)?;
                return Ok(Walk {
                    observations: filled(&course.track),
                    glimpse: None,
                    sighting: None,
                });
            }
        }
    }

    /// Drives one stride along a fragment and looks, unless this stride is to be skipped. Returns
    /// what comes into sight, or `None` for the path.
    fn stride(&mut self, course: &mut Course) -> WalkResult<Option<Ahead>, B> {
        if course.strides >= self.config.longest_fragment {
            return Err(WalkError::Endless {
                strides: course.strides,
                metres: self.driven() - course.begun,
            });
        }
        self.pilot.follow(self.config.stride_s)?;
        self.memory.trail.push(self.pose().position);
        course.strides += 1;
        if course.strides <= course.skip {
            return Ok(None);
        }
        let driven = self.driven();
        let view = self.look()?;
        let landmark = self.pilot.robot().landmark();
        course.left = course.left.filter(|left| landmark == Some(*left));
        if let Some(landmark) = landmark
            && let Some(to_middle) = self.to_landmark(course, driven)
        {
            return Ok(Some(Ahead::Landmark {
                landmark,
                to_middle,
            }));
        }
        // While it senses the landmark that it left, it is at that landmark's place or at the next.
        let is_there = course.left.is_some() && self.tells_neighbours();
        let is_under_way = !is_there && self.is_beyond(course, driven, PLACE);
        match view.segments.place() {
            PlaceKind::Junction => {
                let middle = self.pose().transform(self.middle_of(&view));
                let is_next = is_under_way && !self.is_origin(course, driven, middle);
                return Ok(is_next.then_some(Ahead::Junction(view)));
            }
            PlaceKind::DeadEnd if is_under_way && self.is_before_a_wall(&view.segments, 0.75) => {
                return Ok(Some(Ahead::DeadEnd(view)));
            }
            // A way on may be hidden for a moment.
            PlaceKind::DeadEnd | PlaceKind::Closed | PlaceKind::Path => {}
        }
        if self.is_beyond(course, driven, TRIMMED) {
            let seen = self.observation(&view)?;
            course.track.push((self.pose().position, seen));
        }
        Ok(None)
    }

    /// Returns the distance to the middle of a landmark that is sensed, m; `None` if it is the one
    /// that the robot has left.
    fn to_landmark(&self, course: &Course, driven: f64) -> Option<f64> {
        let width = self.config.corridor_width;
        if course.left.is_none() {
            return Some(TO_LANDMARK * width);
        }
        let is_next = self.tells_neighbours() && self.is_beyond(course, driven, NEIGHBOUR);
        is_next.then_some(width - (driven - course.begun))
    }

    /// Returns whether a landmark seen beyond a place with the same landmark is that of another
    /// place. Ours: the paper's robot has one goal.
    fn tells_neighbours(&self) -> bool {
        self.config.heading == HeadingBy::Walls
    }

    /// Returns whether the origin of a course lies more than `widths` corridor widths back, after
    /// `driven` m in all.
    fn is_beyond(&self, course: &Course, driven: f64, widths: f64) -> bool {
        course.origin.is_none() || driven - course.begun > widths * self.config.corridor_width
    }

    /// Returns whether `middle` still belongs to the origin of a course: consecutive sightings of a
    /// junction are one. It does not once the course is long enough to return there.
    fn is_origin(&self, course: &Course, driven: f64, middle: Point) -> bool {
        let width = self.config.corridor_width;
        course.origin.is_some_and(|origin| {
            driven - course.begun < ROUND * width && (middle - origin).norm() < APART * width
        })
    }

    /// Enters the place in sight and returns it as seen from its middle; `None` if it is not a
    /// place.
    fn enter(&mut self, course: &mut Course, ahead: Ahead) -> WalkResult<Option<Seen>, B> {
        match ahead {
            Ahead::Landmark {
                landmark,
                to_middle,
            } => {
                self.drive_to_landmark(to_middle)?;
                let view = self.look()?;
                self.settle(view, Some(landmark)).map(Some)
            }
            Ahead::Junction(view) => {
                let driven = self.driven();
                let (here, observation) = (self.pose().position, self.observation(&view)?);
                let seen = self.settle(view, None)?;
                if seen.sighting.degree > 2 && !self.is_origin(course, driven, self.pose().position)
                {
                    return Ok(Some(seen));
                }
                // The robot continues from where it was, so that no part of the path is left out.
                self.pilot.go_to(self.pose().inverse().transform(here))?;
                if self.is_beyond(course, driven, TRIMMED) {
                    course.track.push((here, observation));
                }
                Ok(None)
            }
            Ahead::DeadEnd(view) => {
                let seen = self.settle(view, None)?;
                Ok((seen.sighting.degree == 1).then_some(seen))
            }
        }
    }

    /// Returns the observations, glimpse and landmark of a fragment before the robot enters the
    /// place at its end. The middle of that place is at `middle`.
    fn prospect(&self, course: &Course, ahead: &Ahead, middle: Point) -> Prospect {
        let (glimpse, landmark) = match ahead {
            Ahead::Landmark { landmark, .. } => (None, Some(*landmark)),
            Ahead::Junction(view) | Ahead::DeadEnd(view) => (self.glimpse(view), None),
        };
        Prospect {
            observations: self.up_to(course.track.clone(), middle),
            glimpse,
            landmark,
        }
    }

    /// Returns the estimated middle of the place in sight, in the frame of the robot's first pose.
    fn middle_ahead(&self, ahead: &Ahead) -> Point {
        self.pose().transform(match ahead {
            Ahead::Landmark { to_middle, .. } => Point::new(*to_middle, 0.0),
            Ahead::Junction(view) => self.middle_of(view),
            Ahead::DeadEnd(_) => self.before_the_wall(),
        })
    }

    /// Drives `way` m along the path, to near the middle of a landmark, or up to a wall.
    fn drive_to_landmark(&mut self, way: f64) -> WalkResult<(), B> {
        let begun = self.driven();
        let step_s = self.config.pilot.step_us as f64 * 1e-6;
        let needed = way / (self.config.pilot.forward.speed * step_s);
        let wall = 0.75 * self.config.corridor_width;
        // Turns in bends need time, too.
        for _ in 0..(MOST_TIME * needed) as u32 {
            if self.driven() - begun >= way || self.pilot.is_enclosed(wall) {
                break;
            }
            self.pilot.follow(step_s)?;
        }
        Ok(())
    }

    fn arrived(&self, track: Track, seen: Seen) -> Walk {
        Walk {
            observations: self.up_to(track, self.pose().position),
            glimpse: seen.glimpse,
            sighting: Some(seen.sighting),
        }
    }

    /// Returns the observations before the robot came to the place with this `middle`.
    fn up_to(&self, mut track: Track, middle: Point) -> Vec<Observation> {
        let trimmed = TRIMMED * self.config.corridor_width;
        while track
            .pop_if(|(position, _)| (*position - middle).norm() < trimmed)
            .is_some()
        {}
        filled(&track)
    }

    /// Returns the estimated middle of the junction in view, in the robot's frame.
    fn middle_of(&self, view: &View) -> Point {
        view.profile
            .meet_point(&self.config.pilot.curve, &self.config.meet_point)
    }

    /// Drives to the middle of the place in sight, and returns the place.
    fn settle(&mut self, mut view: View, landmark: Option<Landmark>) -> WalkResult<Seen, B> {
        let glimpse = self.glimpse(&view);
        let begun = self.pose().position;
        let stays = landmark.is_some() && self.tells_neighbours();
        for _ in 0..ROUNDS {
            let middle = match view.segments.place() {
                PlaceKind::Junction => self.middle_of(&view),
                // A landmark in a bend.
                PlaceKind::Path if stays && is_bend(&view) => self.middle_of(&view),
                PlaceKind::DeadEnd if self.is_before_a_wall(&view.segments, 1.1) => {
                    self.before_the_wall()
                }
                PlaceKind::DeadEnd | PlaceKind::Path | PlaceKind::Closed => break,
            };
            let from_begin = (self.pose().transform(middle) - begun).norm();
            // A junction farther away is beside the landmark, and not where it stands.
            let is_beside = stays && from_begin > APART * self.config.corridor_width;
            if is_beside || middle.coords.norm() < NEAR {
                break;
            }
            self.pilot.go_to(middle)?;
            view = self.look()?;
        }
        self.memory.branches = view.segments.spaces().collect();
        if let Some(entry) = self.entry(self.pose().position) {
            count_from(entry, &mut self.memory.branches);
        }
        if self.memory.branches.is_empty() {
            // Where the robot came in, it can get out.
            self.memory.branches.push(PI);
        }
        let sighting = Sighting {
            degree: self.memory.branches.len() as u32,
            landmark,
        };
        Ok(Seen { glimpse, sighting })
    }

    /// Returns the bearings of the visible ways out of the place ahead, from its middle.
    fn glimpse(&self, view: &View) -> Option<Bearings> {
        let middle = self.middle_of(view);
        let entry = self.entry(self.pose().transform(middle))?;
        let ways = view.segments.spaces().map(|way| {
            // A way begins at the edge of the place.
            let begins = Heading::from_radians(way).unit() * (PLACE * self.config.corridor_width);
            let from_middle = Point::from(begins) - middle;
            libm::atan2(from_middle.y, from_middle.x)
        });
        let mut ways: Vec<f64> = ways.collect();
        count_from(entry, &mut ways);
        Bearings::of_directions(&ways).ok()
    }

    /// Returns the bearings of the ways out of the present place, beginning with the one by which
    /// the robot came. `None` before it has come to a place.
    pub fn bearings(&self) -> Option<Bearings> {
        // The branches are already counter-clockwise.
        Bearings::of_directions(&self.memory.branches).ok()
    }

    /// Returns the direction of the way by which it came to a place, rad, relative to its heading.
    /// It is the direction of its last position outside.
    ///
    /// Behind a bend the robot may stand askew in the middle of a junction. Another branch is then
    /// nearer to straight behind.
    fn entry(&self, place: Point) -> Option<f64> {
        let width = self.config.corridor_width;
        let mut before = self.memory.trail.iter().rev();
        let outside = before.find(|point| (**point - place).norm() > PLACE * width)?;
        let here = self.pose().inverse();
        let back = here.transform(*outside) - here.transform(place);
        Some(libm::atan2(back.y, back.x))
    }

    /// Returns whether the only way out is the one behind, and the wall across the path is within
    /// `widths` corridor widths.
    fn is_before_a_wall(&self, segments: &Segments, widths: f64) -> bool {
        let near = widths * self.config.corridor_width;
        // In a bend, too, the robot may for a moment see only the way behind it.
        segments.spaces().all(|space| space.abs() > FRAC_PI_2) && self.pilot.is_enclosed(near)
    }

    /// Returns the middle of a dead end: half a corridor's width before the wall ahead.
    fn before_the_wall(&self) -> Point {
        let ahead = self.pilot.ahead().unwrap_or(self.config.corridor_width);
        Point::new(ahead - self.config.corridor_width / 2.0, 0.0)
    }

    fn look(&mut self) -> WalkResult<View, B> {
        let sweep = self.pilot.sweep()?;
        self.memory.observations += 1;
        let profile = Profile::of(&sweep, self.config.alignment)?;
        let segments = profile.segments(&self.config.segments)?;
        self.true_up(&profile, &segments);
        Ok(View { profile, segments })
    }

    /// Turns in place until the wheels' errors are known, if walls give a heading to measure them
    /// by.
    fn calibrate(&mut self) -> WalkResult<(), B> {
        for _ in 0..MOST_TURNS {
            if self.uncertainty() <= CALIBRATED {
                break;
            }
            let sweep = self.pilot.sweep()?;
            let profile = Profile::of(&sweep, self.config.alignment)?;
            let segments = profile.segments(&self.config.segments)?;
            self.true_up(&profile, &segments);
        }
        Ok(())
    }

    /// Removes the drift from the heading: walls stand at right angles, along the axes of the
    /// walker's frame.
    fn true_up(&mut self, profile: &Profile, segments: &Segments) {
        if self.config.heading == HeadingBy::Encoders {
            return;
        }
        let by_walls = profile.askew(&self.config.pilot.curve);
        let seen = match by_walls {
            Some(askew) => Some((askew, BY_WALLS)),
            None => askew_of(segments).map(|askew| (askew, BY_WAYS)),
        };
        if let Some((askew, deviation)) = seen {
            let walls = self.pose().heading.radians() + askew;
            let off = libm::round(walls / FRAC_PI_2) * FRAC_PI_2 - walls;
            let reading = Reading { off, deviation };
            self.pilot.robot_mut().correct(reading);
        }
    }

    /// Returns the number of strides from the middle of a place to within sight of the next, given
    /// the `observations` in between.
    #[must_use]
    pub fn strides(&self, observations: u32) -> u32 {
        // Between neighbouring places there are no observations, so their distance is unknown.
        if observations == 0 {
            return 0;
        }
        let stride = self.config.pilot.forward.speed * self.config.stride_s;
        let unwritten = (2.0 * TRIMMED - IN_SIGHT) * self.config.corridor_width;
        // The longer the way, the more its end varies.
        observations - observations / SPREAD + libm::floor(unwritten / stride) as u32
    }

    fn observation(&self, view: &View) -> WalkResult<Option<Observation>, B> {
        Ok(Observation::of(&view.profile, &self.config.features)?)
    }
}

/// Result of a walk of the body `B`, or the reason why it ended early.
pub type WalkResult<T, B> = Result<T, WalkError<<B as Robot>::Error>>;

/// Reason why a walk did not end at a place.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WalkError<E> {
    /// The robot cannot be driven.
    #[error(transparent)]
    Pilot(#[from] PilotError<E>),
    /// A sweep cannot be read.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A sweep cannot be segmented.
    #[error(transparent)]
    Segments(#[from] SegmentError),
    /// The place does not have that many branches.
    #[error(
        "branch {number} does not exist at a place of {branches}; count from 0, the way by which the robot came"
    )]
    NoBranch {
        /// Number of the branch that was asked for.
        number: usize,
        /// Number of branches.
        branches: usize,
    },
    /// The robot came to no junction, dead end or landmark.
    #[error(
        "no junction, dead end or landmark within {strides} strides, {metres:.0} m: the fragment may be longer, the \
         robot may be going round in an open room, or a sensor may fail; check the sensors and the maze"
    )]
    Endless {
        /// Number of strides driven.
        strides: u32,
        /// Length of these strides, m.
        metres: f64,
    },
    /// The robot turned back where it should not have.
    #[error("the robot does not know where it is; start it at a junction")]
    Lost,
}
