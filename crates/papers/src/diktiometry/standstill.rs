//! How long a walk learns no new way.

use alloc::collections::BTreeSet;

use tolman_arena::diktiometry::Survey;
use tolman_maze::Direction;

/// Counts the moves without a new way, while there is one that was never driven. A way that was
/// driven in one direction is known in both.
#[derive(Clone, Debug, Default)]
pub(super) struct Standstill {
    known: BTreeSet<(u32, Direction)>,
    /// Number of moves since the last new way.
    since: u32,
    /// Maximum of [`Self::since`] so far.
    longest: u32,
}

impl Standstill {
    /// Takes in the survey's last move, in a world with `ways` ways, counted from both ends.
    pub(super) fn note(&mut self, survey: &Survey, direction: Direction, ways: usize) {
        let &[.., from, here] = survey.sites() else {
            return;
        };
        let is_new = here != from && self.known.insert((from, direction));
        if is_new {
            self.known.insert((here, direction.opposite()));
        }
        let is_over = is_new || self.known.len() >= ways;
        self.since = if is_over { 0 } else { self.since + 1 };
        self.longest = self.longest.max(self.since);
    }

    /// Returns the most moves in a row without a new way.
    pub(super) const fn longest(&self) -> u32 {
        self.longest
    }
}
