use core::f64::consts::TAU;

use tolman_robot::{Bumps, Robot, Rolls, Soundings, TurnTranslate};

use super::{GoAhead, LegEnd, LegStep, NearLimits, StopAtBump, StopNear};

/// Parameters of driving until something is near.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct UntilNearConfig {
    /// Minimum distances of things.
    pub limits: NearLimits,
    /// Factor, at least 1, by which all must be farther than its limit for the way to be clear.
    /// Ours: 1.25, so that a leg does not end where it began.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub margin: f64,
    /// Fraction of the full speed driven at, 0 … 1.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub translate: f64,
    /// Fraction of the full turn rate turned at, 0 … 1.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub turn: f64,
    /// Maximum number of time steps of a leg.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_one")
    )]
    pub longest_leg: u32,
    /// Maximum number of time steps of a turn.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_one")
    )]
    pub longest_turn: u32,
}

impl UntilNearConfig {
    /// Returns the paper's thresholds, on a robot that turns by some 0.2 rad and drives some 0.04 m
    /// in a time step at full rate. The paper gives no speeds and no bounds.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            limits: NearLimits::paper(),
            margin: 1.25,
            translate: 1.0,
            turn: 0.75,
            longest_leg: 500,
            longest_turn: 200,
        }
    }
}

/// Drives a robot straight on until something is near, and turns it until the way is clear.
#[derive(Clone, Debug)]
pub struct UntilNear {
    config: UntilNearConfig,
    near: StopNear,
    bump: StopAtBump,
}

/// Way in which a turn ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnEnd {
    /// The way ahead is clear.
    Clear,
    /// The way is clear in no direction.
    Enclosed,
    /// The body touched something whichever way it turned.
    Wedged,
}

/// End of a turn by an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnByEnd {
    /// The robot has turned by the whole angle, or took the maximum number of time steps.
    Turned,
    /// The body touched something, and the robot went free of it.
    Touched,
}

/// Number of reversals of a robot that touches something after which it counts as wedged.
const MOST_REVERSALS: u32 = 4;

impl UntilNear {
    /// Returns a driver without readings.
    #[must_use]
    pub fn new(config: UntilNearConfig) -> Self {
        Self {
            near: StopNear::new(config.limits),
            bump: StopAtBump::default(),
            config,
        }
    }

    /// Multiplies all thresholds by `share`, 0 … 1, from now on; 1 for the thresholds themselves.
    pub const fn give_way(&mut self, share: f64) {
        self.near.give_way(share);
    }

    /// Sets the limit ahead to `share` of its full value, 0 … 1, from now on. The limits beside
    /// stay the same.
    pub fn limit_ahead(&mut self, share: f64) {
        let limits = self.config.limits;
        self.near.limit(NearLimits {
            ahead: limits.ahead * share,
            ..limits
        });
    }

    /// Drives straight on until something is near or touched, or the leg takes too long. O(sensors)
    /// a time step.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn drive<R>(&mut self, robot: &mut R) -> Result<LegEnd, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Soundings + Bumps,
    {
        self.bump.begin();
        for _ in 0..self.config.longest_leg {
            let LegStep { command, ends } = self.propose(robot.sensing());
            if let Some(end) = ends {
                return Ok(end);
            }
            robot.step(&command)?;
        }
        Ok(LegEnd::TooLong)
    }

    /// Returns the layers' decision for this time step.
    fn propose(&mut self, sensing: &(impl Soundings + Bumps)) -> LegStep {
        let translate = self.config.translate;
        let ahead = GoAhead { translate }.propose();
        let near = self.near.correct(ahead, sensing);
        self.bump.correct(near, sensing)
    }

