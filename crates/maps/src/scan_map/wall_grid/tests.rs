use alloc::vec::Vec;

use proptest::prelude::*;
use tolman_robot::Ring;

use super::*;

/// Returns a cell's counts after some scans, computed as plainly as possible.
fn plainly(scans: &[(Point, Heading, Scan)], index: GridIndex) -> [u32; 2] {
    let (mut hits, mut passes) = (0, 0);
    for (from, heading, scan) in scans {
        let ring = scan.ring;
        for (beam, range) in (0..).zip(&scan.ranges) {
            let end = from + heading.turned(ring.bearing(beam)).unit() * *range;
            hits += u32::from(*range < ring.max_range && index_of(end) == index);
        }
        let way = middle(index) - from;
        // The two beams beside the way: the last that does not lie to the left of it, and the next.
        let to_left = |beam: u32| {
            let bearing = heading.radians() + ring.bearing(beam);
            let angle = libm::atan2(way.y, way.x) - bearing;
            angle - TAU * libm::floor(angle / TAU)
        };
        let right = (0..ring.beams).min_by(|a, b| to_left(*a).total_cmp(&to_left(*b)));
        let right = right.unwrap() as usize;
        let left = (right + 1) % scan.ranges.len();
        let shorter = scan.ranges[right].min(scan.ranges[left]);
        let near = way.norm() <= ring.max_range && way.norm() < shorter - WallGrid::CELL;
        passes += u32::from(near);
    }
    [hits.min(255), passes.min(255)]
}

/// Returns the distance to the nearest wall cell, in units; [`FAR`] beyond the reach.
fn nearest_wall(grid: &WallGrid, [column, row]: GridIndex) -> u8 {
    let off = |range: i32| -range..=range;
    let near = off(8).flat_map(|x| off(8).map(move |y| [x, y]));
    let walls = near.filter(|[x, y]| grid.ground([column + x, row + y]) == GroundKind::Wall);
    let units = walls.filter_map(|[x, y]| {
        let far = libm::hypot(f64::from(x), f64::from(y)) * WallGrid::CELL;
        (far < WallGrid::REACH - 1e-9).then_some(libm::floor(far / 0.005 + 1e-6) as u8)
    });
    units.min().unwrap_or(FAR)
}

