//! The wall map against the maze it is a map of.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::wall_map::{CellRay, ClosedCells, ObserveError, TooLarge, WallMap};
use tolman_maze::{Braided, Cell, Direction, Grid, Knowledge, Maze, Wall, Walls};

/// Returns a maze without closed cells of at most 16 × 16.
fn mazes() -> impl Strategy<Value = Maze> {
    (2..=16_u16, 2..=16_u16, any::<u64>()).prop_map(|(width, height, seed)| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        Braided {
            width,
            height,
            share: 0.5,
        }
        .generate(&mut rng)
        .unwrap()
    })
}

/// Returns the rays from a cell to all four sides, each up to the first wall.
fn rays(maze: &Maze, cell: Cell) -> [CellRay; 4] {
    Direction::ALL.map(|direction| {
        let mut at = cell;
        let mut open = 0;
        while maze.is_open(at, direction) {
            at = maze.grid().neighbour(at, direction).unwrap();
            open += 1;
        }
        CellRay::to_wall(direction, open)
    })
}

fn map(grid: Grid, closed_cells: ClosedCells) -> WallMap<16, 1000> {
    WallMap::new(grid, closed_cells).unwrap()
}

fn cell_of(maze: &Maze, index: usize) -> Cell {
    let cell = maze.grid().cells().nth(index % maze.grid().cell_count());
    cell.unwrap()
}

proptest! {
    #[test]
    fn what_is_known_is_true(maze in mazes(), looks in prop::collection::vec(any::<usize>(), 0..30)) {
        for closed_cells in [ClosedCells::Possible, ClosedCells::Impossible] {
            let mut map = map(maze.grid(), closed_cells);
            let mut learned = 0;
            let before = map.unknown_count();
            for look in &looks {
                let cell = cell_of(&maze, *look);
                learned += u32::from(map.observe(cell, &rays(&maze, cell)).unwrap());
                prop_assert_eq!(map.uncertainty(cell), 0);
            }
            prop_assert_eq!(map.unknown_count(), before - learned);
            for id in 0..maze.grid().wall_count() as u32 {
                let known = map.wall(Wall(id));
                let truth = Knowledge::of_standing(maze.stands(Wall(id)));
                prop_assert!(known == Knowledge::Unknown || known == truth);
            }
            for cell in maze.grid().cells() {
                let sides = Direction::ALL.map(|direction| map.knowledge(cell, direction));
                let count = |what| sides.iter().filter(|side| **side == what).count();
                prop_assert_eq!(usize::from(map.uncertainty(cell)), count(Knowledge::Unknown));
                prop_assert_eq!(map.is_dead_end(cell), count(Knowledge::Wall) >= 3);
            }
            if closed_cells == ClosedCells::Impossible {
                for cell in maze.grid().cells().filter(|cell| map.is_dead_end(*cell)) {
                    prop_assert_eq!(map.uncertainty(cell), 0);
                }
            }
        }
    }

    #[test]
    fn undoing_all_is_never_having_looked(
        maze in mazes(),
        looks in prop::collection::vec(any::<usize>(), 0..20),
        again in 0..20_usize,
    ) {
        let dark = map(maze.grid(), ClosedCells::Impossible);
        let mut states = vec![dark];
        let mut seen = dark;
        for look in looks {
            let cell = cell_of(&maze, look);
            if seen.observe(cell, &rays(&maze, cell)).unwrap() > 0 {
                states.push(seen);
            }
        }
        let told = states.len() - 1;
        prop_assert_eq!(seen.undo(again), again.min(told));
        let expected = states[told - again.min(told)];
        for id in 0..maze.grid().wall_count() as u32 {
            prop_assert_eq!(seen.wall(Wall(id)), expected.wall(Wall(id)));
        }
    }
}

