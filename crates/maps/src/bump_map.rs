//! A map from actions and bumps alone: no odometry, no compass error, no view.
//!
//! The robot goes north, east, south or west, to the next place, or bumps and stays. Places look
//! alike, or have looks that several share. A [`BumpMap`] writes down the walk as a tree, in which
//! only ways there and back lead back, and then finds places that are one.
//!
//! - **Folding**: if two places are one, so are those to which the same ways lead from both, and so
//!   on (Stallings, *Topology of finite graphs*, 1983). If a way turns out to be open and closed,
//!   or a place to have two looks, they were not one.
//! - **Evidence**: what agrees counts by how seldom it agrees by chance. Two places are one if all
//!   that agrees once they are folded is more surprising than the number of pairs that were tried
//!   (evidence-driven state merging; Lang, Pearlmutter, Price, *Results of the Abbadingo One DFA
//!   learning competition*, 1998). The most surprising comes first.
//! - **Doubt**: as soon as a move contradicts the map, it is folded again from the walk.
//!
//! A map whose ways are all known predicts every move. It is right up to *bisimulation*: places
//! from which every walk bumps alike are one place of the map, because no walk can part them. The
//! world has to be still, and each way has to lead back.
//!
//! ```
//! use tolman_maps::bump_map::{BumpMap, BumpMove};
//! use tolman_maze::{Cell, Grid, Maze};
//!
//! let maze = Maze::open(Grid::new(3, 2));
//! let (mut map, mut at) = (BumpMap::new(0), Cell::new(0, 0));
//! for _ in 0..600 {
//!     let action = map.advice();
//!     let next = maze.beside(at, action);
//!     map.learn(BumpMove { action, moved: next.is_some(), look: 0 })?;
//!     at = next.unwrap_or(at);
//! }
//! assert_eq!((map.place_count(), map.untried()), (6, 0));
//! # Ok::<(), tolman_maps::bump_map::NotStill>(())
//! ```

mod advice;
mod evidence;
mod graph;

use alloc::vec;
use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::Direction;

use evidence::Evidence;
pub use graph::BumpWay;
use graph::Graph;

/// Expected number of pairs that are made one although they are not, if places agreed by chance.
const FALSE_MERGES: f64 = 1e-4;

/// Number of moves for each place that a complete map predicts before it counts as tested.
const TESTS: usize = 8;

/// Number of places of a map that is not worth folding from the walk again.
const FEW_PLACES: usize = 32;

/// A move of the robot, and what came of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BumpMove {
    /// Where the robot tried to go.
    pub action: Direction,
    /// Whether it went there; otherwise it bumped and stayed.
    pub moved: bool,
    /// What the place looks like where the robot is now. Always the same if it sees nothing.
    pub look: u32,
}

/// The world is not still, or a way does not lead back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "move {number}, to the {action}, contradicts an earlier one: the world has to be still, and \
     each way has to lead back"
)]
pub struct NotStill {
    /// Number of the move, from 1 on.
    pub number: usize,
    /// Where the robot tried to go.
    pub action: Direction,
}

/// A map of places that is learned from actions and bumps.
#[derive(Clone, Debug)]
pub struct BumpMap {
    /// The walk alone: what is one there is one for certain.
    walked: Graph,
    /// The same with places that are one by evidence.
    folded: Graph,
    at: u32,
    last: Direction,
    /// By place, the way that the robot tried last.
    tried_last: Vec<Direction>,
    moves: usize,
    /// Number of moves since the map was folded.
    waited: usize,
    /// Number of places when the map was folded from the walk the last time.
    fewest: usize,
    /// Number of moves in a row that were predicted.
    foretold: usize,
}

