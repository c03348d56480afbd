//! Every drawing is closed, joined and marked, the same for the same seed, and as its name says.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::drawings::{
    blocks, comb, eight, ladder, office, pillars, ring, spiral, star, wings,
};
use tolman_maze::{Braided, Cell, GenerateError, Maze};

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
