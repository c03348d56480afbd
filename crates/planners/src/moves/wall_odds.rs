use tolman_maze::{Cell, Direction, Knowledge};

/// Relation of a side to the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GoalSide {
    /// Between two cells of the goal.
    Within,
    /// Into the goal, while no other such side is known to be open: most goals have one entrance.
    First,
    /// Into the goal, while another is known to be open.
    Another,
}

/// Returns the log-odds that the `side` of `cell` is open, in a maze of competitions. `side` is
/// north or east; `sight` gives the knowledge of other sides, and walls for everything outside.
///
/// A network with one hidden layer of rectifiers looks at the [`AROUND`] nearest sides.
/// `wall_odds.py` fitted it to the classic mazes.
pub(super) fn log_odds(
    cell: Cell,
    side: Direction,
    goal: Option<GoalSide>,
    sight: impl Fn(Cell, Direction) -> Knowledge,
) -> f32 {
    let mut sums = BIAS;
    let mut add = |row: &[f32; UNITS]| {
        for (sum, weight) in sums.iter_mut().zip(row) {
            *sum += weight;
        }
    };
    for ((near, open), wall) in NEAR.iter().zip(&OPEN).zip(&WALL) {
        match near.of(cell, side).map(|(cell, side)| sight(cell, side)) {
            Some(Knowledge::Unknown) => {}
            Some(Knowledge::Open) => add(open),
            Some(Knowledge::Wall) | None => add(wall),
        }
    }
    if let Some(row) = goal.and_then(|goal| GOAL.get(goal as usize)) {
        add(row);
    }
    let units = sums.iter().zip(&OUT);
    OUT_BIAS
        + units
            .map(|(sum, weight)| sum.max(0.0) * weight)
            .sum::<f32>()
}

/// A side near another one.
#[derive(Clone, Copy)]
struct Near {
    /// Whether the sides are parallel.
    is_parallel: bool,
    /// Number of cells to the near side, across this side.
    through: i16,
    /// Number of cells to the near side, along this side.
    along: i16,
}

impl Near {
    /// Returns this side, near the northern or eastern `side` of `cell`. `None` if it lies west or
    /// south of all cells.
    fn of(self, cell: Cell, side: Direction) -> Option<(Cell, Direction)> {
        let (east, north, lateral) = match side {
            Direction::North | Direction::South => (self.along, self.through, Direction::East),
            Direction::East | Direction::West => (self.through, self.along, Direction::North),
        };
        let x = cell.x.checked_add_signed(east)?;
        let y = cell.y.checked_add_signed(north)?;
        let side = if self.is_parallel { side } else { lateral };
        Some((Cell::new(x, y), side))
    }
}

/// Maximum distance of a near side, cells.
const REACH: i16 = 2;
/// Number of near sides: the parallel ones without the side itself, and the perpendicular ones.
const AROUND: usize = 48;
/// Number of near sides that are parallel.
const PARALLEL: usize = 24;
/// Number of hidden units.
const UNITS: usize = 64;

/// Near sides, in the order of the weights.
const NEAR: [Near; AROUND] = {
    let (mut all, mut index) = ([near(0); AROUND], 0);
    while index < AROUND {
        all[index] = near(index);
        index += 1;
    }
    all
};

/// Returns a side by its place in the order of the weights: the parallel ones row by row, then
/// those across.
const fn near(index: usize) -> Near {
    let is_parallel = index < PARALLEL;
    let (width, place, first) = if is_parallel {
        // The side itself, in the middle, is left out.
        let place = index + (index >= PARALLEL / 2) as usize;
        (2 * REACH + 1, place, -REACH)
    } else {
        (2 * REACH, index - PARALLEL, 1 - REACH)
    };
    Near {
        is_parallel,
        through: first + place as i16 % width,
        along: place as i16 / width - if is_parallel { REACH } else { REACH + 1 },
    }
}