impl BumpMap {
    /// Returns the map of a robot that has not moved yet, where it begins at a place with this
    /// look.
    #[must_use]
    pub fn new(look: u32) -> Self {
        let mut walked = Graph::default();
        let at = walked.push(look);
        Self {
            folded: walked.clone(),
            walked,
            at,
            last: Direction::North,
            tried_last: vec![Direction::North],
            moves: 0,
            waited: 0,
            fewest: FEW_PLACES,
            foretold: 0,
        }
    }

    /// Takes in a move. O(places), and O(places²) every time when there were half as many moves as
    /// there are places.
    ///
    /// # Errors
    /// If the move contradicts an earlier one for certain. The map is then unchanged.
    pub fn learn(&mut self, step: BumpMove) -> Result<(), NotStill> {
        let contradiction = NotStill {
            number: self.moves + 1,
            action: step.action,
        };
        let here = self.here();
        let foretold = self.folded.way(here, step.action) != BumpWay::Untried;
        let next = self.walk(step).ok_or(contradiction)?;
        self.walked.keep();
        if let Some(tried_last) = self.tried_last.get_mut(here as usize) {
            *tried_last = step.action;
        }
        let agrees = if step.moved {
            if next as usize == self.folded.len() {
                self.folded.push(step.look);
                self.tried_last.push(step.action);
            }
            self.folded.join(self.at, step.action, next)
        } else {
            self.folded.close(here, step.action)
        };
        self.foretold = if foretold && agrees {
            self.foretold + 1
        } else {
            0
        };
        (self.at, self.last) = (next, step.action);
        self.moves += 1;
        self.waited += 1;
        self.folded.keep();
        if !agrees || self.place_count() > 2 * self.fewest {
            let about = self.place_count();
            self.folded = self.walked.clone();
            self.fold_to(about);
            self.fewest = self.place_count().max(FEW_PLACES);
        } else if self.waited >= self.place_count() / 2 && self.untried() > 0 {
            self.fold();
        }
        Ok(())
    }

    /// Writes a move down in the walk, and returns where it led; `None`, with nothing changed, if
    /// it contradicts the walk.
    fn walk(&mut self, step: BumpMove) -> Option<u32> {
        let known = self.walked.way(self.at, step.action);
        match (known, step.moved) {
            (BumpWay::Untried, false) => {
                self.walked.close(self.at, step.action);
                Some(self.at)
            }
            (BumpWay::Untried, true) => {
                let next = self.walked.push(step.look);
                self.walked.join(self.at, step.action, next);
                Some(next)
            }
            (BumpWay::Closed, false) => Some(self.at),
            (BumpWay::To(next), true) => (self.walked.look(next) == step.look).then_some(next),
            (BumpWay::Closed, true) | (BumpWay::To(_), false) => None,
        }
    }

    /// Looks for places that are one. [`learn`](Self::learn) does so from time to time. O(places²)
    /// and more where many places are alike.
    pub fn fold(&mut self) {
        self.fold_to(self.place_count());
    }

    /// Looks for places that are one, until about `about` of them are left.
    fn fold_to(&mut self, about: usize) {
        self.waited = 0;
        let evidence = Evidence::of(&self.walked);
        while self.fold_once(about, &evidence) {
            self.folded.shorten();
        }
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

    /// Returns the place where the robot is.
    #[must_use]
    pub fn here(&self) -> u32 {
        self.folded.place(self.at)
    }

    /// Returns the place where the robot began.
    #[must_use]
    pub fn start(&self) -> u32 {
        self.folded.place(0)
    }

    /// Returns all places.
    pub fn places(&self) -> impl Iterator<Item = u32> + '_ {
        self.folded.places()
    }

    /// Returns the number of places.
    #[must_use]
    pub const fn place_count(&self) -> usize {
        self.folded.count()
    }

    /// Returns what is known of a way out of a place, and where it leads. A place that is not on
    /// the map has only untried ways.
    #[must_use]
    pub fn way(&self, place: u32, action: Direction) -> BumpWay {
        self.folded.way(place, action)
    }

