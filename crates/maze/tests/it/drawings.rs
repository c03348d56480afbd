//! Every drawing is closed, joined and marked, the same for the same seed, and as its name says.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::drawings::{
    blocks, comb, eight, ladder, ladder_of, office, pillars, ring, spiral, star, wings,
};
use tolman_maze::{Braided, Cell, Direction, GenerateError, Hook, Maze, OneLoop, Rooms};

type Draw = fn((u16, u16), &mut ChaCha8Rng) -> Result<Maze, GenerateError>;

const ALL: [(&str, Draw); 10] = [
    ("blocks", |size, rng| blocks(size, rng)),
    ("comb", |size, rng| comb(size, rng)),
    ("eight", |size, rng| eight(size, rng)),
    ("ladder", |size, rng| ladder(size, rng)),
    ("office", |size, rng| office(size, rng)),
    ("pillars", |size, rng| pillars(size, rng)),
    ("ring", |size, rng| ring(size, rng)),
    ("spiral", |size, rng| spiral(size, rng)),
    ("star", |size, rng| star(size, rng)),
    ("wings", |size, rng| wings(size, rng)),
];

fn drawn(draw: Draw, size: (u16, u16), seed: u64) -> Maze {
    draw(size, &mut ChaCha8Rng::seed_from_u64(seed)).expect("a fit size")
}

fn sizes() -> impl Strategy<Value = (u16, u16)> {
    (5_u16..25, 5_u16..25)
}

/// Returns the number of loops: ways that could be walled up without cutting anything off.
fn loops(maze: &Maze) -> usize {
    maze.opening_count() + 1 - maze.reachable().count()
}

fn degrees(maze: &Maze, degree: usize) -> usize {
    maze.reachable()
        .filter(|cell| maze.degree(*cell) == degree)
        .count()
}

fn has_room(maze: &Maze) -> bool {
    maze.grid().cells().any(|cell| maze.is_room(cell))
}

proptest! {
    #[test]
    fn all_are_joined_marked_and_the_same_again(size in sizes(), seed: u64) {
        for (name, draw) in ALL {
            let maze = drawn(draw, size, seed);
            prop_assert_eq!(maze.check(), Ok(()), "{}\n{}", name, maze);
            prop_assert_eq!(maze.sealed().count(), 0, "{}\n{}", name, maze);
            let (start, heading) = maze.start().expect("marked");
            prop_assert!(maze.is_open(start, heading), "{}\n{}", name, maze);
            prop_assert!(!maze.goals().is_empty() && !maze.goals().contains(&start), "{}\n{}", name, maze);
            prop_assert_eq!(has_room(&maze), name == "pillars", "{}\n{}", name, maze);
            prop_assert_eq!(drawn(draw, size, seed), maze);
        }
    }

    #[test]
    fn each_is_as_its_name_says(size in sizes(), seed: u64) {
        let of = |draw| drawn(draw, size, seed);
        let spiral = of(spiral);
        prop_assert_eq!((loops(&spiral), degrees(&spiral, 1), spiral.junctions().count()), (0, 2, 0));
        let star = of(star);
        prop_assert_eq!((loops(&star), degrees(&star, 1), degrees(&star, 4)), (0, 4, 1), "\n{}", star);
        let comb = of(comb);
        let teeth = usize::from((size.0 - 1) / 2);
        prop_assert_eq!((loops(&comb), degrees(&comb, 1)), (0, teeth + 1));
        let ring = of(ring);
        prop_assert_eq!((loops(&ring), degrees(&ring, 2)), (1, ring.reachable().count()));
        let eight = of(eight);
        prop_assert_eq!((loops(&eight), degrees(&eight, 4), eight.junctions().count()), (2, 1, 1), "\n{}", eight);
        let ladder = of(ladder);
        prop_assert_eq!((loops(&ladder), degrees(&ladder, 3), ladder.junctions().count()), (2, 2, 2), "\n{}", ladder);
        let wings = of(wings);
        prop_assert_eq!(loops(&wings), 0, "\n{}", wings);
        let office = of(office);
        prop_assert_eq!(loops(&office), usize::from(size.1 / 3) - 1, "\n{}", office);
    }

    #[test]
    fn a_quarter_of_the_city_is_walled_up(size in sizes(), seed: u64) {
        let maze = drawn(blocks, size, seed);
        let (columns, rows) = (usize::from(size.0.div_ceil(2)), usize::from(size.1.div_ceil(2)));
        let all = (columns - 1) * rows + columns * (rows - 1);
        let walled = all / 4;
        // A tree of all crossings is left, whatever is walled up.
        let spare = all + 1 - columns * rows;
        prop_assert_eq!(maze.opening_count(), 2 * (all - walled.min(spare)), "\n{}", maze);
    }

    #[test]
    fn the_wings_are_the_same(size in sizes(), seed: u64) {
        let maze = drawn(wings, size, seed);
        let (width, height) = ((size.0 - 1) / 2, (size.1 - 1) / 2);
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
            let [west, east] = [1, 1 + width].map(|wing| Cell::new(wing + x, height + 1 + y));
            prop_assert_eq!(maze.degree(west), maze.degree(east), "\n{}", maze);
        }
    }

    #[test]
    fn braided_corridors_have_no_open_room(width in 2_u16..25, height in 2_u16..25, seed: u64) {
        let braided = Braided { width, height, share: 1.0 };
        let maze = braided.generate_corridors(&mut ChaCha8Rng::seed_from_u64(seed)).expect("a fit size");
        prop_assert_eq!(maze.check(), Ok(()));
        prop_assert!(maze.steps_to_goal().iter().all(Option::is_some));
        prop_assert!(!has_room(&maze), "\n{}", maze);
    }
}

