//! Random worlds to test in.

use proptest::prelude::*;
use tolman_geom::{Point, Vector};
use tolman_maze::{Direction, Grid, Maze};
use tolman_sim::{CorridorSize, Material, Occupancy, Polyline, WallSegment, World};

pub(crate) fn maze() -> impl Strategy<Value = Maze> {
    let walls = prop::collection::vec(any::<bool>(), 72);
    (1_u16..7, 1_u16..7, walls).prop_map(|(width, height, walls)| {
        let grid = Grid::new(width, height);
        let mut maze = Maze::open(grid);
        for (cell, walls) in grid.cells().zip(walls.chunks(2)) {
            for (direction, stands) in [Direction::North, Direction::East].into_iter().zip(walls) {
                if grid.neighbour(cell, direction).is_some() {
                    maze.set_wall(cell, direction, *stands);
                }
            }
        }
        maze
    })
}

pub(crate) fn size() -> impl Strategy<Value = CorridorSize> {
    (0.6..1.2, prop_oneof![Just(0.0), 0.01..0.2]).prop_map(|(corridor_width, wall_thickness)| {
        CorridorSize {
            corridor_width,
            wall_thickness,
        }
    })
}

pub(crate) fn occupancy() -> impl Strategy<Value = Occupancy> {
    (
        1_usize..20,
        1_usize..20,
        0.05..0.7,
        -5.0..5.0,
        prop::collection::vec(0_u8..4, 400),
    )
        .prop_map(|(width, height, resolution, origin, kinds)| {
            let mut occupied: Vec<bool> = kinds[..width * height]
                .iter()
                .map(|kind| *kind == 0)
                .collect();
            occupied[0] = false;
            Occupancy {
                width,
                height,
                resolution,
                origin: Point::new(origin, -origin),
                occupied,
            }
        })
}

/// Returns a number between −5 and 5, half of the time a multiple of 1/4.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        -5.0..5.0,
        (-20_i32..=20).prop_map(|quarter| f64::from(quarter) * 0.25)
    ]
}

pub(crate) fn point() -> impl Strategy<Value = Point> {
    (coordinate(), coordinate()).prop_map(|(x, y)| Point::new(x, y))
}

/// Returns a share of something, half of the time a whole number of 24ths.
fn share() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.0..1.0,
        (0_i32..=24).prop_map(|part| f64::from(part) / 24.0)
    ]
}

/// Returns a world and a point within its bounds that touches no wall: where sensors are.
pub(crate) fn world_and_point() -> impl Strategy<Value = (World, Point)> {
    with_point(world())
}

/// Returns one of these worlds and a point that touches no wall of it.
pub(crate) fn with_point(
    world: impl Strategy<Value = World>,
) -> impl Strategy<Value = (World, Point)> {
    (world, share(), share()).prop_filter_map("touches a wall", |(world, x, y)| {
        let bounds = world.bounds();
        let point = bounds.min + Vector::new(x * bounds.width(), y * bounds.height());
        (world.is_floor(point) && world.nearest_wall_distance(point) > 1e-6)
            .then_some((world, point))
    })
}

/// Returns a few polylines, so that many walls share an end.
pub(crate) fn free_walls() -> impl Strategy<Value = Vec<WallSegment>> {
    let polyline =
        (prop::collection::vec(point(), 2..8), any::<bool>()).prop_map(|(points, closed)| {
            Polyline {
                points,
                closed,
                material: Material::default(),
            }
        });
    prop::collection::vec(polyline, 1..12).prop_filter_map("no wall has length", |polylines| {
        let walls: Vec<WallSegment> = polylines
            .iter()
            .flat_map(|polyline| polyline.walls().collect::<Vec<_>>())
            .filter(|wall| (wall.end - wall.start).norm() > 1e-3)
            .collect();
        (!walls.is_empty()).then_some(walls)
    })
}

pub(crate) fn maze_world() -> impl Strategy<Value = World> {
    (maze(), size()).prop_map(|(maze, size)| World::from_maze(&maze, &size).unwrap())
}

pub(crate) fn world() -> impl Strategy<Value = World> {
    prop_oneof![
        maze_world(),
        free_walls().prop_map(|walls| World::from_segments(walls).unwrap()),
        occupancy().prop_map(|occupancy| World::from_occupancy(&occupancy).unwrap()),
    ]
}
