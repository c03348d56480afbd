use super::Expected;

/// Constancy of something that may come and go, such as a door that is shut and opened. Records
/// when it was last looked for, whether it was there, and how often that had changed.
///
/// Beyond the paper, whose counts say how often a link works, but not whether it works now.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Constancy {
    seen: Option<Seen>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Seen {
    first: u64,
    last: u64,
    outcome: Expected,
    changes: u32,
}

impl Constancy {
    /// Returns the probability that it is there now; 1 for something never looked for.
    ///
    /// The model is a chain of two states with the observed rate of changes per move, v. After t
    /// moves the state is as last seen with probability (1 + exp(−2vt)) / 2.
    #[must_use]
    pub fn chance(&self, now: u64) -> f64 {
        let Some(seen) = self.seen else {
            return 1.0;
        };
        let moves = |from: u64, to: u64| to.saturating_sub(from) as f64;
        let often = f64::from(seen.changes) / moves(seen.first, seen.last).max(1.0);
        let still = 0.5 * (1.0 + libm::exp(-2.0 * often * moves(seen.last, now)));
        match seen.outcome {
            Expected::Met => still,
            Expected::InVain => 1.0 - still,
        }
    }

    /// Records that the thing was looked for, with the outcome.
    pub(super) fn look(&mut self, outcome: Expected, now: u64) {
        let first = Seen {
            first: now,
            last: now,
            outcome,
            changes: 0,
        };
        let seen = self.seen.get_or_insert(first);
        let changed = u32::from(seen.outcome != outcome);
        seen.changes = seen.changes.saturating_add(changed);
        seen.outcome = outcome;
        seen.last = now;
    }

    /// Adds the observations of another thing that turned out to be the same.
    pub(super) fn join(&mut self, other: Self) {
        self.seen = match (self.seen, other.seen) {
            (Some(one), Some(other)) => {
                let later = if one.last >= other.last { one } else { other };
                Some(Seen {
                    first: one.first.min(other.first),
                    changes: one.changes.saturating_add(other.changes),
                    ..later
                })
            }
            (one, other) => one.or(other),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_changed_stays_and_what_changes_is_soon_anyones_guess() {
        let mut wall = Constancy::default();
        assert!((wall.chance(7) - 1.0).abs() < 1e-12);
        wall.look(Expected::Met, 1);
        wall.look(Expected::Met, 100);
        assert!((wall.chance(10_000) - 1.0).abs() < 1e-12);
        let mut door = wall;
        door.look(Expected::InVain, 200);
        assert!(door.chance(200) < 1e-12);
        // One change in 199 moves.
        let chance = 0.5 * (1.0 - libm::exp(-1.0));
        assert!((door.chance(200 + 99) - chance).abs() < 0.01);
        assert!((door.chance(100_000) - 0.5).abs() < 1e-6);
        wall.join(door);
        assert_eq!(wall, door);
    }
}
