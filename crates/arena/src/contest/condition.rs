use alloc::sync::Arc;
use core::f64::consts::PI;

use rand::{Rng, RngExt};
use tolman_control::unit_of;
use tolman_maze::{Cell, Direction, Maze};
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{
    EpuckConfig, LaserPioneerConfig, MotorNoise, Pioneer2dxConfig, Pioneer2dxFaults, WheelScale,
};
use tolman_sim::{Door, DoorState, Material, WorldError};
use tolman_systems::stream;

use crate::course::{Course, pick};
use crate::diktiometry::SurveyorConfig;
use crate::pioneer::without_noise;
use crate::registry::slug;

/// Change of robot and world, of which the system is not told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Condition {
    /// Nothing is changed.
    #[default]
    AsMade,
    /// Each wheel is off by a constant of at most this many percent.
    Wheels(u8),
    /// The compass is off by a constant.
    CompassOffset,
    /// Odometry is off by a constant share.
    ConstantOdometry,
    /// Odometry is off by a share that is drawn again in each time step.
    FreshOdometry,
    /// A door is open while the robot learns, and shut afterwards.
    Doors,
    /// The robot is lifted while it learns and put down elsewhere, without being told.
    Kidnapping,
    /// Readings of all sensors are missing at random.
    DropOuts,
    /// Ranges, odometry and heading are as good as those of real robots. The heading is that of a
    /// gyro, which drifts.
    RealSensors,
    /// Doors shut and open again while the robot runs [errands](super::Errands). Not among
    /// [`ALL`](Self::ALL): other tasks have no such doors.
    MovingDoors,
    /// Motors, wheels, compass and odometry have no errors, as on no real robot. A map learned in
    /// this way can serve as the true one. Not among [`ALL`](Self::ALL).
    Flawless,
}

/// Maximum constant error of a compass, rad.
const COMPASS: f64 = 5.0 * PI / 180.0;

/// Maximum error of odometry, as a share.
const ODOMETRY: f64 = 0.1;

/// Probability that a reading is missing.
const MISSING: f64 = 0.02;

/// Errors of real sensors. Standard deviation of a range, m.
const RANGE_SD: f64 = 0.01;
/// Probability that a beam gives nothing.
const LOST: f64 = 0.005;
/// Constant share by which odometry is off at most: of the distance, and of the turn.
const ROLLED: f64 = 0.01;
const TURNED: f64 = 0.03;
/// Drift of the gyro, rad/min.
const DRIFT: f64 = PI / 180.0;

/// Maximum number of doors that shut and open.
const MOVING_DOORS: usize = 6;

const WHEEL_STREAM: u64 = 32;
const DOOR_STREAM: u64 = 33;

impl Condition {
    /// All conditions, the milder ones first.
    pub const ALL: [Self; 11] = [
        Self::AsMade,
        Self::Wheels(1),
        Self::Wheels(2),
        Self::Wheels(5),
        Self::CompassOffset,
        Self::ConstantOdometry,
        Self::FreshOdometry,
        Self::Doors,
        Self::Kidnapping,
        Self::DropOuts,
        Self::RealSensors,
    ];

    /// Returns the name in tables.
    #[must_use]
    pub fn name(self) -> String {
        let name = match self {
            Self::Wheels(percent) => return format!("wheels {percent}"),
            Self::AsMade => "as made",
            Self::CompassOffset => "compass offset",
            Self::ConstantOdometry => "constant odometry",
            Self::FreshOdometry => "fresh odometry",
            Self::Doors => "doors",
            Self::Kidnapping => "kidnapping",
            Self::DropOuts => "drop-outs",
            Self::RealSensors => "real sensors",
            Self::MovingDoors => "moving doors",
            Self::Flawless => "flawless",
        };
        name.to_owned()
    }

