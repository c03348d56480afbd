//! Places and ways of grounds that are drawn by hand.

use tolman_geom::Point;
use tolman_maps::scan_map::{
    ChartParts, CorridorMap, CorridorPlace, ScanChart, ScanPlace, WallGrid,
};
use tolman_robot::Landmark;

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
        assert!(!map.is_open());
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
    assert!(map.is_open());
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
