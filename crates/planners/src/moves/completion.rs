use tolman_maze::{Cell, Direction, Knowledge};

use super::chart::Chart;
use super::sides::Sides;
use super::split_mix::SplitMix;

/// Draws mazes at random among those that agree with all that is known.
///
/// The unknown sides are drawn one by one, in an order by chance, each given those around it that
/// are known or drawn already. The log-odds that a side is open are a sum of terms for its two
/// ends, the posts, and for its two cells. By far the strongest is a rule of the competitions: no
/// post stands without a wall. The terms were fitted by logistic regression on every second of the
/// classic mazes, all sides of each revealed in an order by chance.
pub(super) struct Completions<'a, const N: usize> {
    chart: &'a Chart<N>,
    /// The unknown sides, as many as there are.
    order: [[[(Cell, Direction); 2]; N]; N],
    unknown: usize,
    /// Whether a way into the goal is known.
    entrance: Entrance,
    rng: SplitMix,
}

/// Whether any of the sides that lead into the goal is open: most goals have one entrance.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Entrance {
    Unknown,
    Known,
}

/// Terms for a post, by the side across it (unknown, open, wall) and the two lateral ones, as
/// [`term`] orders them.
const POST: [[f32; 6]; 3] = [
    [0.00, -0.20, -0.56, 0.36, 0.22, 0.62],
    [0.22, -0.32, -2.78, 0.43, -0.06, 0.79],
    [-0.19, -0.19, -0.20, 0.20, 0.51, 0.83],
];
/// Terms for a cell, by its opposite side and the two lateral ones.
const CELL: [[f32; 6]; 3] = [
    [0.04, -0.35, -0.71, 0.43, 0.02, 1.01],
    [0.18, -0.36, -0.34, 0.38, -0.52, 1.03],
    [-0.28, -0.41, -0.79, 0.49, 0.70, 0.57],
];
/// Log-odds for a side between two cells of the goal.
const WITHIN_GOAL: f32 = 6.7;
/// Log-odds for a side that leads into the goal, while no other is known to be open.
const INTO_GOAL: f32 = -1.24;
/// Log-odds for a side that leads into the goal, once another is known to be open.
const INTO_GOAL_AGAIN: f32 = -3.49;

impl<'a, const N: usize> Completions<'a, N> {
    pub(super) fn new(chart: &'a Chart<N>, rng: SplitMix) -> Self {
        let mut order = [[[(Cell::new(0, 0), Direction::North); 2]; N]; N];
        let mut unknown = 0;
        let slots = order.as_flattened_mut().as_flattened_mut().iter_mut();
        for (slot, side) in slots.zip(chart.unknown().iter()) {
            *slot = side;
            unknown += 1;
        }
        let is_entrance = |cell: Cell, side: Direction| {
            let next = cell.beyond(side);
            chart.certain.contains(cell, side)
                && !next.is_some_and(|cell| chart.goals.contains(cell))
        };
        let entrance = chart.goals.iter().any(|goal| {
            let mut sides = Direction::ALL.into_iter();
            sides.any(|side| is_entrance(goal, side))
        });
        Self {
            chart,
            order,
            unknown,
            entrance: if entrance {
                Entrance::Known
            } else {
                Entrance::Unknown
            },
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
            let goal = match (goals, entrance) {
                ([true, true], _) => WITHIN_GOAL,
                ([false, false], _) => 0.0,
                (_, Entrance::Unknown) => INTO_GOAL,
                (_, Entrance::Known) => INTO_GOAL_AGAIN,
            };
            let odds = libm::expf(draw.surroundings(cell, side, next) + goal);
            if self.rng.share() * (1.0 + odds) < odds {
                draw.certain.insert(cell, side);
                if goals != [false, false] && goals != [true, true] {
                    entrance = Entrance::Known;
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

/// A maze that is drawn in part: what is known or drawn to be open, and what may still be.
struct Draw<const N: usize> {
    hoped: Sides<N>,
    certain: Sides<N>,
}

impl<const N: usize> Draw<N> {
    /// Returns the terms for what is around the `side` of `cell`, beyond which `next` lies.
    fn surroundings(&self, cell: Cell, side: Direction, next: Cell) -> f32 {
        let [left, right] = [side.left(), side.right()].map(|lateral| {
            let across = match cell.beyond(lateral) {
                Some(beside) => self.sight(beside, side),
                None => Knowledge::Wall,
            };
            (across, self.sight(cell, lateral), self.sight(next, lateral))
        });
        let posts = [left, right].map(|(across, near, far)| term(&POST, across, near, far));
        let near = term(&CELL, self.sight(cell, side.opposite()), left.1, right.1);
        let far = term(&CELL, self.sight(next, side), left.2, right.2);
        posts.iter().sum::<f32>() + near + far
    }

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

fn term(terms: &[[f32; 6]; 3], across: Knowledge, one: Knowledge, other: Knowledge) -> f32 {
    // Pairs in whichever order: by the later of the two, then by the other.
    let (low, high) = (one.min(other) as usize, one.max(other) as usize);
    let lateral = high * (high + 1) / 2 + low;
    let row = terms.get(across as usize);
    row.and_then(|row| row.get(lateral)).copied().unwrap_or(0.0)
}

#[cfg(all(test, feature = "alloc"))]
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
