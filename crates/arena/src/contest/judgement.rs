use alloc::collections::{BTreeMap, BTreeSet};
use core::cmp::Reverse;

use tolman_maze::Cell;
use tolman_robot::{Landmark, MapPlace, MapView};

use super::spots::Spots;
use super::true_graph::TrueGraph;
use super::whereabouts::{PlaceVisit, Squares, offset};
use crate::diktiometry::share;

/// Quality of a learned map, compared with the truth. Shares are from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapJudgement {
    /// Whether the map is right as far as the robot has been, and has at least
    /// [`ENOUGH`](Self::ENOUGH) of all places, of the landmarks in rooms, and of all ways.
    pub is_right: bool,
    /// Whether the map is right as far as the robot has been. Its places are then different true
    /// places, its links are different true ways, and it has all ways that were driven.
    pub is_right_of_visited: bool,
    /// Share of the visits at which the robot was in the cell where that place was visited most
    /// often; `None` without visits.
    pub purity: Option<f64>,
    /// Number of places on the map over that of true places. A place with two ways and no landmark
    /// counts as part of a way in both.
    pub places: f64,
    /// Share of the links that are true ways, each counted once; `None` for a map without links.
    pub link_precision: Option<f64>,
    /// Share of the true ways that are on the map.
    pub link_recall: f64,
}

impl MapJudgement {
    /// Minimum share of all places and ways that a right map has.
    pub const ENOUGH: f64 = 0.95;

    /// Returns why the map is wrong or unfinished, in a sentence without a full stop; `None` if it
    /// is right.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        if self.is_right {
            return None;
        }
        let recall = percent(self.link_recall);
        if self.is_right_of_visited {
            return Some(format!(
                "it is right as far as the robot went, but has {recall} of the true ways alone"
            ));
        }
        let links = match self.link_precision {
            Some(share) => format!("{} of its links are true ways", percent(share)),
            None => "it has no links".to_owned(),
        };
        let purity = self.purity.map_or("no visits".to_owned(), |share| {
            format!("{} of the visits at the same place", percent(share))
        });
        Some(format!(
            "{:.2} places for each true one, {purity}; {links}, and {recall} of the true ways are on it",
            self.places
        ))
    }
}

/// Returns the judgement of a map.
///
/// - `stands_for` has the cell for which each place of the map stands, and `purity` the share of
///   the visits in it.
/// - `gone` are the numbers of the ways that the robot truly drove.
///
/// Places of a room that are linked count as one, since a room is one place. Places that stand for
/// cells inside a way, such as bends, belong to the link between the places at its ends. O(links ·
/// ways).
pub(super) fn judge(
    map: &MapView,
    stands_for: &BTreeMap<u32, Cell>,
    purity: Option<f64>,
    truth: &TrueGraph,
    gone: &BTreeSet<usize>,
) -> MapJudgement {
    let spots = stands_for.iter();
    let stands_for: &BTreeMap<u32, Cell> = &spots
        .map(|(place, cell)| (*place, truth.spots().at(*cell)))
        .collect();
    let chart = Chart::of(map, stands_for, truth);
    let mut found: BTreeSet<usize> = BTreeSet::new();
    let (mut links, mut right_links) = (0_usize, 0_usize);
    let mut chains = chart.chains();
    // A chain without a cell in between may be any way between its ends that no other chain is, so
    // these come last.
    chains.sort_by_key(|chain| chain.over.is_empty());
    for chain in chains {
        let way = chart.way_of(&chain, &found, gone);
        match way {
            Matched::Way(way) => {
                found.insert(way);
                right_links += 1;
            }
            Matched::Nothing => {}
            Matched::Stub => continue,
        }
        links += 1;
    }
    let nodes = chart.nodes();
    let cells: BTreeSet<Cell> = nodes.iter().filter_map(|(_, cell)| *cell).collect();
    let are_others = cells.len() == nodes.len();
    let is_marked_rightly = map.places.iter().all(|place| {
        let cell = stands_for.get(&place.id).copied();
        let is_at = |mark| cell.is_some_and(|cell| truth.has(cell, mark));
        place.landmark.is_none_or(is_at)
    });
    let is_right_of_visited = !map.places.is_empty()
        && are_others
        && is_marked_rightly
        && right_links == links
        && gone.is_subset(&found);
    let on_it = cells.intersection(truth.places()).count();
    let is_marked = |(cell, mark): &&(Cell, Landmark)| {
        let mut places = map.places.iter();
        places.any(|place| place.landmark == Some(*mark) && stands_for.get(&place.id) == Some(cell))
    };
    let marks = truth.in_rooms();
    let on_it = on_it + marks.iter().filter(is_marked).count();
    let is_enough = share(on_it, truth.places().len() + marks.len()) >= MapJudgement::ENOUGH
        && share(found.len(), truth.ways().len()) >= MapJudgement::ENOUGH;
    MapJudgement {
        is_right: is_right_of_visited && is_enough,
        is_right_of_visited,
        purity,
        places: nodes.len() as f64 / truth.places().len().max(1) as f64,
        link_precision: (links > 0).then(|| share(right_links, links)),
        link_recall: share(found.len(), truth.ways().len()),
    }
}

