use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec;
use alloc::vec::Vec;

use tolman_maze::Direction;

use super::evidence::Evidence;
use super::graph::{BumpWay, Graph};
use super::{BumpMove, FEW_PLACES, enough_bits};

/// A map, and what it holds of the walk: which moves failed.
#[derive(Clone, Debug)]
pub(super) struct Hypothesis {
    /// The walk alone: what is one there is one for certain.
    walked: Graph,
    /// The same with places that are one by evidence.
    folded: Graph,
    /// Where places lie, if the robot is told that each move is one step on a grid. Then nothing is
    /// folded.
    spots: Option<Spots>,
    at: u32,
    /// By place, the way that the robot tried last.
    pub(super) tried_last: Vec<Direction>,
    /// Number of moves since the map was folded.
    waited: usize,
    /// Number of places when the map was folded from the walk the last time.
    fewest: usize,
    /// Number of moves in a row that were predicted.
    pub(super) foretold: usize,
    /// Length of the description, bits.
    pub(super) bits: f64,
    /// Number of the moves that failed.
    failed: Vec<u32>,
    moves: u32,
    /// Number of the last move that showed something new.
    news: u32,
}

/// What a wall counts in the fingerprint, where an open way counts one.
const CLOSED: u64 = 0x94d0_49bb_1331_11eb;

/// Where places lie on the grid.
#[derive(Clone, Debug, Default)]
struct Spots {
    places: BTreeMap<(i32, i32), u32>,
    of: Vec<(i32, i32)>,
    /// Sum of what all known sides count in the fingerprint.
    known: u64,
}

/// What came of a move on a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    Agrees,
    /// It contradicts what is one by evidence, and the walk does not.
    ContradictsEvidence,
    /// It contradicts the walk.
    ContradictsWalk,
}

impl Hypothesis {
    pub(super) fn new(look: u32, unit_steps: bool) -> Self {
        let mut walked = Graph::default();
        let at = walked.push(look);
        let spots = unit_steps.then(|| Spots {
            places: BTreeMap::from([((0, 0), at)]),
            of: vec![(0, 0)],
            known: 0,
        });
        Self {
            folded: if unit_steps {
                Graph::default()
            } else {
                walked.clone()
            },
            walked,
            spots,
            at,
            tried_last: vec![Direction::North],
            waited: 0,
            fewest: FEW_PLACES,
            foretold: 0,
            bits: 0.0,
            failed: Vec::new(),
            moves: 0,
            news: 0,
        }
    }

    /// Returns the map.
    pub(super) const fn map(&self) -> &Graph {
        if self.spots.is_some() {
            &self.walked
        } else {
            &self.folded
        }
    }

    /// Returns the same, which holds that the next move fails.
    pub(super) fn that_failed(&self, failure: f64) -> Self {
        let mut other = self.clone();
        other.bits += failure;
        other.failed.push(self.moves + 1);
        other
    }

    /// Returns the number of the last move that showed something new, from 1 on.
    pub(super) const fn news(&self) -> u32 {
        self.news
    }

    /// Returns which of the first `moves` moves failed.
    pub(super) fn failed_until(&self, moves: u32) -> &[u32] {
        let count = self.failed.partition_point(|number| *number <= moves);
        self.failed.get(..count).unwrap_or_default()
    }

    pub(super) fn here(&self) -> u32 {
        self.map().place(self.at)
    }

    /// Returns what the walk alone knows of a way out of the robot's place.
    pub(super) fn walked_way(&self, action: Direction) -> BumpWay {
        self.walked.way(self.at, action)
    }

    /// Forgets that a way out of the robot's place is closed.
    pub(super) fn reopen(&mut self, action: Direction) {
        self.walked.reopen(self.at, action);
    }

    /// Takes in a move that did not fail, and folds the map if it is time to. Returns `false`, with
    /// nothing changed, if the move contradicts the walk.
    pub(super) fn learn(&mut self, step: BumpMove) -> bool {
        match self.take(step, false) {
            Taken::Agrees if self.has_doubled() => self.refold(self.map().count()),
            Taken::Agrees => self.fold_in_time(),
            Taken::ContradictsEvidence => self.refold(self.map().count()),
            Taken::ContradictsWalk => return false,
        }
        true
    }

