use core::f64::consts::PI;

use rand::RngExt;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::{Stopping, pioneer_2dx};
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig, WheelScale};
use tolman_sim::sensors::{Backdrop, Light};
use tolman_sim::{Bounds, World};
use tolman_systems::stream;

use super::CellGrid;
use crate::course::Course;
use crate::pioneer::CORRIDOR_WIDTH;
use crate::{BoxError, Simulated};

/// An arena of the place map: a course in a free world, and the truth about it.
#[derive(Clone, Debug)]
pub struct Pitch {
    /// Walls, goals, windows and furniture. The zone `destination` lies before the blue goal, and
    /// `start` before the yellow one.
    pub course: Course,
    /// Middle of each goal's foot, with a heading onto the floor.
    pub goals: Goals<Pose>,
    /// The 8 × 8 cells over its floor.
    pub cells: CellGrid,
    /// Lighting of the arena.
    pub light: Light,
    /// Colours of the arena's floor and ceiling.
    pub backdrop: Backdrop,
}

/// What there is of each of an arena's two goals. In random arenas the goals have other colours,
/// and the first is called blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goals<T> {
    /// That of the blue goal.
    pub blue: T,
    /// That of the yellow goal.
    pub yellow: T,
}

/// Random streams of an arena's seed, one for each consumer.
const START: u64 = 1;
const WHEELS: u64 = 2;

/// Number of positions tried for a start.
const TRIES: u32 = 10_000;

/// An arena that is always the same.
struct Drawn {
    name: &'static str,
    /// The world's file.
    world: &'static str,
    /// Corner in the north-east of the floor, whose south-western corner is the origin.
    corner: Point,
    goals: Goals<Pose>,
    windows: Heading,
    floor: [u8; 3],
}

const fn goal(x: f64, y: f64, heading: Heading) -> Pose {
    Pose::new(Point::new(x, y), heading)
}

/// The paper's pitch (section 3.1), and two that are not in the paper:
///
/// - `pitch` is 4 × 4.6 m of green floor with white boarding 0.4 m high. A blue goal stands in the
///   east and a yellow one in the west, on the short sides. It lies in a room with windows in the
///   north, and a door and a cupboard in the south.
/// - `hall` has 8 × 6 m and walls as high as a room. It has windows in the west, four pieces of
///   furniture, and goals in the north and in the south.
/// - `l-room` has 5 × 5 m without its corner in the north-east, with windows in the south. Neither
///   goal can be seen from the other.
const DRAWN: [Drawn; 3] = [
    Drawn {
        name: "pitch",
        world: include_str!("../../mazes/worlds/pitch.json"),
        corner: Point::new(4.6, 4.0),
        goals: Goals {
            blue: goal(4.6, 2.0, Heading::WEST),
            yellow: goal(0.0, 2.0, Heading::EAST),
        },
        windows: Heading::NORTH,
        floor: [40, 110, 60],
    },
    Drawn {
        name: "hall",
        world: include_str!("../../mazes/worlds/goal-hall.json"),
        corner: Point::new(8.0, 6.0),
        goals: Goals {
            blue: goal(4.0, 0.0, Heading::NORTH),
            yellow: goal(4.0, 6.0, Heading::SOUTH),
        },
        windows: Heading::WEST,
        floor: [150, 140, 125],
    },
    Drawn {
        name: "l-room",
        world: include_str!("../../mazes/worlds/l-room.json"),
        corner: Point::new(5.0, 5.0),
        goals: Goals {
            blue: goal(5.0, 1.3, Heading::WEST),
            yellow: goal(1.3, 5.0, Heading::SOUTH),
        },
        windows: Heading::SOUTH,
        floor: [95, 60, 55],
    },
];

impl Pitch {
    /// Returns the arena of this name: `pitch` for the paper's, `hall`, `l-room`, or `random-` with
    /// a seed.
    ///
    /// # Errors
    /// If no arena has this name.
    pub fn named(name: &str) -> Result<Self, BoxError> {
        if let Some(drawn) = DRAWN.iter().find(|drawn| drawn.name == name) {
            let world = World::from_json(drawn.world)?;
            let light = Light::daylight(drawn.windows);
            return Self::of(name, world, drawn.corner, drawn.goals, light, drawn.floor);
        }
        let seed = name.strip_prefix("random-");
        let seed = seed.and_then(|seed| seed.parse().ok());
        let unknown = || {
            format!(
                "no arena is called {name:?}; the arenas are `pitch`, `hall`, `l-room` and `random-` with a number, such as `random-7`"
            )
        };
        Self::random(seed.ok_or_else(unknown)?)
    }

