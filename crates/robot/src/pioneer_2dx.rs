//! The Pioneer 2-DX: its measures and its readings. It takes the command
//! [`TurnTranslate`](crate::TurnTranslate).

use alloc::vec::Vec;
use core::f64::consts::PI;

use tolman_geom::{Heading, Point, Pose};

use crate::{
    Body, Bumps, Clock, Odometry, Picture, PinholeCamera, Rolls, Snapshot, Sounding, Soundings,
    TakesSnapshots,
};

/// Length of the body, m.
pub const LENGTH: f64 = 0.44;

/// Width of the body, m.
pub const WIDTH: f64 = 0.33;

/// Distance from the wheels' axle to the front of the body, m. The sonars at the back then lie
/// within it.
pub const FRONT: f64 = 0.18;

/// Radius of a wheel, m.
pub const WHEEL_RADIUS: f64 = 0.0825;

/// Distance between the wheels, m.
pub const TRACK: f64 = 0.3206;

/// Number of sonars.
pub const SONARS: usize = 16;

/// Half-width of a sonar's cone, rad: the cone is 15° wide.
pub const SONAR_HALF_WIDTH: f64 = 7.5 * PI / 180.0;

/// Minimum reading of a sonar, m.
pub const SONAR_LEAST: f64 = 0.1;

/// Maximum reading of a sonar, m.
pub const SONAR_MOST: f64 = 5.0;

/// The camera on top: 49° by 37°, 0.3 m above the floor.
pub const CAMERA: PinholeCamera = PinholeCamera {
    position: Point::new(0.0, 0.0),
    height: 0.3,
    field_across: 49.0 * PI / 180.0,
    field_down: 37.0 * PI / 180.0,
};

/// Position and direction of each sonar, m and degrees. Number 0 looks left, 3 and 4 ahead, 7
/// right; 8 to 15 go on clockwise round the back.
const MOUNTS: [(f64, f64, f64); SONARS] = [
    (0.069, 0.136, 90.0),
    (0.114, 0.119, 50.0),
    (0.148, 0.078, 30.0),
    (0.166, 0.027, 10.0),
    (0.166, -0.027, -10.0),
    (0.148, -0.078, -30.0),
    (0.114, -0.119, -50.0),
    (0.069, -0.136, -90.0),
    (-0.157, -0.136, -90.0),
    (-0.203, -0.119, -130.0),
    (-0.237, -0.078, -150.0),
    (-0.255, -0.027, -170.0),
    (-0.255, 0.027, 170.0),
    (-0.237, 0.078, 150.0),
    (-0.203, 0.119, 130.0),
    (-0.157, 0.136, 90.0),
];

/// Returns the pose of each sonar in the robot's frame.
///
/// ```
/// use tolman_robot::pioneer_2dx;
///
/// let mounts = pioneer_2dx::sonar_mounts();
/// assert!(mounts[0].position.y > 0.0, "sonar 0 is on the left");
/// assert!((mounts[0].heading.degrees() - 90.0).abs() < 1e-9, "and looks there");
/// ```
#[must_use]
pub fn sonar_mounts() -> [Pose; SONARS] {
    MOUNTS.map(|(x, y, degrees)| {
        Pose::new(
            Point::new(x, y),
            Heading::from_radians(degrees * PI / 180.0),
        )
    })
}

/// Returns the robot's outline: [`LENGTH`] by [`WIDTH`] round the middle of the wheels' axle.
#[must_use]
pub fn body() -> Body {
    let (front, back, side) = (FRONT, FRONT - LENGTH, 0.5 * WIDTH);
    let corners = [(back, -side), (front, -side), (front, side), (back, side)];
    Body::Polygon {
        corners: Vec::from(corners.map(|(x, y)| Point::new(x, y))),
    }
}

/// Readings in one time step. A sensor without a reading is `None`; the other readings still hold.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pioneer2dxSensing {
    /// Microseconds since the robot was switched on.
    pub time_us: u64,
    /// The range of each sonar, m, [`SONAR_MOST`] where it met nothing.
    pub sonars: Option<[f64; SONARS]>,
    /// Picture of the camera; `None` while the robot moves, which would blur it.
    pub picture: Option<Picture>,
    /// Odometry since the step before.
    pub odometry: Option<Odometry>,
    /// Whether the body touched something in this step.
    pub bump: Option<bool>,
}

impl Pioneer2dxSensing {
    /// State before the first reading: nothing from any sensor.
    pub const SILENT: Self = Self {
        time_us: 0,
        sonars: None,
        picture: None,
        odometry: None,
        bump: None,
    };
}

impl Rolls for Pioneer2dxSensing {
    fn odometry(&self) -> Option<Odometry> {
        self.odometry
    }
}

impl Bumps for Pioneer2dxSensing {
    fn bump(&self) -> Option<bool> {
        self.bump
    }
}

impl Clock for Pioneer2dxSensing {
    fn time_us(&self) -> u64 {
        self.time_us
    }
}

impl Soundings for Pioneer2dxSensing {
    fn soundings(&self) -> impl Iterator<Item = Sounding> + '_ {
        self.sonars.iter().flat_map(|ranges| {
            let readings = sonar_mounts().into_iter().zip(*ranges);
            readings.map(|(mount, range)| Sounding {
                mount,
                half_width: SONAR_HALF_WIDTH,
                range,
                max_range: SONAR_MOST,
            })
        })
    }
}

impl TakesSnapshots for Pioneer2dxSensing {
    fn snapshot(&self) -> Option<Snapshot> {
        self.sonars?;
        Some(Snapshot {
            soundings: self.soundings().collect(),
            picture: Some(self.picture.clone()?),
        })
    }
}