fn scans() -> impl Strategy<Value = Vec<(Point, Heading, Scan)>> {
    let scan = prop::collection::vec(0.2..1.3_f64, 24);
    let one = (-0.5..0.5_f64, -0.5..0.5_f64, -3.0..3.0_f64, scan);
    let one = one.prop_map(|(x, y, heading, ranges)| {
        let ring = Ring::full(24, 1.0);
        let ranges = ranges.into_iter().map(|range| range.min(1.0)).collect();
        let heading = Heading::from_radians(heading);
        (Point::new(x, y), heading, Scan { ring, ranges })
    });
    prop::collection::vec(one, 1..8)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// Beams that ended and passed are counted in each cell. Distances are to the walls that stand
    /// now, whatever walls have come and gone.
    #[test]
    fn a_grid_counts_beams_and_knows_how_far_walls_are(scans in scans()) {
        let mut grid = WallGrid::default();
        for (from, heading, scan) in &scans {
            grid.add(*from, *heading, scan);
        }
        for index in grid.indices() {
            let cell = grid.cell(index).unwrap();
            let [hits, passes] = plainly(&scans, index);
            prop_assert_eq!([u32::from(cell.hits), u32::from(cell.passes)], [hits, passes]);
            let is_wall = hits > 0 && 3 * hits >= passes;
            prop_assert_eq!(cell.is_wall(), is_wall);
            prop_assert_eq!(grid.is_wall(middle(index)), is_wall);
            prop_assert_eq!(grid.is_known(middle(index)), hits + passes > 0);
            let ground = match (is_wall, passes > 0) {
                (true, _) => GroundKind::Wall,
                (false, true) => GroundKind::Floor,
                _ => GroundKind::Unknown,
            };
            prop_assert_eq!(grid.ground(index), ground);
            let near = nearest_wall(&grid, index);
            prop_assert!(cell.wall.abs_diff(near) <= 1, "{index:?}: {} {near}", cell.wall);
            for radius in [0.0, 0.12, 0.3] {
                let fits = passes > 0 && f64::from(cell.wall) * 0.005 >= radius;
                prop_assert_eq!(grid.stands(index, radius), fits);
            }
        }
        prop_assert_eq!(grid.bytes(), grid.len() * 4);
        let [first, end] = grid.bounds();
        prop_assert_eq!(grid.indices().count(), grid.len());
        for outside in [[first[0] - 1, first[1]], [first[0], first[1] - 1], [end[0], first[1]], [first[0], end[1]]] {
            prop_assert_eq!(grid.slot(outside), None);
        }
        let slots = grid.indices().map(|index| grid.slot(index).unwrap());
        prop_assert!(slots.eq(0..grid.len()));
        // All that a robot may ask about lies on it.
        for (from, ..) in &scans {
            for (x, y) in [(-1.35, -1.35), (1.35, 1.35), (-1.35, 1.35)] {
                prop_assert!(grid.cell(index_of(from + Vector::new(x, y))).is_some());
            }
        }
    }

    /// Checks that distances between the middles of cells are interpolated in proportion.
    #[test]
    fn distances_are_interpolated(scans in scans(), x in -1.0..1.0_f64, y in -1.0..1.0_f64) {
        let mut grid = WallGrid::default();
        for (from, heading, scan) in &scans {
            grid.add(*from, *heading, scan);
        }
        let at = Point::new(x, y);
        let (mut sum, mut weights) = (0.0, 0.0);
        for index in grid.indices() {
            let off = (middle(index) - at) / WallGrid::CELL;
            let weight = (1.0 - off.x.abs()).max(0.0) * (1.0 - off.y.abs()).max(0.0);
            weights += weight;
            sum += weight * f64::from(grid.cell(index).unwrap().wall) * 0.005;
        }
        prop_assert!((weights - 1.0).abs() < 1e-9);
        match grid.wall_distance(at) {
            Some(found) => prop_assert!((found - sum).abs() < 1e-9, "{found} {sum}"),
            None => prop_assert!(sum > WallGrid::REACH - 1e-9, "{sum}"),
        }
    }
}

/// Returns the grid of a drawing whose first row is the lowest: `#` is wall, a space unknown, all
/// else floor. The first cell is (−2, −1).
fn drawn(drawing: &[&str]) -> WallGrid {
    let end = [drawing[0].len() as i32 - 2, drawing.len() as i32 - 1];
    WallGrid::of([[-2, -1], end], |[column, row]| {
        match drawing[(row + 1) as usize].as_bytes()[(column + 2) as usize] {
            b'#' => GroundKind::Wall,
            b' ' => GroundKind::Unknown,
            _ => GroundKind::Floor,
        }
    })
}

#[test]
fn a_grid_of_a_drawing_is_what_was_drawn() {
    let grid = drawn(&["#..  ", " .#..", "....."]);
    assert_eq!((grid.bounds(), grid.len()), ([[-2, -1], [3, 2]], 15));
    let letters = grid.indices().map(|index| match grid.ground(index) {
        GroundKind::Wall => '#',
        GroundKind::Floor => '.',
        GroundKind::Unknown => ' ',
    });
    let letters: alloc::string::String = letters.collect();
    assert_eq!(letters, "#..   .#.......");
    for index in grid.indices() {
        assert!(
            grid.cell(index)
                .unwrap()
                .wall
                .abs_diff(nearest_wall(&grid, index))
                <= 1
        );
    }
}

