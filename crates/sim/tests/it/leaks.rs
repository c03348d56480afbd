//! Millions of rays through mazes against an exact oracle in integers: none leaks.
//!
//! Origins are multiples of 2⁻²⁰ of a cell; directions are taken to 2⁻⁶⁰. On which side of a
//! lattice point a ray passes is then a comparison of integers below 2⁸⁸.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction, Grid, Maze};
use tolman_robot::Ring;
use tolman_sim::casters::{BeamSweep, Caster, Lanes, LatticeWalk, WallIndex};
use tolman_sim::{CorridorSize, World};

/// Origins are multiples of 1 / `GRAIN` of a cell.
const GRAIN: i128 = 1 << 20;

/// Directions are taken in multiples of 1 / `FINE`.
const FINE: f64 = 1_152_921_504_606_846_976.0;

/// Distance from a wall's end within which a ray may read either the end or what lies behind it. It
/// is 2⁻³⁰ of a cell, times both units.
const ASIDE: i128 = 1 << (20 + 60 - 30);

/// A ray in integers: the origin in grains, the direction in multiples of 1 / `FINE`.
#[derive(Clone, Copy)]
struct Ray {
    x: i128,
    y: i128,
    dx: i128,
    dy: i128,
}

/// Returns the ranges a ray may read, in cells; `f64::INFINITY` if it may meet nothing within 32
/// lines. One, unless it passes lattice points closely: then one for each side it may pass them on.
fn exact(maze: &Maze, ray: Ray) -> Vec<f64> {
    let (column, row) = (ray.x.div_euclid(GRAIN), ray.y.div_euclid(GRAIN));
    let mut ranges = Vec::new();
    follow(maze, ray, (column, row), 0, &mut ranges);
    ranges
}

fn follow(maze: &Maze, ray: Ray, (column, row): (i128, i128), lines: u32, ranges: &mut Vec<f64>) {
    let cell = match (u16::try_from(column), u16::try_from(row)) {
        (Ok(x), Ok(y)) if lines < 32 => Cell::new(x, y),
        _ => return ranges.push(f64::INFINITY),
    };
    let (east, north) = (ray.dx > 0, ray.dy > 0);
    // Distances to the next lines, in grains.
    let across = ((column + i128::from(east)) * GRAIN - ray.x).abs();
    let up = ((row + i128::from(north)) * GRAIN - ray.y).abs();
    // across / |dx| against up / |dy|.
    let side = across * ray.dy.abs() - up * ray.dx.abs();
    let directions = [
        (
            side <= ASIDE && ray.dx != 0,
            if east {
                Direction::East
            } else {
                Direction::West
            },
        ),
        (
            side >= -ASIDE && ray.dy != 0,
            if north {
                Direction::North
            } else {
                Direction::South
            },
        ),
    ];
    for (possible, direction) in directions {
        if !possible {
            continue;
        }
        let (x, y) = direction.step();
        if maze.is_open(cell, direction) {
            let next = (column + i128::from(x), row + i128::from(y));
            follow(maze, ray, next, lines + 1, ranges);
        } else {
            let (grains, along) = if x == 0 {
                (up, ray.dy)
            } else {
                (across, ray.dx)
            };
            ranges.push(grains as f64 / GRAIN as f64 * (FINE / along.abs() as f64));
        }
    }
}

fn maze(side: u16, rng: &mut ChaCha8Rng) -> Maze {
    let mut maze = Maze::open(Grid::new(side, side));
    for cell in maze.grid().cells().collect::<Vec<_>>() {
        for direction in [Direction::North, Direction::East] {
            if maze.grid().neighbour(cell, direction).is_some() {
                maze.set_wall(cell, direction, rng.random_range(0..5_u32) < 2);
            }
        }
    }
    maze
}

/// Casts at least `count` rays from random points with every caster and returns the number cast.
/// Every other ray goes exactly towards or past a lattice point.
fn fuzz(count: u64, seed: u64) -> u64 {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut cast = 0;
    while cast < count {
        let side = rng.random_range(1..12_u32) as u16;
        let maze = maze(side, &mut rng);
        let world = World::from_maze(&maze, &CorridorSize::thin(1.0)).unwrap();
        let lattice = LatticeWalk::new(&world, Lanes::Widest).unwrap();
        let index = WallIndex::new(world.walls(), Lanes::Widest);
        let max_range = [0.8, 2.5, 20.0][rng.random_range(0..3_u32) as usize];
        let mut sweep = BeamSweep::new(Ring::full(72, max_range));
        for _ in 0..50 {
            // Half of the origins lie on a coarse raster, so that beams meet posts head on.
            let coarse = rng.random::<bool>();
            let mut coordinate = || {
                let grains = rng.random_range(1..u32::from(side) << 20);
                i128::from(if coarse {
                    (grains >> 17 << 17) | 1 << 16
                } else {
                    grains | 1
                })
            };
            let (x, y) = (coordinate(), coordinate());
            let origin = Point::new(x as f64 / GRAIN as f64, y as f64 / GRAIN as f64);
            let target = Point::new(
                f64::from(rng.random_range(0..=u32::from(side))),
                f64::from(rng.random_range(0..=u32::from(side))),
            );
            // Beam 0 looks at a post.
            let pose = Pose::new(origin, Heading::of(target - origin));
            for caster in [&lattice as &dyn Caster, &index] {
                sweep.aim(pose);
                caster.scan(&mut sweep);
                for beam in 0..sweep.beams() {
                    let unit = sweep.direction(beam);
                    let ray = Ray {
                        x,
                        y,
                        dx: (unit.x * FINE) as i128,
                        dy: (unit.y * FINE) as i128,
                    };
                    let (range, allowed) = (sweep.range(beam), exact(&maze, ray));
                    assert!(
                        allowed
                            .iter()
                            .any(|exact| (exact.min(max_range) - range).abs() < 1e-9),
                        "from {origin} towards {unit}: {range} instead of {allowed:?} in\n{maze}"
                    );
                    cast += 1;
                }
            }
        }
    }
    cast
}

#[test]
fn no_ray_leaks() {
    fuzz(1_000_000, 1);
}

/// Takes some minutes; `cargo xtask bench` runs it.
#[test]
#[ignore = "casts a thousand million rays"]
fn no_ray_of_a_thousand_million_leaks() {
    let threads = std::thread::available_parallelism().map_or(1, core::num::NonZero::get) as u64;
    let share = 1_000_000_000_u64.div_ceil(threads);
    let cast: u64 = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|thread| scope.spawn(move || fuzz(share, 100 + thread)))
            .collect();
        workers
            .into_iter()
            .map(|worker| worker.join().unwrap())
            .sum()
    });
    println!("{cast} rays, none leaked");
}
