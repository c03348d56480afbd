//! The paper's planner: an essentially random walk that now and then heeds the map's advice.

use alloc::collections::VecDeque;

use rand::{Rng, RngExt};
use tolman_maps::diktiometry::{Observer, Opportunity};
use tolman_maze::Direction;

/// "The use of exploration scripts were tested by randomly executing them when applicable (generally 30% of the time)."
#[derive(Clone, Debug)]
pub struct Planner {
    heed: f64,
    script: VecDeque<Direction>,
}

/// What a planner decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// Where to go.
    pub direction: Direction,
    /// Why.
    pub reason: Reason,
}

/// Why a robot goes somewhere.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// By chance.
    Walk,
    /// Because of this script, which begins now.
    Advice(Opportunity),
    /// Because of the script that is under way.
    Script,
}

impl Planner {
    /// A planner that begins the best applicable script with this probability, 0 … 1, whenever none is under way.
    #[must_use]
    pub const fn new(heed: f64) -> Self {
        Self {
            heed,
            script: VecDeque::new(),
        }
    }

    /// Where to go from a place with these exits, by direction. None if there is no way on.
    pub fn choose(
        &mut self,
        observer: &Observer,
        exits: &[bool; 4],
        rng: &mut impl Rng,
    ) -> Option<Decision> {
        // As many draws whatever comes of them, so that runs that heed and runs that do not walk alike.
        let heeds = rng.random_range(0.0..1.0) < self.heed;
        let open: Vec<Direction> = Direction::ALL
            .into_iter()
            .filter(|direction| exits[direction.index()])
            .collect();
        let chosen = rng.random_range(0..open.len().max(1) as u32) as usize;
        let mut reason = Reason::Script;
        if self.script.is_empty()
            && heeds
            && let Some(best) = observer.opportunities().into_iter().next()
        {
            let known = best
                .script
                .iter()
                .filter_map(|action| Direction::ALL.get(action.0 as usize));
            self.script = known.copied().collect();
            reason = Reason::Advice(best);
        }
        match self.script.pop_front() {
            Some(direction) if exits[direction.index()] => Some(Decision { direction, reason }),
            // The world is not as the script has it: "failure of a mapper goal does not invalidate a plan".
            _ => {
                self.script.clear();
                let direction = *open.get(chosen)?;
                Some(Decision {
                    direction,
                    reason: Reason::Walk,
                })
            }
        }
    }
}
