//! Speed runs: the search against plain Dijkstra on an explicit graph, explorations against the
//! checker.

use std::path::PathBuf;

use proptest::prelude::*;
use tolman_maze::{Cell, Direction, Grid, Knowledge, Maze, Walls};
use tolman_planners::speed_run::{
    Decision, Extent, Replanning, RunMove, RunState, Slalom, SlalomTurn, SlalomTurns,
    SpeedRunCertificate, SpeedRunCertificateError, SpeedRunConfig, SpeedRunExplorer, SpeedRunMap,
    SpeedRunPlanner, SpeedRunTimes, best_possible_ms,
};
use tolman_planners::{Passages, Unknown};

/// Every wall known, known to be open, or unknown.
#[derive(Clone, Debug)]
struct Sketch {
    grid: Grid,
    /// By [`Grid::wall`].
    walls: Vec<Knowledge>,
}

impl Walls for Sketch {
    fn grid(&self) -> Grid {
        self.grid
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        self.walls[self.grid.wall(cell, direction).0 as usize]
    }
}

impl Sketch {
    /// Returns walls of which only the border is known.
    fn dark(grid: Grid) -> Self {
        let mut sketch = Self {
            grid,
            walls: vec![Knowledge::Unknown; grid.wall_count()],
        };
        for (cell, direction) in grid.border() {
            sketch.set(cell, direction, Knowledge::Wall);
        }
        sketch
    }

    fn set(&mut self, cell: Cell, direction: Direction, knowledge: Knowledge) {
        self.walls[self.grid.wall(cell, direction).0 as usize] = knowledge;
    }

    fn look(&mut self, maze: &Maze, cell: Cell) {
        for direction in Direction::ALL {
            self.set(cell, direction, maze.knowledge(cell, direction));
        }
    }
}

/// Returns a maze of 1 to 12 cells a side with a third of its walls unknown, start and goals
/// anywhere.
fn sketches() -> impl Strategy<Value = (Sketch, Cell, Direction, Vec<Cell>)> {
    (1_u16..=12, 1_u16..=12).prop_flat_map(|(width, height)| {
        let grid = Grid::new(width, height);
        let cell = (0..width, 0..height).prop_map(|(x, y)| Cell::new(x, y));
        let wall = prop_oneof![
            3 => Just(Knowledge::Open),
            2 => Just(Knowledge::Wall),
            1 => Just(Knowledge::Unknown),
        ];
        (
            prop::collection::vec(wall, grid.wall_count()),
            cell.clone(),
            prop::sample::select(&Direction::ALL[..]),
            prop::collection::vec(cell, 1..4),
        )
            .prop_map(move |(walls, start, heading, goals)| {
                let mut sketch = Sketch { grid, walls };
                for (cell, direction) in grid.border() {
                    sketch.set(cell, direction, Knowledge::Wall);
                }
                (sketch, start, heading, goals)
            })
    })
}

fn configs() -> impl Strategy<Value = SpeedRunConfig> {
    prop_oneof![
        Just(SpeedRunConfig::classic()),
        Just(SpeedRunConfig::half_size()),
        Just(SpeedRunConfig::beginner()),
        Just(SpeedRunConfig::classic().without_diagonals()),
        // Straights dear, turns cheap, and a top speed that is reached at once.
        (300.0..420.0, 420.0..600.0, factors()).prop_map(|(slow, fast, factors)| {
            let mut config = SpeedRunConfig::half_size();
            config.turn_speed_mm_s = slow;
            config.diagonal.top_speed_mm_s = fast;
            config.straight.top_speed_mm_s = slow;
            config.slalom = turns(&config, factors);
            config
        }),
    ]
    .prop_filter("moves that last too differently are refused", |config| {
        SpeedRunTimes::<16>::new(config).is_ok()
    })
}

/// How many times its least time each turn takes, in the order of [`Slalom::ALL`].
fn factors() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(1.0..3.0)
}

/// Returns turns that take their least times these `factors`. A mouse does not make those of 2.7
/// or more.
fn turns(config: &SpeedRunConfig, factors: [f64; 6]) -> SlalomTurns {
    let turn = |number: usize| {
        let least = Slalom::ALL[number].least_cells() * config.cell_mm / config.turn_speed_mm_s;
        let time_ms = (1000.0 * least * factors[number]) as u32;
        (factors[number] < 2.7).then_some(SlalomTurn::Timed { time_ms })
    };
    let mut turns = SlalomTurns::NONE;
    (turns.f45, turns.f90, turns.f135) = (turn(0), turn(1), turn(2));
    (turns.f180, turns.fv90, turns.fs90) = (turn(3), turn(4), turn(5));
    turns
}