/// The weights, rows of [`UNITS`] signed bytes, and the bias of the output.
const WEIGHTS: &[u8; (2 * AROUND + 3 + 2) * UNITS + 1] = include_bytes!("wall_odds.bin");
/// Number by which the weight 1 is stored.
const ONE: f32 = 24.0;

static OPEN: [[f32; UNITS]; AROUND] = rows(0);
static WALL: [[f32; UNITS]; AROUND] = rows(AROUND);
static GOAL: [[f32; UNITS]; 3] = rows(2 * AROUND);
const BIAS: [f32; UNITS] = row(2 * AROUND + 3);
static OUT: [f32; UNITS] = row(2 * AROUND + 4);
const OUT_BIAS: f32 = weight(WEIGHTS.len() - 1);

const fn rows<const R: usize>(first: usize) -> [[f32; UNITS]; R] {
    let (mut rows, mut count) = ([[0.0; UNITS]; R], 0);
    while count < R {
        rows[count] = row(first + count);
        count += 1;
    }
    rows
}

const fn row(index: usize) -> [f32; UNITS] {
    let (mut row, mut unit) = ([0.0; UNITS], 0);
    while unit < UNITS {
        row[unit] = weight(index * UNITS + unit);
        unit += 1;
    }
    row
}

const fn weight(at: usize) -> f32 {
    WEIGHTS[at].cast_signed() as f32 / ONE
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    const CELL: Cell = Cell::new(8, 8);

    fn nothing_known(_: Cell, _: Direction) -> Knowledge {
        Knowledge::Unknown
    }

    #[test]
    fn every_side_within_reach_counts_once() {
        let near = NEAR.map(|near| near.of(CELL, Direction::East));
        let mut sides: Vec<_> = near.into_iter().flatten().collect();
        assert_eq!(sides.len(), AROUND);
        assert!(!sides.contains(&(CELL, Direction::East)));
        sides.sort_by_key(|(cell, side)| (cell.x, cell.y, *side as u8));
        sides.dedup();
        assert_eq!(sides.len(), AROUND);
    }

    #[test]
    fn a_maze_mirrored_at_its_diagonal_has_the_same_odds() {
        let mirrored = |side| match side {
            Direction::North => Direction::East,
            _ => Direction::North,
        };
        let sight = |cell: Cell, side| match (3 * cell.x + cell.y + side as u16) % 3 {
            0 => Knowledge::Unknown,
            1 => Knowledge::Open,
            _ => Knowledge::Wall,
        };
        let other = |cell: Cell, side| sight(Cell::new(cell.y, cell.x), mirrored(side));
        let (one, at) = (Cell::new(1, 5), Cell::new(5, 1));
        let odds = log_odds(one, Direction::North, None, sight);
        let again = log_odds(at, Direction::East, None, other);
        assert_eq!(odds.to_bits(), again.to_bits());
    }

    #[test]
    fn competitions_have_no_post_without_a_wall_and_one_way_into_the_goal() {
        let north = Cell::new(8, 9);
        let last_of_a_post = |cell, side| match (cell, side) {
            (CELL, Direction::North) => Knowledge::Open,
            (Cell { x: 9, y: 8 }, Direction::North) => Knowledge::Open,
            (cell, Direction::East) if cell == north => Knowledge::Open,
            _ => Knowledge::Unknown,
        };
        let odds = |goal, sight: fn(Cell, Direction) -> Knowledge| {
            log_odds(CELL, Direction::East, goal, sight)
        };
        let last = log_odds(CELL, Direction::East, None, last_of_a_post);
        assert!(last < -2.0, "{last}");
        assert!(odds(None, nothing_known).abs() < 1.0);
        assert!(odds(Some(GoalSide::Within), nothing_known) > 2.0);
        let first = odds(Some(GoalSide::First), nothing_known);
        assert!(odds(Some(GoalSide::Another), nothing_known) < first);
    }
}