    /// Takes in a move. If the robot `stays`, the way is open and it did not take it.
    pub(super) fn take(&mut self, step: BumpMove, stays: bool) -> Taken {
        self.moves += 1;
        let here = self.here();
        let known = self.map().way(here, step.action);
        let Some(next) = self.walk(step) else {
            return Taken::ContradictsWalk;
        };
        self.walked.keep();
        if let Some(tried_last) = self.tried_last.get_mut(here as usize) {
            *tried_last = step.action;
        }
        if next as usize == self.tried_last.len() {
            self.tried_last.push(step.action);
        }
        if known == BumpWay::Untried {
            self.bits += 1.0;
            self.news = self.moves;
        }
        let agrees = self.spots.is_some() || self.follow(step, next);
        self.foretold = if known != BumpWay::Untried && agrees {
            self.foretold + 1
        } else {
            0
        };
        if !stays {
            self.at = next;
        }
        self.waited += 1;
        if agrees {
            Taken::Agrees
        } else {
            Taken::ContradictsEvidence
        }
    }

    /// Takes in on the folded map what the walk knows already.
    fn follow(&mut self, step: BumpMove, next: u32) -> bool {
        let agrees = if step.moved {
            if next as usize == self.folded.len() {
                self.folded.push(step.look);
            }
            self.folded.join(self.at, step.action, next)
        } else {
            self.folded.close(self.here(), step.action)
        };
        self.folded.keep();
        agrees
    }

    /// Writes a move down in the walk, and returns where it led; `None`, with nothing changed, if
    /// it contradicts the walk.
    fn walk(&mut self, step: BumpMove) -> Option<u32> {
        let known = self.walked.way(self.at, step.action);
        match (known, step.moved) {
            (BumpWay::Untried, false) => {
                self.walked.close(self.at, step.action);
                if let Some(spots) = &mut self.spots {
                    spots.close(&mut self.walked, self.at, step.action);
                }
                Some(self.at)
            }
            (BumpWay::Untried, true) => match &mut self.spots {
                Some(spots) => spots.go(&mut self.walked, self.at, step),
                None => {
                    let next = self.walked.push(step.look);
                    self.walked.join(self.at, step.action, next);
                    Some(next)
                }
            },
            (BumpWay::Closed, false) => Some(self.at),
            (BumpWay::To(next), true) => (self.walked.look(next) == step.look).then_some(next),
            (BumpWay::Closed, true) | (BumpWay::To(_), false) => None,
        }
    }

    /// Returns the hypothesis before any move.
    pub(super) fn unmoved(&self) -> Self {
        Self::new(self.walked.look(0), self.spots.is_some())
    }

    /// Returns whether places are one by evidence on this map.
    pub(super) const fn is_folded(&self) -> bool {
        self.spots.is_none()
    }

    /// Returns whether the map has twice as many places as when it was folded from the walk.
    pub(super) fn has_doubled(&self) -> bool {
        self.spots.is_none() && self.folded.count() > 2 * self.fewest
    }

    /// Folds the map if it is time to.
    pub(super) fn fold_in_time(&mut self) {
        let count = self.folded.count();
        if self.waited >= count / 2 && self.untried() > 0 {
            self.fold_to(count);
        }
    }

    /// Folds the map from the whole walk.
    pub(super) fn refold(&mut self, about: usize) {
        let before = self.description();
        self.folded = self.walked.clone();
        self.bits += self.description() - before;
        self.fold_to(about);
        self.fewest = self.folded.count().max(FEW_PLACES);
    }

    /// Looks for places that are one, until about `about` of them are left. On a grid there are
    /// none.
    pub(super) fn fold_to(&mut self, about: usize) {
        if !self.is_folded() {
            return;
        }
        self.waited = 0;
        let before = self.description();
        let evidence = Evidence::of(&self.walked);
        while self.fold_once(about, &evidence) {
            self.folded.shorten();
        }
        self.bits += self.description() - before;
    }