    /// Returns the number of ways that nobody tried. With none the map is complete. O(places).
    #[must_use]
    pub fn untried(&self) -> usize {
        let ways = self.places().flat_map(|place| self.folded.ways(place));
        ways.filter(|way| *way == BumpWay::Untried).count()
    }

    /// Returns how many moves in a row, up to the last, the map predicted.
    #[must_use]
    pub const fn predicted(&self) -> usize {
        self.foretold
    }

    /// Returns whether the map is complete and probably right: it has predicted the last moves,
    /// eight for each place, which is twice as many as there are ways. O(places).
    #[must_use]
    pub fn is_tested(&self) -> bool {
        self.foretold >= TESTS * self.place_count() && self.untried() == 0
    }

    /// Returns the number of moves.
    #[must_use]
    pub const fn moves(&self) -> usize {
        self.moves
    }
}

/// Returns how many bits have to agree, so that among all pairs of `places` places few agree by
/// chance.
fn enough_bits(places: usize) -> f64 {
    let pairs = places as f64 * places as f64 / 2.0;
    libm::log2(pairs / FALSE_MERGES)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Learns moves: each a direction, and whether the robot went there.
    fn learned(moves: &[(Direction, bool)]) -> Result<BumpMap, NotStill> {
        let mut map = BumpMap::new(0);
        for (action, moved) in moves.iter().copied() {
            map.learn(BumpMove {
                action,
                moved,
                look: 0,
            })?;
        }
        Ok(map)
    }

    use Direction::{East, North, South, West};

    #[test]
    fn a_way_back_leads_back() {
        let map = learned(&[(North, true), (North, false), (South, true)]).unwrap();
        assert_eq!((map.place_count(), map.here()), (2, map.start()));
        let BumpWay::To(north) = map.way(map.start(), North) else {
            panic!("the way was gone");
        };
        assert_eq!(map.way(north, North), BumpWay::Closed);
        assert_eq!(map.way(north, South), BumpWay::To(map.start()));
        assert_eq!(map.way(north, East), BumpWay::Untried);
        assert_eq!(map.untried(), 3 + 2);
    }

    #[test]
    fn a_world_that_changes_is_noticed() {
        let opened = learned(&[(North, false), (East, false), (North, true)]);
        assert_eq!(
            opened.err(),
            Some(NotStill {
                number: 3,
                action: North
            })
        );
        let shut = learned(&[(West, true), (East, true), (West, false)]);
        assert_eq!(
            shut.err(),
            Some(NotStill {
                number: 3,
                action: West
            })
        );
    }

    #[test]
    fn another_look_of_a_place_is_noticed() {
        let mut map = BumpMap::new(7);
        let step = |action, look| BumpMove {
            action,
            moved: true,
            look,
        };
        map.learn(step(North, 3)).unwrap();
        let before = map.clone();
        assert!(map.learn(step(South, 3)).is_err());
        assert_eq!((map.here(), map.moves()), (before.here(), before.moves()));
        map.learn(step(South, 7)).unwrap();
        assert_eq!(map.here(), map.start());
    }

    /// Goes round a square clockwise, and tries the outer ways of each corner.
    #[test]
    fn a_round_walk_becomes_one_round() {
        let round = [
            (North, true),
            (North, false),
            (West, false),
            (East, true),
            (North, false),
            (East, false),
            (South, true),
            (East, false),
            (South, false),
            (West, true),
            (South, false),
            (West, false),
        ];
        let walk: Vec<_> = round.into_iter().cycle().take(round.len() * 6).collect();
        let map = learned(&walk).unwrap();
        assert_eq!((map.place_count(), map.untried()), (4, 0));
        assert!(map.predicted() > 0);
        assert!(!learned(&walk[..20]).unwrap().is_tested());
        let walk: Vec<_> = round.into_iter().cycle().take(round.len() * 12).collect();
        assert!(learned(&walk).unwrap().is_tested());
    }
}
