//! Maps of actions and bumps alone, without odometry, each of another world.

use rand::RngExt;
use tolman_arena::bump_walk::{BumpSight, BumpWalk};
use tolman_arena::family::{Family, FamilySize};
use tolman_experiment::{BoxError, Fields, Options, Record, Row, Table, record};
use tolman_maze::Direction;
use tolman_systems::stream;

use super::fresh::{QUICK, WORLD_STREAM, WORLDS};
use crate::arena::drawn;

/// Name of the table.
pub(super) const ODOMETRY_OFF: &str = "odometry off";

/// Stream of a run's seed from which a random walk is drawn.
const WALK_STREAM: u64 = 21;

/// How the robot chooses its moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Choice {
    /// As its map advises, until it counts as tested.
    Advice,
    /// Any, with equal probability.
    Random,
}

/// A row: a family of worlds, and how the robot moves in them.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlindRow {
    pub(super) row: &'static str,
    family: &'static str,
    size: FamilySize,
    choice: Choice,
    /// Largest number of moves.
    moves: u32,
}

impl BlindRow {
    const fn new(family: &'static str) -> Self {
        Self {
            row: family,
            family,
            size: FamilySize::Middle,
            choice: Choice::Advice,
            moves: 20_000,
        }
    }
}

/// Returns all rows.
pub(super) fn rows() -> Vec<BlindRow> {
    let families = Family::all()
        .into_iter()
        .map(|family| BlindRow::new(family.name));
    let large = ["perfect, large", "braided, large", "blocks, large"];
    let large = large.into_iter().zip(["perfect", "braided", "blocks"]);
    let large = large.map(|(row, family)| BlindRow {
        row,
        size: FamilySize::Large,
        ..BlindRow::new(family)
    });
    let walk = BlindRow {
        row: "braided, small, random walk",
        size: FamilySize::Small,
        choice: Choice::Random,
        moves: 5000,
        ..BlindRow::new("braided")
    };
    families.chain(large).chain([walk]).collect()
}

record! {
    /// A robot that felt its way through a world drawn for the run.
    struct BlindRun {
        /// Whether the map is complete and tells every walk as it would truly be.
        exact: bool => higher("exact"),
        /// Whether the robot says that its map is right: it is complete and was tested.
        said_right: bool => neither("said to be right"),
        /// Whether the robot says that a map is right that is not exact.
        false_right: bool => lower("wrongly said to be right"),
        /// Number of moves until the robot said that its map is right, or until its end.
        moves: u32 => lower("moves"),
        /// Number of places on the map.
        places: usize => neither("places on the map").decimals(1),
        /// Number of cells of the world that can be reached.
        cells: usize => neither("cells").decimals(1),
    }
}

/// Returns the table.
pub(super) fn table(rows: &[BlindRow], options: &Options) -> Table {
    let runs = options.runs_else(WORLDS, QUICK);
    Table::of::<BlindRun>(ODOMETRY_OFF, "Odometry off: actions and bumps alone, each run another world")
        .metrics_from(BlindRun::exact)
        .rows(rows.iter().map(|row| Row::new(row.row).runs(runs)))
        .note(
            "The robot goes from cell to cell to the north, east, south or west, or bumps and stays. \
             It sees nothing and measures nothing. It goes where its map advises until the map is \
             complete and has predicted eight moves for each place, or for 20,000 moves; the random \
             walk has 5000. Exact: the map is complete and equal to the world up to bisimulation. \
             Worlds are the families of the arena, of middle size where nothing is said.",
        )
}

impl BlindRow {
    /// Lets the robot make a map of a new world, and returns the record.
    pub(super) fn run(&self, seed: u64) -> Result<Fields, BoxError> {
        let maze = drawn(self.family, self.size, &mut stream(seed, WORLD_STREAM))?;
        let start = maze.start().map_or_else(Default::default, |(cell, _)| cell);
        let mut walk = BumpWalk::new(&maze, start, BumpSight::None);
        let mut rng = stream(seed, WALK_STREAM);
        let mut moves = 0;
        while moves < self.moves && !(self.choice == Choice::Advice && walk.map().is_tested()) {
            walk.step(match self.choice {
                Choice::Advice => walk.map().advice(),
                Choice::Random => Direction::ALL[rng.random_range(0..4)],
            })?;
            moves += 1;
        }
        let (exact, said_right) = (walk.is_exact(), walk.map().is_tested());
        let steps = maze.steps_to(&[start]);
        let run = BlindRun {
            exact,
            said_right,
            false_right: said_right && !exact,
            moves,
            places: walk.map().place_count(),
            cells: steps.iter().flatten().count(),
        };
        Ok(run.fields()?)
    }
}