/// Returns the cell that each place stands for, and the purity.
///
/// A place of the map stands for the cell where the robot most often was when it believed it was
/// there. A place that was never visited stands for the cell at its position on the map, if it has
/// one. O(visits · log places).
pub(super) fn stands_for(
    map: &MapView,
    visits: &[PlaceVisit],
    squares: Squares,
    spots: &Spots,
) -> (BTreeMap<u32, Cell>, Option<f64>) {
    let ids: BTreeSet<u32> = map.places.iter().map(|place| place.id).collect();
    let mut taken: BTreeMap<u32, BTreeMap<Cell, usize>> = BTreeMap::new();
    for visit in visits.iter().filter(|visit| ids.contains(&visit.place)) {
        let cells = taken.entry(visit.place).or_default();
        *cells.entry(visit.cell).or_default() += 1;
    }
    let all: usize = taken.values().flat_map(BTreeMap::values).sum();
    let mut pure = 0;
    let mut stands_for = BTreeMap::new();
    for (place, cells) in taken {
        let mut of_spots: BTreeMap<Cell, usize> = BTreeMap::new();
        for (cell, count) in &cells {
            *of_spots.entry(spots.at(*cell)).or_default() += count;
        }
        if let Some((spot, count)) = most(of_spots) {
            pure += count;
            let inside = cells
                .into_iter()
                .filter(|(cell, _)| spots.at(*cell) == spot);
            stands_for.extend(most(inside).map(|(cell, _)| (place, cell)));
        }
    }
    let visited = map.places.iter();
    let visited = visited.filter_map(|place| Some((place, *stands_for.get(&place.id)?)));
    if let Some(offset) = offset(visited, squares) {
        for MapPlace { id, position, .. } in &map.places {
            if let Some(position) = position {
                let cell = squares.cell_at(position + offset);
                stands_for.entry(*id).or_insert(cell);
            }
        }
    }
    (stands_for, (all > 0).then(|| share(pure, all)))
}

/// Returns the most frequent cell, and how often it was counted. Of several the first counts.
fn most(counts: impl IntoIterator<Item = (Cell, usize)>) -> Option<(Cell, usize)> {
    let counts = counts.into_iter();
    counts.max_by_key(|(cell, count)| (*count, Reverse(*cell)))
}

