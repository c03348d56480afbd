//! The memory of maps is that of all their parts.

use tolman_geom::Point;
use tolman_maps::diktiometry::{
    Action, Diktiometry, Exits, Frame, FrameId, LinkId, Place, PlaceId, Relation, TrackEntry,
};
use tolman_maps::mslst_graph::{ActionEdge, GraphMapper, MslstGraph, Node, NodeZone};
use tolman_maps::scan_map::{ChartParts, ScanChart, ScanPlace, WallGrid};
use tolman_maps::wall_map::{CellRay, ClosedCells, WallMap};
use tolman_maze::{Cell, Direction, Grid};

use crate::diktiometry::walk::{ODOMETRY, Walk, open, painted};

/// Returns the size of a number of values of a type, bytes.
fn all<T>(parts: impl IntoIterator<Item = usize>) -> usize {
    parts.into_iter().sum::<usize>() * size_of::<T>()
}

/// Returns the memory of a diktiometry, kind of part by kind of part.
fn recounted(map: &Diktiometry) -> usize {
    let places: Vec<&Place> = map.paths.places().map(|(_, place)| place).collect();
    let frames: Vec<&Frame> = map
        .reference
        .frames()
        .iter()
        .filter(|frame| !frame.places.is_empty())
        .collect();
    let histories = || places.iter().flat_map(|place| &place.histories);
    let views = || places.iter().flat_map(|place| &place.views);
    let links = || map.paths.links().map(|(_, link)| link);
    let in_places: [usize; 11] = [
        size_of::<Place>() * places.len(),
        places.iter().map(|place| size_of_val(&*place.estims)).sum(),
        views().map(size_of_val).sum(),
        all::<f64>(views().map(|view| view.columns() * view.rows())),
        all::<LinkId>(
            places
                .iter()
                .map(|place| place.outgoing.len() + place.incoming.len()),
        ),
        places
            .iter()
            .map(|place| size_of_val(&*place.blocked))
            .sum(),
        all::<Vec<TrackEntry>>(places.iter().map(|place| place.histories.len())),
        all::<TrackEntry>(histories().map(Vec::len)),
        all::<PlaceId>(histories().flatten().map(|entry| entry.doubts.len())),
        all::<Action>(places.iter().filter_map(|place| match &place.exits {
            Exits::Unknown => None,
            Exits::Seen(actions) => Some(actions.len()),
        })),
        places.iter().map(|place| size_of_val(&*place.notes)).sum(),
    ];
    let in_links: usize = links()
        .map(|link| size_of_val(link) + size_of_val(&*link.then))
        .sum();
    let in_frames = [
        size_of::<Frame>() * frames.len(),
        all::<PlaceId>(frames.iter().map(|frame| frame.places.len())),
        all::<Relation>(frames.iter().map(|frame| frame.above.len())),
        all::<FrameId>(frames.iter().map(|frame| frame.below.len())),
    ];
    in_places.iter().sum::<usize>() + in_links + in_frames.iter().sum::<usize>()
}

#[test]
fn a_diktiometry_takes_the_memory_of_what_stands() {
    let empty = Diktiometry::default();
    assert_eq!(empty.bytes(), 0);
    let mut walk = Walk::new(open(5).painted(5, 3), ODOMETRY, painted(), 3);
    for moves in [0, 1, 4, 30, 90] {
        walk.wander(moves);
        let map = walk.observer.map();
        assert_eq!(map.bytes(), recounted(map), "after {moves} more moves");
    }
    // Merges left frames behind that hold no places.
    let frames = walk.observer.map().reference.frames();
    assert!(frames.iter().any(|frame| frame.places.is_empty()));
    assert!(
        walk.observer
            .map()
            .reference
            .relation(FrameId(0), FrameId(0))
            .is_none()
    );
}

