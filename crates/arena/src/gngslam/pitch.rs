use alloc::sync::Arc;
use core::f64::consts::PI;

use rand::{Rng, RngExt};
use thiserror::Error;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::Cell;
use tolman_robot::pioneer_2dx;
use tolman_sim::robots::{Pioneer2dxConfig, WheelScale};
use tolman_sim::sensors::{Backdrop, Light};
use tolman_sim::{Area, Bounds, World, WorldError, Zone};
use tolman_systems::stream;

use super::CellGrid;
use super::room::Room;

/// An arena of the place map: its world, and the truth about it.
#[derive(Clone, Debug)]
pub struct Pitch {
    /// Name of the arena: see [`named`](Self::named).
    pub name: String,
    /// Walls, goals, windows and furniture of the arena.
    pub world: Arc<World>,
    /// Poses of the arena's goals.
    pub goals: Goals,
    /// Lighting of the arena.
    pub light: Light,
    /// Colours of the arena's floor and ceiling.
    pub backdrop: Backdrop,
    pub(super) room: Room,
}

/// Middle of each goal's foot, with a heading onto the floor. In random arenas the goals have other
/// colours, and the first is called blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goals {
    /// Pose of the blue goal.
    pub blue: Pose,
    /// Pose of the yellow goal.
    pub yellow: Pose,
}

/// Reason why there is no such arena, or no room in it.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PitchError {
    /// No arena has this name.
    #[error(
        "no arena is called {name:?}; the arenas are `pitch`, `hall`, `l-room` and `random-` with a number, such as `random-7`"
    )]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// The robot found no place to stand.
    #[error(
        "{tries} random places of arena `{name}` were too narrow to turn the robot in; use a larger arena"
    )]
    NoRoom {
        /// Name of the arena.
        name: String,
        /// Number of positions tried.
        tries: u32,
    },
    /// The error of the wheels' calibration is outside its range.
    #[error("`calibration` is {calibration}; give a share from 0 to 0.5")]
    Calibration {
        /// The offending share.
        calibration: f64,
    },
    /// The world cannot be built.
    #[error("no world can be built from the arena; correct its walls")]
    World(#[from] WorldError),
}

/// Random streams of an arena's seed, one for each consumer.
const START: u64 = 1;
const WHEELS: u64 = 2;

/// Distance from a goal to the middle of its zone, and the zone's radius, m.
const ZONE_BEFORE: f64 = 0.8;
const ZONE_RADIUS: f64 = 0.5;

/// Number of positions tried for a start.
const TRIES: u32 = 10_000;

impl Pitch {
    /// Returns the arena of this name: `pitch` for the [paper's](Self::paper), `hall`, `l-room`, or
    /// `random-` with a seed.
    ///
    /// # Errors
    /// [`PitchError::Unknown`] if no arena has this name.
    pub fn named(name: &str) -> Result<Self, PitchError> {
        match name {
            "pitch" => Self::paper(),
            "hall" => Self::hall(),
            "l-room" => Self::l_room(),
            _ => {
                let seed = name.strip_prefix("random-");
                let seed = seed.and_then(|seed| seed.parse().ok());
                let name = name.to_owned();
                Self::random(seed.ok_or(PitchError::Unknown { name })?)
            }
        }
    }

    /// Returns the smallest rectangle that holds the floor.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.room.bounds()
    }

    /// Returns the 8 × 8 cells over its floor.
    #[must_use]
    pub fn cells(&self) -> CellGrid {
        CellGrid::over(self.bounds())
    }

    /// Returns the cell in which a point lies.
    #[must_use]
    pub fn cell_of(&self, point: Point) -> Cell {
        self.cells().cell_of(point)
    }

    /// Returns whether a point lies on the floor and in no furniture.
    #[must_use]
    pub fn holds(&self, point: Point) -> bool {
        self.room.holds(point)
    }

    /// Returns the arena's world for `tolman`'s commands: the zone `destination` lies before the
    /// blue goal, and `start` before the yellow one.
    ///
    /// # Errors
    /// None.
    pub fn world_to_goal(&self) -> Result<World, PitchError> {
        let before = |name: &str, goal: Pose| {
            let centre = goal.position + goal.heading.unit() * ZONE_BEFORE;
            let radius = ZONE_RADIUS;
            Zone::new(name, vec![Area::Disc { centre, radius }])
        };
        let Goals { blue, yellow } = self.goals;
        let world = World::clone(&self.world).with_zone(before("destination", blue))?;
        Ok(world.with_zone(before("start", yellow))?)
    }

    /// Returns the start of a run: a random position where a Pioneer 2-DX can turn, with a random
    /// heading.
    ///
    /// # Errors
    /// [`PitchError::NoRoom`] if there is no such position.
    pub fn start(&self, seed: u64) -> Result<Pose, PitchError> {
        let mut rng = stream(seed, START);
        let radius = pioneer_2dx::body().radius() + 0.02;
        let mut places = (0..TRIES).map(|_| self.anywhere(&mut rng));
        let is_free = |pose: &Pose| {
            let at = pose.position;
            self.holds(at) && self.world.nearest_wall_distance(at) > radius
        };
        places.find(is_free).ok_or_else(|| PitchError::NoRoom {
            name: self.name.clone(),
            tries: TRIES,
        })
    }

    /// Returns a random pose in the bounding rectangle of the floor.
    fn anywhere(&self, rng: &mut impl Rng) -> Pose {
        let bounds = self.bounds();
        let offset = Vector::new(
            rng.random_range(0.0..bounds.width()),
            rng.random_range(0.0..bounds.height()),
        );
        let heading = Heading::from_radians(rng.random_range(-PI..PI));
        Pose::new(bounds.min + offset, heading)
    }

    /// Returns the [paper's robot](paper_robot) in this arena's light.
    ///
    /// # Errors
    /// As [`paper_robot`].
    pub fn robot(&self, seed: u64, calibration: f64) -> Result<Pioneer2dxConfig, PitchError> {
        let mut robot = paper_robot(seed, calibration)?;
        robot.camera.light = self.light;
        robot.camera.backdrop = self.backdrop;
        Ok(robot)
    }
}

/// Name of the Pioneer 2-DX, as in the files of maps.
pub const PIONEER_2DX: &str = "Pioneer 2-DX";

/// Returns the paper's robot. Each wheel counts wrongly by its own constant share within ±
/// `calibration`, drawn from `seed`; with 0 the wheels only slip.
///
/// # Errors
/// [`PitchError::Calibration`] if `calibration` is not from 0 to 0.5.
pub fn paper_robot(seed: u64, calibration: f64) -> Result<Pioneer2dxConfig, PitchError> {
    if !(0.0..=0.5).contains(&calibration) {
        return Err(PitchError::Calibration { calibration });
    }
    let mut rng = stream(seed, WHEELS);
    let mut scale = || 1.0 + calibration * rng.random_range(-1.0..=1.0);
    let wheels = WheelScale {
        left: scale(),
        right: scale(),
    };
    Ok(Pioneer2dxConfig::paper().with_wheel_scale(wheels))
}
