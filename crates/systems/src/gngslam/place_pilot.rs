use core::f64::consts::PI;

use thiserror::Error;
use tolman_control::wander::{LegEnd, UntilNear, UntilNearConfig};
use tolman_geom::{Point, Pose};
use tolman_maps::place_map::{PlaceMap, PlaceMapError};
use tolman_quantizers::UnitId;
use tolman_robot::Standing;

use super::{SnapshotRobot, Wanderer, WandererError};

/// Parameters by which a [`PlacePilot`] follows a way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlacePilotConfig {
    /// Parameters of driving between two looks.
    pub drive: UntilNearConfig,
    /// Distance by odometry within which the robot has reached a node, m.
    pub arrival: f64,
    /// Angle by which the pilot turns to go round an obstacle, rad.
    pub round: f64,
}

impl PlacePilotConfig {
    /// Returns our values for the Pioneer 2-DX; the paper plans ways on the map and does not drive
    /// them.
    #[must_use]
    pub const fn pioneer_2dx() -> Self {
        let mut drive = UntilNearConfig::paper();
        drive.longest_leg = 10;
        drive.limits.ahead = 0.4;
        Self {
            drive,
            arrival: 0.3,
            round: 0.35 * PI,
        }
    }
}

/// Reason why a [`PlacePilot`] cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlacePilotError<E> {
    /// No record came, or the robot failed.
    #[error(transparent)]
    Robot(#[from] WandererError<E>),
    /// The map does not know the record.
    #[error("the map cannot tell where the robot is; give records with its features")]
    Map(#[from] PlaceMapError),
}

/// Drives a robot to a node of a [`PlaceMap`]. It takes a record, asks the map for the nearest node
/// and plans from there along the links (section 3.4: "find a path"). Then it drives towards the
/// next node by its odometry.
///
/// Nodes lie in the frame of the records' odometry. So the robot has to be the one that gathered
/// them, or has to know its pose in that frame.
#[derive(Clone, Debug)]
pub struct PlacePilot<'a> {
    map: &'a PlaceMap,
    config: PlacePilotConfig,
    driver: UntilNear,
    goal: UnitId,
    /// Side on which the robot passes the next obstacle: 1 for left.
    side: f64,
    /// Nodes to which the robot came near since the drive began.
    passed: Vec<UnitId>,
}

impl<'a> PlacePilot<'a> {
    /// Returns a pilot that drives to the node `goal` of `map`.
    #[must_use]
    pub fn new(map: &'a PlaceMap, config: PlacePilotConfig, goal: UnitId) -> Self {
        Self {
            map,
            driver: UntilNear::new(config.drive),
            config,
            goal,
            side: 1.0,
            passed: Vec::new(),
        }
    }

    /// Drives a piece of the way. `wanderer` keeps the robot's dead reckoning. Returns the standing
    /// of the task, which is done when the robot is at the goal by odometry.
    ///
    /// # Errors
    /// [`PlacePilotError`] if the robot fails or takes no snapshot, or the map is of another robot.
    pub fn act<R: SnapshotRobot>(
        &mut self,
        robot: &mut R,
        wanderer: &mut Wanderer,
    ) -> Result<Standing, PlacePilotError<R::Error>> {
        let record = wanderer.record(robot)?;
        let here = self.map.nearest(&record)?;
        let at = record.odometry;
        let Some(way) = self.map.way(here, self.goal) else {
            return Ok(Standing::gave_up(format!(
                "no links lead from node {} to node {}",
                here.0, self.goal.0
            )));
        };
        let near = way.iter().filter(|node| self.is_near(at, **node));
        let near: Vec<UnitId> = near.copied().collect();
        self.passed.extend(near);
        if self.is_near(at, self.goal) {
            return Ok(Standing::Done);
        }
        // On from the last node of the way that it has been near to, so that it does not turn back
        // to the first.
        let last = way.iter().rposition(|node| self.passed.contains(node));
        let next = way
            .get(last.map_or(0, |last| last + 1))
            .unwrap_or(&self.goal);
        let Some(to) = self.map.position(*next) else {
            return Ok(Standing::gave_up("the map does not say where nodes lie"));
        };
        self.go_towards(robot, wanderer, at, to)
            .map_err(WandererError::Robot)?;
        Ok(Standing::UnderWay)
    }

    fn is_near(&self, at: Pose, node: UnitId) -> bool {
        let position = self.map.position(node);
        position.is_some_and(|position| (position - at.position).norm() <= self.config.arrival)
    }

    /// Turns towards a point and drives a leg, round an obstacle if there is one.
    fn go_towards<R: SnapshotRobot>(
        &mut self,
        robot: &mut R,
        wanderer: &mut Wanderer,
        at: Pose,
        to: Point,
    ) -> Result<(), R::Error> {
        let towards = at.inverse().transform(to);
        let mut robot = wanderer.reckoned(robot);
        let bearing = libm::atan2(towards.y, towards.x);
        self.driver.turn_by(&mut robot, bearing)?;
        if self.driver.drive(&mut robot)? != LegEnd::TooLong {
            self.driver
                .turn_by(&mut robot, self.side * self.config.round)?;
            self.driver.drive(&mut robot)?;
            self.side = -self.side;
        }
        Ok(())
    }
}