/// Every drawing and every corridor maze of some seeds, compared with `drawings.txt`.
/// `TOLMAN_PIN=1` writes them there instead, where a change is meant.
#[test]
fn all_are_drawn_as_they_were() {
    let mut text = String::new();
    let mut add = |name: &str, maze: Maze| {
        let start = maze
            .start()
            .map(|(cell, heading)| format!("{cell:?} {heading:?}"));
        let start = start.unwrap_or_default();
        text.push_str(&format!("{name} {start} {:?}\n{maze}\n", maze.goals()));
    };
    for (name, draw) in ALL {
        for (seed, size) in [(1, (11, 7)), (2, (6, 10))] {
            add(name, drawn(draw, size, seed));
        }
    }
    for seed in [1, 2, 3] {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        let hook = Hook {
            width: 4 + seed as u16,
            height: 6,
        };
        add("hook", hook.generate(rng).unwrap());
        let loops = OneLoop {
            width: 9 + seed as u16,
            height: 6,
            dead_ends: 4,
            short: 2 + seed as u32,
        };
        add("one loop", loops.generate(rng).unwrap());
        let braided = Braided {
            width: 8,
            height: 5,
            share: 0.3 * seed as f64,
        };
        add("braided", braided.generate_corridors(rng).unwrap());
        let rooms = Rooms {
            width: 12,
            height: 7,
            attempts: 8,
            smallest: 2,
            largest: 1 + seed as u16,
            extra_doors: 2,
        };
        // The largest room is as small as the smallest at first.
        add("rooms", rooms.generate(rng).unwrap());
    }
    for rungs in [3, 4] {
        let rng = &mut ChaCha8Rng::seed_from_u64(5);
        add("ladder of", ladder_of(rungs, rng).unwrap());
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/drawings.txt");
    if std::env::var_os("TOLMAN_PIN").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let expected = std::fs::read_to_string(path).unwrap();
    for (found, expected) in text.split("\n\n").zip(expected.split("\n\n")) {
        assert_eq!(found, expected, "is the change meant?\n{found}");
    }
    assert_eq!(text.len(), expected.len());
}

/// The straight ways of a maze are counted again: a corridor runs from one bend, junction or dead
/// end to the next.
#[test]
fn three_of_four_corridors_of_one_loop_are_short() {
    for seed in 0..12 {
        let short = 2 + (seed % 3) as u32;
        let drawing = OneLoop {
            width: 11,
            height: 7,
            dead_ends: 3,
            short,
        };
        let maze = drawing
            .generate(&mut ChaCha8Rng::seed_from_u64(seed))
            .unwrap();
        let open = |cell, direction| maze.is_open(cell, direction);
        let goes_on = |cell: Cell, direction: Direction| {
            maze.degree(cell) == 2 && open(cell, direction) && open(cell, direction.opposite())
        };
        let mut lengths = Vec::new();
        for cell in maze.reachable() {
            for direction in [Direction::North, Direction::East] {
                if !open(cell, direction) || goes_on(cell, direction) {
                    continue;
                }
                let (mut at, mut length) = (cell, 0);
                loop {
                    at = maze.grid().neighbour(at, direction).unwrap();
                    length += 1;
                    if !goes_on(at, direction) {
                        break;
                    }
                }
                lengths.push(length);
            }
        }
        let count = lengths.iter().filter(|length| **length <= short).count();
        assert!(
            4 * count >= 3 * lengths.len(),
            "{short} {lengths:?}\n{maze}"
        );
    }
}

#[test]
fn what_is_too_small_is_refused_by_its_name() {
    for (name, draw) in ALL {
        let error = draw((2, 2), &mut ChaCha8Rng::seed_from_u64(1)).unwrap_err();
        assert!(
            matches!(error, GenerateError::Small { drawing, .. } if drawing == name),
            "{error}"
        );
    }
    let error = drawn_too_large();
    assert!(matches!(error, GenerateError::Size { .. }), "{error}");
}

fn drawn_too_large() -> GenerateError {
    ring((2000, 2000), &mut ChaCha8Rng::seed_from_u64(1)).unwrap_err()
}
