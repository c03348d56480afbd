//! The detour: "insight" of rats in an elevated maze with three paths.

use tolman_arena::apparatus::{Apparatus, ApparatusKind};
use tolman_arena::contest::{RatRecord, RatStep, RatTrip};
use tolman_experiment::{Job, Row, Table, record};
use tolman_maze::Maze;

use super::{BETWEEN, NO_VERDICT, drawn, sent};

/// Name of the table.
pub(super) const TABLE: &str = "detour";

/// Name of the baseline that knows the maze, with the block.
const ORACLE: &str = "Oracle";

/// Percent of the rats that took path 3 at once at block B: all but one of ten, as S. F. Walker
/// tells it. For block A no share was found.
const TOOK_PATH_3: f64 = 90.0;

/// Where a block stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Block {
    /// On path 1 alone.
    A,
    /// On the stretch that paths 1 and 2 share.
    B,
}

impl Block {
    const ALL: [Self; 2] = [Self::A, Self::B];

    const fn name(self) -> &'static str {
        match self {
            Self::A => "block A",
            Self::B => "block B",
        }
    }

    /// Returns the index of its door.
    const fn door(self) -> usize {
        match self {
            Self::A => Apparatus::BLOCK_A,
            Self::B => Apparatus::BLOCK_B,
        }
    }

    /// Returns the index of the path that rats took.
    const fn path_of_rats(self) -> usize {
        match self {
            Self::A => 1,
            Self::B => 2,
        }
    }

    /// Returns the system and the block of a row.
    pub(super) fn of_row(row: &str) -> Option<(&str, Self)> {
        let (system, block) = row.split_once(BETWEEN)?;
        let mut all = Self::ALL.into_iter();
        Some((system, all.find(|one| one.name() == block)?))
    }

    pub(super) const fn steps(self) -> [RatStep; 6] {
        [
            RatStep::Explore,
            RatStep::Back,
            RatStep::ToFood,
            RatStep::Back,
            RatStep::Shut(self.door()),
            RatStep::ToFood,
        ]
    }
}

record! {
    /// A run of the detour.
    pub(super) struct DetourRun {
        /// Whether it declared, before it drove, that it cannot work there.
        abstained: bool => neither("abstained"),
        /// Whether, of paths 2 and 3, it first entered the one that rats took: path 2 at block A,
        /// path 3 at block B.
        as_rats: bool => neither("the rats' path first"),
        /// Whether it first entered the other one of the two.
        other_path: bool => neither("the other path first"),
        /// Whether it took path 1 before the block was there.
        shortest_before: Option<bool> => neither("path 1 before"),
        /// Whether it entered path 1 before it tried another one, so that it met the block or saw
        /// it from there.
        met_block: Option<bool> => neither("met the block"),
        /// Whether it came to the food in spite of the block.
        arrived: bool => higher("came to the food"),
        /// For runs that arrived: driven distance over that of the shortest way past the block.
        metres_over_shortest: Option<f64> => lower("metres / shortest"),
        /// Number of times that it was carried to the start box, since it did not come there.
        carried: Option<u32> => neither("carried"),
        /// Reason why it gave up at last.
        why: String => neither("reason"),
    }
}

impl DetourRun {
    pub(super) fn of(record: &RatRecord, apparatus: &Apparatus, block: Block) -> Self {
        if let Some(why) = &record.abstained {
            return Self {
                abstained: true,
                why: why.clone(),
                ..Self::default()
            };
        }
        let [.., before, with_block] = record.trips.as_slice() else {
            return Self::default();
        };
        let others = &apparatus.ways[1..];
        // The index among paths 2 and 3.
        let tried = with_block.first_of(others).map(|way| way + 1);
        let maze = blocked(apparatus, block);
        let shortest = steps_from_box(&maze).map(|steps| f64::from(steps) * record.pitch);
        let over = with_block.arrived.zip(shortest);
        Self {
            abstained: false,
            as_rats: tried == Some(block.path_of_rats()),
            other_path: tried.is_some_and(|way| way != block.path_of_rats()),
            shortest_before: Some(before.first_of(&apparatus.ways) == Some(0)),
            met_block: Some(with_block.first_of(&apparatus.ways) == Some(0)),
            arrived: with_block.arrived.is_some(),
            metres_over_shortest: over.map(|(driven, shortest)| driven / shortest),
            carried: Some(record.carried),
            why: why(with_block),
        }
    }

    /// Returns the run of the oracle, which drives nothing: a shortest way past the block that it
    /// knows of. `None` for another row.
    pub(super) fn of_oracle(job: &Job<'_>) -> Option<Self> {
        let (ORACLE, block) = Block::of_row(job.row)? else {
            return None;
        };
        let apparatus = drawn(ApparatusKind::Detour, job.seed);
        let taken = shortest_way(&blocked(&apparatus, block), &apparatus);
        let before = shortest_way(&apparatus.maze, &apparatus);
        Some(Self {
            as_rats: taken == Some(block.path_of_rats()),
            other_path: taken.is_some_and(|way| way != block.path_of_rats() && way != 0),
            shortest_before: Some(before == Some(0)),
            met_block: Some(taken == Some(0)),
            arrived: taken.is_some(),
            metres_over_shortest: taken.map(|_| 1.0),
            carried: Some(0),
            ..Self::default()
        })
    }
}

/// Returns why a drive was given up; empty if it was not.
pub(super) fn why(trip: &RatTrip) -> String {
    trip.end.why().to_owned()
}

/// Returns the drawing with its block.
fn blocked(apparatus: &Apparatus, block: Block) -> Maze {
    let mut maze = apparatus.maze.clone();
    let (cell, way) = apparatus.doors[block.door()];
    maze.set_wall(cell, way, true);
    maze
}

/// Returns the number of cells from the start box to the food.
fn steps_from_box(maze: &Maze) -> Option<u32> {
    let (start_box, _) = maze.landmarks().first_key_value()?;
    maze.steps_to_goal()[maze.grid().index(*start_box)]
}

/// Returns the index of the way on which the food is nearest.
fn shortest_way(maze: &Maze, apparatus: &Apparatus) -> Option<usize> {
    let steps = maze.steps_to_goal();
    let ways = apparatus.ways.iter().enumerate();
    let left = ways.filter_map(|(index, (cell, way))| {
        let beyond = maze.beside(*cell, *way)?;
        Some((steps[maze.grid().index(beyond)]?, index))
    });
    left.min().map(|(_, index)| index)
}

/// Returns the table.
pub(super) fn table() -> Table {
    let mut rows = Vec::new();
    for system in sent().chain([ORACLE]) {
        for block in Block::ALL {
            let row = Row::new(format!("{system}{BETWEEN}{}", block.name()));
            rows.push(match block {
                Block::A => row,
                Block::B => row.paper_aside("as_rats_percent", TOOK_PATH_3, NO_VERDICT),
            });
        }
    }
    Table::of::<DetourRun>(
        TABLE,
        "A detour: which path is tried first when the shortest one is blocked",
    )
    .metrics_from(DetourRun::abstained)
    .rows(rows)
    .note(
        "Three paths to the food, of growing length; paths 1 and 2 share their last stretch. The \
         system explores the maze, comes back to the start box and is sent to the food. Then a block \
         is put up, on path 1 alone (A) or on the shared stretch (B), and it is sent again. The \
         value of rats is second-hand: nine of ten took path 3 at block B (S. F. Walker, notes on \
         E. C. Tolman and C. H. Honzik, “Insight” in rats, 1930). The oracle knows the block.",
    )
}
