//! How often the corridor detector calls each kind of place a corridor.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::{CorridorDetector, View};
use tolman_geom::{Heading, Pose, Vector};
use tolman_maze::{Cell, Direction, Grid, Maze, MazeFile};
use tolman_robot::Robot;
use tolman_sim::Solo;
use tolman_sim::robots::LaserPioneer;

use tolman_arena::course::Course;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};

/// The table's name in `summary.json`.
pub(super) const NAME: &str = "corridor detector";

record! {
    /// Random poses in one kind of place.
    struct CorridorRun {
        /// Share of the poses at which the detector calls the place a corridor.
        called_corridor_percent: f64 => neither("called corridor").percent(),
    }
}

/// Number of random poses in a run.
const POSES: u32 = 200;

/// Length of a place's arms, cells: farther than the laser sees.
const ARM: u16 = 2;

/// Kinds of places, with the directions in which they are open.
const PLACES: [(&str, &[Direction]); 5] = [
    ("corridor", &[Direction::North, Direction::South]),
    ("bend", &[Direction::North, Direction::East]),
    (
        "T junction",
        &[Direction::North, Direction::East, Direction::South],
    ),
    ("crossing", &Direction::ALL),
    ("dead end", &[Direction::North]),
];

pub(super) fn table() -> Table {
    let title = "What the corridor detector takes for a corridor";
    Table::of::<CorridorRun>(NAME, title)
        .metrics_from(CorridorRun::called_corridor_percent)
        .rows(PLACES.map(|(name, _)| Row::new(name)))
        .note(format!(
            "{POSES} poses a run, anywhere in the cell where the robot stands clear and with any heading."
        ))
}

/// Plays one run: the share of random poses at which a place looks like a corridor.
pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let open = PLACES
        .iter()
        .find(|(name, _)| *name == job.row)
        .map_or(&[][..], |(_, open)| open);
    let centre = Cell::new(ARM, ARM);
    let file = MazeFile::from(place(centre, open));
    let course = Course::for_body(job.row, &file, &pioneer::body())?;
    let detector = CorridorDetector::new(pioneer::ring(), course.corridor_width)?;
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let half = 0.5 * course.corridor_width;
    let (mut poses, mut called) = (0_u32, 0_u32);
    while poses < POSES {
        let offset = Vector::new(
            rng.random_range(-half..=half),
            rng.random_range(-half..=half),
        );
        let heading = Heading::from_degrees(rng.random_range(-180.0..180.0));
        let pose = Pose::new(course.world.cell_centre(centre) + offset, heading);
        if !course.world.clear_for(&pioneer::body(), pose) {
            continue;
        }
        poses += 1;
        let robot = LaserPioneer::new(pioneer::calibrated())?;
        let solo = Solo::new(course.world.clone(), robot, pose, job.seed)?;
        if let Some(scan) = &solo.sensing().scan {
            called += u32::from(detector.detect(View { scan, heading }).is_some());
        }
    }
    let called_corridor_percent = 100.0 * f64::from(called) / f64::from(POSES);
    Ok(CorridorRun {
        called_corridor_percent,
    }
    .fields()?)
}

/// Returns a place with straight arms in the directions in which it is open. The goal is at the end
/// of one.
fn place(centre: Cell, open: &[Direction]) -> Maze {
    let grid = Grid::new(2 * ARM + 1, 2 * ARM + 1);
    let mut maze = Maze::solid(grid);
    let mut end = centre;
    for &direction in open {
        end = centre;
        for _ in 0..ARM {
            maze.set_wall(end, direction, false);
            end = grid.neighbour(end, direction).unwrap_or(end);
        }
    }
    maze.set_goals(vec![end]);
    maze
}
