//! A mouse on a scripted robot: its ranges are computed, its wheels slip, and there is no
//! simulator.

use core::convert::Infallible;

use tolman_control::heading_of;
use tolman_geom::{Heading, Pose};
use tolman_maze::{Cell, Direction, Grid, Knowledge, Maze, Walls};
use tolman_planners::moves::MoveMap;
use tolman_planners::{Passages, Unknown};
use tolman_robot::{
    Compass, Goal, Guess, Landmark, Mapper, Odometry, Position, Ranges, Ring, Robot, Rolls, Scan,
    Standing, System, Task, TurnTranslate,
};

use super::{MazeMouse, MazeMouseConfig, MazeMouseError};
use crate::micromouse::{Brief, SIDE, Search};

const CONFIG: MazeMouseConfig = MazeMouseConfig {
    pitch: 0.5,
    wall_thickness: 0.0,
    turn_per_step: 0.8,
    translate_per_step: 0.2,
};

const START: Task = Task::Reach(Goal::Landmark(Landmark::Start));
const GOAL: Task = Task::Reach(Goal::Landmark(Landmark::Goal));

/// The way to the goal of fewest cells is a staircase, that of fewest moves goes round it.
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

/// Readings of the scripted robot.
struct Sensed {
    scan: Option<Scan>,
    heading: Option<Heading>,
    odometry: Option<Odometry>,
}

impl Ranges for Sensed {
    fn scan(&self) -> Option<&Scan> {
        self.scan.as_ref()
    }
}

impl Compass for Sensed {
    fn heading(&self) -> Option<Heading> {
        self.heading
    }
}

impl Rolls for Sensed {
    fn odometry(&self) -> Option<Odometry> {
        self.odometry
    }
}

/// A point on the maze's floor that turns and translates.
struct Floor {
    maze: Maze,
    pose: Pose,
    ring: Ring,
    /// The share of the way rolled that the robot does not make.
    slip: f64,
    /// Number of time steps so far. If `drops_out`, the sensors drop out every third time step.
    steps: u32,
    drops_out: bool,
    sensed: Sensed,
}

impl Floor {
    fn new(maze: &Maze) -> Self {
        let (start, heading) = maze.start().unwrap();
        let sensed = Sensed {
            scan: None,
            heading: None,
            odometry: None,
        };
        Self {
            maze: maze.clone(),
            // It was not put down exactly in the middle.
            pose: Pose::new(
                CONFIG.middle(start) + 0.03 * heading_of(heading).unit(),
                heading_of(heading),
            ),
            ring: Ring::full(72, 1.2),
            slip: 0.0,
            steps: 0,
            drops_out: false,
            sensed,
        }
    }

    fn cell(&self) -> Cell {
        let index = |along: f64| (along / CONFIG.pitch) as u16;
        Cell::new(index(self.pose.position.x), index(self.pose.position.y))
    }

    /// Returns the distance to the first wall that a beam crosses, m, going from line to line of
    /// the grid.
    fn range(&self, beam: u32) -> f64 {
        let unit = self.pose.heading.turned(self.ring.bearing(beam)).unit();
        let mut at = self.cell();
        loop {
            let middle = CONFIG.middle(at);
            let to_line = |slope: f64, middle: f64, from: f64| {
                let line = middle + 0.5 * CONFIG.pitch * slope.signum();
                (line - from) / slope
            };
            let x = to_line(unit.x, middle.x, self.pose.position.x);
            let y = to_line(unit.y, middle.y, self.pose.position.y);
            let (range, side) = match (x < y, unit.x > 0.0, unit.y > 0.0) {
                (true, true, _) => (x, Direction::East),
                (true, false, _) => (x, Direction::West),
                (false, _, true) => (y, Direction::North),
                (false, _, false) => (y, Direction::South),
            };
            match self.maze.beside(at, side) {
                Some(next) if range < self.ring.max_range => at = next,
                _ => return range.min(self.ring.max_range),
            }
        }
    }
}

impl Robot for Floor {
    type Command = TurnTranslate;
    type Sensing = Sensed;
    type Error = Infallible;

