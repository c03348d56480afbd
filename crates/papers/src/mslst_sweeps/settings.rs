//! Varied parameters: each alone around MSLST 50 in the Large maze, and then the worlds.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;
use tolman_maze::{Braided, Cell, Grid, Maze, MazeFile, Perfect};
use tolman_robot::Ring;
use tolman_sim::robots::LaserPioneerConfig;

use crate::venue::{self, Venue};
use tolman_arena::course::Course;
use tolman_arena::pioneer;
use tolman_experiment::BoxError;
use tolman_systems::mslst::MslstConfig;
use tolman_systems::mslst::ROBOT_UNIT;

/// A table: one parameter, varied over several rows.
#[derive(Debug)]
pub(super) struct Sweep {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// The varied parameter with its unit; `None` if the settings have no order.
    pub(super) axis: Option<&'static str>,
    pub(super) settings: Vec<Setting>,
    pub(super) note: &'static str,
}

/// A row of a sweep: one value of the varied parameter.
#[derive(Debug)]
pub(super) struct Setting {
    pub(super) row: String,
    /// Value on the axis.
    pub(super) value: f64,
    pub(super) config: MslstConfig,
    pub(super) robot: LaserPioneerConfig,
    pub(super) world: World,
}

/// World of a run.
#[derive(Clone, Debug)]
pub(super) enum World {
    /// The same world for all runs, with its own step limit.
    Fixed { course: Box<Course>, steps: u32 },
    /// A random maze for each run, without loops.
    Perfect { side: u16 },
    /// A random maze for each run with every other dead end opened.
    Braided { side: u16 },
}

impl World {
    /// Returns the world of the run with this seed.
    fn venue(&self, seed: u64) -> Result<Venue, BoxError> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        let maze = match *self {
            Self::Fixed { ref course, steps } => {
                return Ok(Venue::new("", "", (**course).clone(), steps));
            }
            Self::Perfect { side } => Perfect {
                width: side,
                height: side,
            }
            .generate(rng)?,
            Self::Braided { side } => Braided {
                width: side,
                height: side,
                share: 0.5,
            }
            .generate(rng)?,
        };
        Venue::of_maze("", &self.name(), maze)
    }

    fn name(&self) -> String {
        match self {
            Self::Fixed { course, .. } => course.name.clone(),
            Self::Perfect { side } => format!("perfect {side} × {side}"),
            Self::Braided { side } => format!("braided {side} × {side}"),
        }
    }
}

impl Setting {
    /// Returns the world of the run with this seed, with this robot.
    pub(super) fn venue(&self, seed: u64) -> Result<Venue, BoxError> {
        let mut venue = self.world.venue(seed)?;
        venue.robot = self.robot.clone();
        Ok(venue)
    }

    /// Returns the configuration that its runs depend on.
    pub(super) fn config(&self) -> impl Serialize {
        #[derive(Serialize)]
        struct Config<'a> {
            mslst: MslstConfig,
            robot: &'a LaserPioneerConfig,
            world: String,
            #[serde(flatten)]
            fixed: Option<venue::World>,
        }
        let fixed = match &self.world {
            World::Fixed { course, steps } => Some(venue::World::of(course, *steps)),
            _ => None,
        };
        Config {
            mslst: self.config,
            robot: &self.robot,
            world: self.world.name(),
            fixed,
        }
    }
}