    /// Turns in place by at least `angle`, rad, counter-clockwise, and on until the way ahead is
    /// clear; by one more turn at most. Where the body touches something it turns the other way.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn turn<R>(&mut self, robot: &mut R, angle: f64) -> Result<TurnEnd, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Soundings + Rolls + Bumps,
    {
        let mut command = TurnTranslate {
            turn: self.config.turn * if angle < 0.0 { -1.0 } else { 1.0 },
            translate: 0.0,
        };
        let (mut turned, mut reversals) = (0.0, 0);
        for _ in 0..self.config.longest_turn {
            robot.step(&command)?;
            let sensing = robot.sensing();
            self.near.take_in(sensing);
            turned += sensing.odometry().map_or(0.0, |rolled| rolled.turn.abs());
            if turned >= angle.abs() && self.near.is_clear(self.config.margin) {
                return Ok(TurnEnd::Clear);
            }
            if turned >= angle.abs() + TAU {
                return Ok(TurnEnd::Enclosed);
            }
            if sensing.bump() == Some(true) {
                command.turn = -command.turn;
                reversals += 1;
            }
            if reversals > MOST_REVERSALS {
                return Ok(TurnEnd::Wedged);
            }
        }
        Ok(TurnEnd::Enclosed)
    }

    /// Backs off by `steps` time steps, at half the speed of a leg.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn back_off<R>(&mut self, robot: &mut R, steps: u32) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Soundings,
    {
        let back = -0.5 * self.config.translate;
        creep(robot, back, steps, |sensing| self.near.take_in(sensing))
    }

    /// Turns in place by `angle`, rad, counter-clockwise, and no farther, by odometry, whatever is
    /// near. Where the body touches something it [goes free](Self::go_free) of that instead.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn turn_by<R>(&self, robot: &mut R, angle: f64) -> Result<TurnByEnd, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Soundings + Rolls + Bumps,
    {
        let (mut turned, mut per_command) = (0.0, None);
        for _ in 0..MOST_TURN_STEPS {
            let left: f64 = angle - turned;
            if left.abs() < NEAR_ENOUGH || left * angle < 0.0 {
                break;
            }
            let most = self.config.turn;
            // Before the first step it is unknown how far a full command turns the robot.
            let wanted =
                per_command.map_or(FIRST_COMMAND, |rate: f64| (left.abs() / rate).min(most));
            let command = TurnTranslate {
                turn: wanted.min(most) * left.signum(),
                translate: 0.0,
            };
            robot.step(&command)?;
            if robot.sensing().bump() == Some(true) {
                self.go_free(robot, STEPS_FREE)?;
                return Ok(TurnByEnd::Touched);
            }
            let rolled = robot.sensing().odometry().map_or(0.0, |rolled| rolled.turn);
            turned += rolled;
            per_command = (rolled.abs() > 0.0)
                .then(|| (rolled / command.turn).abs())
                .or(per_command);
        }
        Ok(TurnByEnd::Turned)
    }

    /// Moves away from the nearest thing for `steps` time steps, at half the speed of a leg. The
    /// robot backs up if the thing lies ahead, and drives on if it lies behind.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn go_free<R>(&self, robot: &mut R, steps: u32) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Soundings,
    {
        let soundings = robot.sensing().soundings();
        let nearest = soundings.min_by(|a, b| a.range.total_cmp(&b.range));
        let ahead = nearest.is_none_or(|nearest| libm::cos(nearest.mount.heading.radians()) > 0.0);
        let half = 0.5 * self.config.translate;
        creep(robot, if ahead { -half } else { half }, steps, |_| {})
    }
}

/// Maximum number of time steps of a turn by an angle.
const MOST_TURN_STEPS: u32 = 60;

/// The first command of such a turn, as a fraction of the full rate.
const FIRST_COMMAND: f64 = 0.05;

/// Error at which a turn is done, rad.
const NEAR_ENOUGH: f64 = 0.02;

/// Number of time steps in which a robot moves away from what it touched while it turned.
const STEPS_FREE: u32 = 4;

