//! Remembers how each way last was, without confusing two places: the baseline of a map whose world
//! changes.

use alloc::collections::{BTreeMap, BTreeSet};

use tolman_maze::Direction;
use tolman_planners::{Graph, path_to};

use super::{Places, TruePlace, leads, share};

/// End of a way.
#[derive(Clone, Copy, Debug)]
struct End {
    site: u32,
    /// Distance from the beginning of the way, m.
    distance: f64,
}

/// The true ways at the time when the robot last saw them. Nothing is inferred about ways that it
/// did not see. If a place has appeared on a way, the way back stays as it was until it is driven.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// End of each way when it was last driven, by site and direction.
    led: BTreeMap<(u32, Direction), End>,
    /// Ways that were shut when they were last seen.
    shut: BTreeSet<(u32, Direction)>,
    /// Numbers of the places that the robot went past and did not meet.
    missed: BTreeSet<u32>,
}

impl Memory {
    /// Takes in which ways lead on from the place where the robot is.
    pub(super) fn see(&mut self, here: &TruePlace) {
        self.missed.remove(&here.site);
        for direction in Direction::ALL {
            let way = (here.site, direction);
            if here.ways[direction.index()].is_some() {
                self.shut.remove(&way);
            } else {
                self.shut.insert(way);
            }
        }
    }

    /// Takes in that a way led to a site, at a distance in metres. Ways do not turn. Its former end
    /// is missed if that is nearer, and lies behind the new end if not.
    pub(super) fn go(&mut self, from: u32, direction: Direction, to: u32, distance: f64) {
        let end = End { site: to, distance };
        if let Some(before) = self.led.insert((from, direction), end)
            && before.site != to
            && before.distance < distance
        {
            self.missed.insert(before.site);
        }
    }

    /// Returns the site at the end of a way, or `None` if it was never driven or is missing by now.
    fn end(&self, way: (u32, Direction)) -> Option<u32> {
        let to = self.led.get(&way)?.site;
        let is_there = !self.shut.contains(&way) && !self.missed.contains(&to);
        is_there.then_some(to)
    }

    /// Returns the ways that are there as far as the robot remembers.
    fn ways(&self) -> impl Iterator<Item = ((u32, Direction), u32)> {
        let all = self.led.keys();
        let met = all.filter(|(site, _)| !self.missed.contains(site));
        met.filter_map(|way| Some((*way, self.end(*way)?)))
    }

    /// Returns the share of the remembered ways that lead where the memory says.
    pub(super) fn precision(&self, truth: &Places) -> f64 {
        let is_right = |(way, to): &((u32, Direction), u32)| leads(truth, *way) == Some(*to);
        share(self.ways().filter(is_right).count(), self.ways().count())
    }

    /// Returns the fewest moves from one site to another, or `None` if the memory knows no way.
    pub(super) fn plan(&self, from: u32, to: u32) -> Option<Vec<Direction>> {
        let path = path_to(self, from, |site| site == to)?;
        let hops = path.windows(2);
        let directions = hops.map(|hop| {
            let mut ways = self.ways_from(hop[0]);
            Some(ways.find(|(_, end)| *end == hop[1])?.0)
        });
        directions.collect()
    }

    fn ways_from(&self, site: u32) -> impl Iterator<Item = (Direction, u32)> {
        let all = Direction::ALL.into_iter();
        all.filter_map(move |direction| Some((direction, self.end((site, direction))?)))
    }
}

impl Graph for Memory {
    fn node_count(&self) -> usize {
        let ends = self.led.iter().flat_map(|(way, end)| [way.0, end.site]);
        ends.max().map_or(0, |last| last as usize + 1)
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        for (_, to) in self.ways_from(node) {
            visit(to, 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use tolman_geom::Point;

    use super::*;

    /// Lets the robot see that all ways of a place lead on, or none.
    fn see(memory: &mut Memory, site: u32, open: bool) {
        memory.see(&TruePlace {
            site,
            position: Point::origin(),
            ways: [open.then_some(0); 4],
        });
    }

    #[test]
    fn it_plans_by_what_it_saw_last() {
        let mut memory = Memory::default();
        see(&mut memory, 0, true);
        memory.go(0, Direction::East, 1, 2.0);
        see(&mut memory, 1, true);
        memory.go(1, Direction::East, 2, 2.0);
        see(&mut memory, 2, true);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East; 2]));
        // The place in between no longer exists.
        memory.go(0, Direction::East, 2, 4.0);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East]));
        assert_eq!(memory.plan(0, 1), None);
        see(&mut memory, 0, false);
        assert_eq!(memory.plan(0, 2), None);
    }

    #[test]
    fn a_place_that_appears_hides_none_behind_it() {
        let mut memory = Memory::default();
        see(&mut memory, 0, true);
        memory.go(0, Direction::East, 2, 4.0);
        see(&mut memory, 2, true);
        memory.go(2, Direction::North, 3, 2.0);
        memory.go(3, Direction::South, 2, 2.0);
        // A door has opened into the corridor.
        memory.go(0, Direction::East, 1, 2.0);
        see(&mut memory, 1, true);
        assert_eq!(memory.plan(3, 2), Some(vec![Direction::South]));
        assert_eq!(memory.plan(0, 2), None);
        memory.go(1, Direction::East, 2, 2.0);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East; 2]));
        // It is shut again.
        memory.go(0, Direction::East, 2, 4.0);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East]));
        assert_eq!(memory.plan(2, 1), None);
    }
}