    /// Makes the most surprising pairs one, as long as what was found before still holds. Returns
    /// whether there was any.
    fn fold_once(&mut self, about: usize, evidence: &Evidence) -> bool {
        let places: Vec<u32> = self.folded.places().collect();
        let enough = enough_bits(about.min(places.len()));
        let mut found = Vec::new();
        for (number, one) in places.iter().enumerate() {
            for other in places.iter().take(number) {
                let bits = self.folded.merge([*other, *one], evidence);
                self.folded.undo(0);
                if let Some(bits) = bits.filter(|bits| *bits >= enough) {
                    found.push((bits, *other, *one));
                }
            }
        }
        found.sort_by(|one, other| other.0.total_cmp(&one.0));
        let mut any = false;
        for (_, one, other) in found {
            let pair = [one, other].map(|id| self.folded.place(id));
            if pair[0] != pair[1] {
                any |= self.folded.merge(pair, evidence).is_some();
                self.folded.keep();
            }
        }
        any
    }

    /// Returns the number of ways that nobody tried.
    pub(super) fn untried(&self) -> usize {
        let ways = self.map().places().flat_map(|place| self.map().ways(place));
        ways.filter(|way| *way == BumpWay::Untried).count()
    }

    /// Returns how many bits tell the folded map: one for each way that is open or closed, and for
    /// each loop which place it comes back to (Rissanen, *Modeling by shortest data description*,
    /// 1978).
    fn description(&self) -> f64 {
        let (mut closed, mut sides) = (0_usize, 0_usize);
        for way in self
            .folded
            .places()
            .flat_map(|place| self.folded.ways(place))
        {
            match way {
                BumpWay::Untried => {}
                BumpWay::Closed => closed += 1,
                BumpWay::To(_) => sides += 1,
            }
        }
        let (open, places) = (sides / 2, self.folded.count());
        let loops = (open + 1).saturating_sub(places);
        (closed + open) as f64 + loops as f64 * libm::log2(places as f64)
    }

