//! Tests of the mouse on mazes: undisturbed, after crashes, and moved unnoticed.
#![expect(clippy::unwrap_used, reason = "a failed unwrap is a failed test")]

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use tolman_firmware::{Command, MAZE, Mouse, Sides};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_planners::speed_run::{RunStep, SpeedRunConfig, SpeedRunTimes, best_possible_ms};

/// What befalls the mouse after a drive.
#[derive(Clone, Copy, Debug)]
enum Mishap {
    /// It crashes, says so, and is put down in a cell where it has been.
    Crash,
    /// It is put down in any cell.
    Carried,
    /// It is put down in a cell where it has been.
    PutBack,
    /// It drives a cell too far.
    Far,
    /// It stays in the cell from which it came.
    Short,
    /// It looks to another side than it believes.
    Turned,
}

/// How a search ended.
#[derive(Debug, PartialEq)]
enum End {
    Ready { run_ms: u32 },
    GaveUp,
    TooLong,
}

/// A simulated mouse.
struct Body<'a> {
    maze: &'a Maze,
    at: Cell,
    heading: Direction,
    /// Where it has been, and how it came in.
    trail: Vec<(Cell, Direction)>,
    rng: ChaCha8Rng,
}

const START: (Cell, Direction) = (Cell::new(0, 0), Direction::North);

fn maze(seed: u64, share: f64) -> Maze {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (width, height) = (MAZE as u16, MAZE as u16);
    let braided = Braided {
        width,
        height,
        share,
    };
    let mut maze = braided.generate(&mut rng).unwrap();
    maze.set_goals(maze.grid().middle().collect());
    maze
}

fn best_ms(maze: &Maze) -> Option<u32> {
    best_possible_ms(maze, &SpeedRunConfig::classic(), START, maze.goals())
}

