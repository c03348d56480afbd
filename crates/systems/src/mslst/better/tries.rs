use alloc::collections::VecDeque;

use tolman_geom::Point;
use tolman_maze::Direction;

/// Actions tried lately, with the robot's believed position.
///
/// A map does not tell why an action fails, or leads to and fro, repeatedly. Whatever the reason,
/// another action is worth a try.
#[derive(Clone, Debug, Default)]
pub(super) struct Tries {
    last: VecDeque<(Point, Direction)>,
}

/// Older tries are forgotten.
const MOST: usize = 24;
/// Distance within which actions are tried at the same place, m.
const NEAR: f64 = 0.35;

impl Tries {
    /// Notes that an action was tried.
    pub(super) fn add(&mut self, at: Point, action: Direction) {
        if self.last.len() == MOST {
            self.last.pop_front();
        }
        self.last.push_back((at, action));
    }

    /// Returns how often an action was tried at a place. O(tries).
    pub(super) fn count(&self, at: Point, action: Direction) -> usize {
        let here =
            |(place, tried): &&(Point, Direction)| *tried == action && (place - at).norm() < NEAR;
        self.last.iter().filter(here).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_tried_counts_there_for_a_time() {
        let mut tries = Tries::default();
        let (here, far) = (Point::new(1.0, 1.0), Point::new(2.0, 1.0));
        tries.add(here, Direction::East);
        tries.add(here, Direction::East);
        let counts = [
            (here, Direction::East),
            (far, Direction::East),
            (here, Direction::West),
        ];
        assert_eq!(
            counts.map(|(at, action)| tries.count(at, action)),
            [2, 0, 0]
        );
        for _ in 0..MOST {
            tries.add(far, Direction::North);
        }
        assert_eq!(tries.count(here, Direction::East), 0);
    }
}