#[test]
fn a_contradiction_changes_nothing() {
    let mut map = map(Grid::new(4, 4), ClosedCells::Possible);
    let origin = Cell::new(0, 0);
    map.observe(origin, &[CellRay::to_wall(Direction::North, 2)])
        .unwrap();
    let before = map;
    let refused = |rays: &[CellRay], cell, known| {
        let mut map = before;
        let error = map.observe(origin, rays).unwrap_err();
        let direction = rays[rays.len() - 1].direction;
        assert_eq!(
            error,
            ObserveError::Contradiction {
                cell,
                direction,
                known
            }
        );
        assert_eq!(map, before);
    };
    let east = CellRay::to_wall(Direction::East, 1);
    let (north, south) = (Direction::North, Direction::South);
    refused(
        &[east, CellRay::to_wall(north, 1)],
        Cell::new(0, 1),
        Knowledge::Open,
    );
    refused(
        &[east, CellRay::to_wall(north, 3)],
        Cell::new(0, 2),
        Knowledge::Wall,
    );
    refused(&[CellRay::out_of_range(south, 1)], origin, Knowledge::Wall);
    refused(
        &[CellRay::to_wall(Direction::East, 4)],
        Cell::new(3, 0),
        Knowledge::Wall,
    );
    let outside = Cell::new(4, 0);
    assert!(matches!(
        map.observe(outside, &[]),
        Err(ObserveError::Outside { .. })
    ));
}

#[test]
fn a_short_sight_tells_nothing_of_what_lies_beyond() {
    let mut map = map(Grid::new(4, 1), ClosedCells::Possible);
    let look = [CellRay::out_of_range(Direction::East, 1)];
    assert_eq!(map.observe(Cell::new(0, 0), &look), Ok(1));
    assert_eq!(
        map.knowledge(Cell::new(1, 0), Direction::East),
        Knowledge::Unknown
    );
}

#[test]
fn a_log_that_is_too_short_undoes_whole_observations_only() {
    let mut map: WallMap<16, 4> = WallMap::new(Grid::new(16, 16), ClosedCells::Possible).unwrap();
    let look = |map: &mut WallMap<16, 4>, y, open| {
        map.observe(Cell::new(0, y), &[CellRay::to_wall(Direction::East, open)])
            .unwrap();
    };
    look(&mut map, 0, 4);
    assert_eq!(
        map.undo(1),
        0,
        "five walls were learned, four are remembered"
    );
    look(&mut map, 1, 1);
    look(&mut map, 2, 0);
    assert_eq!(map.undo(9), 2);
    assert_eq!(
        map.knowledge(Cell::new(0, 1), Direction::East),
        Knowledge::Unknown
    );
    assert_eq!(
        map.knowledge(Cell::new(3, 0), Direction::East),
        Knowledge::Open
    );
    let mut forgetful: WallMap<4, 0> =
        WallMap::new(Grid::new(4, 4), ClosedCells::Possible).unwrap();
    forgetful
        .observe(Cell::new(0, 0), &[CellRay::to_wall(Direction::East, 0)])
        .unwrap();
    assert_eq!(forgetful.undo(1), 0);
}

#[test]
fn a_larger_maze_does_not_fit() {
    let grid = Grid::new(17, 3);
    let error = WallMap::<16>::new(grid, ClosedCells::Possible).unwrap_err();
    assert_eq!(error, TooLarge { grid, side: 16 });
    assert_eq!(
        error.to_string(),
        "the maze is 17 × 3 cells and the map holds 16 × 16 at most"
    );
    assert!(WallMap::<32>::new(Grid::new(32, 32), ClosedCells::Possible).is_ok());
}

#[test]
fn it_draws_what_it_knows() {
    let mut map = map(Grid::new(3, 2), ClosedCells::Impossible);
    let rays = [
        CellRay::to_wall(Direction::North, 1),
        CellRay::to_wall(Direction::East, 0),
    ];
    map.observe(Cell::new(0, 0), &rays).unwrap();
    let drawing = "\
o---o---o---o
|   .   .   |
o   o . o . o
|   |   .   |
o---o---o---o
";
    assert_eq!(map.to_string(), drawing);
}

#[test]
fn visits_are_counted_and_do_not_overflow() {
    let mut map = map(Grid::new(4, 4), ClosedCells::Possible);
    for _ in 0..300 {
        map.visit(Cell::new(1, 2));
    }
    map.visit(Cell::new(99, 99));
    assert_eq!(map.visits(Cell::new(1, 2)), 255);
    assert_eq!((map.visits(Cell::new(99, 99)), map.visited_count()), (0, 1));
}

#[test]
fn a_map_of_16_is_small() {
    assert!(size_of::<WallMap<16>>() <= 1024);
    assert!(size_of::<WallMap<32>>() <= 2048);
}