    fn sensing(&self) -> &Sensed {
        &self.sensed
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
        let turn = command.turn.clamp(-1.0, 1.0) * CONFIG.turn_per_step;
        let distance = command.translate.clamp(-1.0, 1.0) * CONFIG.translate_per_step;
        let cell = self.cell();
        self.pose = self.pose.displaced((1.0 - self.slip) * distance, turn);
        let crossed = Direction::ALL
            .into_iter()
            .any(|side| self.maze.beside(cell, side) == Some(self.cell()));
        assert!(crossed || cell == self.cell(), "it drove through a wall");
        self.steps += 1;
        let senses = !(self.drops_out && self.steps.is_multiple_of(3));
        let ranges = (0..self.ring.beams).map(|beam| self.range(beam)).collect();
        let scan = Scan {
            ring: self.ring,
            ranges,
        };
        self.sensed = Sensed {
            scan: senses.then_some(scan),
            heading: senses.then_some(self.pose.heading),
            odometry: senses.then_some(Odometry { distance, turn }),
        };
        Ok(())
    }
}

fn maze() -> Maze {
    tolman_maze::read(MAZE).unwrap().maze
}

fn brief(maze: &Maze) -> Brief {
    let (start, heading) = maze.start().unwrap();
    Brief {
        grid: maze.grid(),
        start,
        heading,
        goals: maze.goals().to_vec(),
    }
}

/// Lets the mouse pursue a task; the cells it was in, and how the task ended.
fn pursue<S: Search>(
    mouse: &mut MazeMouse<S>,
    floor: &mut Floor,
    task: Task,
) -> (Vec<Cell>, Standing) {
    let mut cells = vec![floor.cell()];
    for _ in 0..300 {
        let Ok(standing) = mouse.act(floor, task);
        if cells.last() != Some(&floor.cell()) {
            cells.push(floor.cell());
        }
        if standing != Standing::UnderWay {
            return (cells, standing);
        }
    }
    panic!("{task:?} has no end");
}

/// Returns the number of steps of a walk by the paper's rules: a turn and up to three cells each.
fn moves(walk: &[Cell]) -> u16 {
    let mut moves = 0;
    let mut row = (None, 0);
    for pair in walk.windows(2) {
        let side = Direction::ALL
            .into_iter()
            .find(|side| maze().grid().neighbour(pair[0], *side) == Some(pair[1]));
        row = if row.0 == side && row.1 < 3 {
            (side, row.1 + 1)
        } else {
            moves += 1;
            (side, 1)
        };
    }
    moves
}

fn fewest_moves(maze: &Maze) -> u16 {
    let passages = Passages::<SIDE>::new(maze, Unknown::Closed).unwrap();
    let map = MoveMap::new(&passages, maze.goals().iter().copied());
    map.moves(maze.start().unwrap().0).unwrap()
}

fn fewest_cells(maze: &Maze) -> usize {
    let start = maze.grid().index(maze.start().unwrap().0);
    maze.steps_to_goal()[start].unwrap() as usize
}

#[test]
fn the_mouse_explores_proves_and_then_makes_a_best_run() {
    let maze = maze();
    for (slip, drops_out) in [(0.0, false), (0.2, false), (0.1, true)] {
        let mut floor = Floor::new(&maze);
        (floor.slip, floor.drops_out) = (slip, drops_out);
        let mut mouse = MazeMouse::certify(brief(&maze), CONFIG).unwrap();
        assert_eq!(mouse.certificate(), None, "nothing is proven yet");
        let (walk, end) = pursue(&mut mouse, &mut floor, Task::Explore);
        assert_eq!(end, Standing::Done);
        assert!(walk.contains(&maze.goals()[0]));
        let proof = mouse.certificate().unwrap();
        assert_eq!(proof.closed_cost, u32::from(fewest_moves(&maze)));
        let (home, end) = pursue(&mut mouse, &mut floor, START);
        assert_eq!((home.last(), end), (Some(&Cell::new(0, 0)), Standing::Done));
        let (run, end) = pursue(&mut mouse, &mut floor, GOAL);
        assert_eq!((run.last(), end), (Some(&maze.goals()[0]), Standing::Done));
        assert_eq!(moves(&run), fewest_moves(&maze));
        assert!(
            run.len() - 1 > fewest_cells(&maze),
            "fewer moves take more cells"
        );
        assert!((mouse.pose().position - floor.pose.position).norm() < 0.05);
    }
}

#[test]
fn the_papers_target_search_makes_the_run_of_fewest_cells() {
    let maze = maze();
    let mut floor = Floor::new(&maze);
    let mut mouse = MazeMouse::target(brief(&maze), CONFIG).unwrap();
    for task in [Task::Explore, START] {
        assert_eq!(pursue(&mut mouse, &mut floor, task).1, Standing::Done);
    }
    let (run, end) = pursue(&mut mouse, &mut floor, GOAL);
    assert_eq!((run.len() - 1, end), (fewest_cells(&maze), Standing::Done));
}