/// Returns every sweep.
pub(super) fn all() -> Result<Vec<Sweep>, BoxError> {
    let [j, large] = fixed()?;
    let at = |value: f64, change: &dyn Fn(&mut MslstConfig)| {
        let mut config = MslstConfig::large(50.0);
        change(&mut config);
        Setting {
            row: format!("{value}"),
            value,
            config,
            robot: pioneer::calibrated(),
            world: large.clone(),
        }
    };
    let thresholds = [5.0, 10.0, 20.0, 35.0, 50.0, 75.0, 100.0, 200.0];
    let actions = [250, 500, 1000, 2000, 4000, 8000];
    let steps = [500, 1000, 2000, 4000, 8000];
    let memories = [1, 2, 4, 6, 8, 12, 16, 24];
    let noises = [0.0, 0.5, 1.0, 1.5, 2.0];
    let by = |name, title, axis, settings| Sweep {
        name,
        title,
        axis: Some(axis),
        settings,
        note: "Large maze, threshold 50.",
    };
    let threshold = |threshold| at(threshold, &|config| config.threshold = threshold);
    let graph = |actions: u32| at(actions.into(), &|config| config.graph_actions = actions);
    let scans = |steps: u32| at(steps.into(), &|config| config.scan_steps = steps);
    let memory = |memory: u32| at(memory.into(), &|config| config.memory = memory);
    let noise = |times| Setting {
        robot: noisy(times),
        ..at(times, &|_| {})
    };
    Ok(vec![
        Sweep {
            note: "Large maze.",
            ..by(
                "threshold",
                "The error threshold of the quantizer",
                "threshold, squared robot units",
                thresholds.map(threshold).into(),
            )
        },
        by(
            "graph",
            "The length of Phase II",
            "actions of Phase II",
            actions.map(graph).into(),
        ),
        by(
            "scans",
            "The length of Phase I",
            "time steps of Phase I",
            steps.map(scans).into(),
        ),
        by(
            "memory",
            "How much is remembered",
            "pairs of state and action",
            memories.map(memory).into(),
        ),
        by(
            "noise",
            "The noise of the motors",
            "times the calibrated noise",
            noises.map(noise).into(),
        ),
        Sweep {
            name: "worlds",
            title: "Other worlds",
            axis: None,
            settings: worlds(j, &large)?,
            note: "Threshold 50 and a memory of eight, in the J maze 100 and six. Random mazes are new in each run, \
                   and give time in proportion to their corridors.",
        },
    ])
}

/// Returns the paper's two worlds with its limits.
fn fixed() -> Result<[World; 2], BoxError> {
    let fixed = |venue: Venue| World::Fixed {
        steps: venue.step_limit,
        course: Box::new(venue.course),
    };
    Ok(venue::papers()?.map(fixed))
}

fn noisy(times: f64) -> LaserPioneerConfig {
    let mut robot = pioneer::calibrated();
    let noise = &mut robot.motor_noise;
    noise.turn.relative_sd *= times;
    noise.turn.absolute_sd *= times;
    noise.translate.relative_sd *= times;
    noise.drift_sd *= times;
    robot
}

fn worlds(j: World, large: &World) -> Result<Vec<Setting>, BoxError> {
    let row = |row: &str, world: World| Setting {
        row: row.to_owned(),
        value: 0.0,
        config: MslstConfig::large(50.0),
        robot: pioneer::calibrated(),
        world,
    };
    let mut rows = vec![
        Setting {
            config: MslstConfig::j(),
            ..row("J", j)
        },
        row("Large", large.clone()),
        Setting {
            robot: with_sonars(),
            ..row("Large, 8 sonars", large.clone())
        },
    ];
    for units in [1.85, 2.1, 2.5] {
        let world = widened(large, units)?;
        rows.push(row(&format!("Large, {units} units wide"), world));
    }
    rows.push(row("open room 6 × 6", room(6)?));
    for side in [10, 20, 30] {
        let world = World::Perfect { side };
        rows.push(row(&world.name(), world));
        let world = World::Braided { side };
        rows.push(row(&world.name(), world));
    }
    Ok(rows)
}

/// Returns a robot with a ring of eight beams instead of the laser's 72, like the sonars of a
/// Khepera.
fn with_sonars() -> LaserPioneerConfig {
    let mut robot = pioneer::calibrated();
    robot.ring = Ring::full(8, robot.ring.max_range);
    robot
}

/// Returns the same maze with corridors of `units` robot units.
fn widened(world: &World, units: f64) -> Result<World, BoxError> {
    let World::Fixed { course, steps } = world else {
        return Ok(world.clone());
    };
    let file = MazeFile {
        corridor_width: Some(units * ROBOT_UNIT),
        ..course.maze.clone().into()
    };
    let course = Course::for_body(&course.name, &file, &pioneer::body())?;
    Ok(World::Fixed {
        course: Box::new(course),
        steps: *steps,
    })
}

/// Returns a square without inner walls, with the destination in its south-east corner.
fn room(side: u16) -> Result<World, BoxError> {
    let mut maze = Maze::open(Grid::new(side, side));
    maze.set_goals(vec![Cell::new(side - 1, 0)]);
    let name = format!("open room {side} × {side}");
    let course = Course::for_body(&name, &MazeFile::from(maze), &pioneer::body())?;
    Ok(World::Fixed {
        steps: course.step_limit(),
        course: Box::new(course),
    })
}