    /// Returns a number that is the same for equal maps with the robot at the same place, whatever
    /// the order in which they were made. O(places), on a grid O(1).
    pub(super) fn fingerprint(&self) -> u64 {
        if let Some(spots) = &self.spots {
            let (x, y) = spots.of.get(self.at as usize).copied().unwrap_or_default();
            return spots.known.wrapping_mul(shifted(-2 * x, -2 * y));
        }
        let here = self.here();
        let mut number = vec![u32::MAX; self.folded.len()];
        let mut queue = VecDeque::from([here]);
        let (mut next, mut hash) = (1, 0xcbf2_9ce4_8422_2325_u64);
        if let Some(slot) = number.get_mut(here as usize) {
            *slot = 0;
        }
        while let Some(place) = queue.pop_front() {
            for way in self.folded.ways(place) {
                let told = match way {
                    BumpWay::Untried => 0,
                    BumpWay::Closed => 1,
                    BumpWay::To(to) => {
                        let to = self.folded.place(to);
                        let Some(slot) = number.get_mut(to as usize) else {
                            continue;
                        };
                        if *slot == u32::MAX {
                            *slot = next;
                            next += 1;
                            queue.push_back(to);
                        }
                        u64::from(*slot) + 2
                    }
                };
                hash = (hash ^ told).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
        hash
    }
}

impl Spots {
    /// Learns that a way is closed, from both sides of the wall.
    fn close(&mut self, graph: &mut Graph, place: u32, action: Direction) {
        let spot = self.spot(place);
        self.known = self
            .known
            .wrapping_add(shifted_side(spot, action).wrapping_mul(CLOSED));
        if let Some(beyond) = self.places.get(&beside(spot, action)) {
            graph.close(*beyond, action.opposite());
        }
    }

    /// Goes to the place beside, which may be known; `None` if a wall contradicts.
    fn go(&mut self, graph: &mut Graph, place: u32, step: BumpMove) -> Option<u32> {
        let spot = self.spot(place);
        let there = beside(spot, step.action);
        if let Some(next) = self.places.get(&there) {
            let next = *next;
            let fits = graph.look(next) == step.look && graph.join(place, step.action, next);
            if fits {
                self.known = self.known.wrapping_add(shifted_side(spot, step.action));
            }
            return fits.then_some(next);
        }
        let next = graph.push(step.look);
        self.places.insert(there, next);
        self.of.push(there);
        graph.join(place, step.action, next);
        self.known = self.known.wrapping_add(shifted_side(spot, step.action));
        for action in Direction::ALL {
            if let Some(other) = self.places.get(&beside(there, action))
                && graph.way(*other, action.opposite()) == BumpWay::Closed
            {
                graph.close(next, action);
            }
        }
        Some(next)
    }

    fn spot(&self, place: u32) -> (i32, i32) {
        self.of.get(place as usize).copied().unwrap_or_default()
    }
}

/// Returns the grid's spot beside another one.
const fn beside((x, y): (i32, i32), action: Direction) -> (i32, i32) {
    match action {
        Direction::North => (x, y + 1),
        Direction::East => (x + 1, y),
        Direction::South => (x, y - 1),
        Direction::West => (x - 1, y),
    }
}

/// Returns what a side between two spots counts in the fingerprint, the same from both.
fn shifted_side((x, y): (i32, i32), action: Direction) -> u64 {
    let (dx, dy) = beside((0, 0), action);
    shifted(2 * x + dx, 2 * y + dy)
}

/// Returns east^x · north^y of two odd numbers, modulo 2⁶⁴. The sum of a map that lies elsewhere is
/// a multiple of these.
fn shifted(x: i32, y: i32) -> u64 {
    power(0x9e37_79b9_7f4a_7c15, x).wrapping_mul(power(0xbf58_476d_1ce4_e5b9, y))
}

/// Returns a power of an odd number modulo 2⁶⁴, where exponents count modulo 2⁶².
fn power(mut base: u64, exponent: i32) -> u64 {
    let (mut exponent, mut power) = (i64::from(exponent) as u64, 1_u64);
    while exponent > 0 {
        if exponent % 2 == 1 {
            power = power.wrapping_mul(base);
        }
        base = base.wrapping_mul(base);
        exponent /= 2;
    }
    power
}

#[cfg(test)]
mod tests {
    use Direction::{East, North, South, West};

    use super::*;

    fn walked(unit_steps: bool, moves: &[(Direction, bool)]) -> Hypothesis {
        let mut hypothesis = Hypothesis::new(0, unit_steps);
        for (action, moved) in moves.iter().copied() {
            let step = BumpMove {
                action,
                moved,
                look: 0,
            };
            assert_eq!(hypothesis.take(step, false), Taken::Agrees);
        }
        hypothesis
    }

    #[test]
    fn equal_maps_have_equal_fingerprints_wherever_they_began() {
        let one = [(North, true), (East, false), (South, true), (West, false)];
        // From the other end, so that the grid's origin lies elsewhere.
        let other = [(East, false), (South, true), (West, false)];
        for unit_steps in [false, true] {
            let one = walked(unit_steps, &one).fingerprint();
            assert_eq!(one, walked(unit_steps, &other).fingerprint());
            let elsewhere = walked(unit_steps, &other[..2]).fingerprint();
            assert_ne!(one, elsewhere);
        }
    }

    #[test]
    fn unit_steps_close_a_loop() {
        let square = [(North, true), (East, true), (South, true), (West, true)];
        assert_eq!(walked(true, &square).map().count(), 4);
        assert_eq!(walked(false, &square).map().count(), 5);
        let bits = |unit_steps| walked(unit_steps, &square).bits;
        assert_eq!((bits(true), bits(false)), (4.0, 4.0));
    }

    #[test]
    fn a_robot_that_stays_learns_that_the_way_is_open() {
        let mut stayed = walked(false, &[]).that_failed(6.0);
        let step = BumpMove {
            action: North,
            moved: true,
            look: 0,
        };
        assert_eq!(stayed.take(step, true), Taken::Agrees);
        assert_eq!((stayed.here(), stayed.map().count()), (0, 2));
        assert_eq!((stayed.bits, stayed.failed_until(1)), (7.0, [1].as_slice()));
        assert!(stayed.failed_until(0).is_empty());
    }
}
