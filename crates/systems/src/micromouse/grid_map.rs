//! Converts the walls of a grid to a map of places.

use tolman_geom::Point;
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_robot::{Landmark, MapLink, MapPlace, MapView};

use super::Brief;

/// Returns the map whose places are the start and the cells with a known opening; its links are the
/// openings. `middle` gives the middle of a cell. O(cells).
pub(super) fn grid_map(
    walls: &impl Walls,
    brief: &Brief,
    middle: impl Fn(Cell) -> Point,
) -> MapView {
    let mut map = MapView::default();
    for cell in brief.grid.cells() {
        let links = map.links.len();
        let open = |side: &Direction| walls.knowledge(cell, *side) == Knowledge::Open;
        let sides = Direction::ALL.into_iter().filter(open);
        let beside = sides.filter_map(|side| brief.grid.neighbour(cell, side));
        map.links.extend(beside.map(|beside| MapLink {
            from: place_of(brief, cell),
            to: place_of(brief, beside),
        }));
        if map.links.len() > links || cell == brief.start {
            map.places.push(MapPlace {
                id: place_of(brief, cell),
                position: Some(middle(cell)),
                landmark: landmark(brief, cell),
            });
        }
    }
    map
}

/// Returns the number of a cell's place on the map.
pub(super) fn place_of(brief: &Brief, cell: Cell) -> u32 {
    brief.grid.index(cell) as u32
}

fn landmark(brief: &Brief, cell: Cell) -> Option<Landmark> {
    if cell == brief.start {
        return Some(Landmark::Start);
    }
    brief.goals.contains(&cell).then_some(Landmark::Goal)
}