    /// Returns the condition of a name, as in tables or as typed: `compass-offset` is compass
    /// offset. `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let mut all = Self::ALL.into_iter().chain([Self::MovingDoors]);
        all.find(|condition| slug(&condition.name()) == slug(name))
    }

    /// Returns the e-puck under this condition.
    pub(crate) fn epuck(self, mut robot: EpuckConfig) -> EpuckConfig {
        match self {
            Self::Wheels(percent) => robot.wheels.push(constant(share(percent))),
            Self::ConstantOdometry => robot.wheels = vec![constant(ODOMETRY)],
            Self::FreshOdometry => robot.wheels = vec![Fault::Slip { share: ODOMETRY }],
            Self::DropOuts => robot.proximity.push(MISSES),
            Self::Flawless => robot.wheels.clear(),
            Self::AsMade
            | Self::CompassOffset
            | Self::Doors
            | Self::MovingDoors
            | Self::Kidnapping
            | Self::RealSensors => {}
        }
        robot
    }

    /// Returns the laser Pioneer under this condition.
    pub(crate) fn laser_pioneer(
        self,
        mut robot: LaserPioneerConfig,
        seed: u64,
    ) -> LaserPioneerConfig {
        let faults = &mut robot.faults;
        match self {
            Self::Wheels(percent) => robot.wheel_scale = wheels(percent, seed),
            Self::CompassOffset => faults.compass.push(Fault::Bounded {
                share: 0.0,
                offset: COMPASS,
                steps: u32::MAX,
            }),
            Self::ConstantOdometry | Self::FreshOdometry => {
                faults.odometry_distance.push(self.odometry());
                faults.odometry_turn.push(self.odometry());
            }
            Self::DropOuts => {
                faults.scan.push(MISSES);
                faults.compass.push(MISSES);
                faults.odometry_distance.push(MISSES);
            }
            Self::RealSensors => {
                robot.scan_noise = Gaussian::absolute(RANGE_SD);
                let max_range = robot.ring.max_range;
                faults.scan.push(Fault::Outliers {
                    probability: LOST,
                    low: max_range,
                    high: max_range,
                });
                faults.odometry_distance = vec![constant(ROLLED)];
                faults.odometry_turn = vec![constant(TURNED)];
                let steps_per_minute = 60e6 / robot.step_us as f64;
                faults.compass.push(Fault::Drift {
                    rate: DRIFT / steps_per_minute,
                });
            }
            Self::Flawless => {
                robot = without_noise(&robot);
                robot.wheel_scale = WheelScale::EXACT;
            }
            Self::AsMade | Self::Doors | Self::MovingDoors | Self::Kidnapping => {}
        }
        robot
    }

    /// Returns the Pioneer 2-DX under this condition.
    pub(crate) fn pioneer_2dx(self, mut robot: Pioneer2dxConfig, seed: u64) -> Pioneer2dxConfig {
        let faults = &mut robot.faults;
        match self {
            Self::Wheels(percent) => robot.wheel_scale = wheels(percent, seed),
            Self::ConstantOdometry | Self::FreshOdometry => {
                faults.left_wheel.push(self.odometry());
                faults.right_wheel.push(self.odometry());
            }
            Self::DropOuts => {
                faults.sonars.push(MISSES);
                faults.picture.push(MISSES);
                faults.left_wheel.push(MISSES);
            }
            Self::Flawless => {
                robot.motor_noise = MotorNoise::default();
                robot.wheel_scale = WheelScale::EXACT;
                robot.wheel_noise = Gaussian::NONE;
                robot.faults = Pioneer2dxFaults::default();
            }
            Self::AsMade
            | Self::CompassOffset
            | Self::Doors
            | Self::MovingDoors
            | Self::Kidnapping
            | Self::RealSensors => {}
        }
        robot
    }

    /// Returns the diktiometry's robot under this condition. As made, its odometry has the same
    /// error for several time steps at a time.
    pub(crate) fn surveyor(self, robot: SurveyorConfig, seed: u64) -> SurveyorConfig {
        let hold_steps = match self {
            Self::ConstantOdometry => u32::MAX,
            Self::FreshOdometry => 1,
            Self::Flawless => {
                return SurveyorConfig {
                    pioneer: self.laser_pioneer(robot.pioneer, seed),
                    odometry_share: 0.0,
                    shared_share: 0.0,
                    outliers: 0.0,
                    compass_bound: 0.0,
                    ..robot
                };
            }
            _ => {
                let pioneer = self.laser_pioneer(robot.pioneer, seed);
                return SurveyorConfig { pioneer, ..robot };
            }
        };
        SurveyorConfig {
            hold_steps,
            ..robot
        }
    }

    /// Returns the openings that are doors, each as a cell and the way out of it: random openings
    /// without any one of which all cells stay connected. None if there are no such openings, or if
    /// this condition has no doors.
    pub(crate) fn doors(self, maze: &Maze, seed: u64) -> Vec<(Cell, Direction)> {
        let most = match self {
            Self::Doors => 1,
            Self::MovingDoors => MOVING_DOORS,
            _ => return Vec::new(),
        };
        let count = maze.reachable().count();
        let openings = maze.reachable().flat_map(|cell| {
            let ways = [Direction::North, Direction::East].into_iter();
            ways.map(move |way| (cell, way))
        });
        let is_needless = |(cell, way): &(Cell, Direction)| {
            let mut shut = maze.clone();
            shut.set_wall(*cell, *way, true);
            maze.is_open(*cell, *way) && shut.reachable().count() == count
        };
        let mut left: Vec<(Cell, Direction)> = openings.filter(is_needless).collect();
        let rng = &mut stream(seed, DOOR_STREAM);
        let mut doors = Vec::new();
        while doors.len() < most
            && let Some(door) = pick(&left, rng)
        {
            left.retain(|other| *other != door);
            doors.push(door);
        }
        doors
    }

    fn odometry(self) -> Fault {
        match self {
            Self::ConstantOdometry => constant(ODOMETRY),
            _ => Fault::Slip { share: ODOMETRY },
        }
    }
}