#[test]
fn a_graph_takes_the_memory_of_nodes_and_edges() {
    let mut mapper = GraphMapper::new(0, NodeZone::Elsewhere);
    for state in 1..6 {
        mapper.succeeded(Direction::East, state, NodeZone::Elsewhere);
    }
    mapper.succeeded(Direction::North, 9, NodeZone::Destination);
    let graph: MslstGraph = mapper.finish();
    let edges: usize = graph
        .ids()
        .map(|id| graph.node(id).unwrap().edges.len())
        .sum();
    assert_eq!((graph.len(), graph.is_empty()), (7, false));
    assert!(edges >= 12);
    assert_eq!(
        graph.bytes(),
        7 * size_of::<Node>() + edges * size_of::<ActionEdge>()
    );
}

fn chart(places: usize, links: usize, goal: usize, start: usize, columns: usize) -> ScanChart {
    let place = |number: usize| ScanPlace {
        position: Point::new(number as f64, 0.0),
        landmark: None,
    };
    ScanChart::from_parts(ChartParts {
        radius: 0.2,
        places: (0..places).map(place).collect(),
        links: (1..=links as u32).map(|to| [0, to]).collect(),
        goal: vec![Point::origin(); goal],
        start: vec![Point::origin(); start],
        numbered: Vec::new(),
        surprise: 0.0,
        cell: WallGrid::CELL,
        first: [0, 0],
        rows: vec![".".repeat(columns); 64],
    })
    .unwrap()
}

#[test]
fn a_chart_takes_the_memory_of_its_lists_and_two_bits_a_cell() {
    assert_eq!(chart(0, 0, 0, 0, 64).bytes(), 64 * 64 / 4);
    let parts = chart(5, 3, 2, 7, 128).bytes() - 64 * 128 / 4;
    let points = 9 * size_of::<Point>();
    assert_eq!(
        parts,
        5 * size_of::<ScanPlace>() + 3 * size_of::<[u32; 2]>() + points
    );
}

#[test]
fn a_wall_map_takes_the_same_memory_whatever_it_remembers() {
    let grid = Grid::new(8, 8);
    let short = WallMap::<8, 4>::new(grid, ClosedCells::Possible).unwrap();
    let long = WallMap::<8, 400>::new(grid, ClosedCells::Possible).unwrap();
    assert_eq!(short.bytes(), long.bytes());
    assert!(short.bytes() < size_of_val(&short));
    // Two bits for each wall, and a byte for the visits to each cell.
    assert!(short.bytes() >= 64 + 2 * 2 * 7 * 8 / 8, "{}", short.bytes());
}

#[test]
fn a_visit_is_taken_back_and_a_wall_forgotten() {
    let mut map = WallMap::<8, 4>::new(Grid::new(3, 3), ClosedCells::Possible).unwrap();
    let cell = Cell::new(1, 2);
    for (visits, unvisits) in [(2, 1), (0, 1), (0, 1)] {
        let before = i32::from(map.visits(cell));
        (0..visits).for_each(|_| map.visit(cell));
        (0..unvisits).for_each(|_| map.unvisit(cell));
        assert_eq!(
            i32::from(map.visits(cell)),
            (before + visits - unvisits).max(0)
        );
    }
    assert_eq!(map.unknown_count(), 12);
    map.observe(cell, &[CellRay::to_wall(Direction::West, 0)])
        .unwrap();
    assert_eq!(map.unknown_count(), 11);
    // The border stays known.
    map.forget(cell, Direction::North);
    assert_eq!(map.unknown_count(), 11);
    map.forget(cell, Direction::West);
    assert_eq!(map.unknown_count(), 12);
    for (width, height, walls) in [(5, 2, 13), (1, 7, 6), (8, 1, 7), (0, 4, 0), (3, 0, 0)] {
        let map = WallMap::<8, 4>::new(Grid::new(width, height), ClosedCells::Possible).unwrap();
        assert_eq!(map.unknown_count(), walls, "{width} × {height}");
    }
}