#[test]
fn the_map_holds_what_was_seen_and_nothing_else() {
    let maze = maze();
    let mut floor = Floor::new(&maze);
    let mut mouse = MazeMouse::certify(brief(&maze), CONFIG).unwrap();
    assert_eq!(mouse.map().places.len(), 1, "the start was told");
    assert_eq!(
        pursue(&mut mouse, &mut floor, Task::Explore).1,
        Standing::Done
    );
    let map = mouse.map();
    assert!(map.places.len() > 8 && map.links.len() > 16);
    let cell = |id: u32| maze.grid().cells().nth(id as usize).unwrap();
    for place in &map.places {
        let cell = cell(place.id);
        assert_eq!(place.position, Some(CONFIG.middle(cell)));
        let is_goal = place.landmark == Some(Landmark::Goal);
        assert_eq!(is_goal, maze.goals().contains(&cell));
    }
    for link in &map.links {
        let mut beside = maze.neighbours(cell(link.from));
        assert!(beside.any(|(_, beside)| beside == cell(link.to)));
        assert!(
            map.links
                .iter()
                .any(|back| (back.from, back.to) == (link.to, link.from))
        );
    }
    let at = Position::Place(maze.grid().index(floor.cell()) as u32);
    assert_eq!(mouse.belief()[0].at, at);
}

#[test]
fn a_goal_can_be_any_cell_even_one_behind_it_before_anything_is_known() {
    let mut maze = maze();
    maze.set_start(Some((Cell::new(0, 0), Direction::West)));
    let mut floor = Floor::new(&maze);
    floor.ring = Ring::fan(37, core::f64::consts::PI, 1.2);
    let mut mouse = MazeMouse::certify(brief(&maze), CONFIG).unwrap();
    let corner = Cell::new(3, 0);
    let place = Goal::Place(maze.grid().index(corner) as u32);
    let (walk, end) = pursue(&mut mouse, &mut floor, Task::Reach(place));
    assert_eq!((walk.last(), end), (Some(&corner), Standing::Done));
    assert_eq!(walk.len(), 4, "straight on, once it has turned");
}

#[test]
fn put_down_anywhere_it_finds_itself_and_goes_to_the_goal() {
    let maze = maze();
    let mut floor = Floor::new(&maze);
    let mut mouse = MazeMouse::whole_maze(brief(&maze), CONFIG).unwrap();
    let (walk, end) = pursue(&mut mouse, &mut floor, Task::Explore);
    assert_eq!(end, Standing::Done);
    assert!(maze.reachable().all(|cell| walk.contains(&cell)));
    for (cell, heading) in maze.reachable().zip(Direction::ALL.into_iter().cycle()) {
        let off = 0.04 * heading_of(heading).unit();
        floor.pose = Pose::new(CONFIG.middle(cell) + off, heading_of(heading));
        assert_eq!(
            <MazeMouse<_> as System<Floor>>::put_down(&mut mouse),
            Standing::UnderWay
        );
        assert!(mouse.belief().len() > 1, "it can be in every cell");
        let (_, end) = pursue(&mut mouse, &mut floor, Task::Localize);
        assert_eq!(end, Standing::Done, "{cell}");
        let id = maze.grid().index(floor.cell()) as u32;
        let there = Guess {
            at: Position::Place(id),
            weight: 1.0,
        };
        assert_eq!(mouse.belief(), [there], "{cell}");
        let (run, end) = pursue(&mut mouse, &mut floor, GOAL);
        assert_eq!((run.last(), end), (Some(&maze.goals()[0]), Standing::Done));
    }
}

#[test]
fn a_cell_that_fits_nowhere_on_its_map_is_said() {
    let maze = maze();
    let mut floor = Floor::new(&maze);
    let mut mouse = MazeMouse::whole_maze(brief(&maze), CONFIG).unwrap();
    pursue(&mut mouse, &mut floor, Task::Explore);
    // Another maze: a room.
    floor.maze = Maze::open(maze.grid());
    floor.pose.position = CONFIG.middle(Cell::new(2, 2));
    let _ = <MazeMouse<_> as System<Floor>>::put_down(&mut mouse);
    let (_, end) = pursue(&mut mouse, &mut floor, Task::Localize);
    let Standing::GaveUp { why } = end else {
        panic!("{end:?}");
    };
    assert!(why.contains("fits nowhere"), "{why}");
    assert_eq!(mouse.belief(), [], "it is still lost");
}