/// Returns the name of a door, by its number from 0.
pub(super) fn door_name(number: usize) -> String {
    match number {
        0 => "door".to_owned(),
        number => format!("door {}", number + 1),
    }
}

/// Returns the course with doors, which stand open, in these openings.
///
/// # Errors
/// If the world has a door of such a name.
pub(crate) fn with_doors(
    mut course: Course,
    openings: &[(Cell, Direction)],
) -> Result<Course, WorldError> {
    let door = |(number, (cell, way)): (usize, &(Cell, Direction))| {
        let next = course.maze.grid().neighbour(*cell, *way).unwrap_or(*cell);
        let [here, there] = [*cell, next].map(|cell| course.cell_centre(cell));
        let middle = here + 0.5 * (there - here);
        let half = unit_of(way.left()) * (0.5 * course.corridor_width);
        Door {
            name: door_name(number),
            start: middle - half,
            end: middle + half,
            material: Material::default(),
            state: DoorState::Open,
            schedule: Vec::new(),
        }
    };
    if !openings.is_empty() {
        let doors: Vec<Door> = openings.iter().enumerate().map(door).collect();
        course.world = Arc::new((*course.world).clone().with_doors(doors)?);
    }
    Ok(course)
}

const MISSES: Fault = Fault::DropOut {
    probability: MISSING,
};

const fn constant(share: f64) -> Fault {
    Fault::Bounded {
        share,
        offset: 0.0,
        steps: u32::MAX,
    }
}

fn share(percent: u8) -> f64 {
    f64::from(percent) / 100.0
}

fn wheels(percent: u8, seed: u64) -> WheelScale {
    let rng = &mut stream(seed, WHEEL_STREAM);
    let [left, right] = [0, 1].map(|_| 1.0 + share(percent) * off(rng));
    WheelScale { left, right }
}

fn off(rng: &mut impl Rng) -> f64 {
    rng.random_range(-1.0..=1.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::family::Family;

    #[test]
    fn a_condition_is_found_as_it_is_typed() {
        for condition in Condition::ALL {
            assert_eq!(Condition::named(&condition.name()), Some(condition));
        }
        assert_eq!(Condition::named("wheels-5"), Some(Condition::Wheels(5)));
        assert_eq!(Condition::named("rain"), None);
    }

    proptest! {
        #[test]
        fn a_shut_door_cuts_nothing_off(family in 0..Family::ARENA.len(), seed: u64) {
            let family = Family::ARENA[family];
            let rng = &mut ChaCha8Rng::seed_from_u64(seed);
            let maze = (family.draw)(family.sizes[0], rng).unwrap();
            prop_assert!(Condition::AsMade.doors(&maze, seed).is_empty());
            let doors = Condition::MovingDoors.doors(&maze, seed);
            prop_assert!(doors.len() <= MOVING_DOORS);
            prop_assert_eq!(&Condition::Doors.doors(&maze, seed)[..], &doors[..doors.len().min(1)]);
            for (cell, way) in &doors {
                prop_assert!(maze.is_open(*cell, *way));
                let mut shut = maze.clone();
                shut.set_wall(*cell, *way, true);
                prop_assert!(shut.reachable().eq(maze.reachable()));
            }
            match doors.as_slice() {
                [_, ..] => {}
                // The maze has no loop.
                [] => {
                    let ways: usize = maze.reachable().map(|cell| maze.degree(cell)).sum();
                    prop_assert_eq!(ways / 2 + 1, maze.reachable().count());
                }
            }
        }

        #[test]
        fn each_wheel_is_off_by_so_much_at_most(percent in 0..10_u8, seed: u64) {
            let scale = wheels(percent, seed);
            for wheel in [scale.left, scale.right] {
                prop_assert!((wheel - 1.0).abs() <= share(percent) + 1e-12);
            }
            prop_assert_eq!(scale, wheels(percent, seed));
        }
    }
}
