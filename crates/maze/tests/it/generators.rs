//! Every generated maze is connected, closed, marked, and the same for the same seed.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Braided, Cell, Direction, GenerateError, Hook, Maze, OneLoop, Perfect, Rooms};

fn rng(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Checks that the maze is sound and connected, with a start from which there is a way to a goal.
fn holds_together(maze: &Maze) -> Result<(), TestCaseError> {
    prop_assert_eq!(maze.check(), Ok(()));
    prop_assert!(
        maze.steps_to_goal().iter().all(Option::is_some),
        "all cells are joined"
    );
    let (start, heading) = maze.start().expect("every generator marks the start");
    prop_assert!(maze.is_open(start, heading));
    prop_assert!(!maze.goals().contains(&start), "there is a way to go");
    if maze.grid().middle().all(|cell| cell != start) {
        prop_assert!(
            maze.grid()
                .middle()
                .all(|cell| maze.goals().contains(&cell))
        );
    }
    Ok(())
}

fn sides() -> impl Strategy<Value = (u16, u16)> {
    (1_u16..30, 1_u16..30).prop_filter("two cells", |(width, height)| width * height > 1)
}

proptest! {
    #[test]
    fn perfect_mazes_are_trees((width, height) in sides(), seed: u64) {
        let maze = Perfect { width, height }.generate(&mut rng(seed)).expect("a fit size");
        holds_together(&maze)?;
        // Connected with one opening less than cells: no loop.
        prop_assert_eq!(maze.opening_count(), maze.grid().cell_count() - 1);
        prop_assert_eq!(maze.degree(maze.start().expect("marked").0), 1);
        if height > 1 {
            prop_assert_eq!(maze.start().expect("marked").1, Direction::North);
        }
    }

    #[test]
    fn a_hook_is_one_corridor_with_its_goal_at_a_bend(width in 2_u16..20, height in 3_u16..20, seed: u64) {
        let maze = Hook { width, height }.generate(&mut rng(seed)).expect("a fit size");
        let inside: Vec<Cell> = maze.reachable().collect();
        // A way from end to end: as long as the stem and the hook and at least a cell of tail.
        prop_assert_eq!(maze.opening_count(), inside.len() - 1);
        prop_assert!(inside.iter().all(|cell| maze.degree(*cell) <= 2));
        prop_assert_eq!(maze.dead_ends().count(), 2);
        prop_assert!(inside.len() > usize::from(width + height - 1));
        let corner = Cell::new(width - 1, 0);
        prop_assert_eq!(maze.goals(), [corner]);
        prop_assert!(maze.is_open(corner, Direction::North) && maze.is_open(corner, Direction::West));
    }

    #[test]
    fn one_loop_has_the_features_that_it_is_named_after(width in 9_u16..14, height in 5_u16..9, seed: u64) {
        let drawing = OneLoop { width, height, dead_ends: 4, short: 4 };
        let maze = drawing.generate(&mut rng(seed)).expect("a fit size");
        let inside: Vec<Cell> = maze.reachable().collect();
        // A tree has one opening less than cells: this is one loop.
        prop_assert_eq!(maze.opening_count(), inside.len());
        prop_assert_eq!(inside.iter().filter(|cell| maze.degree(**cell) == 4).count(), 1);
        prop_assert!(maze.dead_ends().count() >= 4);
        prop_assert_eq!(maze.goals(), [Cell::new(width - 1, 0)]);
        // No room: corridors are a cell wide and at least two apart.
        prop_assert!(maze.grid().cells().all(|cell| !maze.is_room(cell)));
    }

    #[test]
    fn braiding_opens_the_share_of_dead_ends(width in 2_u16..30, height in 2_u16..30, share in 0.0..=1.0, seed: u64) {
        let perfect = Perfect { width, height }.generate(&mut rng(seed)).expect("a fit size");
        let braided = Braided { width, height, share };
        let maze = braided.generate(&mut rng(seed)).expect("a fit size");
        holds_together(&maze)?;
        // All but the start, which stays closed.
        let before = perfect.dead_ends().count() - 1;
        let after = maze.dead_ends().count() - 1;
        let wanted = ((1.0 - share) * before as f64 + 0.5) as usize;
        // The last one opened can take a second with it; a corner beside the start may be walled
        // in.
        prop_assert!(after <= wanted + 1 && after + 1 >= wanted, "{before} -> {after}, not {wanted}");
        prop_assert_eq!(maze.degree(maze.start().expect("marked").0), 1);
    }

    #[test]
    fn rooms_are_joined((width, height) in sides(), attempts in 0_u32..40, extra_doors in 0_u32..5, seed: u64) {
        let largest = width.min(height).min(5);
        let smallest = largest.min(2);
        let rooms = Rooms { width, height, attempts, smallest, largest, extra_doors };
        let maze = rooms.generate(&mut rng(seed)).expect("fit sizes");
        holds_together(&maze)?;
    }

    #[test]
    fn rooms_are_open_inside(seed: u64) {
        // One room of 3 × 3 and no loops but its own: four 2 × 2 blocks in it, so four openings
        // more than a tree has.
        let rooms = Rooms { width: 9, height: 7, attempts: 1, smallest: 3, largest: 3, extra_doors: 0 };
        let maze = rooms.generate(&mut rng(seed)).expect("fit sizes");
        let grid = maze.grid();
        let placed = maze.opening_count() == grid.cell_count() - 1 + 4;
        let refused = maze.opening_count() == grid.cell_count() - 1;
        prop_assert!(placed || refused, "a room is whole or, on the start, not there");
        let doors = Rooms { extra_doors: 3, ..rooms }.generate(&mut rng(seed)).expect("fit sizes");
        let loops = doors.opening_count() - maze.opening_count();
        prop_assert_eq!(loops, if placed { 3 } else { 0 });
    }
}

/// The middle of such a maze holds the start, so the goal is the cell farthest from it.
#[test]
fn the_smallest_mazes_have_a_way_to_go() {
    let check = |width, height, goal, steps| {
        let perfect = Perfect { width, height };
        let maze = perfect.generate(&mut rng(1)).unwrap();
        let braided = Braided {
            width,
            height,
            share: 1.0,
        };
        assert_eq!(braided.generate(&mut rng(1)).unwrap(), maze);
        assert_eq!(maze.goals(), [goal], "\n{maze}");
        assert_eq!(maze.steps_to_goal()[0], Some(steps), "\n{maze}");
    };
    check(1, 2, Cell::new(0, 1), 1);
    check(2, 1, Cell::new(1, 0), 1);
    check(2, 2, Cell::new(1, 0), 3);
}

#[test]
fn impossible_wishes_are_refused() {
    let rng = &mut rng(1);
    for (width, height) in [(0, 0), (0, 9), (1, 1), (1025, 2), (2, u16::MAX)] {
        let refused = Err(GenerateError::Size { width, height });
        assert_eq!(Perfect { width, height }.generate(rng), refused);
        assert_eq!(
            Braided {
                width,
                height,
                share: 0.5
            }
            .generate(rng),
            refused
        );
        let rooms = Rooms {
            width,
            height,
            attempts: 1,
            smallest: 1,
            largest: 1,
            extra_doors: 0,
        };
        assert_eq!(rooms.generate(rng), refused);
    }
    for share in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        let error = Braided {
            width: 4,
            height: 4,
            share,
        }
        .generate(rng)
        .unwrap_err();
        assert!(error.to_string().contains("number from 0 to 1"), "{error}");
    }
    for (smallest, largest) in [(0, 2), (3, 2), (2, 7)] {
        let rooms = Rooms {
            width: 9,
            height: 6,
            attempts: 9,
            smallest,
            largest,
            extra_doors: 0,
        };
        let refused = GenerateError::RoomSide {
            smallest,
            largest,
            width: 9,
            height: 6,
        };
        assert_eq!(rooms.generate(rng), Err(refused));
    }
}

