//! Places and ways of grounds that are drawn by hand.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Point, Vector};
use tolman_maps::scan_map::{
    ChartParts, CorridorMap, CorridorPlace, ScanChart, ScanPlace, WallGrid,
};
use tolman_maze::{Braided, Cell, Direction};
use tolman_robot::Landmark;

use crate::pinned::pinned;

/// Cells of the map for a letter of a drawing: a corridor as wide as one is 0.95 m wide.
const CELLS: usize = 19;
const WIDTH: f64 = CELLS as f64 * WallGrid::CELL;

/// Returns the middle of the first cell of a drawing with this letter, m.
fn middle(drawing: &[&str], letter: char) -> Option<Point> {
    let mut rows = (0..).zip(drawing);
    rows.find_map(|(row, text)| {
        let column = text.find(letter)?;
        let along = |index: usize| (index as f64 + 0.5) * WIDTH;
        Some(Point::new(along(column), along(row)))
    })
}

/// Returns the map of a drawing whose goal was sensed in the middle of `G`.
fn map(drawing: &[&str]) -> CorridorMap {
    map_with(drawing, middle(drawing, 'G').into_iter().collect())
}

/// Returns the map of a drawing, in rows from south to north: `#` is wall, all else floor. The
/// robot began at `S`, and sensed the goal at these points, m.
fn map_with(drawing: &[&str], goal: Vec<Point>) -> CorridorMap {
    let row = |text: &&str| {
        let cells = text.chars().flat_map(|letter| {
            let cell = if letter == '#' { '#' } else { '.' };
            core::iter::repeat_n(cell, CELLS)
        });
        core::iter::repeat_n(cells.collect::<String>(), CELLS)
    };
    let parts = ChartParts {
        radius: 0.225,
        places: vec![ScanPlace {
            position: middle(drawing, 'S').unwrap(),
            landmark: Some(Landmark::Start),
        }],
        links: Vec::new(),
        goal,
        start: Vec::new(),
        numbered: Vec::new(),
        surprise: 0.0,
        cell: WallGrid::CELL,
        first: [0, 0],
        rows: drawing.iter().flat_map(row).collect(),
    };
    CorridorMap::of(&ScanChart::from_parts(parts).unwrap(), WIDTH)
}

#[test]
fn places_are_where_corridors_meet_or_end_and_where_landmarks_stand() {
    let cases: [(&[&str], usize, usize); 5] = [
        // A corridor with the start amid it.
        (&["######", "#.S.G#", "######"], 3, 2),
        // A bend is a part of a way.
        (&["#####", "#S..#", "###.#", "###G#", "#####"], 2, 1),
        // A crossing.
        (&["#####", "##.##", "#S.G#", "##.##", "#####"], 5, 4),
        // A loop on a stem is a way from the junction to itself.
        (
            &["#######", "#S....#", "###.#.#", "###...#", "#######"],
            2,
            2,
        ),
        // Two dead ends of one square.
        (&["#######", "#S...G#", "##.#.##", "#######"], 6, 5),
    ];
    for (drawing, places, ways) in cases {
        let map = map(drawing);
        let found = (map.places().len(), map.ways().len());
        assert_eq!(found, (places, ways), "{drawing:?} {map:?}");
        let marks = map.places().iter().filter(|place| place.landmark.is_some());
        assert_eq!(
            marks.count(),
            drawing.iter().filter_map(|row| row.find('G')).count() + 1
        );
    }
}

#[test]
fn a_goal_in_a_bend_beside_a_junction_is_a_place_of_its_own() {
    let drawing = ["#####", "##.##", "#S.G#", "###.#", "#####"];
    let goal = middle(&drawing, 'G').unwrap();
    // The robot cut the bend, and sensed the goal in the half that is nearer to the junction.
    let sensed = |share: f64| Point::new(goal.x - share * WIDTH, goal.y);
    let map = map_with(&drawing, vec![sensed(0.45), sensed(0.32)]);
    assert_eq!((map.places().len(), map.ways().len()), (5, 4), "{map:?}");
    let marked = |landmark| move |place: &&CorridorPlace| place.landmark == Some(landmark);
    let found = map.places().iter().find(marked(Landmark::Goal)).unwrap();
    assert!((found.position - goal).norm() < 0.5 * WIDTH, "{map:?}");
}

