//! A micromouse as a system: it drives the simulated laser Pioneer of MSLST.

use alloc::sync::Arc;

use tolman_geom::Pose;
use tolman_maze::{Cell, Maze};
use tolman_robot::{Goal, Landmark, Task};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::{CorridorSize, World};
use tolman_systems::micromouse::Search;
use tolman_systems::micromouse::system::{MazeMouse, MazeMouseConfig};

use tolman_arena::Simulated;
use tolman_arena::micromouse::{brief, check};
use tolman_arena::pioneer::{self, CORRIDOR_WIDTH};
use tolman_arena::run::{Limited, TaskEnd, run};

const MAZE: &str = "\
o---o---o---o---o
|               |
o   o---o---o   o
|   |   |     G |
o   o   o   o---o
|   |       |   |
o   o   o---o   o
| S             |
o---o---o---o---o
";

const START: Task = Task::Reach(Goal::Landmark(Landmark::Start));
const GOAL: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

/// Result of one mouse: the cells it really crossed, by task, and how each task ended.
struct Outing {
    cells: Vec<(Vec<Cell>, TaskEnd)>,
    /// Number of time steps in which the robot touched a wall.
    bumps: u32,
}

fn config(robot: &LaserPioneerConfig, thickness: f64) -> MazeMouseConfig {
    let mut config = MazeMouseConfig::new(
        CORRIDOR_WIDTH + thickness,
        robot.turn_per_step,
        robot.translate_per_step,
    );
    config.wall_thickness = thickness;
    config
}

/// Lets a mouse pursue its tasks one by one with a robot in a maze.
fn send<S: Search>(
    maze: &Maze,
    thickness: f64,
    robot: &LaserPioneerConfig,
    mouse: &mut MazeMouse<S>,
    tasks: &[Task],
) -> Outing {
    let size = CorridorSize {
        corridor_width: CORRIDOR_WIDTH,
        wall_thickness: thickness,
    };
    let world = Arc::new(World::from_maze(maze, &size).unwrap());
    let (start, heading) = maze.start().unwrap();
    let pose = Pose::new(
        world.cell_centre(start),
        tolman_control::heading_of(heading),
    );
    let body = LaserPioneer::new(robot.clone()).unwrap();
    let mut pioneer = Simulated::new(Arc::clone(&world), body, pose, 7).unwrap();
    let mut outing = Vec::new();
    for task in tasks {
        let from = pioneer.path().len();
        let mut limited = Limited::new(&mut pioneer, 3000);
        let end = run(&mut limited, mouse, *task).unwrap().end;
        drop(limited);
        let path = pioneer.path()[from..].iter();
        let mut cells: Vec<Cell> = path
            .map(|pose| world.cell_at(pose.position).unwrap())
            .collect();
        cells.dedup();
        outing.push((cells, end));
    }
    Outing {
        cells: outing,
        bumps: pioneer.bumps(),
    }
}

#[test]
fn it_explores_and_proves_and_runs_on_the_calibrated_pioneer() {
    let maze = tolman_maze::read(MAZE).unwrap().maze;
    for thickness in [0.0, 0.1] {
        let robot = pioneer::calibrated();
        let mut mouse =
            MazeMouse::certify(brief(&maze).unwrap(), config(&robot, thickness)).unwrap();
        let tasks = [Task::Explore, START, GOAL];
        let outing = send(&maze, thickness, &robot, &mut mouse, &tasks);
        let proof = mouse.certificate().unwrap();
        assert_eq!(check(&proof, &maze), Ok(()));
        let [(explored, end), (home, back), (run, done)] = &outing.cells[..] else {
            panic!("three tasks");
        };
        assert_eq!([end, back, done], [&TaskEnd::Done; 3]);
        assert!(explored.contains(&Cell::new(3, 2)));
        assert_eq!(home.last(), Some(&Cell::new(0, 0)));
        // North three, east three, south one: the run that was proven, stop by stop.
        assert_eq!(run.len(), 8);
        assert!(proof.run.iter().all(|stop| run.contains(stop)));
        assert_eq!(run.last(), Some(&Cell::new(3, 2)));
        assert_eq!(outing.bumps, 0);
    }
}

#[test]
fn the_papers_target_search_runs_by_the_fewest_cells() {
    let maze = tolman_maze::read(MAZE).unwrap().maze;
    let robot = pioneer::calibrated();
    let mut mouse = MazeMouse::target(brief(&maze).unwrap(), config(&robot, 0.0)).unwrap();
    let outing = send(
        &maze,
        0.0,
        &robot,
        &mut mouse,
        &[Task::Explore, START, GOAL],
    );
    let (run, end) = &outing.cells[2];
    let shortest = maze.steps_to_goal()[0].unwrap() as usize;
    assert_eq!((end, run.len() - 1), (&TaskEnd::Done, shortest));
}

#[test]
fn a_mouse_that_is_told_the_wrong_pitch_does_not_arrive() {
    let maze = tolman_maze::read(MAZE).unwrap().maze;
    let robot = pioneer::calibrated();
    let mut told = config(&robot, 0.0);
    told.pitch = 0.7;
    let mut mouse = MazeMouse::certify(brief(&maze).unwrap(), told).unwrap();
    let outing = send(&maze, 0.0, &robot, &mut mouse, &[Task::Explore]);
    assert!(matches!(outing.cells[0].1, TaskEnd::GaveUp { .. }));
    assert_eq!(mouse.certificate(), None);
}