#[test]
fn a_beam_ends_at_the_first_wall_and_tells_nothing_beyond_the_unknown() {
    let grid = drawn(&["...........", "........#..", "....  ....."]);
    let range = |row: i32, unit: Vector, most| grid.range(middle([-1, row]), unit, most, 0);
    // From the middle of column −1 to the border of column 6 it is 6.5 cells.
    let wall = range(0, Vector::x(), 1.0).unwrap();
    assert!(
        (wall - 0.325).abs() < 0.026 && wall >= 0.325 - 1e-9,
        "{wall}"
    );
    assert_eq!(range(0, Vector::x(), 0.3), Some(0.3));
    assert_eq!(range(1, Vector::x(), 0.4), None);
    assert_eq!(range(1, Vector::x(), 0.12), Some(0.12));
    assert_eq!(range(0, -Vector::x(), 1.0), None, "off the grid");
}

#[test]
fn what_contradicts_the_walls_is_a_share_of_the_beams_that_are_known() {
    let wide = "#".repeat(41);
    let row = alloc::format!("#{}#", ".".repeat(39));
    let mut rows = alloc::vec![wide.as_str()];
    rows.extend(core::iter::repeat_n(row.as_str(), 19));
    rows.push(&wide);
    let grid = drawn(&rows);
    let from = middle([8, 9]);
    let mut scan = Scan::clear(Ring::full(4, 1.5));
    // East, north, west, south: 29.5, 9.5, 9.5 and 9.5 cells.
    scan.ranges = alloc::vec![1.475, 0.475, 0.475, 0.475];
    let share = |scan: &Scan, fewest| grid.contradiction(from, Heading::EAST, scan, fewest);
    assert_eq!(share(&scan, 4), Some(0.0));
    assert_eq!(share(&scan, 5), None);
    for (beam, range, expected) in [
        (1, 0.65, 0.0),
        (1, 0.75, 0.25),
        (3, 0.2, 0.5),
        (2, 0.3, 0.5),
    ] {
        scan.ranges[beam] = range;
        assert_eq!(share(&scan, 4), Some(expected), "{:?}", scan.ranges);
    }
}

#[test]
fn a_visit_counts_within_its_reach_and_in_sight() {
    let mut grid = drawn(&[
        "..........",
        "..........",
        "####.#####",
        "..........",
        "..........",
    ]);
    let at = middle([0, 0]);
    grid.visit(at, 0.16);
    for index in grid.indices() {
        let ground = middle(index);
        let near = (ground - at).norm() <= 0.16;
        let expected = near && grid.sees(at, ground);
        let been = grid.was_visited(grid.slot(index).unwrap());
        assert_eq!(been, expected, "{index:?}");
    }
    let count = |grid: &WallGrid| grid.cells.iter().filter(|cell| cell.been).count();
    // Three cells east and the two there are west in two rows; of the wall nothing is in sight.
    assert_eq!(count(&grid), 6 + 6);
    let before = count(&grid);
    grid.visit(at, 0.16);
    assert_eq!(count(&grid), before);
}

#[test]
fn nothing_is_seen_through_a_wall() {
    let wall = |at: Point| (0.5..0.55).contains(&at.x) && at.y < 1.0;
    let see = |from: (f64, f64), to: (f64, f64)| {
        sees(Point::new(from.0, from.1), Point::new(to.0, to.1), wall)
    };
    assert!(!see((0.0, 0.0), (1.0, 0.0)) && !see((1.0, 0.9), (0.0, 0.9)));
    assert!(see((0.0, 0.0), (0.49, 0.9)) && see((0.0, 1.01), (1.0, 1.01)));
    assert!(see((0.0, 0.0), (0.0, 0.0)) && !see((0.52, 0.0), (0.52, 0.0)));
    // Both ends count.
    assert!(!see((0.45, 0.0), (0.505, 0.0)) && !see((0.505, 0.0), (0.45, 0.0)));
}

#[test]
fn cells_begin_at_the_origin() {
    for index in [[0, 0], [-3, 7], [12, -1]] {
        assert_eq!(index_of(middle(index)), index);
        let low = Point::new(f64::from(index[0]) * 0.05, f64::from(index[1]) * 0.05);
        assert!((middle(index) - low - Vector::new(0.025, 0.025)).norm() < 1e-12);
    }
}
