use alloc::collections::VecDeque;

use rand::{Rng, RngExt};
use tolman_maps::diktiometry::{Observer, Opportunity};
use tolman_maze::Direction;

/// The paper's planner: a random walk that sometimes follows the map's advice.
///
/// "The use of exploration scripts were tested by randomly executing them when
/// applicable (generally 30% of the time)."
#[derive(Clone, Debug)]
pub(super) struct Planner {
    heed: f64,
    script: VecDeque<Direction>,
}

/// Next move of a planner.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlannedMove {
    pub(super) direction: Direction,
    pub(super) reason: Reason,
}

/// Reason for a direction of a walk.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// A random move.
    Walk,
    /// First action of this script, which begins here.
    Advice(Opportunity),
    /// The script in progress.
    Script,
}

impl Planner {
    /// Returns a planner that begins the best applicable script with probability `heed`, 0 … 1,
    /// whenever none is under way.
    pub(super) const fn new(heed: f64) -> Self {
        Self {
            heed,
            script: VecDeque::new(),
        }
    }

    /// Drops the script in progress, because the robot was sent elsewhere.
    pub(super) fn drop_script(&mut self) {
        self.script.clear();
    }

    /// Returns the direction to go from a place whose open ways are `exits`, by
    /// [`Direction::index`]; `None` if no way leads on. Draws two random numbers in any case.
    pub(super) fn choose(
        &mut self,
        observer: &Observer,
        exits: &[bool; 4],
        rng: &mut impl Rng,
    ) -> Option<PlannedMove> {
        // As many draws in any case, so that runs that follow scripts and runs that do not draw the
        // same numbers.
        let heeds = rng.random_range(0.0..1.0) < self.heed;
        let mut open = Vec::from(Direction::ALL);
        open.retain(|direction| exits[direction.index()]);
        let chosen = rng.random_range(0..open.len().max(1) as u32) as usize;
        let mut reason = Reason::Script;
        if self.script.is_empty()
            && heeds
            && let Some(best) = observer.opportunities().into_iter().next()
        {
            let known = best.script.iter();
            let known = known.filter_map(|action| Direction::ALL.get(action.0 as usize));
            self.script = known.copied().collect();
            reason = Reason::Advice(best);
        }
        match self.script.pop_front() {
            Some(direction) if exits[direction.index()] => Some(PlannedMove { direction, reason }),
            // The world is not as the script has it: "failure of a mapper goal does not invalidate
            // a plan".
            _ => {
                self.script.clear();
                let direction = *open.get(chosen)?;
                let reason = Reason::Walk;
                Some(PlannedMove { direction, reason })
            }
        }
    }
}