/// Returns the place that counts for each place of a room: the first of those that links join.
fn of_rooms(
    map: &MapView,
    stands_for: &BTreeMap<u32, Cell>,
    truth: &TrueGraph,
) -> BTreeMap<u32, u32> {
    let room = |place: u32| {
        let cell = stands_for.get(&place).copied();
        cell.filter(|cell| truth.spots().is_shared(*cell))
    };
    let mut one: BTreeMap<u32, u32> = BTreeMap::new();
    for link in &map.links {
        if room(link.from).is_some() && room(link.from) == room(link.to) {
            let [a, b] = [link.from, link.to].map(|end| one.get(&end).copied().unwrap_or(end));
            let [first, other] = [a.min(b), a.max(b)];
            for of in one.values_mut().filter(|of| **of == other) {
                *of = first;
            }
            one.extend([(link.from, first), (link.to, first)]);
        }
    }
    one
}

/// True counterpart of a chain of links on the map.
enum Matched {
    /// The true way with this index.
    Way(usize),
    /// Beginning of a way that was not driven to its end.
    Stub,
    /// No true way, or one that is on the map already.
    Nothing,
}

/// A chain of links between two places, through places that stand for cells inside a way.
struct Chain {
    ends: [u32; 2],
    over: Vec<u32>,
}

/// Number of links there and back, of each two places.
type LinkCounts = BTreeMap<(u32, u32), [usize; 2]>;

/// Links of a learned map, with the true cells that its places stand for.
struct Chart<'a> {
    stands_for: &'a BTreeMap<u32, Cell>,
    truth: &'a TrueGraph,
    /// Links of each place, with the places they lead to. A link from a place to itself is listed
    /// twice.
    links: BTreeMap<u32, Vec<(usize, u32)>>,
}

impl<'a> Chart<'a> {
    fn of(map: &MapView, stands_for: &'a BTreeMap<u32, Cell>, truth: &'a TrueGraph) -> Self {
        let one = of_rooms(map, stands_for, truth);
        let one = |place: u32| one.get(&place).copied().unwrap_or(place);
        let is_shared = |place: u32| {
            let cell = stands_for.get(&place);
            cell.is_some_and(|cell| truth.spots().is_shared(*cell))
        };
        // Number of true ways that join two rooms.
        let doors = |one: u32, other: u32| match [one, other].map(|end| stands_for.get(&end)) {
            [Some(one), Some(other)] => {
                let ways = truth.ways().iter();
                ways.filter(|way| way.joins(*one, *other)).count()
            }
            _ => 0,
        };
        // Number of links there and back, of each two places of the two ends.
        let mut counts: BTreeMap<(u32, u32), LinkCounts> = BTreeMap::new();
        for link in &map.links {
            let [from, to] = [one(link.from), one(link.to)];
            if from == to && link.from != link.to {
                continue;
            }
            let is_back = from > to;
            let places = match is_back {
                true => (link.to, link.from),
                false => (link.from, link.to),
            };
            let of_ends = counts.entry((from.min(to), from.max(to))).or_default();
            of_ends.entry(places).or_default()[usize::from(is_back)] += 1;
        }
        let places = map.places.iter().map(|place| (one(place.id), Vec::new()));
        let mut links: BTreeMap<u32, Vec<(usize, u32)>> = places.collect();
        let mut number = 0;
        for ((one, other), of_places) in counts {
            // A way that can be driven in both directions is on the map twice.
            let each = of_places.values().map(|[there, back]| match one == other {
                true => there.div_ceil(2),
                false => *there.max(back),
            });
            let count = match is_shared(one) && is_shared(other) {
                // Many places of one room may be linked with many of the next by one way.
                true => each
                    .clone()
                    .max()
                    .unwrap_or(0)
                    .max(each.sum::<usize>().min(doors(one, other))),
                false => each.sum(),
            };
            for _ in 0..count {
                links.entry(one).or_default().push((number, other));
                links.entry(other).or_default().push((number, one));
                number += 1;
            }
        }
        Self {
            stands_for,
            truth,
            links,
        }
    }

    fn cell(&self, place: u32) -> Option<Cell> {
        self.stands_for.get(&place).copied()
    }

    fn is_true_place(&self, place: u32) -> bool {
        let cell = self.cell(place);
        cell.is_some_and(|cell| self.truth.places().contains(&cell))
    }