impl<'a> Body<'a> {
    fn new(maze: &'a Maze, seed: u64) -> Self {
        Self {
            maze,
            at: START.0,
            heading: START.1,
            trail: Vec::new(),
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    fn is_open(&self, side: Direction) -> bool {
        self.maze.is_open(self.at, self.heading.turned(side))
    }

    fn look(&self) -> Sides {
        Sides::read(|side| self.is_open(side))
    }

    /// Drives one cell. Returns whether a wall stopped it.
    fn drive(&mut self, side: Direction) -> bool {
        let is_open = self.is_open(side);
        if is_open {
            self.heading = self.heading.turned(side);
            self.at = self.maze.grid().neighbour(self.at, self.heading).unwrap();
            self.trail.push((self.at, self.heading));
        }
        !is_open
    }

    fn pick(&mut self, count: usize) -> usize {
        (self.rng.next_u64() % count as u64) as usize
    }

    /// Moves the mouse so that the side behind it is open, as after a drive.
    fn suffer(&mut self, mishap: Mishap) {
        match mishap {
            Mishap::Crash | Mishap::PutBack => {
                let visit = self.pick(self.trail.len());
                (self.at, self.heading) = self.trail[visit];
            }
            Mishap::Carried => {
                self.at = Cell::new(self.pick(MAZE) as u16, self.pick(MAZE) as u16);
                self.turn();
            }
            Mishap::Far if self.is_open(Direction::North) => {
                self.drive(Direction::North);
            }
            Mishap::Short if self.trail.len() > 1 => {
                (self.at, self.heading) = self.trail[self.trail.len() - 2];
            }
            Mishap::Turned => self.turn(),
            Mishap::Far | Mishap::Short => {}
        }
    }

    fn turn(&mut self) {
        let ways = Direction::ALL.map(|heading| (heading, heading.opposite()));
        let open = ways.map(|(heading, behind)| (heading, self.maze.is_open(self.at, behind)));
        let open: Vec<Direction> = open
            .into_iter()
            .filter_map(|(heading, is_open)| is_open.then_some(heading))
            .collect();
        self.heading = open[self.pick(open.len())];
    }
}

/// Drives until the mouse stays. The mishap befalls it after each number of cells in `when`.
fn search(maze: &Maze, mishap: Mishap, when: &[usize], seed: u64) -> End {
    let times = SpeedRunTimes::new(&SpeedRunConfig::classic()).unwrap();
    let mut mouse = Mouse::new(&times, maze.goals());
    let mut body = Body::new(maze, seed);
    for cells in 0..5000 {
        match mouse.arrive(body.look()).unwrap() {
            Command::Drive(side) => {
                let is_stopped = body.drive(side);
                assert!(!(is_stopped && when.is_empty()), "against a wall");
                if is_stopped {
                    mouse.crash().unwrap();
                }
            }
            Command::Ready { run_ms } => {
                let mut moves = 0;
                mouse.run(|_: RunStep| moves += 1).unwrap();
                assert!(moves > 0);
                return End::Ready { run_ms };
            }
            Command::CarryBack => {
                assert!(!when.is_empty(), "lost without a mishap");
                (body.at, body.heading) = START;
                mouse.carried_back();
            }
            Command::GiveUp => return End::GaveUp,
        }
        if when.contains(&cells) && !body.trail.is_empty() {
            body.suffer(mishap);
            if matches!(mishap, Mishap::Crash) {
                mouse.crash().unwrap();
            }
        }
    }
    End::TooLong
}

/// Returns how many of these mice know the best run in the end, each in a maze of its own. Mazes
/// with few and with many loops take turns.
fn right_of(mishap: Mishap, mazes: core::ops::Range<u64>) -> usize {
    let is_right = |seed: &u64| {
        let maze = maze(*seed, [0.1, 0.3, 0.5, 0.7][*seed as usize % 4]);
        let when = ChaCha8Rng::seed_from_u64(*seed).next_u64() as usize % 200;
        let best = best_ms(&maze).map(|run_ms| End::Ready { run_ms });
        Some(search(&maze, mishap, &[when], *seed)) == best
    };
    mazes.filter(is_right).count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_run_found_is_the_best_of_all_with_and_without_crashes(
        seed in any::<u64>(),
        crashes in prop::collection::vec(0_usize..200, 0..3),
    ) {
        let maze = maze(seed, 0.5);
        let best = best_ms(&maze);
        prop_assume!(best.is_some());
        let end = search(&maze, Mishap::Crash, &crashes, seed);
        prop_assert_eq!(end, End::Ready { run_ms: best.unwrap() });
    }
}

#[test]
fn a_mouse_that_is_moved_unnoticed_finds_the_best_run() {
    for mishap in [
        Mishap::Carried,
        Mishap::PutBack,
        Mishap::Far,
        Mishap::Short,
        Mishap::Turned,
    ] {
        assert!(right_of(mishap, 0..24) >= 23, "{mishap:?}");
    }
}

/// `cargo test --release -p tolman-firmware --test mouse -- --ignored --nocapture`
#[test]
#[ignore = "prints the shares of docs/micromouse.md in two minutes"]
fn shares_of_mice_that_find_the_best_run() {
    let text = std::env::var("SEED").unwrap_or_default();
    let first = text.parse().unwrap_or(1_000_000);
    for mishap in [
        Mishap::Crash,
        Mishap::Carried,
        Mishap::PutBack,
        Mishap::Far,
        Mishap::Short,
        Mishap::Turned,
    ] {
        let right = right_of(mishap, first..first + 1000);
        println!("{mishap:?}: {right} of 1000");
        assert!(right >= 990);
    }
}

#[test]
fn a_mouse_gives_up_a_maze_without_a_way_only_after_a_second_map() {
    let mut maze = maze(3, 0.5);
    let goals: Vec<Cell> = maze.goals().to_vec();
    for goal in &goals {
        for side in Direction::ALL {
            let beyond = maze.grid().neighbour(*goal, side);
            if beyond.is_some_and(|beyond| !goals.contains(&beyond)) {
                maze.set_wall(*goal, side, true);
            }
        }
    }
    let times = SpeedRunTimes::new(&SpeedRunConfig::classic()).unwrap();
    let mut mouse = Mouse::new(&times, &goals);
    let mut body = Body::new(&maze, 3);
    let mut maps = 1;
    loop {
        match mouse.arrive(body.look()).unwrap() {
            Command::Drive(side) => assert!(!body.drive(side)),
            Command::CarryBack => {
                maps += 1;
                (body.at, body.heading) = START;
                mouse.carried_back();
            }
            Command::Ready { .. } => panic!("there is no way to the goal"),
            Command::GiveUp => break,
        }
    }
    assert_eq!(maps, 2);
}

#[test]
fn all_that_a_mouse_holds_fits_into_10_kib() {
    let held = size_of::<Mouse<'_>>() + size_of::<SpeedRunTimes<MAZE>>();
    assert!(held <= 10 << 10, "{held} bytes");
}