/// Drives straight ahead or back for `steps` time steps, and calls `each` after every step.
fn creep<R>(
    robot: &mut R,
    translate: f64,
    steps: u32,
    mut each: impl FnMut(&R::Sensing),
) -> Result<(), R::Error>
where
    R: Robot<Command = TurnTranslate>,
{
    let turn = 0.0;
    for _ in 0..steps {
        robot.step(&TurnTranslate { turn, translate })?;
        each(robot.sensing());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Point, Pose};
    use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig};
    use tolman_sim::{Polyline, Solo, World};

    use super::*;

    fn robot(width: f64, height: f64, pose: Pose) -> Solo<Pioneer2dx> {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let outline = Polyline {
            points: corners.map(|(x, y)| Point::new(x, y)).to_vec(),
            closed: true,
            material: tolman_sim::Material::default(),
        };
        let world = World::from_segments(outline.walls().collect()).unwrap();
        let model = Pioneer2dx::new(Pioneer2dxConfig::noiseless()).unwrap();
        Solo::new(world, model, pose, 1).unwrap()
    }

    /// Its front sonars are 0.166 m ahead of the axle, and a mean of three readings is a step of
    /// 0.04 m late.
    #[test]
    fn it_stops_before_the_wall_ahead() {
        let start = Pose::new(Point::new(1.0, 2.0), Heading::EAST);
        let mut robot = robot(6.0, 4.0, start);
        let end = UntilNear::new(UntilNearConfig::paper()).drive(&mut robot);
        assert_eq!(end, Ok(LegEnd::Near));
        let from_wall = 6.0 - robot.truth().pose.position.x - 0.166;
        assert!((1.0..=1.1).contains(&from_wall), "{from_wall}");
        assert_eq!(robot.bumps(), 0);
    }

    #[test]
    fn a_leg_has_an_end_where_nothing_is_near() {
        let start = Pose::new(Point::new(5.0, 50.0), Heading::EAST);
        let mut robot = robot(100.0, 100.0, start);
        let end = UntilNear::new(UntilNearConfig::paper()).drive(&mut robot);
        assert_eq!(end, Ok(LegEnd::TooLong));
        assert!((robot.truth().pose.position.x - 25.0).abs() < 1e-9);
    }

    #[test]
    fn it_turns_out_of_a_corner() {
        let start = Pose::new(Point::new(5.4, 3.4), Heading::from_degrees(45.0));
        let mut robot = robot(6.0, 4.0, start);
        let mut driver = UntilNear::new(UntilNearConfig::paper());
        assert_eq!(driver.turn(&mut robot, 0.3), Ok(TurnEnd::Clear));
        let heading = robot.truth().pose.heading.degrees();
        assert!(!(0.0..90.0).contains(&heading), "{heading}");
        assert_eq!(driver.drive(&mut robot), Ok(LegEnd::Near));
    }

    #[test]
    fn it_turns_by_an_angle_and_goes_away_from_what_is_near() {
        let start = Pose::new(Point::new(1.0, 2.0), Heading::EAST);
        let mut robot = robot(6.0, 4.0, start);
        let driver = UntilNear::new(UntilNearConfig::paper());
        // The wall in the west is behind, beside, and ahead.
        for (angle, heading, along) in [(0.001, 0.0, 1.1), (1.0, 1.0, 1.15), (-4.1, -3.1, 1.25)] {
            driver.turn_by(&mut robot, angle).unwrap();
            let off = robot
                .truth()
                .pose
                .heading
                .turn_to(Heading::from_radians(heading));
            assert!(off.abs() < 0.04, "{off}");
            driver.go_free(&mut robot, 5).unwrap();
            let x = robot.truth().pose.position.x;
            assert!((x - along).abs() < 0.01, "{x}");
        }
    }

    /// In a chest the robot turns round once. After it gives way, it drives.
    #[test]
    fn it_finds_no_way_out_of_a_chest() {
        let start = Pose::new(Point::new(0.6, 0.6), Heading::EAST);
        let mut robot = robot(1.2, 1.2, start);
        let mut driver = UntilNear::new(UntilNearConfig::paper());
        assert_eq!(driver.turn(&mut robot, 0.3), Ok(TurnEnd::Enclosed));
        driver.give_way(0.2);
        assert_eq!(driver.turn(&mut robot, 0.3), Ok(TurnEnd::Clear));
    }
}
