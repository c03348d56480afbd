use alloc::collections::BTreeSet;

use tolman_maps::cpm::{CpMap, Junction};
use tolman_maze::{Cell, Maze};

use super::fragments::{TrueFragments, landmark_at};
use super::layout::Layout;

/// Returns whether a map is that of a maze, as far as the robot has been. The map is laid over the
/// maze from the start on, port by port:
///
/// - each of its places has to be another true place, with as many ways and the same landmark;
/// - each of its fragments has to be another true one that joins the same ports;
/// - together they have to be the fragments that were walked.
///
/// So nothing is on the map twice, confused with another or unconnected.
///
/// O(fragments · cells).
pub(super) fn is_map_right(
    map: &CpMap,
    maze: &Maze,
    fragments: &TrueFragments,
    walked: &BTreeSet<u32>,
) -> bool {
    let layout = Layout::of(map, maze);
    let mut cells = BTreeSet::new();
    let are_places = map.junctions().all(|(id, junction)| {
        let cell = layout.place(id);
        cell.is_some_and(|cell| is_like(junction, maze, cell) && cells.insert(cell))
    });
    let mut laid = BTreeSet::new();
    let are_fragments = map.fragments().all(|(id, _)| {
        let lie = layout.fragments.get(&id).filter(|lie| lie.is_right);
        let ways = lie.and_then(|lie| fragments.driven(lie.cells.iter().copied()));
        ways.is_some_and(|ways| ways.iter().all(|way| laid.insert(way.fragment)))
    });
    are_places && are_fragments && laid == *walked
}

/// Returns whether a map is that of the whole maze. Each place and fragment that can be reached
/// from the start must be on it once, joined as in the maze. O(fragments · cells).
#[must_use]
pub fn is_whole_map_right(map: &CpMap, maze: &Maze) -> bool {
    let fragments = TrueFragments::of(maze);
    let all = fragments.ways().map(|(.., way)| way.fragment).collect();
    is_map_right(map, maze, &fragments, &all)
}

