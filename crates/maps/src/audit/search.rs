//! Searches the surest way between two poses: Dijkstra's algorithm over the poses at which closures
//! end.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Reverse;

use super::chain::Chain;
use super::link::Link;
use super::way::{Leg, Way};

/// Working memory of searches, kept between them so that it need not be cleared.
pub(super) struct Search {
    /// Poses at which closures end, in order.
    stations: Vec<u32>,
    /// The stations of the lower and the higher pose of each closure.
    ends: Vec<[u32; 2]>,
    /// The closures of each station, those of station s at `first_at[s] .. first_at[s + 1]`.
    closures: Vec<u32>,
    first_at: Vec<u32>,
    /// The cost of the span to the next station; infinite at the end of a piece.
    next: Vec<f64>,
    reached: Vec<Reached>,
    heap: BinaryHeap<Reverse<(u64, u32)>>,
    round: u32,
    /// The round in which each run was barred last.
    barred: Vec<u32>,
}

#[derive(Clone, Copy, Default)]
struct Reached {
    round: u32,
    before: u32,
    /// Closure over which the search came, `SPAN` for none.
    over: u32,
    cost: f64,
}

const SPAN: u32 = u32::MAX;

impl Search {
    /// Prepares searches over the closures for which `is_open` is true.
    pub(super) fn new(links: &[Link], is_open: &[bool], chain: &Chain) -> Self {
        let open = links.iter().zip(is_open).filter(|(_, is_open)| **is_open);
        let mut stations: Vec<u32> = open
            .flat_map(|(link, _)| [link.first, link.second])
            .collect();
        stations.sort_unstable();
        stations.dedup();
        let station = |pose: u32| stations.partition_point(|station| *station < pose) as u32;
        let ends: Vec<[u32; 2]> = links
            .iter()
            .map(|link| [station(link.first), station(link.second)])
            .collect();
        let (closures, first_at) = closures_at(stations.len(), &ends, is_open);
        let next = stations
            .windows(2)
            .map(|pair| match chain.joins(pair[0], pair[1]) {
                true => chain.span_cost(pair[0], pair[1]),
                false => f64::INFINITY,
            });
        let next = next.chain([f64::INFINITY]).collect();
        let runs = links.iter().map(|link| link.run + 1).max().unwrap_or(0);
        Self {
            reached: alloc::vec![Reached::default(); stations.len()],
            stations,
            ends,
            closures,
            first_at,
            next,
            heap: BinaryHeap::new(),
            round: 0,
            barred: alloc::vec![0; runs as usize],
        }
    }

    /// Returns the surest way from the lower pose of a closure to the higher one. It leads over
    /// odometry and `believed` closures, none of them of the closure's own run or of the runs of
    /// `shunned`. `None` if no such way exists.
    ///
    /// # Complexity
    /// O((stations + closures) · log stations).
    pub(super) fn way(
        &mut self,
        link: u32,
        links: &[Link],
        believed: &[bool],
        shunned: &[u32],
    ) -> Option<Way> {
        self.round += 1;
        for shunned in shunned.iter().chain([&link]) {
            self.barred[links[*shunned as usize].run as usize] = self.round;
        }
        let [from, to] = self.ends[link as usize];
        self.heap.clear();
        self.reach(from, from, SPAN, 0.0);
        while let Some(Reverse((cost, station))) = self.heap.pop() {
            if station == to {
                return Some(self.trace(from, to));
            }
            if cost == self.reached[station as usize].cost.to_bits() {
                self.spread_from(station, f64::from_bits(cost), links, believed);
            }
        }
        None
    }

    fn spread_from(&mut self, station: u32, cost: f64, links: &[Link], believed: &[bool]) {
        let here = station as usize;
        if self.next[here].is_finite() {
            self.reach(station + 1, station, SPAN, cost + self.next[here]);
        }
        if here > 0 && self.next[here - 1].is_finite() {
            self.reach(station - 1, station, SPAN, cost + self.next[here - 1]);
        }
        for place in self.first_at[here]..self.first_at[here + 1] {
            let over = self.closures[place as usize];
            let link = &links[over as usize];
            if believed[over as usize] && self.barred[link.run as usize] != self.round {
                let [low, high] = self.ends[over as usize];
                self.reach(low + high - station, station, over, cost + link.cost);
            }
        }
    }

    fn reach(&mut self, station: u32, before: u32, over: u32, cost: f64) {
        let reached = &mut self.reached[station as usize];
        if reached.round != self.round || cost < reached.cost {
            *reached = Reached {
                round: self.round,
                before,
                over,
                cost,
            };
            // Of numbers from 0 on the bits are in the same order.
            self.heap.push(Reverse((cost.to_bits(), station)));
        }
    }

    fn trace(&self, from: u32, to: u32) -> Way {
        let mut back = Vec::new();
        let mut station = to;
        while station != from {
            let reached = self.reached[station as usize];
            back.push((reached.before, station, reached.over));
            station = reached.before;
        }
        let mut way = Way::default();
        for (before, station, over) in back.into_iter().rev() {
            match over {
                SPAN => way.span(
                    self.stations[before as usize],
                    self.stations[station as usize],
                ),
                _ if self.ends[over as usize][0] == before => way.legs.push(Leg::Up(over)),
                _ => way.legs.push(Leg::Down(over)),
            }
        }
        way
    }
}

/// Returns the open closures of each station, and the index at which those of each begin.
fn closures_at(stations: usize, ends: &[[u32; 2]], is_open: &[bool]) -> (Vec<u32>, Vec<u32>) {
    let open = || (0_u32..).zip(ends).zip(is_open).filter(|(_, open)| **open);
    let mut first_at = alloc::vec![0_u32; stations + 1];
    for ((_, ends), _) in open() {
        for end in ends {
            first_at[*end as usize + 1] += 1;
        }
    }
    for station in 0..stations {
        first_at[station + 1] += first_at[station];
    }
    let mut free = first_at.clone();
    let mut closures = alloc::vec![0; first_at[stations] as usize];
    for ((closure, ends), _) in open() {
        for end in ends {
            let place = &mut free[*end as usize];
            closures[*place as usize] = closure;
            *place += 1;
        }
    }
    (closures, first_at)
}
