use alloc::collections::VecDeque;

use tolman_geom::Point;
use tolman_maze::Direction;

/// Actions that failed lately, with the robot's believed position.
///
/// A map does not tell why an action fails repeatedly. Whatever the reason, another action is worth
/// a try.
#[derive(Clone, Debug, Default)]
pub(super) struct Failures {
    last: VecDeque<(Point, Direction)>,
}

/// Older failures are forgotten.
const MOST: usize = 24;
/// Distance within which failing actions fail at the same place, m.
const NEAR: f64 = 0.35;
/// Number of failures at a place before an action costs more there.
const FREE: usize = 1;
/// Extra cost of an action per failure, time steps.
const COST: f64 = 15.0;

impl Failures {
    /// Notes that an action failed.
    pub(super) fn add(&mut self, at: Point, action: Direction) {
        if self.last.len() == MOST {
            self.last.pop_front();
        }
        self.last.push_back((at, action));
    }

    /// Returns the extra cost of an action at a place where it has failed, time steps. O(failures).
    pub(super) fn cost(&self, at: Point, action: Direction) -> f64 {
        let here =
            |(place, failed): &&(Point, Direction)| *failed == action && (place - at).norm() < NEAR;
        let count = self.last.iter().filter(here).count();
        COST * count.saturating_sub(FREE) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_again_costs_more_there_for_a_time() {
        let mut failures = Failures::default();
        let (here, far) = (Point::new(1.0, 1.0), Point::new(2.0, 1.0));
        failures.add(here, Direction::East);
        assert!(failures.cost(here, Direction::East) <= 0.0);
        failures.add(here, Direction::East);
        assert!(failures.cost(here, Direction::East) >= COST);
        assert!(failures.cost(far, Direction::East) <= 0.0);
        assert!(failures.cost(here, Direction::West) <= 0.0);
        for _ in 0..MOST {
            failures.add(far, Direction::North);
        }
        assert!(failures.cost(here, Direction::East) <= 0.0);
    }
}
