use alloc::collections::VecDeque;
use alloc::vec;

use tolman_maze::Direction;

use super::{BumpMap, BumpWay};

impl BumpMap {
    /// Returns where to go to learn more: to the nearest way that nobody tried, straight on where
    /// it makes no difference. On a complete map to all ways in turn, which tests it. O(places).
    ///
    /// Where moves may fail, first of all to the same way again if a bump is not believed yet, and
    /// on the shortest walk that tells the likeliest hypotheses apart as soon as one failure more
    /// is less likely than that the best is wrong.
    ///
    /// Straight on, because a robot that turns at each place meets few walls, and walls are what
    /// places differ by.
    #[must_use]
    pub fn advice(&self) -> Direction {
        if let Some(again) = self.tries.again() {
            return again;
        }
        if self.beam.doubt() > libm::exp2(-self.worth.failure())
            && let Some(telling) = self.beam.telling()
        {
            return telling;
        }
        let here = self.here();
        // For each place, the first action of the way there.
        let mut first = vec![None; self.map().len()];
        let mut queue = VecDeque::from([here]);
        while let Some(place) = queue.pop_front() {
            let begin = first.get(place as usize).copied().flatten();
            for action in self.preferred() {
                match self.map().way(place, action) {
                    BumpWay::Closed => {}
                    BumpWay::Untried => return begin.unwrap_or(action),
                    BumpWay::To(next) => {
                        if let Some(slot @ None) = first.get_mut(next as usize)
                            && next != here
                        {
                            *slot = Some(begin.unwrap_or(action));
                            queue.push_back(next);
                        }
                    }
                }
            }
        }
        self.in_turn()
    }

    /// Returns the four actions, straight on first and back last.
    fn preferred(&self) -> [Direction; 4] {
        let ahead = self.last;
        [ahead, ahead.left(), ahead.right(), ahead.opposite()]
    }

    /// Returns the next way in turn, clockwise from the one that the robot tried last at this
    /// place, or the one after that, by chance.
    ///
    /// Who takes the next one at each place tries every way again and again (the rotor-router;
    /// Priezzhev, Dhar, Dhar, Krishnamurthy, *Eulerian walkers as a model of self-organized
    /// criticality*, 1996). But on a wrong map it could go round in the world forever without a
    /// contradiction.
    fn in_turn(&self) -> Direction {
        let before = self.beam.best.tried_last.get(self.here() as usize);
        let next = before.copied().unwrap_or(self.last).right();
        if self.coin() { next } else { next.right() }
    }

    /// Returns a coin's side that follows from the number of moves alone.
    const fn coin(&self) -> bool {
        // Weyl's sequence of the golden ratio, scrambled.
        let scrambled = (self.moves as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (scrambled ^ scrambled >> 31).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 63 == 0
    }
}