/// Configurations with slow straights, turns that last anything and differ to the left, and braking
/// apart from accelerating.
fn uneven_configs<const N: usize>() -> impl Strategy<Value = SpeedRunConfig> {
    let speeds = (60.0..300.0, 1.0..1.5, 1.0..1.5, 1000.0..9000.0);
    (speeds, factors(), factors()).prop_filter_map(
        "moves that last too differently are refused",
        |((slow, straight, diagonal, braking), right, left)| {
            let mut config = SpeedRunConfig::half_size();
            config.turn_speed_mm_s = slow;
            config.straight.top_speed_mm_s = slow * straight;
            config.straight.braking_mm_s2 = Some(braking);
            config.diagonal.top_speed_mm_s = slow * diagonal;
            config.slalom = turns(&config, right);
            config.slalom_left = Some(turns(&config, left));
            SpeedRunTimes::<N>::new(&config).is_ok().then_some(config)
        },
    )
}

fn start_of(cell: Cell, heading: Direction) -> RunState {
    RunState::Straight { cell, heading }
}

proptest! {
    #[test]
    fn the_search_finds_what_plain_dijkstra_finds(
        (sketch, start, heading, goals) in sketches(),
        config in configs(),
    ) {
        let times = SpeedRunTimes::<16>::new(&config).unwrap();
        let from = start_of(start, heading);
        let mut map = SpeedRunMap::<16>::new();
        let hoped = Passages::new(&sketch, Unknown::Open).unwrap();
        let expected = best_possible_ms(&sketch, &config, (start, heading), &goals);
        for extent in [Extent::Until(from), Extent::Everywhere] {
            map.search(&hoped, &times, &goals, extent);
            prop_assert_eq!(map.time_ms(from), expected);
            let mut run = map.run(&hoped, &times, from);
            run.by_ref().for_each(drop);
            prop_assert_eq!(run.has_arrived(), expected.is_some());
        }
    }

    /// Also where a straight and a turn lead on by more buckets than the queue has.
    #[test]
    fn moves_that_last_very_differently_are_searched_too(
        (sketch, start, heading, goals) in sketches(),
        config in uneven_configs::<12>(),
    ) {
        let times = SpeedRunTimes::<12>::new(&config).unwrap();
        let from = start_of(start, heading);
        let mut map = SpeedRunMap::<12>::new();
        let mut small = SpeedRunMap::<12, [u16; 16]>::new();
        let hoped = Passages::new(&sketch, Unknown::Open).unwrap();
        let expected = best_possible_ms(&sketch, &config, (start, heading), &goals);
        for extent in [Extent::Until(from), Extent::Everywhere] {
            map.search(&hoped, &times, &goals, extent);
            prop_assert_eq!(map.time_ms(from), expected);
            let mut run = map.run(&hoped, &times, from);
            run.by_ref().for_each(drop);
            prop_assert_eq!(run.has_arrived(), expected.is_some());
            small.search(&hoped, &times, &goals, extent);
            let held = expected.filter(|best| *best < u32::from(u16::MAX));
            prop_assert_eq!(small.time_ms(from), held);
        }
    }

    #[test]
    fn a_run_on_known_walls_is_certified_where_nothing_better_can_be_hoped_for(
        (sketch, start, heading, goals) in sketches(),
        config in configs(),
    ) {
        let times = SpeedRunTimes::<16>::new(&config).unwrap();
        let from = start_of(start, heading);
        let known = Passages::new(&sketch, Unknown::Closed).unwrap();
        let mut map = SpeedRunMap::<16>::new();
        map.search(&known, &times, &goals, Extent::Everywhere);
        if let Some(time) = map.time_ms(from) {
            let run = map.run(&known, &times, from);
            let edges: Vec<_> = run.clone().edges().collect();
            for (cell, direction) in &edges {
                prop_assert_eq!(sketch.knowledge(*cell, *direction), Knowledge::Open);
            }
            let mut certificate = SpeedRunCertificate {
                start,
                heading,
                moves: run.map(|step| step.run_move).collect(),
                time_ms: time,
            };
            let hoped = best_possible_ms(&sketch, &config, (start, heading), &goals).unwrap();
            let verdict = certificate.check(&sketch, &config, &goals);
            prop_assert_eq!(verdict.is_ok(), hoped == time, "{:?}", verdict);
            certificate.time_ms += 1;
            prop_assert!(certificate.check(&sketch, &config, &goals).is_err());
        }
    }

    #[test]
    fn the_incremental_plan_is_as_fast_as_a_new_one(
        (truth, start, heading, goals) in sketches(),
        order in prop::collection::vec((0_u16..12, 0_u16..12, any::<bool>()), 0..60),
    ) {
        let times = SpeedRunTimes::<16>::new(&SpeedRunConfig::classic()).unwrap();
        let from = start_of(start, heading);
        let mut sketch = Sketch::dark(truth.grid);
        let mut planner = SpeedRunPlanner::<16>::new(&times, from, &goals);
        let mut map = SpeedRunMap::<16>::new();
        for (x, y, forget) in order {
            let cell = Cell::new(x, y);
            if truth.grid.contains(cell) {
                // Walls are seen, and now and then forgotten.
                for direction in Direction::ALL {
                    let inner = truth.grid.neighbour(cell, direction).is_some();
                    let known = if forget && inner {
                        Knowledge::Unknown
                    } else {
                        truth.knowledge(cell, direction)
                    };
                    sketch.set(cell, direction, known);
                }
            }
            let hoped = Passages::new(&sketch, Unknown::Open).unwrap();
            planner.update(&hoped);
            map.search(&hoped, &times, &goals, Extent::Everywhere);
            prop_assert_eq!(planner.time_ms(), map.time_ms(from));
            let mut run = planner.run(&hoped);
            run.by_ref().for_each(drop);
            prop_assert_eq!(run.has_arrived(), planner.time_ms().is_some());
            prop_assert_eq!(planner.update(&hoped), Replanning::Kept);
        }
    }

    #[test]
    fn explorations_end_at_home_with_a_run_that_the_checker_certifies(
        (sketch, start, heading, goals) in sketches(),
    ) {
        let mut maze = Maze::open(sketch.grid);
        for cell in sketch.grid.cells() {
            for direction in [Direction::North, Direction::East] {
                let stands = sketch.knowledge(cell, direction) == Knowledge::Wall;
                maze.set_wall(cell, direction, stands);
            }
        }
        let config = SpeedRunConfig::half_size();
        let expected = best_possible_ms(&maze, &config, (start, heading), &goals);
        let outcome = explore::<16>(&maze, start, heading, &goals, &config);
        prop_assert_eq!(outcome, expected);
    }
}