    fn degree(&self, place: u32) -> usize {
        self.links.get(&place).map_or(0, Vec::len)
    }

    /// Returns whether a place stands for a cell inside a way, and is part of a chain.
    fn is_amid(&self, place: u32) -> bool {
        !self.is_true_place(place) && self.cell(place).is_some() && self.degree(place) == 2
    }

    /// Returns whether a link leads to a cell inside a way and no farther.
    fn is_stub(&self, place: u32) -> bool {
        !self.is_true_place(place) && self.cell(place).is_some() && self.degree(place) == 1
    }

    /// Returns the places that are not part of a chain or the end of a stub, with their cells.
    fn nodes(&self) -> Vec<(u32, Option<Cell>)> {
        let places = self.links.keys().copied();
        let nodes = places.filter(|place| !self.is_amid(*place) && !self.is_stub(*place));
        nodes.map(|place| (place, self.cell(place))).collect()
    }

    /// Returns all chains. Links that meet at a place inside a way are joined.
    fn chains(&self) -> Vec<Chain> {
        let mut used: BTreeSet<usize> = BTreeSet::new();
        let mut chains = Vec::new();
        let ends = self.links.keys().filter(|place| !self.is_amid(**place));
        // Only cycles without an end are left then.
        for from in ends.chain(self.links.keys()) {
            for (link, to) in self.links.get(from).into_iter().flatten() {
                if used.insert(*link) {
                    chains.push(self.chain(*from, *to, &mut used));
                }
            }
        }
        chains
    }

    fn chain(&self, from: u32, to: u32, used: &mut BTreeSet<usize>) -> Chain {
        let (mut at, mut over) = (to, Vec::new());
        while at != from && self.is_amid(at) {
            let mut on = self.links.get(&at).into_iter().flatten();
            let Some((link, next)) = on.find(|(link, _)| !used.contains(link)) else {
                break;
            };
            used.insert(*link);
            over.push(at);
            at = *next;
        }
        let ends = [from, at];
        Chain { ends, over }
    }

