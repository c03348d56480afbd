//! Wall maps and graphs of MSLST, saved and loaded; what breaks an invariant is refused.

use proptest::prelude::*;
use serde_json::{Value, json};
use tolman_maps::mslst_graph::{GraphMapper, MslstGraph, NodeZone};
use tolman_maps::wall_map::{CellRay, ClosedCells, RayEnd, WallMap};
use tolman_maze::{Cell, Direction, Grid};

type Map = WallMap<8, 12>;

/// Observations that may contradict each other: those that do are not taken in.
fn observations() -> impl Strategy<Value = Vec<(Cell, Vec<CellRay>)>> {
    let ray = (0..4_usize, 0..3_u16, any::<bool>()).prop_map(|(direction, open, wall)| CellRay {
        direction: Direction::ALL[direction],
        open,
        end: if wall {
            RayEnd::Wall
        } else {
            RayEnd::OutOfRange
        },
    });
    let cell = (0..8_u16, 0..8_u16).prop_map(|(x, y)| Cell::new(x, y));
    prop::collection::vec((cell, prop::collection::vec(ray, 1..4)), 0..40)
}

fn walked(grid: Grid, observations: &[(Cell, Vec<CellRay>)], undone: usize) -> Map {
    let mut map = Map::new(grid, ClosedCells::Impossible).unwrap();
    for (cell, rays) in observations {
        let _ = map.observe(*cell, rays);
        map.visit(*cell);
    }
    map.undo(undone);
    map
}

proptest! {
    #[test]
    fn a_wall_map_reads_back_as_it_was(
        width in 0..=8_u16,
        height in 0..=8_u16,
        observations in observations(),
        undone in 0..3_usize,
    ) {
        let mut map = walked(Grid::new(width, height), &observations, undone);
        let text = serde_json::to_string(&map).unwrap();
        let mut read: Map = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(&read, &map);
        prop_assert_eq!(serde_json::to_string(&read).unwrap(), text);
        // They go on alike: what comes next, and what is forgotten.
        for (cell, rays) in &observations {
            prop_assert_eq!(read.observe(*cell, rays), map.observe(*cell, rays));
        }
        for _ in 0..20 {
            prop_assert_eq!(read.undo(1), map.undo(1));
            prop_assert_eq!(&read, &map);
        }
        prop_assert_eq!(read.to_string(), map.to_string());
    }

    #[test]
    fn a_map_with_a_shorter_memory_forgets_the_oldest(observations in observations()) {
        let map = walked(Grid::new(8, 8), &observations, 0);
        let read: WallMap<16, 5> = serde_json::from_value(serde_json::to_value(map).unwrap()).unwrap();
        prop_assert_eq!(read.unknown_count(), map.unknown_count());
        let (mut short, mut long) = (read, map);
        let undone = short.undo(100);
        long.undo(undone);
        prop_assert_eq!(short.to_string(), long.to_string());
    }

    #[test]
    fn a_graph_reads_back_as_it_was(actions in prop::collection::vec((0..4_usize, 0..5_u32, any::<bool>()), 0..40)) {
        let mut mapper = GraphMapper::new(0, NodeZone::Elsewhere);
        for (direction, state, goal) in actions {
            let direction = Direction::ALL[direction];
            if state == 0 {
                mapper.failed(direction);
                continue;
            }
            let zone = if goal { NodeZone::Destination } else { NodeZone::Elsewhere };
            mapper.succeeded(direction, state, zone);
        }
        let graph = mapper.finish();
        let text = serde_json::to_string(&graph).unwrap();
        let read: MslstGraph = serde_json::from_str(&text).unwrap();
        // The distances, which are not saved, among it.
        prop_assert_eq!(read, graph);
    }
}

/// Returns why a saved map of 2 × 2 cells is refused after a change.
fn refused(change: impl FnOnce(&mut Value)) -> String {
    let mut map = Map::new(Grid::new(2, 2), ClosedCells::Possible).unwrap();
    let ray = CellRay::to_wall(Direction::North, 0);
    map.observe(Cell::new(0, 0), &[ray]).unwrap();
    let mut value = serde_json::to_value(map).unwrap();
    assert_eq!(serde_json::from_value::<Map>(value.clone()).unwrap(), map);
    change(&mut value);
    serde_json::from_value::<Map>(value)
        .unwrap_err()
        .to_string()
}

#[test]
fn a_broken_wall_map_is_refused() {
    let grid = Grid::new(2, 2);
    let (border, inner) = (
        grid.wall(Cell::new(0, 0), Direction::West),
        grid.wall(Cell::new(0, 0), Direction::East),
    );
    let north = grid.wall(Cell::new(0, 0), Direction::North);
    assert!(refused(|map| map["open"] = json!([border])).contains("not between"));
    assert!(refused(|map| map["open"] = json!([999])).contains("wall 999"));
    assert!(refused(|map| map["open"] = json!([north])).contains("twice"));
    assert!(refused(|map| map["standing"] = json!([north, inner, inner])).contains("twice"));
    assert!(refused(|map| map["remembered"] = json!([[inner]])).contains("neither open"));
    assert!(refused(|map| map["remembered"] = json!([[north], [north]])).contains("twice"));
    assert!(refused(|map| map["visits"] = json!([[0, 0]])).contains("2 rows of 2"));
    assert!(refused(|map| map["grid"] = json!({"width": 9, "height": 2})).contains("at most"));
    assert!(refused(|map| map["widht"] = json!(1)).contains("unknown field `widht`"));
    assert!(refused(|map| map["closed_cells"] = json!("maybe")).contains("maybe"));
}

#[test]
fn a_broken_graph_is_refused() {
    let read = |value: Value| serde_json::from_value::<MslstGraph>(value);
    let east = json!({"state": 1, "zone": "elsewhere", "edges": [{"action": "east", "head": 1}]});
    let west = json!({"state": 2, "zone": "destination", "edges": [{"action": "west", "head": 0}]});
    let graph = read(json!({"nodes": [east, west]})).unwrap();
    assert_eq!(graph.distance(0), Some(1));
    let why = |value| read(value).unwrap_err().to_string();
    assert!(why(json!({"nodes": []})).contains("no nodes"));
    assert!(why(json!({"nodes": [east]})).contains("node 1"));
    assert!(why(json!({"nodes": [east, east]})).contains("edge"));
    assert!(why(json!({"nodes": [east, west], "distances": [7, 0]})).contains("unknown field"));
}
