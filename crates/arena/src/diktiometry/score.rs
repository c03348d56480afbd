//! Compares a learned map with the truth.

use alloc::collections::{BTreeMap, BTreeSet};
use core::cmp::Reverse;

use tolman_maps::diktiometry::{Observer, PathGraph, PlaceId};
use tolman_maze::Direction;
use tolman_systems::diktiometry::Diktiometer;

use super::{Places, leads};

/// True position of the robot while the map had it at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visit {
    /// Site of the true place.
    pub site: u32,
    /// Place on the map, by its id at that time.
    pub place: PlaceId,
}

impl Visit {
    /// Returns the visits of a system that was at these sites, from its first place on.
    pub(super) fn all<E>(system: &Diktiometer<E>, sites: &[u32]) -> Vec<Self> {
        let visited = system.visited().iter().zip(sites);
        let visits = visited.filter_map(|(place, site)| Some((*site, (*place)?)));
        visits.map(|(site, place)| Self { site, place }).collect()
    }
}

/// Quality of a map. Every share is from 0 to 1, and 1 of an empty whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapScore {
    /// Number of places on the map.
    pub places: usize,
    /// True places that were visited.
    pub visited: usize,
    /// Share of visits to the true place that the map's place stands for: the one where it was
    /// visited most often. Below 1 there is polytopy, one node for several places.
    pub purity: f64,
    /// Share of visited true places for which exactly one place on the map stands. Others suffer
    /// monotopy, several nodes for one, or are not on the map.
    pub share_once: f64,
    /// Share of the links on the map that lead where their action truly leads.
    pub link_precision: f64,
    /// Share of the believed links that lead where their action truly leads. The believed link of
    /// an action is its likeliest one, if its probability exceeds ½.
    pub believed_precision: f64,
    /// Share of the true ways of the whole world that are on the map.
    pub link_recall: f64,
    /// Share of the ways driven at least once that are on the map.
    pub gone_recall: f64,
    /// Whether the map is isomorphic to the graph of visited places and driven ways.
    pub is_isomorphic: bool,
}

/// A true way: a site and a direction.
type Way = (u32, Direction);

/// Scores a map; `None` is an empty one. `visits` are all places the robot was at, from the first
/// on; `gone` are the ways it took; `truth` are the places now. Action n of the map is direction n
/// of [`Direction::ALL`]. O(visits · log places + links · log links).
#[must_use]
pub fn score(
    map: Option<&Observer>,
    visits: &[Visit],
    gone: &[(u32, Direction)],
    truth: &Places,
) -> MapScore {
    let nothing = PathGraph::default();
    let map = map.map_or(&nothing, |observer| &observer.map().paths);
    // How often each place on the map was each true place.
    let mut taken: BTreeMap<PlaceId, BTreeMap<u32, usize>> = BTreeMap::new();
    for visit in visits {
        // A place that was elided is not on the map: its visits say nothing of it.
        if let Some(place) = map.resolve(visit.place) {
            let sites = taken.entry(place).or_default();
            *sites.entry(visit.site).or_default() += 1;
        }
    }
    let stands_for = taken.iter().filter_map(|(place, sites)| {
        // Of sites that are equally frequent the first.
        let all = sites.iter();
        let most = all.max_by_key(|(site, count)| (**count, Reverse(**site)));
        most.map(|(site, _)| (*place, *site))
    });
    let stands_for: BTreeMap<PlaceId, u32> = stands_for.collect();
    let all: usize = taken.values().flat_map(BTreeMap::values).sum();
    let right = taken.iter().map(|(place, sites)| sites[&stands_for[place]]);
    let right: usize = right.sum();

    let mut visited: BTreeMap<u32, usize> = visits.iter().map(|visit| (visit.site, 0)).collect();
    for site in stands_for.values() {
        *visited.entry(*site).or_default() += 1;
    }
    let once = visited.values().filter(|count| **count == 1).count();

    let leads = |way: Way| leads(truth, way);
    let mut found: BTreeSet<Way> = BTreeSet::new();
    let (mut links, mut correct) = (0, 0);
    let (mut believed, mut believed_rightly) = (0, 0);
    for (id, link) in map.links() {
        links += 1;
        let is_believed =
            map.chance(id) > 0.5 && map.likely(link.from).any(|(likely, _)| likely == id);
        believed += usize::from(is_believed);
        let direction = Direction::ALL.get(link.action.0 as usize).copied();
        let ends = [link.from, link.to].map(|place| stands_for.get(&place).copied());
        if let (Some(direction), [Some(from), Some(to)]) = (direction, ends)
            && leads((from, direction)) == Some(to)
        {
            correct += 1;
            found.insert((from, direction));
            believed_rightly += usize::from(is_believed);
        }
    }
    let sites = truth.keys();
    let ways = sites.flat_map(|site| Direction::ALL.map(|direction| (*site, direction)));
    let open: BTreeSet<Way> = ways.filter(|way| leads(*way).is_some()).collect();
    let gone: BTreeSet<Way> = gone.iter().copied().collect();
    let gone: BTreeSet<Way> = gone.intersection(&open).copied().collect();
    let recall = |ways: &BTreeSet<Way>| share(ways.intersection(&found).count(), ways.len());

    let places = map.places().count();
    let is_isomorphic = places == visited.len()
        && once == visited.len()
        && right == all
        && correct == links
        && links == gone.len()
        && gone.is_subset(&found);
    MapScore {
        places,
        visited: visited.len(),
        purity: share(right, all),
        share_once: share(once, visited.len()),
        link_precision: share(correct, links),
        believed_precision: share(believed_rightly, believed),
        link_recall: recall(&open),
        gone_recall: recall(&gone),
        is_isomorphic,
    }
}

/// Returns the share of a part in a whole, 0 to 1; 1 if the whole is empty.
pub(crate) fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 {
        1.0
    } else {
        part as f64 / whole as f64
    }
}