    fn way_of(&self, chain: &Chain, found: &BTreeSet<usize>, gone: &BTreeSet<usize>) -> Matched {
        let over: Option<Vec<Cell>> = chain.over.iter().map(|place| self.cell(*place)).collect();
        let ([Some(one), Some(other)], Some(over)) = (chain.ends.map(|end| self.cell(end)), over)
        else {
            return Matched::Nothing;
        };
        let ways = || self.truth.ways().iter().enumerate();
        let [a, b] = chain.ends;
        if self.is_stub(a) || self.is_stub(b) {
            let (root, tip) = if self.is_stub(a) {
                (other, one)
            } else {
                (one, other)
            };
            let is_along = |way: &super::TrueWay| {
                let mut cells = over.iter().chain([&tip]);
                way.ends.contains(&root) && cells.all(|cell| way.between.contains(cell))
            };
            let mut along = ways().filter(|(number, way)| !gone.contains(number) && is_along(way));
            return along.next().map_or(Matched::Nothing, |_| Matched::Stub);
        }
        let mut fitting = ways().filter(|(number, way)| {
            way.joins(one, other)
                && !found.contains(number)
                && over.iter().all(|cell| way.between.contains(cell))
        });
        // Among ways that the map does not tell apart, those that were driven come first.
        let fitting: Vec<usize> = fitting.by_ref().map(|(number, _)| number).collect();
        let walked = fitting.iter().find(|number| gone.contains(number));
        let best = walked.or(fitting.first());
        best.map_or(Matched::Nothing, |way| Matched::Way(*way))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use tolman_geom::Point;
    use tolman_maze::Maze;
    use tolman_robot::MapLink;

    use super::super::true_graph::PlaceRule;
    use super::*;
    use crate::cpm::landmark_at;
    use crate::family::Family;

    fn drawn(family: usize, seed: u64) -> Maze {
        let family = Family::ARENA[family];
        (family.draw)(family.sizes[0], &mut ChaCha8Rng::seed_from_u64(seed)).unwrap()
    }

    /// Returns a map with each of these cells as a place, by its index, and with links for the
    /// openings between neighbours.
    fn of_cells(maze: &Maze) -> (MapView, Vec<PlaceVisit>) {
        let id = |cell: Cell| maze.grid().index(cell) as u32;
        let mut map = MapView::default();
        let mut visits = Vec::new();
        for cell in maze.reachable() {
            map.places.push(MapPlace {
                landmark: landmark_at(maze, cell),
                ..place(id(cell))
            });
            visits.push(PlaceVisit {
                place: id(cell),
                cell,
            });
            let links = maze.neighbours(cell).map(|(_, next)| MapLink {
                from: id(cell),
                to: id(next),
            });
            map.links.extend(links);
        }
        (map, visits)
    }

    /// Returns a map with the true places only.
    fn of_places(maze: &Maze, truth: &TrueGraph) -> (MapView, Vec<PlaceVisit>) {
        let id = |cell: Cell| maze.grid().index(cell) as u32;
        let mut map = MapView::default();
        let mut visits = Vec::new();
        for cell in truth.places() {
            map.places.push(place(id(*cell)));
            visits.push(PlaceVisit {
                place: id(*cell),
                cell: *cell,
            });
        }
        for (number, (cell, mark)) in (20_000..).zip(truth.in_rooms()) {
            map.places.push(MapPlace {
                landmark: Some(*mark),
                ..place(number)
            });
            visits.push(PlaceVisit {
                place: number,
                cell: *cell,
            });
            map.links.extend(MapLink::both_ways(id(*cell), number));
        }
        for way in truth.ways() {
            let [from, to] = way.ends.map(id);
            map.links
                .extend([MapLink { from, to }, MapLink { from: to, to: from }]);
        }
        (map, visits)
    }

    const fn place(id: u32) -> MapPlace {
        MapPlace {
            id,
            position: None,
            landmark: None,
        }
    }

    fn judged(maze: &Maze, truth: &TrueGraph, map: &(MapView, Vec<PlaceVisit>)) -> MapJudgement {
        let gone = (0..truth.ways().len()).collect();
        let squares = Squares {
            grid: maze.grid(),
            pitch: 1.0,
            origin: Point::origin(),
        };
        let (stands_for, purity) = stands_for(&map.0, &map.1, squares, truth.spots());
        judge(&map.0, &stands_for, purity, truth, &gone)
    }

    fn rules() -> impl Strategy<Value = PlaceRule> {
        prop_oneof![Just(PlaceRule::Landmarks), Just(PlaceRule::Corners)]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn the_true_map_is_right_with_bends_or_without(family in 0..Family::ARENA.len(), seed: u64, rule in rules()) {
            let maze = drawn(family, seed);
            let truth = TrueGraph::of(&maze, rule);
            for map in [of_places(&maze, &truth), of_cells(&maze)] {
                let judged = judged(&maze, &truth, &map);
                prop_assert!(judged.is_right && judged.is_right_of_visited, "{judged:?}\n{maze}");
                // A room alone has no ways.
                let precision = judged.link_precision.unwrap_or(1.0);
                prop_assert!(truth.ways().is_empty() || judged.link_precision.is_some());
                prop_assert_eq!((judged.purity, precision, judged.link_recall), (Some(1.0), 1.0, 1.0));
                prop_assert!((judged.places - 1.0).abs() < 1e-9);
            }
        }

        #[test]
        fn a_map_with_one_fault_is_not_right(family in 0..Family::ARENA.len(), seed: u64, fault in 0..4_usize, which: prop::sample::Index) {
            let maze = drawn(family, seed);
            let truth = TrueGraph::of(&maze, PlaceRule::Landmarks);
            let (mut map, mut visits) = of_places(&maze, &truth);
            // A room alone has no ways.
            prop_assume!(!truth.ways().is_empty());
            let way = &truth.ways()[which.index(truth.ways().len())];
            let [from, to] = way.ends.map(|cell| maze.grid().index(cell) as u32);
            let link = MapLink { from, to };
            match fault {
                // A way that was driven is missing.
                0 => {
                    let back = MapLink { from: link.to, to: link.from };
                    let kept = map.links.iter().position(|one| *one == link).unwrap();
                    map.links.remove(kept);
                    let kept = map.links.iter().position(|one| *one == back).unwrap();
                    map.links.remove(kept);
                }
                // One way is on the map twice.
                1 => map.links.extend([link, MapLink { from: link.to, to: link.from }]),
                // One place is on the map twice.
                2 => {
                    map.places.push(place(10_000));
                    visits.push(PlaceVisit { place: 10_000, cell: maze.start().unwrap().0 });
                }
                // Two places are merged into one.
                _ => {
                    let cells = [truth.places().first(), truth.places().last()];
                    let [kept, lost] = cells.map(|cell| maze.grid().index(*cell.unwrap()) as u32);
                    map.places.retain(|place| place.id != lost);
                    let rename = |id: &mut u32| if *id == lost { *id = kept };
                    for link in &mut map.links {
                        rename(&mut link.from);
                        rename(&mut link.to);
                    }
                    visits.iter_mut().for_each(|visit| rename(&mut visit.place));
                }
            }
            let judged = judged(&maze, &truth, &(map, visits));
            prop_assert!(!judged.is_right && !judged.is_right_of_visited, "{judged:?}\n{maze}");
        }
    }

    #[test]
    fn of_two_ways_between_two_places_the_short_one_is_not_the_long_one() {
        let text = "\
start = 0 0 east

o---o---o---o
|       |   |
o   o   o---o
|   |   |   |
o   o   o---o
| S       G |
o---o---o---o
";
        let maze = tolman_maze::read(text).unwrap().maze;
        for rule in [PlaceRule::Landmarks, PlaceRule::Corners] {
            let truth = TrueGraph::of(&maze, rule);
            let judged = judged(&maze, &truth, &of_cells(&maze));
            assert!(judged.is_right, "{judged:?}");
        }
    }

    #[test]
    fn who_never_leaves_home_is_right_of_what_it_visited_and_not_right() {
        let maze = drawn(0, 1);
        let truth = TrueGraph::of(&maze, PlaceRule::Landmarks);
        let (start, _) = maze.start().unwrap();
        let map = MapView {
            places: vec![place(0)],
            links: Vec::new(),
            ..MapView::default()
        };
        let stands_for = BTreeMap::from([(0, start)]);
        let judged = judge(&map, &stands_for, Some(1.0), &truth, &BTreeSet::new());
        assert!(judged.is_right_of_visited && !judged.is_right);
        let map = MapView::default();
        let empty = judge(&map, &BTreeMap::new(), None, &truth, &BTreeSet::new());
        assert!(!empty.is_right_of_visited && !empty.is_right);
    }

    #[test]
    fn purity_is_the_share_of_visits_in_the_majority_s_cell() {
        let maze = drawn(0, 1);
        let cells: Vec<Cell> = maze.reachable().take(2).collect();
        let visit = |place, cell: usize| PlaceVisit {
            place,
            cell: cells[cell],
        };
        let map = MapView {
            places: vec![place(0), place(1)],
            links: Vec::new(),
            ..MapView::default()
        };
        let visits = [
            visit(0, 0),
            visit(0, 0),
            visit(0, 1),
            visit(1, 1),
            visit(7, 1),
        ];
        let squares = Squares {
            grid: maze.grid(),
            pitch: 1.0,
            origin: Point::origin(),
        };
        let (stands_for, purity) = stands_for(&map, &visits, squares, &Spots::default());
        assert_eq!(purity, Some(0.75));
        assert_eq!(stands_for, BTreeMap::from([(0, cells[0]), (1, cells[1])]));
    }
}