/// The draws are over `u32` and ChaCha is the same everywhere, so these hold on every platform.
#[test]
fn a_seed_is_a_maze() {
    let check = |maze: Maze, expect: &str| assert_eq!(maze.to_string(), expect, "\n{maze}");
    check(
        Perfect {
            width: 6,
            height: 4,
        }
        .generate(&mut rng(1))
        .unwrap(),
        "\
o---o---o---o---o---o---o
|       |               |
o   o   o   o---o   o---o
|   |     G   G |       |
o---o---o---o---o---o   o
|         G | G         |
o   o---o   o   o---o   o
| S |           |       |
o---o---o---o---o---o---o
",
    );
    check(
        Braided {
            width: 6,
            height: 4,
            share: 0.5,
        }
        .generate(&mut rng(1))
        .unwrap(),
        "\
o---o---o---o---o---o---o
|       |               |
o   o   o   o---o   o---o
|   |     G   G |       |
o---o---o---o---o---o   o
|         G | G         |
o   o   o   o   o---o   o
| S |                   |
o---o---o---o---o---o---o
",
    );
    check(
        Rooms {
            width: 9,
            height: 5,
            attempts: 9,
            smallest: 2,
            largest: 3,
            extra_doors: 1,
        }
        .generate(&mut rng(1))
        .unwrap(),
        "\
o---o---o---o---o---o---o---o---o---o
|   |       |                       |
o   o   o   o   o   o---o---o---o---o
|   |           |                   |
o   o   o   o---o   o   o   o   o   o
|   |       |     G |   |           |
o   o---o   o   o   o   o   o   o---o
|       |   |       |   |           |
o   o   o   o   o   o   o   o   o   o
| S |       |       |   |           |
o---o---o---o---o---o---o---o---o---o
",
    );
}

#[test]
fn what_cannot_be_drawn_says_why() {
    let small = Hook {
        width: 1,
        height: 3,
    }
    .generate(&mut rng(1));
    assert_eq!(
        small,
        Err(GenerateError::Size {
            width: 1,
            height: 3
        })
    );
    for (width, height) in [(2, 9), (9, 2), (1, 1), (0, 3)] {
        let narrow = OneLoop {
            width,
            height,
            dead_ends: 0,
            short: 9,
        };
        let refused = narrow.generate(&mut rng(1));
        assert_eq!(refused, Err(GenerateError::Size { width, height }));
    }
    // Wide enough to be drawn, but not for a crossing.
    let least = OneLoop {
        width: 3,
        height: 3,
        dead_ends: 0,
        short: 9,
    };
    let refused = least.generate(&mut rng(1)).unwrap_err();
    assert!(
        matches!(refused, GenerateError::Features { .. }),
        "{refused}"
    );
    let drawing = OneLoop {
        width: 5,
        height: 5,
        dead_ends: 40,
        short: 4,
    };
    let refused = drawing.generate(&mut rng(1)).unwrap_err();
    assert!(
        matches!(refused, GenerateError::Features { .. }),
        "{refused}"
    );
}