/// Returns whether a place of a map could be a cell, by its ports and its landmark.
fn is_like(junction: &Junction, maze: &Maze, cell: Cell) -> bool {
    maze.degree(cell) == junction.ports.len() && junction.landmark == landmark_at(maze, cell)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use tolman_maps::cpm::{Dictionary, MapFile};
    use tolman_robot::Landmark;

    use super::super::fragments::tests::THREE_WAYS;
    use super::*;

    /// Landmark and number of ports of each place: start, both crossings, goal.
    const PLACES: [(Option<Landmark>, usize); 4] = [
        (Some(Landmark::Start), 1),
        (None, 4),
        (None, 4),
        (Some(Landmark::Goal), 1),
    ];

    /// The fragments by the ports of both ends; those of the crossings lead west, south, east and
    /// north.
    const FRAGMENTS: [[(usize, usize); 2]; 5] = [
        [(0, 0), (1, 0)],
        [(1, 2), (2, 0)],
        [(1, 3), (2, 3)],
        [(1, 1), (2, 1)],
        [(2, 2), (3, 0)],
    ];

    fn map(places: &[(Option<Landmark>, usize)], fragments: &[[(usize, usize); 2]]) -> CpMap {
        let open = |(landmark, degree): &(Option<Landmark>, usize)| {
            (*landmark, vec![json!({"open": 0}); *degree])
        };
        let mut junctions: Vec<(Option<Landmark>, Vec<Value>)> = places.iter().map(open).collect();
        for (id, ends) in fragments.iter().enumerate() {
            for (sign, (place, port)) in ["minus", "plus"].into_iter().zip(ends) {
                junctions[*place].1[*port] = json!({ sign: id });
            }
        }
        let junction = |(id, (landmark, ports)): (usize, &(Option<Landmark>, Vec<Value>))| json!({"id": id, "landmark": landmark, "ports": ports});
        let fragment = |(id, [minus, plus]): (usize, &[(usize, usize); 2])| json!({"id": id, "patterns": [0], "motion": null, "traversals": 1, "minus": minus, "plus": plus});
        let mut dictionary = Dictionary::new(1);
        dictionary.learn(&[1.0], &[1.0], 0.1).unwrap();
        let empty = MapFile::of(&CpMap::default(), &dictionary).unwrap();
        let mut file = serde_json::to_value(empty).unwrap();
        file["counts"]["fragments"] = json!(fragments.len());
        file["counts"]["junctions"] = json!(places.len());
        file["map"] = json!({
            "patterns": 1,
            "next_fragment": fragments.len(),
            "next_junction": places.len(),
            "fragments": fragments.iter().enumerate().map(fragment).collect::<Vec<_>>(),
            "junctions": junctions.iter().enumerate().map(junction).collect::<Vec<_>>(),
        });
        let file: MapFile = serde_json::from_value(file).unwrap();
        file.map(&dictionary).unwrap()
    }

    /// Returns whether a map is right if all fragments were walked except those between these
    /// cells.
    fn is_right(map: &CpMap, unwalked: &[u32]) -> bool {
        let maze = tolman_maze::read(THREE_WAYS).unwrap().maze;
        let fragments = TrueFragments::of(&maze);
        let walked = fragments.ways().map(|(_, _, way)| way.fragment);
        let walked = walked.filter(|fragment| !unwalked.contains(fragment));
        is_map_right(map, &maze, &fragments, &walked.collect())
    }

    /// Returns the number of the true fragment that leaves a cell in a heading.
    fn leaving(x: u16, y: u16, degrees: f64) -> u32 {
        let maze = tolman_maze::read(THREE_WAYS).unwrap().maze;
        let heading = tolman_geom::Heading::from_degrees(degrees);
        let way = TrueFragments::of(&maze).way(Cell::new(x, y), heading);
        way.unwrap().fragment
    }

    #[test]
    fn the_map_of_what_was_walked_is_right() {
        assert!(is_right(&map(&PLACES, &FRAGMENTS), &[]));
        // It does not matter from which end a fragment was walked, nor which port of a junction is
        // the first.
        let mut turned = FRAGMENTS;
        turned[2].reverse();
        for fragment in &mut turned {
            for (place, port) in fragment {
                *port = if *place == 2 { (*port + 1) % 4 } else { *port };
            }
        }
        assert!(is_right(&map(&PLACES, &turned), &[]));
        // Nor that the robot has not been everywhere.
        let way_to_goal = [FRAGMENTS[0], FRAGMENTS[1], FRAGMENTS[4]];
        let [north, south] = [leaving(1, 1, 90.0), leaving(1, 1, -90.0)];
        assert!(is_right(&map(&PLACES, &way_to_goal), &[north, south]));
    }

    #[test]
    fn a_map_with_one_wrong_joint_is_not() {
        let mut crossed = FRAGMENTS;
        crossed[2][1].1 = 1;
        crossed[3][1].1 = 3;
        assert!(!is_right(&map(&PLACES, &crossed), &[]));
        // The way over the north, taken for a loop of the first crossing.
        let north = leaving(1, 1, 90.0);
        let mut looped = FRAGMENTS.to_vec();
        looped[2] = [(1, 3), (1, 1)];
        looped.remove(3);
        assert!(!is_right(&map(&PLACES, &looped), &[leaving(1, 1, -90.0)]));
        assert!(!is_right(&map(&PLACES, &looped), &[north]));
    }

    #[test]
    fn a_map_that_has_a_thing_twice_or_not_at_all_is_not() {
        // One fragment was taken for another.
        let missing = [&FRAGMENTS[..2], &FRAGMENTS[3..]].concat();
        assert!(is_right(&map(&PLACES, &missing), &[leaving(1, 1, 90.0)]));
        assert!(!is_right(&map(&PLACES, &missing), &[]));
        // The second crossing twice: by the north one comes to another.
        let mut twice = FRAGMENTS;
        twice[2][1] = (4, 3);
        let places = [&PLACES[..], &[(None, 4)]].concat();
        assert!(!is_right(&map(&places, &twice), &[]));
        // A junction that hangs in the air.
        assert!(!is_right(&map(&places, &FRAGMENTS), &[]));
    }

    #[test]
    fn a_place_that_was_seen_wrongly_is_not_right() {
        let mut forks = PLACES;
        forks[1].1 = 5;
        assert!(!is_right(&map(&forks, &FRAGMENTS), &[]));
        let mut plain = PLACES;
        plain[3].0 = None;
        assert!(!is_right(&map(&plain, &FRAGMENTS), &[]));
    }
}
