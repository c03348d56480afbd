use tolman_maze::Direction;

use super::FALSE_MERGES;

/// What the robot's moves are worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BumpMoves {
    /// No move fails.
    #[default]
    Certain,
    /// Where a way is open the robot may stay, and takes it for a bump.
    MayBump,
    /// Where a way is open the robot may stay, and believes that it has gone. What places look like
    /// is then not used.
    MayStay {
        /// Number of moves along open ways of which one fails.
        one_in: u32,
        /// Whether the robot is told that the world is a grid and each move one step on it.
        unit_steps: bool,
    },
}

impl BumpMoves {
    /// Returns −log₂ of the share of the moves that fail unnoticed.
    pub(super) fn failure(self) -> f64 {
        match self {
            Self::MayStay { one_in, .. } => libm::log2(f64::from(one_in)),
            Self::Certain | Self::MayBump => f64::INFINITY,
        }
    }
}

/// How often moves fail: `failed` of `tried`, learned on the way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rate {
    failed: u32,
    tried: u32,
}

impl Rate {
    /// Counts moves along an open way, of which all but the last one failed.
    pub(super) const fn count(&mut self, failed: u32) {
        self.failed += failed;
        self.tried += failed + 1;
    }

    /// Returns −log₂ of the share of failures, as if one half of a move more had failed, and one
    /// half not (Krichevsky, Trofimov, *The performance of universal encoding*, 1981).
    pub(super) fn bits(self) -> f64 {
        libm::log2((f64::from(self.tried) + 1.0) / (f64::from(self.failed) + 0.5))
    }
}

/// Bumps in a row against the same way, which are not believed yet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tries {
    action: Option<Direction>,
    bumps: u32,
}

impl Tries {
    /// Counts a bump, and returns whether all of them together are a wall: that an open one fails
    /// that often is as seldom as a false merge, among all ways of all `places`.
    pub(super) fn bump(&mut self, action: Direction, rate: Rate, places: usize) -> bool {
        if self.action != Some(action) {
            *self = Self {
                action: Some(action),
                bumps: 0,
            };
        }
        self.bumps += 1;
        let ways = places as f64 * 4.0;
        let believed = f64::from(self.bumps) * rate.bits() >= libm::log2(ways / FALSE_MERGES);
        if believed {
            *self = Self::default();
        }
        believed
    }

    /// Ends the tries, and returns how often a move to `action` failed just before.
    pub(super) fn end(&mut self, action: Direction) -> u32 {
        let tries = core::mem::take(self);
        if tries.action == Some(action) {
            tries.bumps
        } else {
            0
        }
    }

    /// Returns what to try again.
    pub(super) const fn again(self) -> Option<Direction> {
        self.action
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rarer_failures_are_the_sooner_a_bump_is_believed() {
        let tries = |rate: Rate| {
            let mut tries = Tries::default();
            let needed = (1..).find(|_| tries.bump(Direction::East, rate, 64));
            needed.unwrap()
        };
        let mut rate = Rate::default();
        let unknown = tries(rate);
        for number in 0..400 {
            rate.count(u32::from(number % 100 == 50));
        }
        // One in 100 fails: 256 ways, and three bumps are one in 10⁶.
        assert_eq!((unknown, tries(rate)), (22, 4));
    }

    #[test]
    fn another_way_is_tried_from_the_first() {
        let mut tries = Tries::default();
        for _ in 0..3 {
            assert!(!tries.bump(Direction::East, Rate::default(), 1));
        }
        assert_eq!(tries.again(), Some(Direction::East));
        assert_eq!(tries.end(Direction::North), 0);
        assert_eq!(tries.again(), None);
        assert!(!tries.bump(Direction::West, Rate::default(), 1));
        assert_eq!(tries.end(Direction::West), 1);
    }
}
