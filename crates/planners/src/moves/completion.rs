use tolman_maze::{Cell, Direction, Knowledge};

use super::chart::Chart;
use super::sides::Sides;
use super::split_mix::SplitMix;
use super::wall_odds::{GoalSide, log_odds};

/// Draws random mazes that agree with all known walls.
///
/// The unknown sides are drawn one by one in random order. The probability of each follows from
/// [`log_odds`], given the sides around it that are known or already drawn.
pub(super) struct Completions<'a, const N: usize> {
    chart: &'a Chart<N>,
    /// Unknown sides, in the order in which they are drawn. Only the first `unknown` entries count.
    order: [[[(Cell, Direction); 2]; N]; N],
    unknown: usize,
    /// Kind of an unknown side that leads into the goal: it depends on whether another such side is
    /// known to be open.
    entrance: GoalSide,
    rng: SplitMix,
}

impl<'a, const N: usize> Completions<'a, N> {
    pub(super) fn new(chart: &'a Chart<N>, rng: SplitMix) -> Self {
        let mut order = [[[(Cell::new(0, 0), Direction::North); 2]; N]; N];
        let mut unknown = 0;
        let slots = order.as_flattened_mut().as_flattened_mut().iter_mut();
        for (slot, side) in slots.zip(chart.unknown().iter()) {
            *slot = side;
            unknown += 1;
        }
        Self {
            chart,
            order,
            unknown,
            entrance: entrance(chart),
            rng,
        }
    }

    /// Returns the open sides of one maze. O(unknown sides).
    pub(super) fn draw(&mut self) -> Sides<N> {
        self.shuffle();
        let mut draw = Draw {
            hoped: self.chart.hoped,
            certain: self.chart.certain,
        };
        let mut entrance = self.entrance;
        let order = self.order.as_flattened().as_flattened();
        for (cell, side) in order.iter().copied().take(self.unknown) {
            let Some(next) = cell.beyond(side) else {
                continue;
            };
            let goals = [cell, next].map(|cell| self.chart.goals.contains(cell));
            let goal = match goals {
                [true, true] => Some(GoalSide::Within),
                [false, false] => None,
                _ => Some(entrance),
            };
            let sight = |cell, side| draw.sight(cell, side);
            let odds = libm::expf(log_odds(cell, side, goal, sight));
            if self.rng.share() * (1.0 + odds) < odds {
                draw.certain.insert(cell, side);
                if goal == Some(GoalSide::First) {
                    entrance = GoalSide::Another;
                }
            } else {
                draw.hoped.remove(cell, side);
            }
        }
        draw.certain
    }

    /// Shuffles the order, by Fisher and Yates.
    fn shuffle(&mut self) {
        let order = self.order.as_flattened_mut().as_flattened_mut();
        for last in (1..self.unknown as u32).rev() {
            order.swap(last as usize, self.rng.below(last + 1) as usize);
        }
    }
}

/// Returns [`GoalSide::Another`] if an open side is known that leads into the goal, else
/// [`GoalSide::First`].
fn entrance<const N: usize>(chart: &Chart<N>) -> GoalSide {
    let is_entrance = |cell: Cell, side: Direction| {
        let next = cell.beyond(side);
        chart.certain.contains(cell, side) && !next.is_some_and(|cell| chart.goals.contains(cell))
    };
    let is_known = chart.goals.iter().any(|goal| {
        let mut sides = Direction::ALL.into_iter();
        sides.any(|side| is_entrance(goal, side))
    });
    if is_known {
        GoalSide::Another
    } else {
        GoalSide::First
    }
}

/// A maze that is drawn in part: the sides known or drawn to be open, and those that may still be
/// open.
struct Draw<const N: usize> {
    hoped: Sides<N>,
    certain: Sides<N>,
}

impl<const N: usize> Draw<N> {
    fn sight(&self, cell: Cell, side: Direction) -> Knowledge {
        if self.certain.contains(cell, side) {
            Knowledge::Open
        } else if self.hoped.contains(cell, side) {
            Knowledge::Unknown
        } else {
            Knowledge::Wall
        }
    }
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    use super::*;
    use tolman_maze::{Grid, Walls};

    /// A maze of which two rows are known: their sides are open.
    struct TwoRows;

    impl Walls for TwoRows {
        fn grid(&self) -> Grid {
            Grid::new(8, 8)
        }

        fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
            match self.grid().neighbour(cell, direction) {
                None => Knowledge::Wall,
                Some(next) if cell.y < 2 && next.y < 2 => Knowledge::Open,
                Some(_) => Knowledge::Unknown,
            }
        }
    }

    #[test]
    fn what_is_known_stays_and_the_rest_differs() {
        let goals: [Cell; 4] = [(3, 3), (3, 4), (4, 3), (4, 4)].map(|(x, y)| Cell::new(x, y));
        let chart = Chart::<16>::new(&TwoRows, Cell::new(0, 0), &goals).unwrap();
        let mut completions = Completions::new(&chart, SplitMix::new(7));
        let (one, other) = (completions.draw(), completions.draw());
        assert_ne!(one, other);
        for maze in [one, other] {
            assert_eq!(chart.certain.minus(&maze), Sides::NONE);
            assert_eq!(maze.minus(&chart.hoped), Sides::NONE);
        }
        let again = Completions::new(&chart, SplitMix::new(7)).draw();
        assert_eq!(again, one, "the same seed, the same maze");
        // About half of all sides are open, as in the mazes of competitions.
        let drawn = one.minus(&chart.certain).len();
        let unknown = chart.unknown().len();
        assert!(
            (unknown / 3..unknown * 2 / 3).contains(&drawn),
            "{drawn} of {unknown}"
        );
    }
}