/// Explores and has the result checked. Returns the duration of the run, or `None` if the explorer
/// is stuck.
fn explore<const N: usize>(
    maze: &Maze,
    home: Cell,
    heading: Direction,
    goals: &[Cell],
    config: &SpeedRunConfig,
) -> Option<u32> {
    let times = SpeedRunTimes::<N>::new(config).unwrap();
    let mut explorer = SpeedRunExplorer::<N>::new(&times, home, heading, goals);
    let mut sketch = Sketch::dark(maze.grid());
    let (mut at, mut looks) = (home, heading);
    let mut cells = 0;
    let mut was_at_goal = false;
    loop {
        sketch.look(maze, at);
        was_at_goal |= goals.contains(&at);
        match explorer.decide(&sketch, at, looks).unwrap() {
            Decision::Drive(direction) => {
                assert!(maze.is_open(at, direction), "against the wall at {at}");
                at = maze.grid().neighbour(at, direction).unwrap();
                looks = direction;
                cells += 1;
                assert!(cells < 20_000, "an exploration that does not end");
            }
            Decision::Finished { run_ms } => {
                assert!(was_at_goal && at == home);
                let known = Passages::new(&sketch, Unknown::Closed).unwrap();
                let run = explorer.planner().run(&known);
                let certificate = SpeedRunCertificate {
                    start: home,
                    heading,
                    moves: run.map(|step| step.run_move).collect(),
                    time_ms: run_ms,
                };
                assert_eq!(certificate.check(&sketch, config, goals), Ok(()));
                return Some(run_ms);
            }
            Decision::Stuck => return None,
        }
    }
}

/// Returns every twentieth maze of a folder of other people's mazes, or none and a message where
/// they are not at hand.
fn mazes_of_others(folder: &str) -> Vec<Maze> {
    let data = std::env::var_os("TOLMAN_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let Ok(entries) = std::fs::read_dir(data.join("mazes").join(folder)) else {
        #[expect(clippy::print_stderr, reason = "a test left out has to say so")]
        {
            eprintln!("SKIPPED: {folder} is not there; set TOLMAN_DATA to run this test");
        }
        return Vec::new();
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let texts = paths
        .iter()
        .step_by(20)
        .map(|path| std::fs::read_to_string(path).unwrap());
    let files = texts.filter_map(|text| tolman_maze::read(&text).ok());
    files.map(|file| file.maze).collect()
}

#[test]
fn competition_mazes_are_explored_and_certified() {
    for (folder, config) in [
        ("classic", SpeedRunConfig::classic()),
        ("halfsize", SpeedRunConfig::half_size()),
    ] {
        for maze in mazes_of_others(folder) {
            let (home, heading) = maze.start().unwrap();
            let best = best_possible_ms(&maze, &config, (home, heading), maze.goals());
            let found = explore::<32>(&maze, home, heading, maze.goals(), &config);
            assert!(found.is_some());
            assert_eq!(found, best, "\n{maze}");
        }
    }
}

/// Beyond the border there is no way, even where the first wall inside is open.
#[test]
fn no_run_leads_over_the_border() {
    let maze = Maze::open(Grid::new(3, 3));
    let config = SpeedRunConfig::classic();
    for (cell, heading) in [
        (Cell::new(0, 1), Direction::West),
        (Cell::new(1, 0), Direction::South),
        (Cell::new(2, 1), Direction::East),
        (Cell::new(1, 2), Direction::North),
        (Cell::new(0, 0), Direction::West),
        (Cell::new(0, 0), Direction::South),
    ] {
        let run_move = RunMove::Straight { half_cells: 2 };
        let certificate = SpeedRunCertificate {
            start: cell,
            heading,
            moves: vec![run_move],
            time_ms: 0,
        };
        let told = certificate.check(&maze, &config, &[cell]);
        let expected = SpeedRunCertificateError::NotOpen {
            number: 0,
            run_move,
        };
        assert_eq!(told, Err(expected), "{cell:?} {heading:?}");
    }
}