#[test]
fn what_cannot_be_done_is_given_up_with_a_reason() {
    let gives_up = |maze: &Maze, config: MazeMouseConfig, task: Task| {
        let mut mouse = MazeMouse::certify(brief(maze), config).unwrap();
        match pursue(&mut mouse, &mut Floor::new(maze), task).1 {
            Standing::GaveUp { why } => why,
            standing => panic!("{standing:?}"),
        }
    };
    let numbered = Task::Reach(Goal::Landmark(Landmark::Numbered(3)));
    let why = gives_up(&maze(), CONFIG, numbered);
    assert!(why.contains("the goals"), "{why}");
    let mut closed = maze();
    for side in Direction::ALL {
        closed.set_wall(closed.goals()[0], side, true);
    }
    let why = gives_up(&closed, CONFIG, Task::Explore);
    assert!(why.contains("no way"), "{why}");
    // Cells of another size: what it sees cannot be.
    let config = MazeMouseConfig {
        pitch: 0.37,
        ..CONFIG
    };
    let why = gives_up(&maze(), config, Task::Explore);
    assert!(why.contains("its map"), "{why}");
}

/// It is carried to every cell, amid its exploration and before its end.
#[test]
fn carried_while_it_explores_it_finds_itself_and_explores_the_rest() {
    let maze = maze();
    for (number, cell) in maze.reachable().enumerate() {
        let mut floor = Floor::new(&maze);
        let mut mouse = MazeMouse::whole_maze(brief(&maze), CONFIG).unwrap();
        for _ in 0..4 + number % 8 {
            let Ok(standing) = mouse.act(&mut floor, Task::Explore);
            assert_eq!(standing, Standing::UnderWay);
        }
        floor.pose.position = CONFIG.middle(cell);
        let (_, end) = pursue(&mut mouse, &mut floor, Task::Explore);
        assert_eq!(end, Standing::Done, "{cell}");
        let place = maze.grid().index(floor.cell()) as u32;
        assert_eq!(mouse.belief()[0].at, Position::Place(place), "{cell}");
        for cell in maze.reachable() {
            for side in Direction::ALL {
                let found = mouse.walls().knowledge(cell, side);
                assert_eq!(found, maze.knowledge(cell, side), "{side} of {cell}");
            }
        }
        let visits = mouse.visits();
        assert_eq!(visits.len(), mouse.visit_count());
    }
}

/// A door is shut on its way, and another one is opened.
#[test]
fn a_mouse_that_meets_a_moved_wall_believes_its_eyes_and_goes_another_way() {
    let mut maze = Maze::open(Grid::new(4, 3));
    maze.set_start(Some((Cell::new(0, 0), Direction::North)));
    maze.set_goals(vec![Cell::new(3, 2)]);
    let mut floor = Floor::new(&maze);
    let mut mouse = MazeMouse::whole_maze(brief(&maze), CONFIG).unwrap();
    let (_, end) = pursue(&mut mouse, &mut floor, Task::Explore);
    assert_eq!(end, Standing::Done);
    floor.pose.position = CONFIG.middle(Cell::new(0, 0));
    mouse.pilot.put_at(floor.pose.position);
    mouse.at = Cell::new(0, 0);
    for x in 0..3 {
        floor.maze.set_wall(Cell::new(x, 1), Direction::North, true);
    }
    floor.maze.set_wall(Cell::new(2, 1), Direction::East, true);
    let (run, end) = pursue(&mut mouse, &mut floor, GOAL);
    assert_eq!((run.last(), end), (Some(&Cell::new(3, 2)), Standing::Done));
    assert_eq!(
        mouse.walls().knowledge(Cell::new(2, 1), Direction::East),
        Knowledge::Wall
    );
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let refused = |change: fn(&mut MazeMouseConfig)| {
        let mut config = CONFIG;
        change(&mut config);
        match MazeMouse::certify(brief(&maze()), config) {
            Err(MazeMouseError::Field(error)) => Some(error.field),
            _ => None,
        }
    };
    assert_eq!(refused(|_| {}), None);
    assert_eq!(refused(|config| config.pitch = 0.0), Some("pitch"));
    assert_eq!(refused(|config| config.pitch = f64::NAN), Some("pitch"));
    assert_eq!(
        refused(|config| config.wall_thickness = 0.25),
        Some("wall_thickness")
    );
    assert_eq!(
        refused(|config| config.turn_per_step = f64::INFINITY),
        Some("turn_per_step")
    );
    assert_eq!(
        refused(|config| config.translate_per_step = -1.0),
        Some("translate_per_step")
    );
}