#[test]
fn a_room_is_one_place_with_its_gateways() {
    let map = map(&[
        "#########",
        "##...####",
        "#S.....G#",
        "##...####",
        "####.####",
        "#########",
    ]);
    assert_eq!((map.places().len(), map.ways().len()), (4, 3), "{map:?}");
}

#[test]
fn a_robot_that_passes_a_place_between_two_points_was_there() {
    let map = map(&["######", "#.S.G#", "######"]);
    let [east, start] = [Point::new(3.3, 1.425), map.places()[0].position];
    let visits = map.visits(&[start, east]);
    assert_eq!(visits[0], map.at(start));
    assert_eq!(visits.len(), 2);
}

#[test]
fn a_corridor_map_is_seen_with_all_its_ways_both_ways() {
    let map = map(&["#####", "##.##", "#S.G#", "##.##", "#####"]);
    let view = map.view();
    assert_eq!((view.places.len(), view.links.len()), (5, 8));
    for (place, seen) in map.places().iter().zip(&view.places) {
        assert_eq!(
            (Some(place.position), place.landmark),
            (seen.position, seen.landmark)
        );
    }
    for way in map.ways() {
        let [from, to] = way.ends;
        for (from, to) in [(from, to), (to, from)] {
            assert!(
                view.links
                    .iter()
                    .any(|link| (link.from, link.to) == (from, to))
            );
        }
        // The arms of the crossing are straight.
        let [from, to] = way.ends.map(|end| map.places()[end as usize].position);
        let straight = (from - to).norm();
        assert!(
            (way.length - straight).abs() < 0.1 * WIDTH,
            "{way:?} {straight}"
        );
    }
}

#[test]
fn a_robot_is_at_a_place_within_a_third_of_a_corridor() {
    let map = map(&["######", "#.S.G#", "######"]);
    for (number, place) in (0..).zip(map.places()) {
        for (share, expected) in [(0.0, Some(number)), (0.32, Some(number)), (0.34, None)] {
            let aside = Point::new(place.position.x, place.position.y + share * WIDTH);
            assert_eq!(map.at(aside), expected, "{share}");
        }
    }
    // A trail that jumps over a place, but not far: it was there at the nearest point.
    let start = map.places()[1].position;
    let beside = |share: f64| Point::new(start.x + share * WIDTH, start.y);
    for (share, expected) in [(0.4, Some(1)), (0.58, Some(1)), (0.61, None)] {
        let visits = map.visits(&[beside(-0.62), beside(share), beside(0.7)]);
        assert_eq!(visits, [None, expected, None], "{share}");
    }
}

#[test]
fn the_nearest_point_of_a_trail_tells_which_place_it_passed() {
    let map = map(&["######", "#.S.G#", "######"]);
    let start = map.places()[1].position;
    let trail = [-0.5, -0.25, 0.3, 0.55].map(|share| Point::new(start.x + share * WIDTH, start.y));
    assert_eq!(map.visits(&trail), [None, Some(1), None, None]);
    let nearer = [-0.3, -0.15, 0.19].map(|share| Point::new(start.x + share * WIDTH, start.y));
    assert_eq!(map.visits(&nearer), [None, Some(1), Some(1)]);
}

#[test]
fn goals_as_wide_as_several_corridors_are_several_places() {
    let drawing = ["######", "#S...#", "###.##", "###G##", "######"];
    let at = middle(&drawing, 'G').unwrap();
    let marks = |shares: &[f64]| {
        let sensed = shares
            .iter()
            .map(|share| Point::new(at.x, at.y + share * WIDTH));
        let goals = map_with(&drawing, sensed.collect());
        let goals = goals
            .places()
            .iter()
            .filter(|place| place.landmark == Some(Landmark::Goal));
        goals.count()
    };
    // One point in another corridor, or several at its edge, may be an error.
    assert_eq!(marks(&[-0.1, 0.3]), 1);
    assert_eq!(marks(&[-0.8, -0.1, 0.3]), 1);
    assert_eq!(marks(&[-0.58, -0.55, -0.1, 0.3]), 1);
    assert_eq!(marks(&[-0.8, -0.65, -0.1, 0.3]), 2);
    // Sensed at one point, it is one goal there.
    assert_eq!(marks(&[0.1]), 1);
}