    pub(super) fn of(
        name: &str,
        world: World,
        corner: Point,
        goals: Goals<Pose>,
        light: Light,
        floor: [u8; 3],
    ) -> Result<Self, BoxError> {
        let body = pioneer_2dx::body();
        Ok(Self {
            course: Course::in_free_world(name, world, CORRIDOR_WIDTH, &body)?,
            goals,
            cells: CellGrid::over(Bounds {
                min: Point::origin(),
                max: corner,
            }),
            light,
            backdrop: Backdrop {
                floor,
                ceiling: [200, 200, 195],
                stains: 0.08,
            },
        })
    }

    /// Returns the start of a run: a random position where a Pioneer 2-DX can turn, with a random
    /// heading.
    ///
    /// # Errors
    /// If there is no such position.
    pub fn start(&self, seed: u64) -> Result<Pose, BoxError> {
        let mut rng = stream(seed, START);
        let radius = pioneer_2dx::body().radius() + 0.02;
        let bounds = self.cells.bounds();
        let mut poses = (0..TRIES).map(|_| {
            let offset = Vector::new(
                rng.random_range(0.0..bounds.width()),
                rng.random_range(0.0..bounds.height()),
            );
            let heading = Heading::from_radians(rng.random_range(-PI..PI));
            Pose::new(bounds.min + offset, heading)
        });
        let Course { name, world, .. } = &self.course;
        let is_free = |pose: &Pose| {
            let at = pose.position;
            world.nearest_wall_distance(at) > radius && self.course.leads_on(at)
        };
        let narrow = || {
            format!(
                "{TRIES} random places of arena `{name}` were too narrow to turn the robot in; use a larger arena"
            )
        };
        Ok(poses.find(is_free).ok_or_else(narrow)?)
    }

    /// Returns the [paper's robot](paper_robot) in this arena's light.
    ///
    /// # Errors
    /// As [`paper_robot`].
    pub fn robot(&self, seed: u64, calibration: f64) -> Result<Pioneer2dxConfig, BoxError> {
        let mut robot = paper_robot(seed, calibration)?;
        robot.camera.light = self.light;
        robot.camera.backdrop = self.backdrop;
        Ok(robot)
    }

    /// Returns a robot at the [start](Self::start) of a run with this `seed`, at rest. It stands
    /// still when the run is over.
    ///
    /// # Errors
    /// If it cannot be built or cannot stand there.
    pub fn put(
        &self,
        robot: Pioneer2dxConfig,
        seed: u64,
    ) -> Result<Stopping<Simulated<Pioneer2dx>>, BoxError> {
        let robot = Pioneer2dx::new(robot)?;
        let robot = self.course.robot_at(self.start(seed)?, robot, seed)?;
        Ok(Stopping::new(robot))
    }
}

/// Name of the Pioneer 2-DX, as in the files of maps.
pub const PIONEER_2DX: &str = "Pioneer 2-DX";

/// Returns the paper's robot. Each wheel counts wrongly by its own constant share within ±
/// `calibration`, drawn from `seed`; with 0 the wheels only slip.
///
/// # Errors
/// If `calibration` is not from 0 to 0.5.
pub fn paper_robot(seed: u64, calibration: f64) -> Result<Pioneer2dxConfig, BoxError> {
    if !(0.0..=0.5).contains(&calibration) {
        return Err(format!("`calibration` is {calibration}; give a share from 0 to 0.5").into());
    }
    let mut rng = stream(seed, WHEELS);
    let mut scale = || 1.0 + calibration * rng.random_range(-1.0..=1.0);
    let wheels = WheelScale {
        left: scale(),
        right: scale(),
    };
    Ok(Pioneer2dxConfig::paper().with_wheel_scale(wheels))
}
