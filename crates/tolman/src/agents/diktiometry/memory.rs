//! What a mapper can know that confuses no two places and remembers all that it saw: the measure of a map whose world changes.

use alloc::collections::{BTreeMap, BTreeSet};

use tolman_maze::Direction;
use tolman_planners::{Graph, path_to};

use super::office::TruePlace;

/// The true ways as they were when the robot last saw them.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// Where a way led when it was last gone, by site and direction.
    led: BTreeMap<(u32, Direction), u32>,
    /// Ways that were shut when they were last seen.
    shut: BTreeSet<(u32, Direction)>,
    /// Places that were not met where they had been.
    missed: BTreeSet<u32>,
}

impl Memory {
    /// The robot is at a site and sees which ways lead on.
    pub(super) fn see(&mut self, site: u32, exits: &[bool; 4]) {
        self.missed.remove(&site);
        for direction in Direction::ALL {
            let way = (site, direction);
            if exits[direction.index()] {
                self.shut.remove(&way);
            } else {
                self.shut.insert(way);
            }
        }
    }

    /// A way led to a site.
    pub(super) fn go(&mut self, from: u32, direction: Direction, to: u32) {
        let before = self.led.insert((from, direction), to);
        self.missed.extend(before.filter(|before| *before != to));
    }

    /// The ways that it takes to be there.
    fn ways(&self) -> impl Iterator<Item = ((u32, Direction), u32)> {
        let all = self.led.iter().map(|(way, to)| (*way, *to));
        all.filter(|(way, to)| {
            let ends = [way.0, *to].iter().any(|end| self.missed.contains(end));
            !ends && !self.shut.contains(way)
        })
    }

    /// The share of the ways it takes to be there that lead where it says.
    pub(super) fn precision(&self, truth: &BTreeMap<u32, TruePlace>) -> f64 {
        let leads = |((site, direction), to): &((u32, Direction), u32)| {
            let place = truth.get(site);
            place.and_then(|place| place.ways[direction.index()]) == Some(*to)
        };
        let right = self.ways().filter(leads).count();
        match self.ways().count() {
            0 => 1.0,
            all => right as f64 / all as f64,
        }
    }

    /// The fewest moves from one site to another, if it knows a way.
    pub(super) fn plan(&self, from: u32, to: u32) -> Option<Vec<Direction>> {
        let path = path_to(self, from, |site| site == to)?;
        let hops = path.iter().zip(path.iter().skip(1));
        hops.map(|(tail, head)| {
            let mut ways = self.ways_from(*tail);
            ways.find(|(_, end)| end == head)
                .map(|(direction, _)| direction)
        })
        .collect()
    }

    fn ways_from(&self, site: u32) -> impl Iterator<Item = (Direction, u32)> {
        let ways = Direction::ALL.map(|direction| (site, direction));
        ways.into_iter().filter_map(|way| {
            let to = *self.led.get(&way)?;
            let there = !self.shut.contains(&way) && !self.missed.contains(&to);
            there.then_some((way.1, to))
        })
    }
}

impl Graph for Memory {
    fn node_count(&self) -> usize {
        let ends = self.led.iter().flat_map(|(way, to)| [way.0, *to]);
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
    use super::*;

    #[test]
    fn it_plans_by_what_it_saw_last() {
        let mut memory = Memory::default();
        let all = [true; 4];
        memory.see(0, &all);
        memory.go(0, Direction::East, 1);
        memory.see(1, &all);
        memory.go(1, Direction::East, 2);
        memory.see(2, &all);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East; 2]));
        // The place between is no longer one.
        memory.go(0, Direction::East, 2);
        assert_eq!(memory.plan(0, 2), Some(vec![Direction::East]));
        assert_eq!(memory.plan(0, 1), None);
        memory.see(0, &[false; 4]);
        assert_eq!(memory.plan(0, 2), None);
    }
}