/// Returns the map of a braided maze whose walls are uneven, with the cell size of a scan map.
fn of_maze(seed: u64) -> (CorridorMap, Vec<Point>) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let shape = Braided {
        width: 4,
        height: 4,
        share: 0.6,
    };
    let maze = shape.generate(&mut rng).unwrap();
    // A wall is as wide as three cells, a corridor as fourteen to eighteen.
    let corridor = 14 + 2 * (seed as usize % 3);
    let pitch = corridor + 3;
    let side = 4 * pitch + 3;
    let mut rows = vec![vec!['.'; side]; side];
    for (row, letters) in rows.iter_mut().enumerate() {
        for (column, letter) in letters.iter_mut().enumerate() {
            let at = |along: usize| {
                (
                    (along / pitch).min(3) as u16,
                    along % pitch < 3 || along >= 4 * pitch,
                )
            };
            let ((x, is_west), (y, is_south)) = (at(column), at(row));
            let cell = Cell::new(x, y);
            let border = (column >= 4 * pitch, row >= 4 * pitch);
            let stands = |direction| !maze.is_open(cell, direction);
            let is_wall = match (is_west, is_south) {
                (true, true) => true,
                (true, false) => border.0 || stands(Direction::West),
                (false, true) => border.1 || stands(Direction::South),
                _ => false,
            };
            *letter = if is_wall { '#' } else { '.' };
        }
    }
    for _ in 0..12 {
        // Boxes that stand about, some of them at walls.
        let [column, row] = [0, 1].map(|_| rng.random_range(1..side - 3));
        for letters in &mut rows[row..row + 2] {
            letters[column..column + 2].fill('#');
        }
    }
    let middle =
        |cell: usize| (3.0 + pitch as f64 * cell as f64 + 0.5 * corridor as f64) * WallGrid::CELL;
    let stand = |number: usize| Point::new(middle(number % 4), middle(number / 4));
    let landmark = |number: usize| match number {
        0 => Some(Landmark::Start),
        6 => Some(Landmark::Numbered(3)),
        _ => None,
    };
    let places = [0, 3, 6, 9].map(|number| ScanPlace {
        position: stand(number),
        landmark: landmark(number),
    });
    // Later ones were sensed anywhere, also where corridors meet.
    let (goal, far) = match seed {
        ..12 => (stand(15), 1.0),
        _ => (stand(rng.random_range(0..16)), rng.random_range(0.5..2.5)),
    };
    let goal = [-0.2, 0.1, 0.3].map(|off| goal + Vector::new(far * off, 0.5 * far * off));
    let parts = ChartParts {
        radius: 0.2,
        places: places.to_vec(),
        links: Vec::new(),
        goal: goal.to_vec(),
        start: if seed % 4 == 3 {
            vec![stand(12)]
        } else {
            Vec::new()
        },
        numbered: Vec::new(),
        surprise: 0.0,
        cell: WallGrid::CELL,
        first: [0, 0],
        rows: rows.into_iter().map(String::from_iter).collect(),
    };
    let width = corridor as f64 * WallGrid::CELL;
    let map = CorridorMap::of(&ScanChart::from_parts(parts).unwrap(), width);
    (map, (0..16).map(stand).collect())
}

#[test]
fn maps_of_uneven_mazes_are_what_they_were() {
    let mut figures = Vec::new();
    for seed in 0..28 {
        let (map, trail) = of_maze(seed);
        figures.push(format!("{seed} {:?}", map.visits(&trail)));
        figures.extend(
            map.places()
                .iter()
                .map(|place| format!("{:?} {:?}", place.position, place.landmark)),
        );
        figures.extend(
            map.ways()
                .iter()
                .map(|way| format!("{:?} {}", way.ends, way.length)),
        );
    }
    pinned("corridor_map", &figures);
}
