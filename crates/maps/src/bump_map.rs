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
//! - **Failures**: where a robot may stay unnoticed, hypotheses about which moves failed go on side
//!   by side. Each is weighed by the length of its description: one bit for each way that is known,
//!   log₂ places for each loop, −log₂ of its share for each failure (Rissanen, *Modeling by
//!   shortest data description*, 1978). Evidence may have misled them, so that from time to time
//!   the walk is gone over again without any, and folded at its end.
//!
//! A map whose ways are all known predicts every move. It is right up to *bisimulation*: places
//! from which every walk bumps alike are one place of the map, because no walk can part them. The
//! world has to be still, and each way has to lead back. What moves are worth, [`BumpMoves`] says.
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
mod beam;
mod evidence;
mod graph;
mod hypothesis;
mod moves;

use alloc::vec::Vec;

use thiserror::Error;
use tolman_maze::Direction;

use beam::Beam;
pub use graph::BumpWay;
use graph::Graph;
use hypothesis::Hypothesis;
pub use moves::BumpMoves;
use moves::{Rate, Tries};

/// Expected number of pairs that are made one although they are not, if places agreed by chance.
const FALSE_MERGES: f64 = 1e-4;

/// Number of moves for each place that a complete map predicts before it counts as tested.
const TESTS: usize = 8;

/// Number of places of a map that is not worth folding from the walk again.
const FEW_PLACES: usize = 32;

/// Number of moves after which the robot begins again for the first time.
const PATIENCE: usize = 2048;

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
    worth: BumpMoves,
    /// What the robot holds of its walk, the likeliest first.
    beam: Beam,
    /// How often moves failed.
    rate: Rate,
    /// Bumps that are not believed yet.
    tries: Tries,
    /// All moves, where they may fail unnoticed.
    walk: Vec<BumpMove>,
    /// Number of moves until the robot begins again, if its map is not complete.
    patience: usize,
    last: Direction,
    moves: usize,
}

impl BumpMap {
    /// Returns the map of a robot that has not moved yet, where it begins at a place with this
    /// look.
    #[must_use]
    pub fn new(look: u32) -> Self {
        Self::with_moves(look, BumpMoves::Certain)
    }

    /// Returns the map of a robot that has not moved yet, whose moves are worth this much.
    ///
    /// Where bumps may be false, how often is learned, and a bump that nobody expected is tried
    /// again until it is believed: [`advice`](Self::advice) says so. Where the robot may stay
    /// unnoticed, several hypotheses about which moves failed go on side by side; the map is that
    /// of the likeliest, and a look back may replace it.
    #[must_use]
    pub fn with_moves(look: u32, worth: BumpMoves) -> Self {
        let unit_steps = matches!(
            worth,
            BumpMoves::MayStay {
                unit_steps: true,
                ..
            }
        );
        Self {
            worth,
            beam: Beam::new(Hypothesis::new(look, unit_steps)),
            rate: Rate::default(),
            tries: Tries::default(),
            walk: Vec::new(),
            patience: PATIENCE,
            last: Direction::North,
            moves: 0,
        }
    }

    /// Takes in a move. O(places), and O(places²) every time when there were half as many moves as
    /// there are places.
    ///
    /// Where the robot may stay unnoticed, it is O(hypotheses · places²) at times, and O(hypotheses
    /// · places · moves) when the walk is gone over again. A walk that nothing explains is
    /// forgotten, and the map begins again.
    ///
    /// # Errors
    /// If the move contradicts an earlier one for certain, which it can only where moves do not
    /// fail. The map is then unchanged.
    pub fn learn(&mut self, step: BumpMove) -> Result<(), NotStill> {
        let contradiction = NotStill {
            number: self.moves + 1,
            action: step.action,
        };
        let learned = match self.worth {
            BumpMoves::MayStay { .. } => {
                self.learn_doubtful(step);
                true
            }
            BumpMoves::MayBump => !self.believes(step) || self.beam.best.learn(step),
            BumpMoves::Certain => self.beam.best.learn(step),
        };
        if !learned {
            return Err(contradiction);
        }
        self.last = step.action;
        self.moves += 1;
        Ok(())
    }

    /// Takes in a move that the robot may only believe to have made. Begins again if nothing
    /// explains the walk, or if it took too long, and is then twice as patient (Luby, Sinclair,
    /// Zuckerman, *Optimal speedup of Las Vegas algorithms*, 1993).
    fn learn_doubtful(&mut self, step: BumpMove) {
        let failure = self.worth.failure();
        self.walk.push(step);
        let explained = self.beam.learn(&self.walk, failure);
        let best = &self.beam.best;
        let late = self.walk.len() > self.patience && best.is_folded() && best.untried() > 0;
        if !explained || late {
            self.beam = Beam::new(best.unmoved());
            self.walk.clear();
            self.patience *= 2;
        }
    }

    /// Takes in that a move may have failed, and returns whether to believe it. What the map
    /// expects is believed at once, a new wall after several tries. Who went through a wall knows
    /// better.
    fn believes(&mut self, step: BumpMove) -> bool {
        let walked = self.beam.best.walked_way(step.action);
        if step.moved {
            let failed = self.tries.end(step.action);
            self.rate.count(failed);
            if walked == BumpWay::Closed {
                self.beam.best.reopen(step.action);
            }
            return true;
        }
        match (walked, self.way(self.here(), step.action)) {
            (_, BumpWay::Closed) => true,
            (BumpWay::To(_), _) => {
                self.tries.bump(step.action, self.rate, self.place_count());
                false
            }
            _ => self.tries.bump(step.action, self.rate, self.place_count()),
        }
    }

    /// Looks for places that are one. [`learn`](Self::learn) does so from time to time. O(places²)
    /// and more where many places are alike.
    pub fn fold(&mut self) {
        let about = self.place_count();
        self.beam.best.fold_to(about);
    }

    const fn map(&self) -> &Graph {
        self.beam.best.map()
    }

    /// Returns the place where the robot is.
    #[must_use]
    pub fn here(&self) -> u32 {
        self.beam.best.here()
    }

    /// Returns the place where the robot began, or began again.
    #[must_use]
    pub fn start(&self) -> u32 {
        self.map().place(0)
    }

    /// Returns all places.
    pub fn places(&self) -> impl Iterator<Item = u32> + '_ {
        self.map().places()
    }

    /// Returns the number of places.
    #[must_use]
    pub const fn place_count(&self) -> usize {
        self.map().count()
    }

    /// Returns what is known of a way out of a place, and where it leads. A place that is not on
    /// the map has only untried ways.
    #[must_use]
    pub fn way(&self, place: u32, action: Direction) -> BumpWay {
        self.map().way(place, action)
    }

    /// Returns the number of ways that nobody tried. With none the map is complete. O(places).
    #[must_use]
    pub fn untried(&self) -> usize {
        self.beam.best.untried()
    }

    /// Returns how many moves in a row, up to the last, the map predicted.
    #[must_use]
    pub const fn predicted(&self) -> usize {
        self.beam.best.foretold
    }

    /// Returns whether the map is complete and probably right: it has predicted the last moves,
    /// eight for each place, which is twice as many as there are ways, and no failure more would
    /// explain them as well. O(places).
    #[must_use]
    pub fn is_tested(&self) -> bool {
        let sure = self.beam.is_sure(self.worth.failure());
        sure && self.predicted() >= TESTS * self.place_count() && self.untried() == 0
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
